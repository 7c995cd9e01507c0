// SPDX-License-Identifier: MIT
#include "render/overlay.h"

#include <epoxy/gl.h>

#include <cmath>
#include <glm/glm.hpp>

#include "render/shader.h"

namespace elbowroom {
namespace {

// As shaders/line.vert.glsl and marker.vert.glsl have them.
struct LineSegment {
  glm::vec4 a, b, colour_a, colour_b, style;
};
struct MarkerItem {
  glm::vec4 place, colour, style;
};

bool finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::vector<LineSegment> segments_of(const Trail& trail, const Style& style, const Vec3& origin,
                                     double pixel_scale) {
  std::vector<LineSegment> segments;
  const float width =
      (trail.width > 0 ? trail.width : style.trail_width) * static_cast<float>(pixel_scale);
  const auto colour = [&](std::size_t i) {
    const Rgb rgb = trail.colours.empty()      ? style.accent
                    : i < trail.colours.size() ? trail.colours[i]
                                               : trail.colours.back();
    return glm::vec4(linear_from_rgb(rgb), trail.opacity);
  };
  double along = 0;
  for (std::size_t i = 0; i + 1 < trail.points.size(); ++i) {
    const Vec3 &a = trail.points[i], &b = trail.points[i + 1];
    if (!finite(a) || !finite(b)) continue;
    const double next = along + glm::length(b - a);
    segments.push_back({glm::vec4(glm::vec3(a - origin), static_cast<float>(along)),
                        glm::vec4(glm::vec3(b - origin), static_cast<float>(next)), colour(i),
                        colour(i + 1), glm::vec4(width, 2.0 * trail.dash, 0, 0)});
    along = next;
  }
  return segments;
}

MarkerItem item_of(const Marker& marker, const Vec3& origin, double pixel_scale) {
  return {
      glm::vec4(glm::vec3(marker.place - origin), marker.radius * static_cast<float>(pixel_scale)),
      glm::vec4(linear_from_rgb(marker.colour), marker.opacity),
      glm::vec4(static_cast<float>(marker.shape), 0, 0, 0)};
}

}  // namespace

Result<Overlay> Overlay::create() {
  Overlay overlay;
  auto lines = make_program("line.vert.glsl", "line.frag.glsl");
  if (!lines) return lines.error();
  auto markers = make_program("marker.vert.glsl", "marker.frag.glsl");
  if (!markers) return markers.error();
  overlay.lines_ = std::move(*lines);
  overlay.markers_ = std::move(*markers);
  overlay.empty_ = make_vertex_array();
  return overlay;
}

void Overlay::draw_batch(const GlProgram& program, int count, float strength, float hidden) {
  if (count == 0) return;
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, data_.name());
  glUseProgram(program.name());
  glDepthFunc(GL_LEQUAL);
  glUniform1f(0, strength);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count);
  if (hidden > 0) {
    glDepthFunc(GL_GREATER);
    glUniform1f(0, strength * hidden);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count);
    glDepthFunc(GL_LEQUAL);
  }
}

void Overlay::draw(const Frame& frame, const Style& style, const Vec3& origin) {
  glBindVertexArray(empty_.name());
  glDepthMask(GL_FALSE);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDisable(GL_CULL_FACE);
  for (const auto& trail : frame.trails) {
    const auto segments = segments_of(trail, style, origin, frame.pixel_scale);
    data_.write(segments.data(), segments.size() * sizeof(LineSegment));
    draw_batch(lines_, static_cast<int>(segments.size()), 1.0f, trail.hidden);
  }
  const auto draw_marker = [&](const Marker& marker) {
    if (!finite(marker.place)) return;
    const MarkerItem item = item_of(marker, origin, frame.pixel_scale);
    data_.write(&item, sizeof item);
    draw_batch(markers_, 1, 1.0f, marker.hidden);
  };
  for (const auto& marker : frame.markers) draw_marker(marker);
  for (const auto& contact : frame.contacts) {
    if (!contact.ring) continue;
    // Surfaces meet here, so half of the ring is always inside one: it shows through in full.
    draw_marker({contact.place, style.problem, 26, MarkerShape::halo, 0.42f, 1.0f});
    draw_marker({contact.place, style.problem, 11, MarkerShape::ring, 1.0f, 1.0f});
  }
  glDepthMask(GL_TRUE);
}

}  // namespace elbowroom
