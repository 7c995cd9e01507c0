// SPDX-License-Identifier: MIT
#include "render/frame_uniforms.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace elbowroom {
namespace {

Vec3 direction(double azimuth_degrees, double elevation_degrees) {
  const double a = glm::radians(azimuth_degrees), e = glm::radians(elevation_degrees);
  return {std::cos(e) * std::sin(a), std::sin(e), std::cos(e) * std::cos(a)};
}

glm::vec4 light(Rgb colour, float strength) {
  return glm::vec4(linear_from_rgb(colour) * strength, 1.0f);
}

std::vector<Vec3> corners(const Bounds& box) {
  std::vector<Vec3> out;
  for (int i = 0; i < 8; ++i) {
    out.emplace_back((i & 1) ? box.upper.x : box.lower.x, (i & 2) ? box.upper.y : box.lower.y,
                     (i & 4) ? box.upper.z : box.lower.z);
  }
  return out;
}

// The grid lies at 0 if the bodies stand near it; else below the lowest one.
double ground_height(const Frame& frame, const Bounds& all, double size) {
  if (frame.ground && std::isfinite(*frame.ground)) return *frame.ground;
  if (all.empty() || std::abs(all.lower.y) < 0.25 * size) return 0;
  return all.lower.y > 0 || all.upper.y < 0 ? all.lower.y : 0;
}

void set_depth_range(const Bounds& all, const Style& style, ViewSetup& view) {
  const Camera& camera = view.camera;
  Bounds seen = all;
  if (style.ground) {
    const double reach = style.grid_radius * view.size;
    seen.add(Vec3(camera.focus.x - reach, view.ground, camera.focus.z - reach));
    seen.add(Vec3(camera.focus.x + reach, view.ground, camera.focus.z + reach));
  }
  double nearest = camera.distance, farthest = camera.distance;
  if (!seen.empty()) {
    for (const auto& corner : corners(seen)) {
      const double depth = glm::dot(camera.eye() - corner, camera.backward());
      nearest = std::min(nearest, depth);
      farthest = std::max(farthest, depth);
    }
  }
  const double pad = 0.01 * (farthest - nearest) + 0.01 * camera.distance;
  view.far = farthest + pad;
  view.near = camera.orthographic
                  ? nearest - pad
                  : std::max({nearest - pad, 0.02 * camera.distance, 1e-5 * view.far});
}

// The map holds the bodies about the focus; casters nearer to the light are clamped onto it.
void set_light(const Style& style, const std::vector<Bounds>& bodies, ViewSetup& view) {
  const Camera& camera = view.camera;
  const double turn = style.key_follows_camera ? glm::degrees(camera.azimuth) : 0.0;
  const double elevation = std::clamp(double{style.key_elevation}, 5.0, 89.0);
  const Vec3 z = direction(style.key_azimuth + turn, elevation);
  const Vec3 x = glm::normalize(glm::cross(Vec3(0, 1, 0), z)), y = glm::cross(z, x);
  view.key_direction = z;

  const double half = camera.distance * std::tan(0.5 * camera.field_of_view);
  const double reach = 1.5 * std::max(half * std::max(view.aspect, 1.0), view.size);
  Bounds lit;  // in light axes, relative to the focus
  const auto add = [&](const Vec3& p) {
    const Vec3 q = p - camera.focus;
    lit.add(Vec3(glm::dot(q, x), glm::dot(q, y), glm::dot(q, z)));
  };
  for (const auto& body : bodies) {
    Bounds part;
    part.lower = glm::max(body.lower, camera.focus - reach);
    part.upper = glm::min(body.upper, camera.focus + reach);
    if (body.empty() || part.lower.x > part.upper.x || part.lower.y > part.upper.y ||
        part.lower.z > part.upper.z) {
      continue;
    }
    for (const auto& corner : corners(part)) {
      add(corner);
      // Where its shadow falls on the ground, unless that is very far.
      const double down = (corner.y - view.ground) / z.y;
      if (style.ground && down > 0) add(corner - z * std::min(down, 4.0 * reach));
    }
  }
  if (lit.empty()) add(camera.focus);
  const Vec3 middle = lit.centre();
  const double pad = 0.05 * view.size;
  const double width = std::max(lit.extent().x, lit.extent().y) + 2.0 * pad;
  const double range = lit.extent().z + 2.0 * pad;
  view.shadow_width = width;
  view.shadow_range = range;
  Mat4 from_world(1.0);  // light view: the map's near plane at the top of the lit region
  for (int i = 0; i < 3; ++i) {
    from_world[i][0] = x[i];
    from_world[i][1] = y[i];
    from_world[i][2] = z[i];
  }
  const double top = lit.upper.z + pad;
  view.light_clip_from_world =
      glm::ortho(middle.x - 0.5 * width, middle.x + 0.5 * width, middle.y - 0.5 * width,
                 middle.y + 0.5 * width, -top, -top + range) *
      from_world;
}

}  // namespace

ViewSetup make_view(const Camera& camera, const Style& style, const Frame& frame,
                    const std::vector<Bounds>& bodies, double size, double aspect) {
  ViewSetup view;
  view.camera = sanitized(camera);
  view.aspect = aspect;
  view.size = std::isfinite(size) && size > 0 ? size : 1.0;
  Bounds all;
  for (const auto& body : bodies) all.add(body);
  view.ground = ground_height(frame, all, view.size);
  set_depth_range(all, style, view);
  set_light(style, bodies, view);
  view.clip_from_world =
      view.camera.projection(aspect, view.near, view.far) * view.camera.view_from_focus();
  return view;
}

FrameUniforms make_uniforms(const ViewSetup& view, const Style& style, const Frame& frame,
                            int width, int height) {
  const Camera& camera = view.camera;
  FrameUniforms out{};
  out.clip_from_world = glm::mat4(view.clip_from_world);
  out.view_from_world = glm::mat4(camera.view_from_focus());
  const Mat4 half = glm::translate(Mat4(1.0), Vec3(0.5)) * glm::scale(Mat4(1.0), Vec3(0.5));
  out.light_from_world = glm::mat4(half * view.light_clip_from_world);
  const Vec3 backward = camera.backward();
  out.eye = glm::vec4(glm::vec3(backward * camera.distance), camera.orthographic ? 1.0f : 0.0f);
  out.backward = glm::vec4(glm::vec3(backward), 0.0f);
  out.viewport =
      glm::vec4(width, height, 1.0f / static_cast<float>(width), 1.0f / static_cast<float>(height));
  out.key_direction = glm::vec4(glm::vec3(view.key_direction), 0.0f);
  out.key_colour = light(style.key_colour, style.key);
  // The fill comes from the other side of the viewer than the key.
  const double key_side = glm::dot(view.key_direction, camera.right()) <= 0 ? 1.0 : -1.0;
  const Vec3 fill =
      glm::normalize(0.8 * key_side * camera.right() + 0.25 * Vec3(0, 1, 0) + 0.6 * backward);
  out.fill_direction = glm::vec4(glm::vec3(fill), 0.0f);
  out.fill_colour = light(style.fill_colour, style.fill);
  out.sky_colour = light(style.sky_colour, style.sky);
  out.bounce_colour = light(style.bounce_colour, style.bounce);
  out.rim = glm::vec4(style.rim, style.exposure, 0, 0);
  out.shadow =
      glm::vec4(view.shadow_width, view.shadow_range, style.key_size, style.shadow_map_size);
  const double tangent = std::tan(0.5 * camera.field_of_view);
  const double half_height = camera.orthographic ? camera.distance * tangent : tangent;
  out.occlusion = glm::vec4(style.occlusion, style.occlusion_radius * view.size, 0.5 / half_height,
                            style.occlusion > 0 ? 1.0f : 0.0f);
  out.unproject = glm::vec4(half_height * view.aspect, half_height, 0, 0);
  out.backdrop_centre = light(style.backdrop_centre, 1);
  out.backdrop_edge = light(style.backdrop_edge, 1);

  // A hair below, so that a floor of the scene's own at that height hides it.
  const double height_shown = view.ground - 0.002 * view.size - camera.focus.y;
  const double major = std::pow(10.0, std::round(std::log10(view.size)));
  const double spacing = major / 5.0;
  const double period = major;
  out.ground = glm::vec4(height_shown, spacing, style.grid_radius * view.size, 1.0f);
  // Lines stand at whole multiples in the world; what is left of the focus modulo the period is
  // small enough for floats.
  out.ground_offset = glm::vec4(0, 0, -std::remainder(camera.focus.x, period),
                                -std::remainder(camera.focus.z, period));
  out.grid_colour = glm::vec4(linear_from_rgb(style.grid), style.grid_opacity);
  out.ground_shadow = glm::vec4(linear_from_rgb(style.ground_shadow), style.ground_shadow_opacity);
  out.problem = light(style.problem, 1);
  int count = 0;
  for (const auto& contact : frame.contacts) {
    const double radius =
        contact.radius > 0 ? contact.radius : double{style.contact_radius} * view.size;
    const glm::vec4 packed(glm::vec3(contact.place - camera.focus), static_cast<float>(radius));
    if (!std::isfinite(packed.x + packed.y + packed.z + packed.w)) continue;
    if (count == kMaxContacts) break;
    out.contacts[count++] = packed;
  }
  out.contact_count = glm::vec4(count, 0, 0, 0);
  return out;
}

}  // namespace elbowroom
