// SPDX-License-Identifier: MIT
// What a pixel shows, and where the GPU has put a figure's vertices.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "render/scene_renderer_data.h"

namespace elbowroom {

std::vector<Pick> SceneRenderer::Data::draw_ids(const Mat4& clip_from_world, int width,
                                                int height) {
  const GlTexture id = make_texture(GL_RGBA32UI, width, height);
  const GlTexture depth = make_texture(GL_DEPTH_COMPONENT32F, width, height);
  const GlFramebuffer target = make_framebuffer();
  glNamedFramebufferTexture(target.name(), GL_COLOR_ATTACHMENT0, id.name(), 0);
  glNamedFramebufferTexture(target.name(), GL_DEPTH_ATTACHMENT, depth.name(), 0);
  glBindFramebuffer(GL_FRAMEBUFFER, target.name());
  glViewport(0, 0, width, height);
  const GLuint nothing[4] = {0, 0, 0, 0};
  const float far = 1;
  glDepthMask(GL_TRUE);
  glClearBufferuiv(GL_COLOR, 0, nothing);
  glClearBufferfv(GL_DEPTH, 0, &far);
  glEnable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glUseProgram(pick.name());
  const glm::mat4 matrix(clip_from_world);
  glUniformMatrix4fv(0, 1, GL_FALSE, &matrix[0][0]);
  for (const auto& item : items) {
    glUniform2ui(1, static_cast<GLuint>(item.actor + 1), static_cast<GLuint>(item.mesh));
    figures[item.actor].bind();
    figures[item.actor].draw(*actor_models[item.actor], item.mesh);
  }
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  std::vector<GLuint> found(4 * count);
  glGetTextureImage(id.name(), 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT,
                    static_cast<GLsizei>(found.size() * sizeof(GLuint)), found.data());
  glDisable(GL_DEPTH_TEST);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glBindVertexArray(0);
  glUseProgram(0);

  const Mat4 world_from_clip = glm::inverse(clip_from_world);
  std::vector<Pick> picks(count);
  for (std::size_t i = 0; i < count; ++i) {
    const GLuint* pixel = &found[4 * i];
    if (pixel[0] == 0) continue;
    const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;  // y upwards
    Pick& pick = picks[static_cast<std::size_t>((height - 1 - y) * width + x)];
    pick.actor = static_cast<int>(pixel[0]) - 1;
    pick.mesh = static_cast<int>(pixel[1]);
    pick.triangle = static_cast<int>(pixel[2]);
    float z = 0;
    std::memcpy(&z, &pixel[3], sizeof z);
    const glm::dvec4 world =
        world_from_clip * glm::dvec4(2.0 * (x + 0.5) / width - 1.0, 2.0 * (y + 0.5) / height - 1.0,
                                     2.0 * double{z} - 1.0, 1.0);
    pick.place = view.camera.focus + Vec3(world) / world.w;
  }
  return picks;
}

Pick SceneRenderer::pick(double x, double y) {
  Data& d = *data_;
  if (!d.drawn || !std::isfinite(x) || !std::isfinite(y)) return Pick();
  // The one pixel blown up to the whole of a 1 × 1 target.
  const double width = d.buffers.width, height = d.buffers.height;
  const double ndc_x = 2.0 * x / width - 1.0, ndc_y = 1.0 - 2.0 * y / height;
  Mat4 zoom(1.0);
  zoom[0][0] = width;
  zoom[1][1] = height;
  zoom[3][0] = -ndc_x * width;
  zoom[3][1] = -ndc_y * height;
  return d.draw_ids(zoom * d.view.clip_from_world, 1, 1).front();
}

std::vector<Pick> SceneRenderer::pick_all(const Frame& frame, const Camera& camera,
                                          const PictureSize& size) {
  Data& d = *data_;
  const int width = std::clamp(size.width, 1, 2048), height = std::clamp(size.height, 1, 2048);
  Style style;
  style.ground = false;
  d.set_frame(frame, camera, style, static_cast<double>(width) / height);
  return d.draw_ids(d.view.clip_from_world, width, height);
}

std::vector<Vec3> SceneRenderer::read_positions(int actor, int mesh) const {
  const auto a = static_cast<std::size_t>(actor);
  if (actor < 0 || a >= data_->actor_models.size() || data_->actor_models[a] == nullptr) return {};
  const GpuModel& gpu = *data_->actor_models[a];
  if (mesh < 0 || mesh >= static_cast<int>(gpu.model().meshes.size())) return {};
  const auto all = data_->figures[a].read_positions(gpu);
  const RenderMesh& range = gpu.geometry().meshes[static_cast<std::size_t>(mesh)];
  std::vector<Vec3> out(gpu.model().meshes[static_cast<std::size_t>(mesh)].positions.size(),
                        Vec3(std::numeric_limits<double>::quiet_NaN()));
  for (auto v = range.first_vertex; v < range.first_vertex + range.vertex_count; ++v) {
    out[gpu.geometry().bindings[v].source] = all[v];
  }
  return out;
}

}  // namespace elbowroom
