// SPDX-License-Identifier: MIT
// What one picture shows: the world's state and what is drawn over it. World space, the scene's
// units; times are in the states already. Plain values, no GL.
#pragma once

#include <optional>
#include <vector>

#include "core/scene/world.h"
#include "render/colour.h"

namespace elbowroom {

// How one actor is drawn.
struct ActorLook {
  bool visible = true;
  // By node, [0, 1]: joints whose body parts take the emphasis colour (the selected limb). Empty:
  // none.
  std::vector<float> emphasis;
  Rgb emphasis_colour = 0x3ecf9a;
  float emphasis_strength = 0;  // 0 leaves the parts their own colour
};

// A place in the problem colour: surfaces within the radius glow, and a ring marks it.
struct ContactMark {
  Vec3 place{0.0};
  double radius = 0;  // world; 0: Style::contact_radius × size
  bool ring = true;
};

// Triangles in the problem colour: those in contact, by index in the Mesh.
struct TriangleGlow {
  int actor = -1, mesh = -1;
  std::vector<std::uint8_t> levels{};  // one a triangle, 0 to 255; shorter: the rest is 0
};

// Another state of an actor (or of another version of it), translucent: an alternative, the clip
// behind its correction. Only the nearest surface of a ghost is seen; surfaces that coincide with
// solid ones give way to them.
struct Ghost {
  const Actor* actor = nullptr;  // must outlive the draw
  const ActorState* state = nullptr;
  Rgb colour = 0xa78bfa;
  float opacity = 0.55f;
  std::vector<float> parts{};  // by node, [0, 1]: only these joints' parts; empty: the whole figure
};

// A polyline: the way of a hand.
struct Trail {
  std::vector<Vec3> points;
  std::vector<Rgb> colours;  // one a point, or one for all
  float opacity = 1;
  float width = 0;       // pixels; 0: Style::trail_width
  double dash = 0;       // world length of a dash and its gap; 0: solid
  float hidden = 0.25f;  // how strong it shows through bodies
};

enum class MarkerShape { disc, ring, halo };

struct Marker {
  Vec3 place{0.0};
  Rgb colour = 0xffd166;
  float radius = 5;  // pixels
  MarkerShape shape = MarkerShape::disc;
  float opacity = 1;
  float hidden = 0.45f;
};

struct Frame {
  const World* world = nullptr;                     // null: an empty scene
  const std::vector<ActorState>* states = nullptr;  // of world_state_at; same count as actors
  std::vector<ActorLook> looks;                     // by actor; may be shorter
  std::vector<ContactMark> contacts;
  std::vector<TriangleGlow> glows;
  std::vector<Ghost> ghosts;
  std::vector<Trail> trails;
  std::vector<Marker> markers;
  double size = 0;  // scene_size(); 0: found from the world, which costs more
  std::optional<double>
      ground;              // height of the grid; else 0, or the lowest body if that is far off
  double pixel_scale = 1;  // of line widths and radii in pixels (screen scale)
  // Keep a copy of the picture without ghosts, trails and marks: a next frame with this set that
  // differs in nothing else is drawn over it. Costs a copy, and the memory of a second picture.
  bool keep_scene = false;
};

}  // namespace elbowroom
