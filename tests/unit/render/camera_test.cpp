// SPDX-License-Identifier: MIT
#include "render/camera.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/base/random.h"

namespace elbowroom::test {
namespace {

std::vector<Vec3> cloud(std::uint64_t seed, double size) {
  Random random(seed);
  std::vector<Vec3> points;
  for (int i = 0; i < 60; ++i) {
    points.push_back(
        size * Vec3(random.uniform(-1, 1), random.uniform(-0.3, 2), random.uniform(-0.5, 0.8)) +
        size * Vec3(5, 1, -3));
  }
  return points;
}

TEST(Camera, FramedPointsJustFitInTheMargins) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    for (const double size : {1e-3, 1.0, 1e4}) {
      for (const bool orthographic : {false, true}) {
        Camera camera;
        camera.azimuth = 0.9 * static_cast<double>(seed);
        camera.elevation = 0.05 * static_cast<double>(seed) - 0.4;
        camera.orthographic = orthographic;
        const auto points = cloud(seed, size);
        const double aspect = seed % 2 == 0 ? 1.6 : 0.7, margin = 0.1;
        camera = framed(camera, points, aspect, margin);
        double left = 1, right = 0, top = 1, bottom = 0;
        for (const auto& p : points) {
          const Vec3 at = project(camera, aspect, p);
          EXPECT_GT(at.z, 0);
          left = std::min(left, at.x), right = std::max(right, at.x);
          top = std::min(top, at.y), bottom = std::max(bottom, at.y);
        }
        const double low = 0.5 * margin, high = 1 - 0.5 * margin, slack = 1e-9;
        EXPECT_GE(left, low - slack);
        EXPECT_LE(right, high + slack);
        EXPECT_GE(top, low - slack);
        EXPECT_LE(bottom, high + slack);
        // Tight in one direction, centred in the other.
        EXPECT_NEAR(std::max(right - left, bottom - top), high - low, 1e-6);
        EXPECT_NEAR(left + right, 1, 1e-6 + (orthographic ? 0 : 0.12));
        EXPECT_NEAR(top + bottom, 1, 1e-6 + (orthographic ? 0 : 0.12));
      }
    }
  }
}

TEST(Camera, ProjectionMatrixAgreesWithProject) {
  for (const bool orthographic : {false, true}) {
    Camera camera;
    camera.focus = Vec3(1, 2, 3);
    camera.azimuth = 0.4;
    camera.elevation = -0.3;
    camera.distance = 7;
    camera.orthographic = orthographic;
    const Mat4 clip = camera.projection(1.3, 0.1, 100) * camera.view_from_focus();
    for (const auto& p : cloud(3, 0.4)) {
      const glm::dvec4 c = clip * glm::dvec4(p - camera.focus, 1);
      const Vec3 at = project(camera, 1.3, p);
      EXPECT_NEAR(at.x, 0.5 + 0.5 * c.x / c.w, 1e-9);
      EXPECT_NEAR(at.y, 0.5 - 0.5 * c.y / c.w, 1e-9);
    }
  }
}

TEST(Camera, AxesAreRightHandedAndPresetsLookTheirWay) {
  Camera camera;
  EXPECT_LT(glm::length(with_preset(camera, ViewPreset::front).backward() - Vec3(0, 0, 1)), 1e-9);
  EXPECT_LT(glm::length(with_preset(camera, ViewPreset::side).backward() - Vec3(1, 0, 0)), 1e-9);
  EXPECT_LT(glm::length(with_preset(camera, ViewPreset::top).backward() - Vec3(0, 1, 0)), 1e-3);
  EXPECT_LT(glm::length(with_preset(camera, ViewPreset::top).right() - Vec3(1, 0, 0)), 1e-9);
  EXPECT_TRUE(with_preset(camera, ViewPreset::front, true).orthographic);
  camera.azimuth = 2;
  camera.elevation = 0.5;
  EXPECT_LT(glm::length(glm::cross(camera.right(), camera.up()) - camera.backward()), 1e-12);
}

TEST(Camera, DragsStayInRange) {
  Camera camera;
  for (int i = 0; i < 100; ++i) camera = orbited(camera, 0.3, 0.2);
  EXPECT_LT(camera.elevation, 0.5 * kPi);
  EXPECT_LE(std::abs(camera.azimuth), kPi);
  const Camera moved = panned(camera, 0.5, 0);
  EXPECT_NEAR(project(moved, 1, camera.focus).x, 0.0, 1e-9);
  EXPECT_DOUBLE_EQ(zoomed(camera, 2).distance, 2 * camera.distance);
  EXPECT_DOUBLE_EQ(zoomed(camera, std::numeric_limits<double>::quiet_NaN()).distance,
                   camera.distance);
}

TEST(Camera, PickRayIsTheInverseOfProject) {
  Random random(7);
  for (int i = 0; i < 2000; ++i) {
    Camera camera;
    camera.focus = (i % 4 == 0 ? 1e6 : 1.0) * Vec3(1, -0.5, 0.3);
    camera.azimuth = random.uniform(-3, 3);
    camera.elevation = random.uniform(-1.5, 1.5);
    camera.distance = std::pow(10.0, random.uniform(-2, 4));
    camera.field_of_view = random.uniform(0.1, 2.0);
    camera.orthographic = i % 2 == 0;
    const double aspect = random.uniform(0.3, 3);
    const double x = random.uniform(-0.5, 1.5), y = random.uniform(-0.5, 1.5);
    const WorldRay ray = pick_ray(camera, aspect, x, y);
    EXPECT_NEAR(glm::length(ray.direction), 1, 1e-12);
    if (!camera.orthographic) {
      EXPECT_EQ(ray.origin, camera.eye());
    }
    const double start = camera.orthographic ? 1e4 * camera.distance : 0.0;
    for (const double along : {0.3, 1.0, 7.0}) {
      const Vec3 at =
          project(camera, aspect, ray.origin + (start + along * camera.distance) * ray.direction);
      EXPECT_GT(at.z, 0);
      const double slack = 1e-9 + 1e-9 / camera.distance;
      EXPECT_NEAR(at.x, x, slack);
      EXPECT_NEAR(at.y, y, slack);
    }
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const WorldRay middle = pick_ray({}, nan, nan, nan);
  EXPECT_EQ(middle.direction, -Camera{}.backward());
}

TEST(Camera, HostileValuesArePutRight) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Camera camera;
  camera.focus = Vec3(nan);
  camera.distance = -1;
  camera.elevation = 9;
  camera.azimuth = std::numeric_limits<double>::infinity();
  const Camera sound = sanitized(camera);
  EXPECT_GT(sound.distance, 0);
  EXPECT_EQ(sound.focus, Vec3(0.0));
  EXPECT_LT(sound.elevation, 0.5 * kPi);
  EXPECT_EQ(sound.azimuth, 0);
  // No points, one point, points that are not numbers.
  EXPECT_EQ(framed(sound, std::vector<Vec3>{}, 1).distance, sound.distance);
  EXPECT_GT(framed(sound, std::vector<Vec3>{Vec3(4)}, 1).distance, 0);
  EXPECT_LT(glm::length(framed(sound, std::vector<Vec3>{Vec3(4)}, 1).focus - Vec3(4)), 1e-6);
  EXPECT_EQ(framed(sound, std::vector<Vec3>{Vec3(nan)}, 1).distance, sound.distance);
  EXPECT_EQ(framed(sound, Bounds{}, 1).distance, sound.distance);
}

}  // namespace
}  // namespace elbowroom::test
