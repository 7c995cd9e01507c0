// SPDX-License-Identifier: MIT
#include "render/scene_renderer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "render/frame_uniforms.h"
#include "render/gpu_model.h"
#include "render/overlay.h"
#include "render/picture_buffers.h"
#include "render/shader.h"

namespace elbowroom {
namespace {

constexpr int kLargestPicture = 8192;
constexpr std::int64_t kMostPixels = 40'000'000;

// Texture units and storage bindings of the shaders.
enum Unit : GLuint {
  kBase = 0,
  kShadowCompare = 1,
  kShadowDepth = 2,
  kOcclusion = 3,
  kGeometry = 4
};
constexpr GLuint kFrameBinding = 0, kGlowBinding = 0;

// One mesh of one actor to be drawn.
struct Item {
  std::size_t actor = 0;
  int mesh = 0;
  Role role = Role::obstacle;
};

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

GlSampler make_sampler(GLenum filter, GLenum wrap, float anisotropy) {
  GLuint name = 0;
  glCreateSamplers(1, &name);
  glSamplerParameteri(
      name, GL_TEXTURE_MIN_FILTER,
      static_cast<GLint>(filter == GL_LINEAR && wrap == GL_REPEAT ? GL_LINEAR_MIPMAP_LINEAR
                                                                  : filter));
  glSamplerParameteri(name, GL_TEXTURE_MAG_FILTER, static_cast<GLint>(filter));
  glSamplerParameteri(name, GL_TEXTURE_WRAP_S, static_cast<GLint>(wrap));
  glSamplerParameteri(name, GL_TEXTURE_WRAP_T, static_cast<GLint>(wrap));
  if (anisotropy > 1 && epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic")) {
    glSamplerParameterf(name, GL_TEXTURE_MAX_ANISOTROPY_EXT, anisotropy);
  }
  return GlSampler(name);
}

}  // namespace

struct SceneRenderer::Data {
  GlProgram skinning, surface, shadow, geometry, ground_geometry, occlusion, blur, backdrop, ground,
      ghost, ghost_depth, pick, draft_surface, draft_ground;
  std::optional<Overlay> overlay;
  PictureBuffers buffers;
  GlSampler base_sampler, plain_sampler, compare_sampler, depth_sampler;
  GlVertexArray empty;
  StreamBuffer uniforms, glow;
  std::vector<std::unique_ptr<GpuModel>> models;
  std::vector<GpuFigure> figures;        // by actor
  std::vector<GpuFigure> ghost_figures;  // by ghost

  // Of the last frame.
  std::vector<GpuModel*> actor_models;
  std::vector<Item> items;
  std::vector<int> glow_begin;  // by actor: its first byte in the glow buffer, −1: none
  ViewSetup view;
  bool drawn = false;

  // What the shadow map shows; empty: nothing.
  struct Cast {
    std::size_t actor;
    int mesh;
    std::uint64_t version;
    bool operator==(const Cast&) const = default;
  };
  std::vector<Cast> casts;
  // What a kept picture shows.
  struct Scene {
    std::vector<Cast> items;
    std::vector<std::uint8_t> uniforms, glow;
    std::vector<glm::vec4> emphasis;  // by actor
    Style style;
    bool operator==(const Scene&) const = default;
  };
  std::optional<Scene> kept_scene;
  std::vector<std::uint8_t> glow_levels;  // as uploaded
  Scene scene_of(const Frame& frame, const Style& style, const FrameUniforms& uniforms) const;
  void draw_scene(const Frame& frame, const Style& style);
  void copy_picture(const GlFramebuffer& from, const GlFramebuffer& to) const;

  Mat4 cast_matrix{0.0};
  unsigned cast_map = 0;

  GpuModel* model(const std::shared_ptr<const Model>& wanted);
  void drop_unused_models();
  void collect(const Frame& frame);
  // Deforms all figures and sets the view; `items` are then what is to be drawn.
  void set_frame(const Frame& frame, const Camera& camera, const Style& style, double aspect);
  void deform_figures(const Frame& frame, const Vec3& origin);
  void upload_glow(const Frame& frame);
  void draw_shadow();
  void draw_occlusion(const Style& style);
  void draw_surfaces(const Frame& frame, const Style& style);
  void draw_ghosts(const Frame& frame);
  void bind_maps() const;
  std::vector<Pick> draw_ids(const Mat4& clip_from_world, int width, int height);
};

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
  std::erase_if(items, [this](const Item& item) {
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

Result<SceneRenderer> SceneRenderer::create() {
  if (epoxy_gl_version() < 45) {
    return Error{"the graphics driver offers OpenGL " + std::to_string(epoxy_gl_version() / 10) +
                     "." + std::to_string(epoxy_gl_version() % 10) + ", 4.5 is needed",
                 "rendering", "update the driver; Mesa's llvmpipe (libgl1-mesa-dri) has it too"};
  }
  auto data = std::make_unique<Data>();
  auto skinning = make_compute_program("skin.comp.glsl");
  if (!skinning) return skinning.error();
  data->skinning = std::move(*skinning);
  struct Wanted {
    GlProgram* program;
    const char* vertex;
    const char* fragment;
    const char* prelude = "";
  };
  const Wanted wanted[] = {
      {&data->surface, "surface.vert.glsl", "surface.frag.glsl"},
      {&data->shadow, "depth.vert.glsl", "depth.frag.glsl"},
      {&data->geometry, "surface.vert.glsl", "geometry.frag.glsl"},
      {&data->ground_geometry, "ground.vert.glsl", "geometry.frag.glsl"},
      {&data->occlusion, "screen.vert.glsl", "occlusion.frag.glsl"},
      {&data->blur, "screen.vert.glsl", "blur.frag.glsl"},
      {&data->backdrop, "screen.vert.glsl", "backdrop.frag.glsl"},
      {&data->ground, "ground.vert.glsl", "ground.frag.glsl"},
      {&data->ghost, "surface.vert.glsl", "ghost.frag.glsl"},
      {&data->ghost_depth, "surface.vert.glsl", "ghost_depth.frag.glsl"},
      {&data->pick, "depth.vert.glsl", "pick.frag.glsl"},
      {&data->draft_surface, "draft_surface.vert.glsl", "draft_surface.frag.glsl",
       "#define DRAFT\n"},
      {&data->draft_ground, "ground.vert.glsl", "ground.frag.glsl", "#define DRAFT\n"},
  };
  for (const auto& [program, vertex, fragment, prelude] : wanted) {
    auto made = make_program(vertex, fragment, prelude);
    if (!made) return made.error();
    *program = std::move(*made);
  }
  auto overlay = Overlay::create();
  if (!overlay) return overlay.error();
  data->overlay.emplace(std::move(*overlay));
  data->base_sampler = make_sampler(GL_LINEAR, GL_REPEAT, 8);
  data->plain_sampler = make_sampler(GL_LINEAR, GL_REPEAT, 1);
  data->depth_sampler = make_sampler(GL_NEAREST, GL_CLAMP_TO_EDGE, 1);
  data->compare_sampler = make_sampler(GL_LINEAR, GL_CLAMP_TO_EDGE, 1);
  glSamplerParameteri(data->compare_sampler.name(), GL_TEXTURE_COMPARE_MODE,
                      GL_COMPARE_REF_TO_TEXTURE);
  glSamplerParameteri(data->compare_sampler.name(), GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  data->empty = make_vertex_array();
  return SceneRenderer(std::move(data));
}

SceneRenderer::SceneRenderer(std::unique_ptr<Data> data) : data_(std::move(data)) {}
SceneRenderer::SceneRenderer(SceneRenderer&&) noexcept = default;
SceneRenderer& SceneRenderer::operator=(SceneRenderer&&) noexcept = default;
SceneRenderer::~SceneRenderer() = default;

Status SceneRenderer::draw(const Frame& frame, const Camera& camera, const Style& style,
                           const PictureSize& size) {
  Data& d = *data_;
  GLint largest = kLargestPicture;
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
  largest = std::min(largest, kLargestPicture);
  const int width = std::clamp(size.width, 1, largest);
  const int height = std::clamp(size.height, 1, largest);
  d.drawn = false;
  // Multisampled colour and depth take 32 bytes a pixel; more than this is a slip of the caller's.
  if (std::int64_t{width} * height > kMostPixels) {
    return Error{"the picture would have more than 40 million pixels", "rendering",
                 "make the picture smaller"};
  }
  auto sized = d.buffers.resize(width, height, style.samples,
                                std::clamp(style.shadow_map_size, 16, largest));
  if (!sized) return sized;

  d.set_frame(frame, camera, style, static_cast<double>(width) / height);
  const FrameUniforms uniforms = make_uniforms(d.view, style, frame, width, height);
  d.uniforms.write(&uniforms, sizeof uniforms);
  glBindBufferBase(GL_UNIFORM_BUFFER, kFrameBinding, d.uniforms.name());

  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glEnable(GL_MULTISAMPLE);
  const bool have_kept = static_cast<bool>(d.buffers.kept);
  if (frame.keep_scene && d.buffers.make_kept()) {
    Data::Scene scene = d.scene_of(frame, style, uniforms);
    if (have_kept && d.kept_scene == scene) {
      d.copy_picture(d.buffers.kept, d.buffers.picture);
    } else {
      d.draw_scene(frame, style);
      d.copy_picture(d.buffers.picture, d.buffers.kept);
      d.kept_scene = std::move(scene);
    }
  } else {
    d.draw_scene(frame, style);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, d.buffers.picture.name());
  glViewport(0, 0, width, height);
  glEnable(GL_FRAMEBUFFER_SRGB);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  d.draw_ghosts(frame);
  d.overlay->draw(frame, style, d.view.camera.focus);

  if (d.buffers.samples > 1) {
    glBlitNamedFramebuffer(d.buffers.picture.name(), d.buffers.resolved_target.name(), 0, 0, width,
                           height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  }
  glDisable(GL_FRAMEBUFFER_SRGB);
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glFrontFace(GL_CCW);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glBindVertexArray(0);
  glUseProgram(0);
  for (GLuint unit = kBase; unit <= kGeometry; ++unit) {
    glBindTextureUnit(unit, 0);
    glBindSampler(unit, 0);
  }
  d.drawn = true;
  return Done{};
}

Status SceneRenderer::draw(const World& world, double t, const Camera& camera, const Style& style,
                           const PictureSize& size) {
  std::vector<ActorState> states;
  world_state_at(world, t, states);
  Frame frame;
  frame.world = &world;
  frame.states = &states;
  return draw(frame, camera, style, size);
}

unsigned SceneRenderer::texture() const {
  return data_->drawn ? data_->buffers.resolved_bytes.name() : 0u;
}

void SceneRenderer::present(unsigned framebuffer, int x, int y) const {
  present(framebuffer, x, y, data_->buffers.width, data_->buffers.height);
}

void SceneRenderer::present(unsigned framebuffer, int x, int y, int width, int height) const {
  if (!data_->drawn) return;
  const int own_width = data_->buffers.width, own_height = data_->buffers.height;
  glDisable(GL_SCISSOR_TEST);
  glBlitNamedFramebuffer(data_->buffers.bytes_source.name(), framebuffer, 0, 0, own_width,
                         own_height, x, y, x + width, y + height, GL_COLOR_BUFFER_BIT,
                         width == own_width && height == own_height ? GL_NEAREST : GL_LINEAR);
}

Picture SceneRenderer::read() const {
  if (!data_->drawn) return Picture();
  const int width = data_->buffers.width, height = data_->buffers.height;
  Picture picture(width, height, 0);
  const std::size_t row = 3 * static_cast<std::size_t>(width);
  std::vector<std::uint8_t> pixels(row * static_cast<std::size_t>(height));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glGetTextureImage(data_->buffers.resolved_bytes.name(), 0, GL_RGB, GL_UNSIGNED_BYTE,
                    static_cast<GLsizei>(pixels.size()), pixels.data());
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
    std::memcpy(&picture.rgb[y * row], &pixels[(static_cast<std::size_t>(height) - 1 - y) * row],
                row);
  }
  return picture;
}

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
