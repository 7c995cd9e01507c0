// SPDX-License-Identifier: MIT
// A filmstrip: the same motion at several times, side by side, with captions; one row a version
// ("Before", "After"). Needs no display.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/scene/world.h"
#include "render/frame.h"
#include "render/picture.h"
#include "render/shot.h"
#include "render/style.h"

namespace elbowroom {

struct FilmstripRow {
  const World* world = nullptr;  // required; must outlive the call
  std::string label;             // over the row; may be empty
  Rgb label_colour = 0x9aa3b2;
  // By time: where surfaces are in contact. Not given (empty): nothing is said of contacts; given:
  // each frame's caption says "contact" or "clear".
  std::vector<std::vector<ContactMark>> contacts;
  std::vector<Trail> trails;  // in every frame
  // The limb of FilmstripRequest::limb takes this colour.
  Rgb limb_colour = 0x3ecf9a;
  float limb_strength = 0;
  // Another version as a ghost behind this one: its actor, and only the limb if there is one.
  const World* ghost = nullptr;
};

struct FilmstripRequest {
  std::vector<FilmstripRow> rows;         // at least one
  std::vector<double> times;              // seconds, at least one, finite
  int columns = 0;                        // frames a line; 0: all, up to six
  int frame_width = 0, frame_height = 0;  // pixels at scale 1; 0: chosen to suit the motion
  std::string title;
  std::string caption;           // quiet text under the title
  int actor = 0, character = 0;  // the figure
  std::vector<int> limb;         // nodes of the acting limb; may be empty
  std::optional<Vec3> forward;   // the way the figure faces; found from its motion if not given

  // The camera; see render/shot.h. What is not given is chosen.
  std::optional<double> azimuth, elevation;  // radians
  std::optional<Vec3> focus;
  double extent = 0;
  CameraMove move = CameraMove::automatic;

  double scale = 1;  // of everything: 2 for a screen of double density
  bool fine = true;  // each frame is drawn at twice its size and reduced
  Style style = strip_style();

  // The house style with light that comes with the camera.
  static Style strip_style();
};

// Draws in an offscreen context of its own. Errors: nothing to draw, sizes or times out of range,
// no EGL. `warnings` (may be null) is told of missing fonts and of what was left out.
Result<Picture> render_filmstrip(const FilmstripRequest& request,
                                 std::vector<std::string>* warnings = nullptr);

// The same with a renderer whose context is current.
Result<Picture> render_filmstrip(SceneRenderer& renderer, const FilmstripRequest& request,
                                 std::vector<std::string>* warnings = nullptr);

}  // namespace elbowroom
