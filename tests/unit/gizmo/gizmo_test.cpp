// SPDX-License-Identifier: MIT
// Drags come to what the mouse points at, and handles are where they are drawn.
#include "render/gizmo.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/random.h"

namespace elbowroom::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

constexpr GizmoHandle kAxes[] = {GizmoHandle::axis_x, GizmoHandle::axis_y, GizmoHandle::axis_z};
constexpr GizmoHandle kPlanes[] = {GizmoHandle::plane_x, GizmoHandle::plane_y,
                                   GizmoHandle::plane_z};
constexpr GizmoHandle kRings[] = {GizmoHandle::ring_x, GizmoHandle::ring_y, GizmoHandle::ring_z};

GizmoView random_view(Random& random, const Vec3& about, bool orthographic) {
  GizmoView view;
  view.camera.azimuth = random.uniform(-3, 3);
  view.camera.elevation = random.uniform(-1.4, 1.4);
  view.camera.distance = std::pow(10.0, random.uniform(-2, 3));
  view.camera.field_of_view = random.uniform(0.3, 1.0);
  view.camera.orthographic = orthographic;
  view.camera.focus =
      about + 0.15 * view.camera.distance *
                  Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  view.width = random.uniform(300, 2000);
  view.height = random.uniform(300, 1200);
  return view;
}

GizmoPose random_pose(Random& random) {
  GizmoPose pose;
  pose.place = 3.0 * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  pose.rotation = quat_from_rotation_vector(
      2.0 * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)));
  return pose;
}

Vec3 axis_of(const GizmoPose& pose, GizmoSpace space, int i) {
  Vec3 unit(0.0);
  unit[i] = 1;
  return space == GizmoSpace::local ? pose.rotation * unit : unit;
}

glm::dvec2 pixel(const GizmoView& view, const Vec3& place) {
  return glm::dvec2(view.to_pixels(place));
}

// Length of 100 pixels at the pose's place.
double reach_of(const GizmoView& view, const GizmoPose& pose) {
  return 100 * view.world_per_pixel(pose.place);
}

TEST(GizmoDrag, AxisFollowsTheMouseAlongItsLine) {
  Random random(1);
  int tried = 0;
  for (int i = 0; i < 600; ++i) {
    const GizmoPose pose = random_pose(random);
    const GizmoView view = random_view(random, pose.place, i % 2 == 0);
    const auto space = i % 3 == 0 ? GizmoSpace::world : GizmoSpace::local;
    const int k = i % 3;
    const Vec3 axis = axis_of(pose, space, k);
    if (glm::length(glm::cross(axis, view.to_eye(pose.place))) < 0.2) continue;
    ++tried;
    const double reach = reach_of(view, pose);
    const double from = reach * random.uniform(0.1, 0.9), to = reach * random.uniform(-2, 2);
    GizmoDrag drag = begin_drag(view, pose, space, kAxes[k], pixel(view, pose.place + from * axis));
    const glm::dvec2 goal = pixel(view, pose.place + to * axis);
    GizmoPose moved = drag.drag_to(goal);
    EXPECT_LT(glm::length(moved.place - (pose.place + (to - from) * axis)), 1e-7 * reach);
    EXPECT_EQ(moved.rotation, pose.rotation);
    EXPECT_NEAR(drag.amount().first, to - from, 1e-7 * reach);
    // Beside the line makes no difference.
    const glm::dvec2 along = goal - pixel(view, pose.place);
    const glm::dvec2 aside(-along.y, along.x);
    EXPECT_LT(glm::length(drag.drag_to(goal + 0.7 * aside).place - moved.place), 1e-6 * reach);
    // And back: to the bit.
    moved = drag.drag_to(pixel(view, pose.place + from * axis));
    EXPECT_EQ(moved.place, pose.place);
  }
  EXPECT_GT(tried, 400);
}

TEST(GizmoDrag, PlaneAndScreenFollowTheMouse) {
  Random random(2);
  int tried = 0;
  for (int i = 0; i < 600; ++i) {
    const GizmoPose pose = random_pose(random);
    const GizmoView view = random_view(random, pose.place, i % 2 == 0);
    const auto space = i % 4 < 2 ? GizmoSpace::world : GizmoSpace::local;
    const bool screen = i % 5 == 0;
    const int k = i % 3, low = k == 0 ? 1 : 0, high = k == 2 ? 1 : 2;
    const Vec3 a = screen ? view.camera.right() : axis_of(pose, space, low);
    const Vec3 b = screen ? view.camera.up() : axis_of(pose, space, high);
    if (std::abs(glm::dot(glm::cross(a, b), view.to_eye(pose.place))) < 0.2) continue;
    ++tried;
    const double reach = reach_of(view, pose);
    const auto random_place = [&] {
      return pose.place + reach * (random.uniform(-1, 1) * a + random.uniform(-1, 1) * b);
    };
    const Vec3 from = random_place(), to = random_place();
    GizmoDrag drag =
        begin_drag(view, pose, space, screen ? GizmoHandle::screen : kPlanes[k], pixel(view, from));
    const GizmoPose moved = drag.drag_to(pixel(view, to));
    EXPECT_LT(glm::length(moved.place - (pose.place + to - from)), 1e-7 * reach);
    EXPECT_NEAR(drag.amount().first, glm::dot(to - from, a), 1e-7 * reach);
    EXPECT_NEAR(drag.amount().second, glm::dot(to - from, b), 1e-7 * reach);
    EXPECT_EQ(drag.drag_to(pixel(view, from)).place, pose.place);
  }
  EXPECT_GT(tried, 400);
}

TEST(GizmoDrag, RingTurnsWithTheMouseAndRoundAndRound) {
  Random random(3);
  int tried = 0;
  for (int i = 0; i < 400; ++i) {
    const GizmoPose pose = random_pose(random);
    const GizmoView view = random_view(random, pose.place, i % 2 == 0);
    const auto space = i % 4 < 2 ? GizmoSpace::world : GizmoSpace::local;
    const bool of_view = i % 5 == 0;
    const Vec3 axis = of_view ? view.to_eye(pose.place) : axis_of(pose, space, i % 3);
    if (std::abs(glm::dot(axis, view.to_eye(pose.place))) < 0.4) continue;
    ++tried;
    const Vec3 x = glm::normalize(glm::cross(axis, Vec3(0.3, 0.5, -0.8)));
    const Vec3 y = glm::cross(axis, x);
    const double radius = 0.6 * reach_of(view, pose);
    const auto at = [&](double angle) {
      return pixel(view, pose.place + radius * (std::cos(angle) * x + std::sin(angle) * y));
    };
    const double grip = random.uniform(-3, 3);
    GizmoDrag drag =
        begin_drag(view, pose, space, of_view ? GizmoHandle::ring_view : kRings[i % 3], at(grip));
    const double sense = i % 2 == 0 ? 1 : -1;
    for (double angle = 0.5; angle < 15; angle += 0.5) {
      const GizmoPose turned = drag.drag_to(at(grip + sense * angle));
      EXPECT_NEAR(drag.amount().first, sense * angle, 1e-6);
      EXPECT_LT(angle_between(turned.rotation,
                              quat_from_rotation_vector(sense * angle * axis) * pose.rotation),
                1e-6);
      EXPECT_EQ(turned.place, pose.place);
    }
    GizmoDrag short_drag = begin_drag(view, pose, space, kRings[i % 3], at(grip));
    (void)short_drag.drag_to(at(grip + 2));
    EXPECT_EQ(short_drag.drag_to(at(grip)).rotation, pose.rotation);
  }
  EXPECT_GT(tried, 200);
}

TEST(GizmoDrag, RingSeenFromItsEdgeTurnsByItsNearSide) {
  GizmoView view;
  view.camera.orthographic = true;
  const GizmoPose pose;
  // From the front the ring about y is a line; its near side goes to the right for a positive turn.
  GizmoDrag drag = begin_drag(view, pose, GizmoSpace::world, GizmoHandle::ring_y, {500, 350});
  (void)drag.drag_to({520, 350});
  EXPECT_GT(drag.amount().first, 0.1);
  const double small = drag.amount().first;
  (void)drag.drag_to({540, 380});
  EXPECT_NEAR(drag.amount().first, 2 * small, 1e-9);
  EXPECT_EQ(drag.drag_to({500, 350}).rotation, pose.rotation);
}

TEST(GizmoDrag, SnapsToMultiplesAndTakesTypedValues) {
  GizmoView view;
  view.camera.azimuth = 0.5;
  view.camera.elevation = 0.3;
  const GizmoPose pose{Vec3(0.1, 0.2, 0.3), quat_from_rotation_vector(Vec3(0.3, -0.2, 0.5))};
  const glm::dvec2 grip = pixel(view, pose.place);
  GizmoDrag drag = begin_drag(view, pose, GizmoSpace::world, GizmoHandle::axis_x, grip);
  for (double x = -200; x < 200; x += 7) {
    (void)drag.drag_to(grip + glm::dvec2(x, 0.3 * x), 0.05);
    EXPECT_NEAR(std::remainder(drag.amount().first, 0.05), 0, 1e-12);
  }
  EXPECT_EQ(drag.drag_to(grip, 0.05).place, pose.place);
  EXPECT_LT(glm::length(drag.apply_amount(0.12).place - (pose.place + Vec3(0.12, 0, 0))), 1e-15);
  EXPECT_EQ(drag.label(), "+0.120 m X");
  EXPECT_EQ(drag.apply_amount(kNan).place, pose.place);
  EXPECT_EQ(drag.label(), "+0.000 m X");

  GizmoDrag plane = begin_drag(view, pose, GizmoSpace::local, GizmoHandle::plane_y, grip);
  const GizmoPose moved = plane.apply_amount(0.5, -12.25);
  const Vec3 want = pose.place + pose.rotation * Vec3(0.5, 0, -12.25);
  EXPECT_LT(glm::length(moved.place - want), 1e-12);
  EXPECT_EQ(plane.label(), "+0.500 m X, -12.25 m Z local");

  GizmoDrag ring =
      begin_drag(view, pose, GizmoSpace::local, GizmoHandle::ring_y, grip + glm::dvec2(60, 0));
  const GizmoPose turned = ring.apply_amount(glm::radians(35.0));
  EXPECT_LT(angle_between(turned.rotation, pose.rotation * quat_from_rotation_vector(
                                                               glm::radians(35.0) * Vec3(0, 1, 0))),
            1e-12);
  EXPECT_EQ(ring.label(), "35.0\u00b0 Y local");
  (void)ring.drag_to(grip + glm::dvec2(20, 55), glm::radians(15.0));
  EXPECT_NEAR(std::remainder(glm::degrees(ring.amount().first), 15.0), 0, 1e-9);
}

TEST(GizmoDrag, StaysFiniteAtTheHorizonAndBehindTheEye) {
  Random random(4);
  for (int i = 0; i < 400; ++i) {
    const GizmoPose pose = random_pose(random);
    GizmoView view = random_view(random, pose.place, i % 2 == 0);
    const Vec3 axis = axis_of(pose, GizmoSpace::world, i % 3);
    if (i % 4 == 0) {
      // Straight along the axis.
      view.camera.focus = pose.place;
      view.camera.azimuth = std::atan2(axis.x, axis.z);
      view.camera.elevation = std::asin(axis.y);
    }
    for (const auto* handles : {kAxes, kPlanes, kRings}) {
      GizmoDrag drag = begin_drag(view, pose, GizmoSpace::world, handles[i % 3],
                                  pixel(view, pose.place) + glm::dvec2(3, 5));
      const double scale = sanitized(view.camera).distance;
      for (int k = 0; k < 20; ++k) {
        const double far = k < 10 ? 1e3 : 1e7;
        const GizmoPose moved =
            drag.drag_to({random.uniform(-far, far), random.uniform(-far, far)});
        EXPECT_TRUE(std::isfinite(glm::length(moved.place)));
        EXPECT_NEAR(glm::length(moved.rotation), 1, 1e-9);
        // A mouse within the neighbourhood of the viewport keeps the target there, too.
        if (k < 10) {
          EXPECT_LT(glm::length(moved.place - pose.place), 2000 * scale);
        }
        if (!view.camera.orthographic) {
          EXPECT_GT(view.to_pixels(moved.place).z, 0);
        }
      }
      (void)drag.guides();
    }
  }
}

TEST(GizmoDrag, HostileValuesDoNotMoveAnything) {
  const GizmoView view;
  const GizmoPose pose{Vec3(1, 2, 3), Quat(1, 0, 0, 0)};
  GizmoDrag nothing;
  EXPECT_EQ(nothing.drag_to({3, 4}).place, Vec3(0.0));
  EXPECT_EQ(nothing.apply_amount(5).place, Vec3(0.0));
  EXPECT_EQ(nothing.label(), "");
  EXPECT_TRUE(nothing.guides().empty());

  GizmoView behind = view;
  behind.camera.focus = Vec3(1, 2, 3 - 20);
  GizmoDrag drag = begin_drag(behind, pose, GizmoSpace::world, GizmoHandle::axis_x, {3, 4});
  EXPECT_EQ(drag.handle(), GizmoHandle::none);
  EXPECT_EQ(drag.drag_to({300, 400}).place, pose.place);
  EXPECT_TRUE(make_gizmo(behind, pose, {}).parts.empty());
  behind.camera.orthographic = true;  // which shows what is behind the eye
  EXPECT_FALSE(make_gizmo(behind, pose, {}).parts.empty());

  drag = begin_drag(view, GizmoPose{}, GizmoSpace::local, GizmoHandle::axis_y, {500, 300});
  const GizmoPose good = drag.drag_to({500, 250});
  EXPECT_GT(good.place.y, 0);
  EXPECT_EQ(drag.drag_to({kNan, 3}).place, good.place);
  EXPECT_EQ(drag.drag_to({3, kInfinity}).place, good.place);
  EXPECT_EQ(drag.drag_to({500, 250}, kNan).place, good.place);
  EXPECT_EQ(begin_drag(view, pose, GizmoSpace::world, GizmoHandle::axis_x, {kNan, 0}).handle(),
            GizmoHandle::none);
  EXPECT_TRUE(make_gizmo(view, {Vec3(kNan), Quat(1, 0, 0, 0)}, {}).parts.empty());
  GizmoView flat = view;
  flat.height = 0;
  EXPECT_TRUE(make_gizmo(flat, pose, {}).parts.empty());
  const GizmoPose odd{Vec3(0.0), Quat(kNan, 0, 0, 0)};
  GizmoOptions local;
  local.space = GizmoSpace::local;
  for (const auto& part : make_gizmo(view, odd, local).parts) {
    for (const auto& p : part.points) EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y));
  }
  EXPECT_EQ(hit(make_gizmo(view, GizmoPose{}, {}), {kNan, 0}), GizmoHandle::none);
  EXPECT_EQ(hit(make_gizmo(view, GizmoPose{}, {}), {500, 350}, kNan), GizmoHandle::none);
}

TEST(Gizmo, EveryHandleIsFoundWhereItIsDrawn) {
  Random random(5);
  int views = 0;
  for (int i = 0; i < 400; ++i) {
    const GizmoPose pose = random_pose(random);
    GizmoView view = random_view(random, pose.place, i % 2 == 0);
    // A view in which no axis lies along or across the line of sight.
    GizmoOptions options;
    options.space = GizmoSpace::local;
    const Vec3 seen = glm::conjugate(pose.rotation) * view.to_eye(pose.place);
    if (std::min({std::abs(seen.x), std::abs(seen.y), std::abs(seen.z)}) < 0.4) continue;
    ++views;
    for (const auto mode : {GizmoMode::translate, GizmoMode::rotate}) {
      options.mode = mode;
      const GizmoShape shape = make_gizmo(view, pose, options);
      std::vector<GizmoHandle> want = {GizmoHandle::ring_view};
      want.insert(want.end(), std::begin(kRings), std::end(kRings));
      if (mode == GizmoMode::translate) {
        want = {GizmoHandle::screen};
        want.insert(want.end(), std::begin(kAxes), std::end(kAxes));
        want.insert(want.end(), std::begin(kPlanes), std::end(kPlanes));
      }
      for (const auto handle : want) {
        int found = 0;
        for (const auto& part : shape.parts) {
          if (part.handle != handle || !part.can_grab) continue;
          // Along lines, and between the middle and the corners of what is filled.
          const std::size_t count = part.points.size();
          glm::dvec2 middle(0.0);
          for (const auto& p : part.points) middle += p / static_cast<double>(count);
          for (std::size_t k = 0; k < count; ++k) {
            const bool line = part.kind == GizmoPart::Kind::line;
            const glm::dvec2 other = line ? part.points[std::min(k + 1, count - 1)] : middle;
            for (const double u : {0.0, 0.3, 0.6, 1.0}) {
              found += hit(shape, glm::mix(part.points[k], other, u)) == handle;
            }
          }
        }
        EXPECT_GT(found, 0) << static_cast<int>(handle);
      }
      EXPECT_EQ(hit(shape, pixel(view, pose.place) + glm::dvec2(400, 0)), GizmoHandle::none);
    }
  }
  EXPECT_GT(views, 20);
}

TEST(Gizmo, KeepsItsSizeOnTheScreen) {
  for (const bool orthographic : {false, true}) {
    for (const double distance : {0.01, 1.0, 50.0, 1e5}) {
      GizmoView view;
      view.camera.distance = distance;
      view.camera.orthographic = orthographic;
      double farthest = 0;
      for (const auto& part : make_gizmo(view, GizmoPose{}, {}).parts) {
        for (const auto& p : part.points) farthest = std::max(farthest, p.x - 500);
      }
      EXPECT_NEAR(farthest, GizmoOptions{}.size, 1e-6);
    }
  }
}

TEST(Gizmo, HandlesAlongTheViewFadeAndCanNotBeGrabbed) {
  GizmoView view;  // from the front: z points at the eye
  const auto grabbable = [](const GizmoShape& shape, GizmoHandle handle) {
    for (const auto& part : shape.parts) {
      if (part.handle == handle && part.can_grab) return true;
    }
    return false;
  };
  for (const bool orthographic : {false, true}) {
    view.camera.orthographic = orthographic;
    const GizmoShape shape = make_gizmo(view, GizmoPose{}, {});
    EXPECT_TRUE(grabbable(shape, GizmoHandle::axis_x));
    EXPECT_FALSE(grabbable(shape, GizmoHandle::axis_z));
    EXPECT_TRUE(grabbable(shape, GizmoHandle::plane_z));
    EXPECT_FALSE(grabbable(shape, GizmoHandle::plane_x));
    EXPECT_FALSE(grabbable(shape, GizmoHandle::plane_y));
  }
}

TEST(Gizmo, TheChosenHandleStandsOut) {
  const GizmoView view;
  GizmoOptions options;
  options.hovered = GizmoHandle::axis_x;
  for (const auto& part : make_gizmo(view, GizmoPose{}, options).parts) {
    EXPECT_EQ(part.colour == GizmoColours::active, part.handle == GizmoHandle::axis_x);
  }
  options.dragged = GizmoHandle::axis_y;
  for (const auto& part : make_gizmo(view, GizmoPose{}, options).parts) {
    EXPECT_EQ(part.colour == GizmoColours::active, part.handle == GizmoHandle::axis_y);
    if (part.handle != GizmoHandle::axis_y) {
      EXPECT_LT(part.opacity, 0.31f);
    }
  }
}

}  // namespace
}  // namespace elbowroom::test
