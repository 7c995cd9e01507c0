// SPDX-License-Identifier: MIT
// An orbit camera: it looks at a focus from a direction and a distance. y is up, as in glTF.
//
// World space, the scene's units; angles in radians. All members are free to set; what a picture
// cannot be made with (NaN, distance 0) is put right by sanitized(), which every function here and
// the renderer apply. Pure values, any thread.
#pragma once

#include <vector>

#include "core/base/math.h"
#include "core/base/ray.h"
#include "render/bounds.h"

namespace elbowroom {

struct Camera {
  Vec3 focus{0.0};
  double azimuth = 0;    // of the eye as seen from the focus: 0 on the +z side (a glTF figure's
                         // front), positive towards +x
  double elevation = 0;  // of the eye above the focus, (−π/2, π/2)
  double distance = 5;   // eye to focus; scales the picture in ortho too
  double field_of_view = 0.5;  // vertical, perspective and ortho show the same at the focus
  bool orthographic = false;

  bool operator==(const Camera&) const = default;

  Vec3 backward() const;  // unit, from the focus to the eye
  Vec3 right() const;     // unit, the picture's x
  Vec3 up() const;        // unit, the picture's y
  Vec3 eye() const;
  // view_from_world with the focus at the origin of the input: far from the world's origin floats
  // only see differences from the focus.
  Mat4 view_from_focus() const;
  // clip_from_view for GL: z in [−1, 1]. near and far are distances from the eye, near > 0 in
  // perspective.
  Mat4 projection(double aspect, double near, double far) const;
};

// The camera with everything finite and in range; the identity for a sound one.
Camera sanitized(Camera camera);

// Front (1), side (3) and top (7) as in Blender, and the three-quarter view of a new scene.
enum class ViewPreset { front, side, top, three_quarter };
// Turns only; focus and distance stay. Front, side and top are orthographic if `orthographic`.
Camera with_preset(Camera camera, ViewPreset preset, bool orthographic = false);

// Drags: angles in radians; pan in fractions of the picture's height; factor > 1 goes away.
Camera orbited(Camera camera, double azimuth, double elevation);
Camera panned(Camera camera, double right, double up);
Camera zoomed(Camera camera, double factor);

// Moves focus and distance so that all points just fit, at the camera's angles, in a picture of
// that aspect (width / height) with `margin` of its half size left free on each side: the tightest
// fit there is. No points: the camera stays as it is.
Camera framed(const Camera& camera, const std::vector<Vec3>& points, double aspect,
              double margin = 0.1);
Camera framed(const Camera& camera, const Bounds& bounds, double aspect, double margin = 0.1);

// Position in the picture, x to the right and y down, both [0, 1], z the distance along the view;
// z ≤ 0 is behind the eye.
Vec3 project(const Camera& camera, double aspect, const Vec3& point);

// The ray of all points that project() takes to (x, y); unit direction. In perspective it begins at
// the eye; in ortho, where a picture shows what is behind the eye too, 10,000 distances before it.
// Positions that are not finite count as the picture's middle.
WorldRay pick_ray(const Camera& camera, double aspect, double x, double y);

}  // namespace elbowroom
