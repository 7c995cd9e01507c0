// SPDX-License-Identifier: MIT
// The buffers a picture is made in: multisampled colour and depth, the resolved picture, the
// half-size geometry and occlusion maps, and the shadow map. Made anew when the size changes.
#pragma once

#include "core/base/result.h"
#include "render/gl_objects.h"

namespace elbowroom {

class PictureBuffers {
 public:
  // Sizes in pixels and texels, at least 1; samples are capped by what the driver has.
  Status resize(int width, int height, int samples, int shadow_size);

  int width = 0, height = 0, samples = 0, shadow_size = 0;
  int half_width = 0, half_height = 0;

  GlRenderbuffer colour, depth;
  GlFramebuffer picture;     // multisampled, SRGB8_ALPHA8; of one sample it draws into resolved
  GlTexture resolved;        // SRGB8_ALPHA8
  GlTexture resolved_bytes;  // the same memory as RGBA8: the sRGB bytes as they are
  GlFramebuffer resolved_target, bytes_source;

  // Makes the buffers of a second picture like the first one, where there are none yet.
  bool make_kept();
  GlRenderbuffer kept_colour, kept_depth;
  GlFramebuffer kept;

  GlTexture geometry, occlusion, blurred;
  GlRenderbuffer half_depth;
  GlFramebuffer geometry_target, occlusion_target, blurred_target;

  GlTexture shadow;
  GlFramebuffer shadow_target;
};

}  // namespace elbowroom
