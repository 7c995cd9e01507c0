// SPDX-License-Identifier: MIT
// Owners of OpenGL names: made empty, filled by the drawing classes, deleted with their owner.
//
// All of render's drawing classes need a current GL 4.5 core context on the calling thread when
// they are constructed, used and destroyed; none of them makes one (render/offscreen_context.h and
// the editor's window do).
#pragma once

#include <cstddef>
#include <utility>

namespace elbowroom {

enum class GlKind { buffer, texture, framebuffer, renderbuffer, vertex_array, sampler, program };

// The names are GLuint; spelt out so that headers need no GL.
template <GlKind kind>
class GlObject {
 public:
  GlObject() = default;
  explicit GlObject(unsigned name) : name_(name) {}
  GlObject(GlObject&& other) noexcept : name_(std::exchange(other.name_, 0u)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  GlObject(const GlObject&) = delete;
  GlObject& operator=(const GlObject&) = delete;
  ~GlObject() { reset(); }

  unsigned name() const { return name_; }
  explicit operator bool() const { return name_ != 0; }
  void reset();

 private:
  unsigned name_ = 0;
};

using GlBuffer = GlObject<GlKind::buffer>;
using GlTexture = GlObject<GlKind::texture>;
using GlFramebuffer = GlObject<GlKind::framebuffer>;
using GlRenderbuffer = GlObject<GlKind::renderbuffer>;
using GlVertexArray = GlObject<GlKind::vertex_array>;
using GlSampler = GlObject<GlKind::sampler>;
using GlProgram = GlObject<GlKind::program>;

extern template class GlObject<GlKind::buffer>;
extern template class GlObject<GlKind::texture>;
extern template class GlObject<GlKind::framebuffer>;
extern template class GlObject<GlKind::renderbuffer>;
extern template class GlObject<GlKind::vertex_array>;
extern template class GlObject<GlKind::sampler>;
extern template class GlObject<GlKind::program>;

// Immutable buffer with that content; never of size 0, so that it can always be bound.
GlBuffer make_static_buffer(const void* data, std::size_t bytes);

// A buffer whose content changes from frame to frame; grows, never shrinks.
class StreamBuffer {
 public:
  void write(const void* data, std::size_t bytes);
  // Room for `bytes` without content.
  void reserve(std::size_t bytes);
  unsigned name() const { return buffer_.name(); }

 private:
  GlBuffer buffer_;
  std::size_t capacity_ = 0;
};

// Immutable 2D texture without content; `format` is a sized GL internal format.
GlTexture make_texture(unsigned format, int width, int height, int levels = 1);
GlVertexArray make_vertex_array();
GlFramebuffer make_framebuffer();

}  // namespace elbowroom
