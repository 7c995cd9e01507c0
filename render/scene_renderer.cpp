// SPDX-License-Identifier: MIT
#include "render/scene_renderer.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "render/scene_renderer_data.h"

namespace elbowroom {
namespace {

constexpr int kLargestPicture = 8192;
constexpr std::int64_t kMostPixels = 40'000'000;

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

}  // namespace elbowroom
