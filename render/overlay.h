// SPDX-License-Identifier: MIT
// Trails and marks: lines and round marks of a fixed size in pixels, drawn over the scene with its
// depth; what bodies hide is drawn faintly.
#pragma once

#include <vector>

#include "core/base/result.h"
#include "render/frame.h"
#include "render/gl_objects.h"
#include "render/style.h"

namespace elbowroom {

class Overlay {
 public:
  static Result<Overlay> create();

  // Draws the frame's trails, markers and contact rings into the bound framebuffer; the uniforms of
  // frame.glsl are bound. `origin` is what positions are relative to.
  void draw(const Frame& frame, const Style& style, const Vec3& origin);

 private:
  Overlay() = default;
  void draw_batch(const GlProgram& program, int count, float strength, float hidden);

  GlProgram lines_, markers_;
  GlVertexArray empty_;
  StreamBuffer data_;
};

}  // namespace elbowroom
