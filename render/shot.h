// SPDX-License-Identifier: MIT
// Where to look from: a camera for each time of a strip, such that the figure, what it runs into
// and the acting limb are seen well, in the same size in every frame.
//
// The figure and the parts of other bodies near it are framed; far geometry (a ground of 100 m) is
// not. The direction is a three-quarter view from the front, on the side and at the height from
// which contacts and limb are least hidden. If the figure walks far, the camera walks with it.
// Deterministic. World space, radians, seconds.
#pragma once

#include <optional>
#include <vector>

#include "render/camera.h"
#include "render/scene_renderer.h"

namespace elbowroom {

enum class CameraMove { automatic, fixed, follow };

struct ShotRequest {
  std::vector<const World*> worlds;  // all are framed alike; the first decides on sides
  std::vector<double> times;
  int actor = 0;                // whose file holds the figure
  int character = 0;            // in its model; without characters all bodies are the figure
  std::vector<int> limb;        // nodes of the acting limb; may be empty
  std::optional<Vec3> forward;  // the way the figure faces; found from its motion if not given
  std::vector<std::vector<Vec3>> contacts;  // by time; may be shorter

  std::optional<double> azimuth, elevation;  // as in Camera; what is not given is chosen
  std::optional<Vec3> focus;                 // look here instead, at `extent` (radius) of the scene
  double extent = 0;                         // 0: 0.45 × the figure's height
  CameraMove move = CameraMove::automatic;
  double margin = 0.1;  // of the picture's half size, left free
  double field_of_view = 0.42;
};

struct Shot {
  std::vector<Camera> cameras;  // by time; framed for `aspect`
  double aspect = 1;            // width / height
  double size = 1;              // the figure's height
  double ground = 0;            // height the figure stands at
  bool follows = false;
};

// `aspect` > 0 is kept; 0 lets the shot choose one between 0.62 and 1.7 that suits the motion.
// Requires at least one world and one time. Cost: up to 68 pictures of 128 × 128 pixels.
Shot plan_shot(SceneRenderer& renderer, const ShotRequest& request, double aspect);

}  // namespace elbowroom
