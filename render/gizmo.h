// SPDX-License-Identifier: MIT
// The handles by which a target is moved and turned with the mouse: what they look like, which of
// them is under the mouse, and what a drag of one comes to.
//
// Plain values, no GL and no user interface: the shapes are lines, polygons and discs in pixels for
// any 2D painter. Places and lengths are world space, the scene's units (metres in labels), angles
// radians, in double; pixels are from the viewport's top left, y down. Handles keep their size on
// the screen. Values that are not finite give an empty shape and a drag that does not move. Any
// thread; cost: some 400 points a shape.
#pragma once

#include <string>
#include <vector>

#include "core/base/math.h"
#include "render/camera.h"
#include "render/colour.h"

namespace elbowroom {

enum class GizmoMode { translate, rotate };
enum class GizmoSpace { world, local };  // whose axes the handles follow

enum class GizmoHandle {
  none,
  axis_x,  // along an axis
  axis_y,
  axis_z,
  plane_x,  // in the plane across that axis
  plane_y,
  plane_z,
  screen,  // in the picture's plane
  ring_x,  // about an axis
  ring_y,
  ring_z,
  ring_view,  // about the line of sight
};

// All colours of the gizmo.
struct GizmoColours {
  static constexpr Rgb axis[3] = {0xe5716b, 0x7cc98a, 0x5b9df0};
  static constexpr Rgb neutral = 0xe6e9ef;  // disc and outer ring
  static constexpr Rgb active = 0xffd166;   // under the mouse, or being dragged: the selection's
};

// The camera and the viewport's size in pixels.
struct GizmoView {
  Camera camera;
  double width = 1000, height = 700;

  double aspect() const;
  // Pixels, and in z the distance along the view.
  Vec3 to_pixels(const Vec3& place) const;
  WorldRay ray(const glm::dvec2& pixel) const;
  // How long a pixel is at a place's depth. Requires it before the eye, or ortho.
  double world_per_pixel(const Vec3& place) const;
  // Unit, from a place to the eye.
  Vec3 to_eye(const Vec3& place) const;
  // The place is before the eye, and all is finite.
  bool can_show(const Vec3& place) const;
};

struct GizmoPose {
  Vec3 place{0.0};
  Quat rotation{1, 0, 0, 0};
};

struct GizmoPart {
  enum class Kind { line, loop, polygon, disc };  // open line, closed line, filled and convex, disc
  Kind kind = Kind::line;
  GizmoHandle handle = GizmoHandle::none;
  std::vector<glm::dvec2> points{};  // pixels; of a disc its middle
  double size = 0;                   // width of a line, radius of a disc, pixels
  Rgb colour = 0xffffff;
  float opacity = 1;
  double depth = 0;  // mean distance along the view
  bool can_grab = false;
};

struct GizmoShape {
  std::vector<GizmoPart> parts;  // in painting order, far to near
};

struct GizmoOptions {
  GizmoMode mode = GizmoMode::translate;
  GizmoSpace space = GizmoSpace::world;
  GizmoHandle hovered = GizmoHandle::none;
  GizmoHandle dragged = GizmoHandle::none;  // the others step back
  double size = 84;                         // pixels, length of an arm; times the screen's scale
  double pixel_scale = 1;                   // of line widths
};

// Empty where the place can't be shown. Handles that look along the view (an axis at the eye, a
// plane from its edge) fade out and can't be grabbed.
GizmoShape make_gizmo(const GizmoView& view, const GizmoPose& pose, const GizmoOptions& options);

// What is under the mouse, within `tolerance` pixels: the disc before all others, else the nearest
// one; inside a square only a line or tip before it and nearer than 0.4 × tolerance comes first.
GizmoHandle hit(const GizmoShape& shape, const glm::dvec2& mouse, double tolerance = 6);

// How far a drag has gone. Axis: world length. Plane: along the two other axes in the order x, y,
// z. Screen: to the right and up in the picture. Ring: radians about the axis, more than a turn if
// the mouse went round.
struct GizmoAmount {
  double first = 0, second = 0;
};

// One drag of one handle. Everything is relative to where it began, by the view it began with: with
// the mouse back at its start the pose is the start's to the bit (after a whole turn about a ring:
// up to rounding, and the amount says so).
class GizmoDrag {
 public:
  GizmoDrag() = default;  // of nothing: does not move

  // `snap` > 0: the amounts are multiples of it (world length or radians).
  GizmoPose drag_to(const glm::dvec2& mouse, double snap = 0);
  // A typed amount instead of the mouse's. Not finite: the start.
  GizmoPose apply_amount(double first, double second = 0);

  GizmoHandle handle() const { return handle_; }
  const GizmoPose& start() const { return start_; }
  const GizmoPose& pose() const { return pose_; }
  const GizmoAmount& amount() const { return amount_; }
  // "+0.120 m X", "+0.120 m X, -0.050 m Z", "0.130 m", "35.0° Y"; local axes say so.
  std::string label() const;
  // What to paint besides the gizmo: the line of the axis, or the sector that has been turned.
  std::vector<GizmoPart> guides() const;

 private:
  friend GizmoDrag begin_drag(const GizmoView&, const GizmoPose&, GizmoSpace, GizmoHandle,
                              const glm::dvec2&, double);
  bool is_ring() const;
  int axis() const;  // 0, 1, 2; −1: none of its own
  double axis_amount(const glm::dvec2& mouse) const;
  Vec3 plane_point(const glm::dvec2& mouse) const;   // relative to the start's place
  double ring_angle(const glm::dvec2& mouse) const;  // relative to the grip, (−π, π]
  double allowed_part(const GizmoAmount& amount) const;
  GizmoPose set_amount(const GizmoAmount& amount);

  GizmoHandle handle_ = GizmoHandle::none;
  GizmoSpace space_ = GizmoSpace::world;
  GizmoView view_;
  GizmoPose start_, pose_;
  GizmoAmount amount_;
  glm::dvec2 grip_{0.0};
  double size_ = 84;
  // Axis: direction. Plane and screen: the two directions and, as `normal_`, what is across. Ring:
  // normal_ is the axis, first_ points from the middle to the grip.
  Vec3 first_{1, 0, 0}, second_{0, 1, 0}, normal_{0, 0, 1};
  double turned_ = 0;  // of a ring, before snapping
};

// `handle` may be one that can't be grabbed by mouse at present (a key chose it).
GizmoDrag begin_drag(const GizmoView& view, const GizmoPose& pose, GizmoSpace space,
                     GizmoHandle handle, const glm::dvec2& mouse, double size = 84);

}  // namespace elbowroom
