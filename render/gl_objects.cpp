// SPDX-License-Identifier: MIT
#include "render/gl_objects.h"

#include <epoxy/gl.h>

#include <algorithm>

namespace elbowroom {

template <GlKind kind>
void GlObject<kind>::reset() {
  if (name_ == 0) return;
  if constexpr (kind == GlKind::buffer) glDeleteBuffers(1, &name_);
  if constexpr (kind == GlKind::texture) glDeleteTextures(1, &name_);
  if constexpr (kind == GlKind::framebuffer) glDeleteFramebuffers(1, &name_);
  if constexpr (kind == GlKind::renderbuffer) glDeleteRenderbuffers(1, &name_);
  if constexpr (kind == GlKind::vertex_array) glDeleteVertexArrays(1, &name_);
  if constexpr (kind == GlKind::sampler) glDeleteSamplers(1, &name_);
  if constexpr (kind == GlKind::program) glDeleteProgram(name_);
  name_ = 0;
}

template class GlObject<GlKind::buffer>;
template class GlObject<GlKind::texture>;
template class GlObject<GlKind::framebuffer>;
template class GlObject<GlKind::renderbuffer>;
template class GlObject<GlKind::vertex_array>;
template class GlObject<GlKind::sampler>;
template class GlObject<GlKind::program>;

GlBuffer make_static_buffer(const void* data, std::size_t bytes) {
  static const unsigned char zeros[16] = {};
  GLuint name = 0;
  glCreateBuffers(1, &name);
  if (bytes == 0) {
    glNamedBufferStorage(name, sizeof zeros, zeros, 0);
  } else {
    glNamedBufferStorage(name, static_cast<GLsizeiptr>(bytes), data, 0);
  }
  return GlBuffer(name);
}

void StreamBuffer::reserve(std::size_t bytes) {
  bytes = std::max<std::size_t>(bytes, 16);
  if (buffer_ && bytes <= capacity_) return;
  GLuint name = 0;
  glCreateBuffers(1, &name);
  capacity_ = bytes + bytes / 2;
  glNamedBufferStorage(name, static_cast<GLsizeiptr>(capacity_), nullptr, GL_DYNAMIC_STORAGE_BIT);
  buffer_ = GlBuffer(name);
}

void StreamBuffer::write(const void* data, std::size_t bytes) {
  reserve(bytes);
  if (bytes > 0) glNamedBufferSubData(buffer_.name(), 0, static_cast<GLsizeiptr>(bytes), data);
}

GlTexture make_texture(unsigned format, int width, int height, int levels) {
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &name);
  glTextureStorage2D(name, levels, format, width, height);
  return GlTexture(name);
}

GlVertexArray make_vertex_array() {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  return GlVertexArray(name);
}

GlFramebuffer make_framebuffer() {
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  return GlFramebuffer(name);
}

}  // namespace elbowroom
