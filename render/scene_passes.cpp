// SPDX-License-Identifier: MIT
// The passes of one picture, in their order: figures deformed, shadow, occlusion, surfaces, ghosts.
#include <algorithm>
#include <cmath>

#include "render/scene_renderer_data.h"

namespace elbowroom {
namespace {

void set_winding(const Material* material, int winding, bool cull) {
  if (!cull || (material != nullptr && material->double_sided)) {
    glDisable(GL_CULL_FACE);
    return;
  }
  glEnable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  glFrontFace(winding < 0 ? GL_CW : GL_CCW);
}

const Material* material_of(const Model& model, const Mesh& mesh) {
  if (mesh.material < 0 || mesh.material >= static_cast<int>(model.materials.size()))
    return nullptr;
  return &model.materials[static_cast<std::size_t>(mesh.material)];
}

}  // namespace

GpuModel* SceneRenderer::Data::model(const std::shared_ptr<const Model>& wanted) {
  if (!wanted) return nullptr;
  for (const auto& have : models) {
    if (&have->model() == wanted.get()) return have.get();
  }
  models.push_back(std::make_unique<GpuModel>(wanted));
  return models.back().get();
}

void SceneRenderer::Data::drop_unused_models() {
  std::erase_if(models, [](const auto& model) { return model->unused(); });
}

void SceneRenderer::Data::collect(const Frame& frame) {
  items.clear();
  actor_models.clear();
  if (frame.world == nullptr || frame.states == nullptr) return;
  const auto& actors = frame.world->actors;
  const std::size_t count = std::min(actors.size(), frame.states->size());
  for (std::size_t a = 0; a < count; ++a) {
    const bool visible = a >= frame.looks.size() || frame.looks[a].visible;
    actor_models.push_back(visible ? model(actors[a].model) : nullptr);
    if (actor_models.back() == nullptr) continue;
    const auto roles = mesh_roles(actors[a]);
    for (std::size_t m = 0; m < roles.size(); ++m) {
      items.push_back({a, static_cast<int>(m), roles[m]});
    }
  }
}

void SceneRenderer::Data::deform_figures(const Frame& frame, const Vec3& origin) {
  while (figures.size() < actor_models.size()) figures.emplace_back();
  for (std::size_t a = 0; a < actor_models.size(); ++a) {
    if (actor_models[a] == nullptr) continue;
    const auto& emphasis = a < frame.looks.size() ? frame.looks[a].emphasis : std::vector<float>();
    figures[a].deform(skinning, *actor_models[a], (*frame.states)[a], origin, emphasis);
  }
  std::erase_if(items, [this](const DrawnMesh& item) {
    return figures[item.actor].winding(item.mesh) == 0 ||
           actor_models[item.actor]
                   ->geometry()
                   .meshes[static_cast<std::size_t>(item.mesh)]
                   .index_count == 0;
  });
}

void SceneRenderer::Data::upload_glow(const Frame& frame) {
  glow_begin.assign(actor_models.size(), -1);
  std::vector<std::uint8_t> levels;
  for (const auto& part : frame.glows) {
    const auto a = static_cast<std::size_t>(part.actor);
    if (part.actor < 0 || a >= actor_models.size() || actor_models[a] == nullptr) continue;
    const RenderGeometry& geometry = actor_models[a]->geometry();
    if (part.mesh < 0 || part.mesh >= static_cast<int>(geometry.meshes.size())) continue;
    if (glow_begin[a] < 0) {
      glow_begin[a] = static_cast<int>(levels.size());
      levels.resize(levels.size() + geometry.triangle_count, 0);
    }
    const RenderMesh& mesh = geometry.meshes[static_cast<std::size_t>(part.mesh)];
    const std::size_t count = std::min<std::size_t>(part.levels.size(), mesh.index_count / 3);
    for (std::size_t t = 0; t < count; ++t) {
      auto& level = levels[static_cast<std::size_t>(glow_begin[a]) + mesh.first_triangle + t];
      level = std::max(level, part.levels[t]);
    }
  }
  levels.resize((levels.size() + 3) / 4 * 4, 0);
  glow.write(levels.data(), levels.size());
  glow_levels = std::move(levels);
}

void SceneRenderer::Data::set_frame(const Frame& frame, const Camera& camera, const Style& style,
                                    double aspect) {
  drop_unused_models();
  collect(frame);
  const Camera sound = sanitized(camera);
  deform_figures(frame, sound.focus);
  upload_glow(frame);
  std::vector<Bounds> bodies;
  for (const auto& item : items) bodies.push_back(figures[item.actor].bounds(item.mesh));
  double size = frame.size;
  if (!(size > 0) || !std::isfinite(size)) size = frame.world ? scene_size(*frame.world) : 1.0;
  view = make_view(sound, style, frame, bodies, size, aspect);
}

void SceneRenderer::Data::draw_shadow() {
  std::vector<Cast> wanted;
  for (const auto& item : items) {
    wanted.push_back({item.actor, item.mesh, figures[item.actor].version()});
  }
  // The light stands still while the camera turns, so the map often does, too.
  if (cast_map == buffers.shadow.name() && cast_matrix == view.light_clip_from_world &&
      casts == wanted) {
    return;
  }
  casts = std::move(wanted);
  cast_matrix = view.light_clip_from_world;
  cast_map = buffers.shadow.name();
  glBindFramebuffer(GL_FRAMEBUFFER, buffers.shadow_target.name());
  glViewport(0, 0, buffers.shadow_size, buffers.shadow_size);
  glClear(GL_DEPTH_BUFFER_BIT);
  glEnable(GL_DEPTH_CLAMP);
  glDisable(GL_CULL_FACE);
  glUseProgram(shadow.name());
  const glm::mat4 matrix(view.light_clip_from_world);
  glUniformMatrix4fv(0, 1, GL_FALSE, &matrix[0][0]);
  for (const auto& item : items) {
    figures[item.actor].bind();
    figures[item.actor].draw(*actor_models[item.actor], item.mesh);
  }
  glDisable(GL_DEPTH_CLAMP);
}

void SceneRenderer::Data::draw_occlusion(const Style& style) {
  if (style.occlusion <= 0 || style.draft) return;
  glBindFramebuffer(GL_FRAMEBUFFER, buffers.geometry_target.name());
  glViewport(0, 0, buffers.half_width, buffers.half_height);
  const float nothing[4] = {0, 0, 0, 0};
  glClearBufferfv(GL_COLOR, 0, nothing);
  glClear(GL_DEPTH_BUFFER_BIT);
  glUseProgram(geometry.name());
  for (const auto& item : items) {
    const auto& model = actor_models[item.actor]->model();
    const Mesh& mesh = model.meshes[static_cast<std::size_t>(item.mesh)];
    set_winding(material_of(model, mesh), figures[item.actor].winding(item.mesh),
                style.cull_back_faces);
    figures[item.actor].bind();
    figures[item.actor].draw(*actor_models[item.actor], item.mesh);
  }
  glDisable(GL_CULL_FACE);
  glBindVertexArray(empty.name());
  if (style.ground) {
    glUseProgram(ground_geometry.name());
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  }
  glDisable(GL_DEPTH_TEST);
  glBindTextureUnit(kGeometry, buffers.geometry.name());
  glBindFramebuffer(GL_FRAMEBUFFER, buffers.occlusion_target.name());
  glUseProgram(occlusion.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindTextureUnit(kOcclusion, buffers.occlusion.name());
  glBindFramebuffer(GL_FRAMEBUFFER, buffers.blurred_target.name());
  glUseProgram(blur.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glEnable(GL_DEPTH_TEST);
}

void SceneRenderer::Data::bind_maps() const {
  glBindTextureUnit(kShadowCompare, buffers.shadow.name());
  glBindSampler(kShadowCompare, compare_sampler.name());
  glBindTextureUnit(kShadowDepth, buffers.shadow.name());
  glBindSampler(kShadowDepth, depth_sampler.name());
  glBindTextureUnit(kOcclusion, buffers.blurred.name());
  glBindTextureUnit(kGeometry, buffers.geometry.name());
}

void SceneRenderer::Data::draw_surfaces(const Frame& frame, const Style& style) {
  glUseProgram(style.draft ? draft_surface.name() : surface.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kGlowBinding, glow.name());
  for (const auto& item : items) {
    const GpuModel& gpu = *actor_models[item.actor];
    const Mesh& mesh = gpu.model().meshes[static_cast<std::size_t>(item.mesh)];
    const Material* material = material_of(gpu.model(), mesh);
    const bool textured = material != nullptr && material->base_color_image >= 0;
    glm::vec3 base = material != nullptr ? glm::vec3(material->base_color) : glm::vec3(1.0f);
    for (int c = 0; c < 3; ++c) {
      base[c] = std::isfinite(base[c]) ? std::clamp(base[c], 0.0f, 1.0f) : 1.0f;
    }
    const bool obstacle = item.role == Role::obstacle;
    const glm::vec3 tone = linear_from_rgb(obstacle ? style.obstacle : style.character);
    // White without a texture is what a file says that has no colours.
    const bool colourless = !textured && std::min({base.r, base.g, base.b}) > 0.95f;
    const float own = obstacle ? style.obstacle_materials : style.character_materials;
    if (colourless) base = tone;
    glUniform4f(0, base.r, base.g, base.b, 1.0f);
    glUniform4f(1, tone.r, tone.g, tone.b, colourless ? 1.0f : own);
    const auto part = [](float value, float fallback) {
      return std::isfinite(value) ? std::clamp(value, 0.0f, 1.0f) : fallback;
    };
    glUniform4f(2, material != nullptr ? part(material->roughness, 1) : 0.8f,
                material != nullptr && !colourless ? part(material->metallic, 0) : 0.0f, 0, 0);
    glm::vec4 emphasis(0.0f);
    if (item.actor < frame.looks.size()) {
      const ActorLook& look = frame.looks[item.actor];
      emphasis = glm::vec4(linear_from_rgb(look.emphasis_colour), look.emphasis_strength);
    }
    glUniform4fv(3, 1, &emphasis[0]);
    const auto& range = gpu.geometry().meshes[static_cast<std::size_t>(item.mesh)];
    const int begin = glow_begin[item.actor];
    glUniform1i(4, begin < 0 ? -1 : begin + static_cast<int>(range.first_triangle));
    glBindTextureUnit(kBase, gpu.texture(mesh.material));
    // A filter of many taps is dear where there is no GPU, and the white texture needs none.
    const bool fine = !style.draft && gpu.has_texture(mesh.material);
    glBindSampler(kBase, fine ? base_sampler.name() : plain_sampler.name());
    set_winding(material, figures[item.actor].winding(item.mesh), style.cull_back_faces);
    figures[item.actor].bind();
    figures[item.actor].draw(gpu, item.mesh);
  }
  glDisable(GL_CULL_FACE);
}

void SceneRenderer::Data::draw_ghosts(const Frame& frame) {
  // Farther ghosts first, so that they show through nearer ones.
  struct Order {
    double distance;
    std::size_t ghost;
    GpuModel* model;
  };
  std::vector<Order> order;
  while (ghost_figures.size() < frame.ghosts.size()) ghost_figures.emplace_back();
  for (std::size_t g = 0; g < frame.ghosts.size(); ++g) {
    const Ghost& ghost = frame.ghosts[g];
    if (ghost.actor == nullptr || ghost.state == nullptr) continue;
    GpuModel* gpu = model(ghost.actor->model);
    if (gpu == nullptr) continue;
    ghost_figures[g].deform(skinning, *gpu, *ghost.state, view.camera.focus, ghost.parts);
    Bounds all;
    for (std::size_t m = 0; m < gpu->geometry().meshes.size(); ++m) {
      all.add(ghost_figures[g].bounds(static_cast<int>(m)));
    }
    if (all.empty()) continue;
    order.push_back({glm::dot(view.camera.eye() - all.centre(), view.camera.backward()), g, gpu});
  }
  std::stable_sort(order.begin(), order.end(),
                   [](const Order& a, const Order& b) { return a.distance > b.distance; });
  glDisable(GL_CULL_FACE);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(1.0f, 4.0f);  // away: what coincides with a solid surface gives way to it
  for (const auto& [distance, g, gpu] : order) {
    const Ghost& ghost_look = frame.ghosts[g];
    const glm::vec4 colour(linear_from_rgb(ghost_look.colour), ghost_look.opacity);
    const float part = ghost_look.parts.empty() ? 0.0f : 1.0f;
    const auto draw_all = [&] {
      ghost_figures[g].bind();
      for (std::size_t m = 0; m < gpu->geometry().meshes.size(); ++m) {
        const int mesh = static_cast<int>(m);
        if (ghost_figures[g].winding(mesh) != 0) ghost_figures[g].draw(*gpu, mesh);
      }
    };
    glUseProgram(ghost_depth.name());
    glUniform4f(1, part, 0, 0, 0);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glDepthMask(GL_TRUE);
    draw_all();
    glUseProgram(ghost.name());
    glUniform4fv(0, 1, &colour[0]);
    glUniform4f(1, part, 0, 0, 0);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_FALSE);
    draw_all();
  }
  glDepthMask(GL_TRUE);
  glDisable(GL_POLYGON_OFFSET_FILL);
}

SceneRenderer::Data::Scene SceneRenderer::Data::scene_of(const Frame& frame, const Style& style,
                                                         const FrameUniforms& uniforms) const {
  Scene scene;
  for (const auto& item : items) {
    scene.items.push_back({item.actor, item.mesh, figures[item.actor].version()});
  }
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(&uniforms);
  scene.uniforms.assign(bytes, bytes + sizeof uniforms);
  scene.glow = glow_levels;
  for (const int begin : glow_begin) scene.emphasis.emplace_back(begin);
  for (const auto& look : frame.looks) {
    scene.emphasis.emplace_back(linear_from_rgb(look.emphasis_colour), look.emphasis_strength);
  }
  scene.style = style;
  return scene;
}

void SceneRenderer::Data::copy_picture(const GlFramebuffer& from, const GlFramebuffer& to) const {
  glBlitNamedFramebuffer(from.name(), to.name(), 0, 0, buffers.width, buffers.height, 0, 0,
                         buffers.width, buffers.height, GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT,
                         GL_NEAREST);
}

// All but ghosts, trails and marks.
void SceneRenderer::Data::draw_scene(const Frame& frame, const Style& style) {
  draw_shadow();
  draw_occlusion(style);
  glBindFramebuffer(GL_FRAMEBUFFER, buffers.picture.name());
  glViewport(0, 0, buffers.width, buffers.height);
  glEnable(GL_FRAMEBUFFER_SRGB);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  bind_maps();
  draw_surfaces(frame, style);
  // At the far plane: only where there is nothing yet.
  glDepthMask(GL_FALSE);
  glBindVertexArray(empty.name());
  glUseProgram(backdrop.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  if (style.ground) {
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glUseProgram(style.draft ? draft_ground.name() : ground.name());
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    glDisable(GL_BLEND);
  }
  glDepthMask(GL_TRUE);
}

}  // namespace elbowroom
