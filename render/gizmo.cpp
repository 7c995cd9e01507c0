// SPDX-License-Identifier: MIT
#include "render/gizmo.h"

#include <algorithm>
#include <cmath>

#include "render/gizmo_view.h"

namespace elbowroom {
namespace {

using Kind = GizmoPart::Kind;

GizmoHandle handle_of(GizmoHandle first, int axis) {
  return static_cast<GizmoHandle>(static_cast<int>(first) + axis);
}

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

std::vector<glm::dvec2> convex_hull(std::vector<glm::dvec2> points) {
  std::sort(points.begin(), points.end(), [](const glm::dvec2& a, const glm::dvec2& b) {
    return a.x != b.x ? a.x < b.x : a.y < b.y;
  });
  std::vector<glm::dvec2> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t begin = hull.size();
    for (const auto& p : points) {
      while (hull.size() >= begin + 2 &&
             cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0) {
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

double distance_to_segment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 way = b - a;
  const double square = glm::dot(way, way);
  const double u = square > 0 ? std::clamp(glm::dot(p - a, way) / square, 0.0, 1.0) : 0.0;
  return glm::length(p - a - u * way);
}

double distance_to_line(const GizmoPart& part, const glm::dvec2& p) {
  double nearest = std::numeric_limits<double>::infinity();
  const std::size_t count = part.points.size();
  for (std::size_t i = 0; i + 1 < count; ++i) {
    nearest = std::min(nearest, distance_to_segment(p, part.points[i], part.points[i + 1]));
  }
  if (part.kind != Kind::line && count > 1) {
    nearest = std::min(nearest, distance_to_segment(p, part.points.back(), part.points.front()));
  }
  return nearest;
}

bool inside(const GizmoPart& part, const glm::dvec2& p) {
  bool left = false, right = false;
  for (std::size_t i = 0; i < part.points.size(); ++i) {
    const glm::dvec2& a = part.points[i];
    const glm::dvec2& b = part.points[(i + 1) % part.points.size()];
    (cross(b - a, p - a) < 0 ? right : left) = true;
  }
  return part.points.size() > 2 && left != right;
}

float faded(double value, double gone, double full) {
  const double u = std::clamp((value - gone) / (full - gone), 0.0, 1.0);
  return static_cast<float>(u * u * (3.0 - 2.0 * u));
}

bool is_plane(GizmoHandle handle) {
  return handle >= GizmoHandle::plane_x && handle <= GizmoHandle::plane_z;
}

class Builder {
 public:
  Builder(const GizmoView& view, const GizmoPose& pose, const GizmoOptions& options)
      : view_(view),
        options_(options),
        place_(pose.place),
        arm_(arm_length(view, pose.place, options.size)),
        to_eye_(view.to_eye(pose.place)) {
    for (int i = 0; i < 3; ++i) axes_[i] = gizmo_axis(pose.rotation, options.space, i);
    scale_ =
        std::isfinite(options.pixel_scale) && options.pixel_scale > 0 ? options.pixel_scale : 1.0;
  }

  GizmoShape translate() {
    for (int i = 0; i < 3; ++i) {
      add_arm(i);
      add_plane(i);
    }
    GizmoPart disc = part(Kind::disc, GizmoHandle::screen, GizmoColours::neutral, 1, true);
    disc.points = {pixel_of(view_, place_)};
    disc.size = 6.5 * scale_;
    disc.depth = view_.to_pixels(place_).z - arm_;  // over the arms
    shape_.parts.push_back(disc);
    return sorted();
  }

  GizmoShape rotate() {
    for (int i = 0; i < 3; ++i) add_ring(i);
    std::vector<Vec3> circle;
    const Vec3 x = any_across(to_eye_), y = glm::cross(to_eye_, x);
    for (int i = 0; i < kRingPoints; ++i) {
      const double angle = kPi2 * i / kRingPoints;
      circle.push_back(place_ + kViewRing * arm_ * (std::cos(angle) * x + std::sin(angle) * y));
    }
    add_line(Kind::loop, GizmoHandle::ring_view, circle, GizmoColours::neutral, 0.55f, true);
    return sorted();
  }

 private:
  static Vec3 any_across(const Vec3& v) {
    return glm::normalize(glm::cross(v, std::abs(v.y) < 0.9 ? Vec3(0, 1, 0) : Vec3(1, 0, 0)));
  }

  GizmoPart part(Kind kind, GizmoHandle handle, Rgb colour, float opacity, bool can_grab) const {
    GizmoPart out;
    out.kind = kind;
    out.handle = handle;
    const bool chosen = handle == options_.dragged ||
                        (options_.dragged == GizmoHandle::none && handle == options_.hovered);
    const bool others = options_.dragged != GizmoHandle::none && handle != options_.dragged;
    out.colour = chosen ? GizmoColours::active : colour;
    out.opacity = others ? 0.3f * opacity : opacity;
    out.can_grab = can_grab;
    out.size = 2.5 * scale_;
    return out;
  }

  void place_points(GizmoPart& out, const std::vector<Vec3>& points) const {
    double depth = 0;
    for (const auto& p : points) {
      const Vec3 at = view_.to_pixels(p);
      out.points.emplace_back(at.x, at.y);
      depth += at.z;
    }
    out.depth = depth / static_cast<double>(points.size());
  }

  void add_line(Kind kind, GizmoHandle handle, const std::vector<Vec3>& points, Rgb colour,
                float opacity, bool can_grab) {
    if (points.size() < 2) return;
    GizmoPart out = part(kind, handle, colour, opacity, can_grab);
    place_points(out, points);
    shape_.parts.push_back(std::move(out));
  }

  void add_arm(int i) {
    const Vec3 axis = axes_[i];
    const GizmoHandle handle = handle_of(GizmoHandle::axis_x, i);
    const double sine = glm::length(glm::cross(axis, to_eye_));
    const float opacity = faded(sine, 0.08, 0.25);
    if (opacity <= 0) return;
    const bool can_grab = opacity > 0.4f;
    const Rgb colour = GizmoColours::axis[i];
    add_line(Kind::line, handle, {place_ + 0.14 * arm_ * axis, place_ + 0.84 * arm_ * axis}, colour,
             opacity, can_grab);
    // The tip, a cone: its outline is the hull of its base and its point.
    GizmoPart tip = part(Kind::polygon, handle, colour, opacity, can_grab);
    const Vec3 x = any_across(axis), y = glm::cross(axis, x);
    std::vector<Vec3> cone = {place_ + arm_ * axis};
    for (int k = 0; k < 16; ++k) {
      const double angle = kPi2 * k / 16;
      cone.push_back(place_ +
                     arm_ * (0.82 * axis + 0.065 * (std::cos(angle) * x + std::sin(angle) * y)));
    }
    place_points(tip, cone);
    tip.points = convex_hull(tip.points);
    shape_.parts.push_back(std::move(tip));
  }

  void add_plane(int i) {
    const float opacity = faded(std::abs(glm::dot(axes_[i], to_eye_)), 0.1, 0.3);
    if (opacity <= 0) return;
    const bool can_grab = opacity > 0.4f;
    const GizmoHandle handle = handle_of(GizmoHandle::plane_x, i);
    // On the sides towards the eye: like the faces of a cube, none covers another.
    const auto facing = [this](const Vec3& axis) {
      return glm::dot(axis, to_eye_) < 0 ? -axis : axis;
    };
    const Vec3 a = facing(axes_[(i + 1) % 3]), b = facing(axes_[(i + 2) % 3]);
    const double from = 0.26 * arm_, to = 0.46 * arm_;
    const std::vector<Vec3> corners = {place_ + from * a + from * b, place_ + to * a + from * b,
                                       place_ + to * a + to * b, place_ + from * a + to * b};
    GizmoPart fill = part(Kind::polygon, handle, GizmoColours::axis[i], 0.32f * opacity, can_grab);
    place_points(fill, corners);
    shape_.parts.push_back(std::move(fill));
    add_line(Kind::loop, handle, corners, GizmoColours::axis[i], 0.8f * opacity, can_grab);
    shape_.parts.back().size = 1.25 * scale_;
    shape_.parts.back().can_grab = false;  // the square's inside is what is grabbed
  }

  // The half towards the eye can be grabbed; the other one is shown faintly.
  void add_ring(int i) {
    const GizmoHandle handle = handle_of(GizmoHandle::ring_x, i);
    const Vec3 axis = axes_[i], toward = to_eye_ - glm::dot(to_eye_, axis) * axis;
    const double slant = glm::length(toward);
    const Vec3 x = slant > 1e-6 ? toward / slant : any_across(axis), y = glm::cross(axis, x);
    const double radius = kRingRadius * arm_;
    const auto arc = [&](double from, double to) {
      std::vector<Vec3> points;
      const int count = std::max(2, static_cast<int>(kRingPoints * (to - from) / kPi2) + 1);
      for (int k = 0; k < count; ++k) {
        const double angle = from + (to - from) * k / (count - 1);
        points.push_back(place_ + radius * (std::cos(angle) * x + std::sin(angle) * y));
      }
      return points;
    };
    // A ring seen face on is whole.
    if (slant < 0.15) {
      auto points = arc(0, kPi2);
      points.pop_back();
      add_line(Kind::loop, handle, points, GizmoColours::axis[i], 1, true);
      return;
    }
    add_line(Kind::line, handle, arc(0.5 * kPi, 1.5 * kPi), GizmoColours::axis[i], 0.18f, false);
    add_line(Kind::line, handle, arc(-0.5 * kPi, 0.5 * kPi), GizmoColours::axis[i], 1, true);
  }

  GizmoShape sorted() {
    std::stable_sort(shape_.parts.begin(), shape_.parts.end(),
                     [](const GizmoPart& a, const GizmoPart& b) { return a.depth > b.depth; });
    return std::move(shape_);
  }

  const GizmoView& view_;
  const GizmoOptions& options_;
  Vec3 place_;
  double arm_, scale_ = 1;
  Vec3 to_eye_, axes_[3];
  GizmoShape shape_;
};

}  // namespace

GizmoShape make_gizmo(const GizmoView& view, const GizmoPose& pose, const GizmoOptions& options) {
  if (!view.can_show(pose.place)) return {};
  Builder builder(view, pose, options);
  return options.mode == GizmoMode::translate ? builder.translate() : builder.rotate();
}

GizmoHandle hit(const GizmoShape& shape, const glm::dvec2& mouse, double tolerance) {
  if (!is_finite(mouse) || !(tolerance >= 0)) return GizmoHandle::none;
  GizmoHandle best = GizmoHandle::none;
  int best_rank = 2;
  double best_distance = 0;
  for (const auto& part : shape.parts) {
    if (!part.can_grab) continue;
    double distance = 0;
    int rank = 1;
    bool covers = false;  // what is farther
    if (part.kind == Kind::disc) {
      distance = std::max(glm::length(mouse - part.points.front()) - part.size, 0.0);
      if (distance > 0.5 * tolerance) continue;
      rank = 0;
    } else if (part.kind == Kind::polygon) {
      const bool plane = is_plane(part.handle);
      covers = plane && inside(part, mouse);
      if (!covers && !inside(part, mouse)) distance = distance_to_line(part, mouse);
      if (distance > (plane ? 0.25 : 1.0) * tolerance) continue;
      // A line before the square that is as near as that is meant, though the mouse is inside.
      if (plane) distance += 0.4 * tolerance;
    } else {
      distance = distance_to_line(part, mouse);
      if (distance > tolerance + 0.5 * part.size) continue;
    }
    // Later parts are nearer: of equals they win.
    if (rank < best_rank || (rank == best_rank && (covers || distance <= best_distance))) {
      best = part.handle;
      best_rank = rank;
      best_distance = distance;
    }
  }
  return best;
}

}  // namespace elbowroom
