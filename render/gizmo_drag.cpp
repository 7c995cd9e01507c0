// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "render/gizmo.h"
#include "render/gizmo_view.h"

namespace elbowroom {
namespace {

// Below this a direction is too near the line of sight for a point under the mouse to say anything
// about it: the mouse's own way does then.
constexpr double kEndOn = 0.08;
// A ring whose axis is farther from the line of sight than this cosine is an edge to the eye.
constexpr double kFlatRing = 0.3;
// Places that a drag reaches lie between these multiples of the start's depth: a mouse at the
// vanishing point does not throw the target to infinity.
constexpr double kNearest = 0.05, kFarthest = 20;

double snapped(double value, double snap) {
  if (!std::isfinite(snap) || snap <= 0) return value;
  const double steps = std::round(value / snap);
  return std::isfinite(steps * snap) ? steps * snap : value;
}

}  // namespace

bool GizmoDrag::is_ring() const { return handle_ >= GizmoHandle::ring_x; }

int GizmoDrag::axis() const {
  const int h = static_cast<int>(handle_);
  for (const auto first : {GizmoHandle::axis_x, GizmoHandle::plane_x, GizmoHandle::ring_x}) {
    const int i = h - static_cast<int>(first);
    if (i >= 0 && i < 3) return i;
  }
  return -1;
}

GizmoDrag begin_drag(const GizmoView& view, const GizmoPose& pose, GizmoSpace space,
                     GizmoHandle handle, const glm::dvec2& mouse, double size) {
  GizmoDrag drag;
  drag.start_ = drag.pose_ = pose;
  if (handle == GizmoHandle::none || !view.can_show(pose.place) || !is_finite(mouse)) return drag;
  drag.handle_ = handle;
  drag.space_ = space;
  drag.view_ = view;
  drag.view_.camera = sanitized(view.camera);
  drag.grip_ = mouse;
  drag.size_ = size;
  const Camera& camera = drag.view_.camera;
  const Vec3 to_eye = view.to_eye(pose.place);
  const int axis = drag.axis();
  const auto axis_at = [&](int i) { return gizmo_axis(pose.rotation, space, i % 3); };
  if (drag.is_ring()) {
    drag.normal_ = axis >= 0 ? axis_at(axis) : to_eye;
    const Vec3 grip = drag.plane_point(mouse);
    drag.first_ = glm::length(grip) > 0 ? glm::normalize(grip) : camera.right();
    drag.second_ = glm::cross(drag.normal_, drag.first_);
  } else if (handle == GizmoHandle::screen) {
    drag.first_ = camera.right();
    drag.second_ = camera.up();
    drag.normal_ = camera.backward();
  } else if (handle >= GizmoHandle::plane_x) {
    const int low = axis == 0 ? 1 : 0, high = axis == 2 ? 1 : 2;
    drag.first_ = axis_at(low);
    drag.second_ = axis_at(high);
    drag.normal_ = axis_at(axis);
  } else {
    drag.first_ = axis_at(axis);
  }
  return drag;
}

// Along the axis' line in the picture: how far the mouse is from the start there is a linear
// fraction of the place on the axis.
double GizmoDrag::axis_amount(const glm::dvec2& mouse) const {
  const Camera& camera = view_.camera;
  const double per_pixel = view_.world_per_pixel(start_.place);
  const Vec3 to_eye = view_.to_eye(start_.place);
  if (glm::length(glm::cross(first_, to_eye)) < kEndOn) {
    // The axis points at the eye: up is along it.
    return (grip_.y - mouse.y) * per_pixel;
  }
  const Vec3 from_eye = start_.place - camera.eye();
  const double depth = -glm::dot(from_eye, camera.backward());
  const double deeper = camera.orthographic ? 0.0 : -glm::dot(first_, camera.backward());
  // A place s along the axis is seen at s · way / (1 + s · deeper / depth) from the start.
  glm::dvec2 way(glm::dot(first_, camera.right()), -glm::dot(first_, camera.up()));
  if (!camera.orthographic) {
    way -= glm::dvec2(glm::dot(from_eye, camera.right()), -glm::dot(from_eye, camera.up())) *
           (deeper / depth);
  }
  way /= per_pixel;
  const double speed = glm::length(way);
  const glm::dvec2 middle = pixel_of(view_, start_.place);
  const auto place_at = [&](const glm::dvec2& pixel) {
    const double along = glm::dot(pixel - middle, way / speed);
    double left = speed;
    if (!camera.orthographic) {
      left = std::clamp(speed - along * deeper / depth, speed / kFarthest, speed / kNearest);
    }
    return along / left;
  };
  return place_at(mouse) - place_at(grip_);
}

// Where the mouse's ray meets the plane through the start's place across normal_.
Vec3 GizmoDrag::plane_point(const glm::dvec2& mouse) const {
  const Camera& camera = view_.camera;
  const Vec3 to_eye = view_.to_eye(start_.place);
  const double per_pixel = view_.world_per_pixel(start_.place);
  const double facing = glm::dot(normal_, to_eye);
  if (std::abs(facing) < kEndOn) {
    // Seen from its edge: what the mouse's way in the picture leaves within the plane.
    const glm::dvec2 way = (mouse - pixel_of(view_, start_.place)) * per_pixel;
    const Vec3 moved = way.x * camera.right() - way.y * camera.up();
    return moved - glm::dot(moved, normal_) * normal_;
  }
  WorldRay ray = view_.ray(mouse);
  // From the plane through the start across the view, so that the way to go is short.
  const double behind = glm::dot(ray.origin - start_.place, camera.backward());
  const double forward = -glm::dot(ray.direction, camera.backward());
  const Vec3 on_picture = ray.origin + ray.direction * (behind / forward) - start_.place;
  const double height = glm::dot(on_picture, normal_);
  double slope = -glm::dot(ray.direction, normal_) / forward;
  // Beyond the horizon the ray does not come down any more: as far as is allowed, then.
  const double sign = facing > 0 ? 1.0 : -1.0;
  slope = sign * std::max(sign * slope, 1e-9);
  double deeper = height / slope;
  if (!camera.orthographic) {
    const double depth = view_.to_pixels(start_.place).z;
    deeper = std::clamp(deeper, (kNearest - 1) * depth, (kFarthest - 1) * depth);
  } else {
    const double reach = kFarthest * camera.distance;
    deeper = std::clamp(deeper, -reach, reach);
  }
  const Vec3 point = on_picture + deeper / forward * ray.direction;
  return point - glm::dot(point, normal_) * normal_;
}

double GizmoDrag::ring_angle(const glm::dvec2& mouse) const {
  const Vec3 to_eye = view_.to_eye(start_.place);
  const double facing = glm::dot(normal_, to_eye);
  if (std::abs(facing) < kFlatRing) {
    // The ring's near side moves across the picture: a radius is a radian.
    const Vec3 tangent = glm::normalize(glm::cross(normal_, to_eye));
    const glm::dvec2 way(glm::dot(tangent, view_.camera.right()),
                         -glm::dot(tangent, view_.camera.up()));
    const double radius =
        kRingRadius * arm_length(view_, start_.place, size_) / view_.world_per_pixel(start_.place);
    return glm::dot(mouse - grip_, way) / std::max(glm::length(way) * radius, 1e-9);
  }
  if (mouse == grip_) return 0;  // to the bit
  const Vec3 point = plane_point(mouse);
  const double x = glm::dot(point, first_), y = glm::dot(point, second_);
  return x == 0 && y == 0 ? std::remainder(turned_, kPi2) : std::atan2(y, x);
}

// The part of a move that keeps the place before the eye.
double GizmoDrag::allowed_part(const GizmoAmount& amount) const {
  if (view_.camera.orthographic) return 1;
  const Vec3 moved = amount.first * first_ + amount.second * second_;
  const double nearer = glm::dot(moved, view_.camera.backward());
  const double most = (1 - kNearest) * view_.to_pixels(start_.place).z;
  return nearer > most ? most / nearer : 1;
}

GizmoPose GizmoDrag::set_amount(const GizmoAmount& amount) {
  amount_ = amount;
  pose_ = start_;
  if (is_ring()) {
    if (amount.first != 0) {
      pose_.rotation =
          glm::normalize(quat_from_rotation_vector(std::remainder(amount.first, kPi2) * normal_) *
                         sound_rotation(start_.rotation));
    }
  } else {
    pose_.place = start_.place + amount.first * first_ + amount.second * second_;
    if (!is_finite(pose_.place)) pose_ = start_, amount_ = {};
  }
  return pose_;
}

GizmoPose GizmoDrag::drag_to(const glm::dvec2& mouse, double snap) {
  if (handle_ == GizmoHandle::none || !is_finite(mouse)) return pose_;
  GizmoAmount amount;
  if (is_ring()) {
    const double facing = std::abs(glm::dot(normal_, view_.to_eye(start_.place)));
    const double angle = ring_angle(mouse);
    // Round and round: the nearest of all angles that look alike.
    turned_ = facing < kFlatRing ? angle : angle + kPi2 * std::round((turned_ - angle) / kPi2);
    amount.first = snapped(turned_, snap);
    return set_amount(amount);
  }
  if (handle_ <= GizmoHandle::axis_z) {
    amount.first = axis_amount(mouse);
  } else {
    const Vec3 moved = plane_point(mouse) - plane_point(grip_);
    amount = {glm::dot(moved, first_), glm::dot(moved, second_)};
  }
  const double part = allowed_part(amount);
  amount = {part * amount.first, part * amount.second};
  const GizmoAmount steps{snapped(amount.first, snap), snapped(amount.second, snap)};
  return set_amount(allowed_part(steps) < 1 ? amount : steps);
}

GizmoPose GizmoDrag::apply_amount(double first, double second) {
  if (handle_ == GizmoHandle::none) return pose_;
  const bool two = handle_ >= GizmoHandle::plane_x && handle_ <= GizmoHandle::screen;
  if (!two) second = 0;
  if (!std::isfinite(first) || !std::isfinite(second)) return set_amount({});
  if (is_ring()) turned_ = first;
  return set_amount({first, second});
}

std::string GizmoDrag::label() const {
  static constexpr const char* kNames[] = {"X", "Y", "Z"};
  char text[128] = "";
  const int i = axis();
  const auto length = [](double value) { return value == 0 ? 0.0 : value; };  // no "-0"
  const auto digits = [](double value) { return std::abs(value) < 9.9995 ? 3 : 2; };
  const double a = length(amount_.first), b = length(amount_.second);
  if (handle_ == GizmoHandle::none) return text;
  if (is_ring()) {
    const double degrees = length(std::round(10.0 * glm::degrees(a)) / 10.0);
    std::snprintf(text, sizeof text, "%.1f\u00b0 %s", degrees, i < 0 ? "view" : kNames[i]);
  } else if (handle_ == GizmoHandle::screen) {
    const double way = std::hypot(a, b);
    std::snprintf(text, sizeof text, "%.*f m", digits(way), way);
  } else if (handle_ >= GizmoHandle::plane_x) {
    std::snprintf(text, sizeof text, "%+.*f m %s, %+.*f m %s", digits(a), a, kNames[i == 0 ? 1 : 0],
                  digits(b), b, kNames[i == 2 ? 1 : 2]);
  } else {
    std::snprintf(text, sizeof text, "%+.*f m %s", digits(a), a, kNames[i]);
  }
  std::string out = text;
  if (space_ == GizmoSpace::local && i >= 0) out += " local";
  return out;
}

std::vector<GizmoPart> GizmoDrag::guides() const {
  std::vector<GizmoPart> parts;
  if (handle_ == GizmoHandle::none) return parts;
  const int i = axis();
  const Rgb colour = i >= 0 ? GizmoColours::axis[i] : GizmoColours::neutral;
  const double arm = arm_length(view_, start_.place, size_);
  if (is_ring()) {
    // The sector from the grip; of more than a turn the whole disc.
    const Vec3 to_eye = view_.to_eye(start_.place);
    const bool flat = std::abs(glm::dot(normal_, to_eye)) < kFlatRing;
    const Vec3 x = flat ? glm::normalize(to_eye - glm::dot(to_eye, normal_) * normal_) : first_;
    const Vec3 y = glm::cross(normal_, x);
    const double angle = std::clamp(amount_.first, -kPi2, kPi2);
    const double radius = (i >= 0 ? kRingRadius : kViewRing) * arm;
    // Convex pieces of a quarter turn at most.
    const int pieces = std::max(1, static_cast<int>(std::ceil(std::abs(angle) / (0.5 * kPi))));
    for (int piece = 0; piece < pieces && angle != 0; ++piece) {
      GizmoPart sector;
      sector.kind = GizmoPart::Kind::polygon;
      sector.colour = GizmoColours::active;
      sector.opacity = 0.22f;
      sector.points.push_back(pixel_of(view_, start_.place));
      for (int k = 0; k <= 16; ++k) {
        const double at = angle * (piece + k / 16.0) / pieces;
        sector.points.push_back(
            pixel_of(view_, start_.place + radius * (std::cos(at) * x + std::sin(at) * y)));
      }
      parts.push_back(std::move(sector));
    }
    return parts;
  }
  // Lines through the start, as far as the view goes and no farther than shortly before the eye.
  const auto add_line = [&](const Vec3& direction, Rgb line_colour) {
    const Camera& camera = view_.camera;
    const double depth = view_.to_pixels(start_.place).z;
    const double deeper = camera.orthographic ? 0.0 : -glm::dot(direction, camera.backward());
    const double far = 4000.0 * view_.world_per_pixel(start_.place);
    double from = -far, to = far;
    if (deeper > 0) from = std::max(from, -(1 - kNearest) * depth / deeper);
    if (deeper < 0) to = std::min(to, -(1 - kNearest) * depth / deeper);
    GizmoPart line;
    line.points = {pixel_of(view_, start_.place + from * direction),
                   pixel_of(view_, start_.place + to * direction)};
    line.size = 1;
    line.colour = line_colour;
    line.opacity = 0.5f;
    parts.push_back(std::move(line));
  };
  if (handle_ <= GizmoHandle::axis_z) {
    add_line(first_, colour);
  } else if (handle_ != GizmoHandle::screen) {
    add_line(first_, GizmoColours::axis[i == 0 ? 1 : 0]);
    add_line(second_, GizmoColours::axis[i == 2 ? 1 : 2]);
  }
  return parts;
}

}  // namespace elbowroom
