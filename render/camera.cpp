// SPDX-License-Identifier: MIT
#include "render/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace elbowroom {
namespace {

// A little short of the pole, where "up" in the picture would be undefined.
constexpr double kMaxElevation = 0.5 * kPi - 1e-4;

bool finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

Vec3 Camera::backward() const {
  return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
          std::cos(elevation) * std::cos(azimuth)};
}

Vec3 Camera::right() const { return {std::cos(azimuth), 0.0, -std::sin(azimuth)}; }

Vec3 Camera::up() const { return glm::cross(backward(), right()); }

Vec3 Camera::eye() const { return focus + distance * backward(); }

Mat4 Camera::view_from_focus() const {
  const Vec3 x = right(), y = up(), z = backward();
  Mat4 m(1.0);
  for (int i = 0; i < 3; ++i) {
    m[i][0] = x[i];
    m[i][1] = y[i];
    m[i][2] = z[i];
  }
  m[3][2] = -distance;
  return m;
}

Mat4 Camera::projection(double aspect, double near, double far) const {
  if (orthographic) {
    const double half = distance * std::tan(0.5 * field_of_view);
    return glm::ortho(-half * aspect, half * aspect, -half, half, near, far);
  }
  return glm::perspective(field_of_view, aspect, near, far);
}

Camera sanitized(Camera camera) {
  const Camera fallback;
  if (!finite(camera.focus)) camera.focus = fallback.focus;
  if (!std::isfinite(camera.azimuth)) camera.azimuth = 0;
  if (!std::isfinite(camera.elevation)) camera.elevation = 0;
  if (!std::isfinite(camera.distance) || camera.distance <= 0) camera.distance = fallback.distance;
  if (!std::isfinite(camera.field_of_view)) camera.field_of_view = fallback.field_of_view;
  camera.distance = std::clamp(camera.distance, 1e-9, 1e12);
  camera.elevation = std::clamp(camera.elevation, -kMaxElevation, kMaxElevation);
  camera.field_of_view = std::clamp(camera.field_of_view, 0.01, 2.6);
  return camera;
}

Camera with_preset(Camera camera, ViewPreset preset, bool orthographic) {
  camera.orthographic = orthographic && preset != ViewPreset::three_quarter;
  camera.elevation = 0;
  switch (preset) {
    case ViewPreset::front:
      camera.azimuth = 0;
      break;
    case ViewPreset::side:
      camera.azimuth = 0.5 * kPi;
      break;
    case ViewPreset::top:
      camera.azimuth = 0;
      camera.elevation = kMaxElevation;
      break;
    case ViewPreset::three_quarter:
      camera.azimuth = glm::radians(35.0);
      camera.elevation = glm::radians(14.0);
      break;
  }
  return camera;
}

Camera orbited(Camera camera, double azimuth, double elevation) {
  camera.azimuth = std::remainder(camera.azimuth + azimuth, 2.0 * kPi);
  camera.elevation += elevation;
  return sanitized(camera);
}

Camera panned(Camera camera, double right, double up) {
  camera = sanitized(camera);
  const double height = 2.0 * camera.distance * std::tan(0.5 * camera.field_of_view);
  camera.focus += height * (right * camera.right() + up * camera.up());
  return sanitized(camera);
}

Camera zoomed(Camera camera, double factor) {
  if (std::isfinite(factor) && factor > 0) camera.distance *= factor;
  return sanitized(camera);
}

Camera framed(const Camera& given, const std::vector<Vec3>& points, double aspect, double margin) {
  Camera camera = sanitized(given);
  const Vec3 right = camera.right(), up = camera.up(), backward = camera.backward();
  const double keep = 1.0 - std::clamp(margin, 0.0, 0.9);
  const double tan_y = std::tan(0.5 * camera.field_of_view) * keep;
  const double tan_x = tan_y * (std::isfinite(aspect) && aspect > 0 ? aspect : 1.0);
  constexpr double kNone = -std::numeric_limits<double>::infinity();

  // The four side planes of the frustum touch the points where these linear functions of them are
  // largest. In camera axes, with the eye at (ex, ey, ez) and looking along −z, a point is inside
  // the right plane if x − ex ≤ tan_x (ez − z), that is x + tan_x z ≤ ex + tan_x ez, and so on.
  double plane[4] = {kNone, kNone, kNone, kNone};
  Bounds box;  // in camera axes
  for (const auto& p : points) {
    if (!finite(p)) continue;
    const Vec3 q(glm::dot(p, right), glm::dot(p, up), glm::dot(p, backward));
    box.add(q);
    const double slope_x = camera.orthographic ? 0.0 : tan_x;
    const double slope_y = camera.orthographic ? 0.0 : tan_y;
    plane[0] = std::max(plane[0], q.x + slope_x * q.z);
    plane[1] = std::max(plane[1], -q.x + slope_x * q.z);
    plane[2] = std::max(plane[2], q.y + slope_y * q.z);
    plane[3] = std::max(plane[3], -q.y + slope_y * q.z);
  }
  if (box.empty()) return camera;
  const double depth = box.upper.z - box.lower.z;
  const double size = std::max({box.extent().x, box.extent().y, depth, 1e-9});
  const double x = 0.5 * (plane[0] - plane[1]), y = 0.5 * (plane[2] - plane[3]);
  // How far the eye must be back for each pair of planes; the larger need decides, and the other
  // direction is centred by the means above.
  const double z_x = 0.5 * (plane[0] + plane[1]) / tan_x;
  const double z_y = 0.5 * (plane[2] + plane[3]) / tan_y;
  if (camera.orthographic) {
    camera.distance = std::max({z_x, z_y, 0.01 * size});
    camera.focus = x * right + y * up + box.centre().z * backward;
    return sanitized(camera);
  }
  const double eye = std::max({z_x, z_y, box.upper.z + 0.05 * size});
  const double focus = std::min(box.centre().z, eye - 0.05 * size);
  // The eye lies at (x, y, eye) in camera axes; the focus straight before it.
  camera.focus = x * right + y * up + focus * backward;
  camera.distance = eye - focus;
  return sanitized(camera);
}

Camera framed(const Camera& camera, const Bounds& bounds, double aspect, double margin) {
  if (bounds.empty()) return sanitized(camera);
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back((i & 1) ? bounds.upper.x : bounds.lower.x,
                         (i & 2) ? bounds.upper.y : bounds.lower.y,
                         (i & 4) ? bounds.upper.z : bounds.lower.z);
  }
  return framed(camera, corners, aspect, margin);
}

Vec3 project(const Camera& given, double aspect, const Vec3& point) {
  const Camera camera = sanitized(given);
  const Vec3 offset = point - camera.eye();
  const double depth = -glm::dot(offset, camera.backward());
  const double half =
      (camera.orthographic ? camera.distance : depth) * std::tan(0.5 * camera.field_of_view);
  return {0.5 + 0.5 * glm::dot(offset, camera.right()) / (half * aspect),
          0.5 - 0.5 * glm::dot(offset, camera.up()) / half, depth};
}

WorldRay pick_ray(const Camera& given, double aspect, double x, double y) {
  const Camera camera = sanitized(given);
  if (!std::isfinite(x)) x = 0.5;
  if (!std::isfinite(y)) y = 0.5;
  if (!std::isfinite(aspect) || aspect <= 0) aspect = 1.0;
  const double tangent = std::tan(0.5 * camera.field_of_view);
  const Vec3 across =
      (2.0 * x - 1.0) * tangent * aspect * camera.right() + (1.0 - 2.0 * y) * tangent * camera.up();
  if (camera.orthographic) {
    return {camera.focus + camera.distance * (across + 1e4 * camera.backward()),
            -camera.backward()};
  }
  return {camera.eye(), glm::normalize(across - camera.backward())};
}

}  // namespace elbowroom
