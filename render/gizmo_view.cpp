// SPDX-License-Identifier: MIT
#include "render/gizmo_view.h"

#include <algorithm>
#include <cmath>

namespace elbowroom {

bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool is_finite(const glm::dvec2& v) { return std::isfinite(v.x) && std::isfinite(v.y); }

Quat sound_rotation(const Quat& q) {
  const double length = glm::length(q);
  return std::isfinite(length) && length > 1e-12 ? q / length : Quat(1, 0, 0, 0);
}

Vec3 gizmo_axis(const Quat& rotation, GizmoSpace space, int axis) {
  Vec3 unit(0.0);
  unit[axis] = 1;
  return space == GizmoSpace::local ? sound_rotation(rotation) * unit : unit;
}

double GizmoView::aspect() const { return width / height; }

Vec3 GizmoView::to_pixels(const Vec3& place) const {
  const Vec3 at = project(camera, aspect(), place);
  return {at.x * width, at.y * height, at.z};
}

WorldRay GizmoView::ray(const glm::dvec2& pixel) const {
  return pick_ray(camera, aspect(), pixel.x / width, pixel.y / height);
}

double GizmoView::world_per_pixel(const Vec3& place) const {
  const Camera sound = sanitized(camera);
  const double depth =
      sound.orthographic ? sound.distance : glm::dot(sound.eye() - place, sound.backward());
  return 2.0 * depth * std::tan(0.5 * sound.field_of_view) / height;
}

Vec3 GizmoView::to_eye(const Vec3& place) const {
  const Camera sound = sanitized(camera);
  if (sound.orthographic) return sound.backward();
  const Vec3 way = sound.eye() - place;
  const double length = glm::length(way);
  return length > 0 ? way / length : sound.backward();
}

bool GizmoView::can_show(const Vec3& place) const {
  if (!is_finite(place) || !std::isfinite(width) || !std::isfinite(height)) return false;
  if (width < 1 || height < 1) return false;
  const Vec3 at = to_pixels(place);
  const Camera sound = sanitized(camera);
  return is_finite(at) && (sound.orthographic || at.z > 1e-6 * sound.distance);
}

double arm_length(const GizmoView& view, const Vec3& place, double size) {
  if (!std::isfinite(size) || size < 1) size = 84;
  size = std::min(size, 0.45 * std::min(view.width, view.height));
  const double length = size * view.world_per_pixel(place);
  if (sanitized(view.camera).orthographic) return length;
  return std::min(length, 0.5 * view.to_pixels(place).z);
}

glm::dvec2 pixel_of(const GizmoView& view, const Vec3& place) {
  return glm::dvec2(view.to_pixels(place));
}

}  // namespace elbowroom
