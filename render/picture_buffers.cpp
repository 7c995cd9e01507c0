// SPDX-License-Identifier: MIT
#include "render/picture_buffers.h"

#include <epoxy/gl.h>

#include <algorithm>

namespace elbowroom {
namespace {

GlRenderbuffer make_renderbuffer(GLenum format, int width, int height, int samples) {
  GLuint name = 0;
  glCreateRenderbuffers(1, &name);
  glNamedRenderbufferStorageMultisample(name, samples, format, width, height);
  return GlRenderbuffer(name);
}

GlFramebuffer make_target(const GlTexture& texture) {
  GlFramebuffer target = make_framebuffer();
  glNamedFramebufferTexture(target.name(), GL_COLOR_ATTACHMENT0, texture.name(), 0);
  return target;
}

bool complete(const GlFramebuffer& framebuffer) {
  return glCheckNamedFramebufferStatus(framebuffer.name(), GL_FRAMEBUFFER) ==
         GL_FRAMEBUFFER_COMPLETE;
}

void filter_nearest(const GlTexture& texture) {
  glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

}  // namespace

Status PictureBuffers::resize(int new_width, int new_height, int new_samples, int new_shadow_size) {
  GLint most_samples = 1;
  glGetIntegerv(GL_MAX_SAMPLES, &most_samples);
  new_samples = std::clamp(new_samples, 1, std::max(most_samples, 1));
  if (shadow_size != new_shadow_size) {
    shadow_size = new_shadow_size;
    shadow = make_texture(GL_DEPTH_COMPONENT32F, shadow_size, shadow_size);
    shadow_target = make_framebuffer();
    glNamedFramebufferTexture(shadow_target.name(), GL_DEPTH_ATTACHMENT, shadow.name(), 0);
    glNamedFramebufferDrawBuffer(shadow_target.name(), GL_NONE);
    glNamedFramebufferReadBuffer(shadow_target.name(), GL_NONE);
  }
  if (width != new_width || height != new_height || samples != new_samples) {
    width = new_width;
    height = new_height;
    samples = new_samples;
    kept.reset();
    kept_colour.reset();
    kept_depth.reset();
    half_width = (width + 1) / 2;
    half_height = (height + 1) / 2;

    // Asked for one sample a driver may give four.
    const int asked = samples > 1 ? samples : 0;
    colour =
        make_renderbuffer(GL_SRGB8_ALPHA8, asked > 0 ? width : 1, asked > 0 ? height : 1, asked);
    depth = make_renderbuffer(GL_DEPTH_COMPONENT32F, width, height, asked);
    picture = make_framebuffer();
    glNamedFramebufferRenderbuffer(picture.name(), GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                   depth.name());
    resolved = make_texture(GL_SRGB8_ALPHA8, width, height);
    GLuint view = 0;
    glGenTextures(1, &view);
    glTextureView(view, GL_TEXTURE_2D, resolved.name(), GL_RGBA8, 0, 1, 0, 1);
    resolved_bytes = GlTexture(view);
    glTextureParameteri(view, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(view, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(view, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    resolved_target = make_target(resolved);
    if (asked > 0) {
      glNamedFramebufferRenderbuffer(picture.name(), GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                     colour.name());
    } else {
      glNamedFramebufferTexture(picture.name(), GL_COLOR_ATTACHMENT0, resolved.name(), 0);
    }
    bytes_source = make_target(resolved_bytes);

    geometry = make_texture(GL_RGBA32F, half_width, half_height);
    occlusion = make_texture(GL_R8, half_width, half_height);
    blurred = make_texture(GL_R8, half_width, half_height);
    for (const auto* map : {&geometry, &occlusion, &blurred}) filter_nearest(*map);
    half_depth = make_renderbuffer(GL_DEPTH_COMPONENT32F, half_width, half_height, 0);
    geometry_target = make_target(geometry);
    glNamedFramebufferRenderbuffer(geometry_target.name(), GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                   half_depth.name());
    occlusion_target = make_target(occlusion);
    blurred_target = make_target(blurred);
  }
  for (const auto* target : {&shadow_target, &picture, &resolved_target, &bytes_source,
                             &geometry_target, &occlusion_target, &blurred_target}) {
    if (!complete(*target)) {
      width = height = shadow_size = 0;
      return Error{"the graphics driver refuses buffers of that size", "rendering",
                   "make the picture smaller"};
    }
  }
  return Done{};
}

bool PictureBuffers::make_kept() {
  if (kept) return true;
  const int asked = samples > 1 ? samples : 0;
  kept_colour = make_renderbuffer(GL_SRGB8_ALPHA8, width, height, asked);
  kept_depth = make_renderbuffer(GL_DEPTH_COMPONENT32F, width, height, asked);
  kept = make_framebuffer();
  glNamedFramebufferRenderbuffer(kept.name(), GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                 kept_colour.name());
  glNamedFramebufferRenderbuffer(kept.name(), GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                 kept_depth.name());
  if (complete(kept)) return true;
  kept.reset();
  return false;
}

}  // namespace elbowroom
