// SPDX-License-Identifier: MIT
// Draws a Frame as a lit picture: soft shadows, ambient occlusion, ground grid, ghosts, trails and
// marks, multisampled, in linear light with sRGB output.
//
// The picture is made in buffers of the renderer's own; present() copies it to a window, texture()
// shows it in a user interface, read() fetches it. All calls need the GL 4.5 core context that was
// current at create(); framebuffer, program, vertex array, viewport, blend, depth, cull and scissor
// state are left at GL's defaults. Not thread-safe. Models are uploaded when first seen and dropped
// when their last owner outside lets go of them.
#pragma once

#include <memory>

#include "core/base/result.h"
#include "render/camera.h"
#include "render/frame.h"
#include "render/picture.h"
#include "render/style.h"

namespace elbowroom {

// What a pixel shows.
struct Pick {
  int actor = -1, mesh = -1, triangle = -1;  // −1: nothing there
  Vec3 place{0.0};                           // world
  bool hit() const { return actor >= 0; }
};

// Pixels of the picture, from the top left; those of the size.
struct PictureSize {
  int width = 1600, height = 1000;
};

class SceneRenderer {
 public:
  // Error: a GL older than 4.5, or shaders that the driver refuses.
  static Result<SceneRenderer> create();
  SceneRenderer(SceneRenderer&&) noexcept;
  SceneRenderer& operator=(SceneRenderer&&) noexcept;
  ~SceneRenderer();

  // Draws the frame into the renderer's own buffers. Sizes are clamped to [1, 8192] and the
  // driver's limit. Error: more than 40 million pixels, or buffers that the driver refuses.
  Status draw(const Frame& frame, const Camera& camera, const Style& style,
              const PictureSize& size);
  // The same, of the world at time t.
  Status draw(const World& world, double t, const Camera& camera, const Style& style,
              const PictureSize& size);

  // GL texture of the last picture: RGBA8 that holds sRGB bytes, as a user interface blends them;
  // rows go upwards. 0 before the first draw. Good until the next draw of another size.
  unsigned texture() const;
  // Copies the last picture, pixel for pixel, to a framebuffer's rectangle with that lower left.
  void present(unsigned framebuffer, int x, int y) const;
  // The same into a rectangle of another size, smoothly stretched: for pictures drawn coarser.
  void present(unsigned framebuffer, int x, int y, int width, int height) const;
  // The last picture, rows downwards, opaque. Waits for the GPU.
  Picture read() const;

  // What the last picture shows at a pixel (from the top left). Draws one pixel's worth of ids;
  // ghosts and marks are not picked.
  Pick pick(double x, double y);

  // The same for every pixel of a small picture, rows downwards, without drawing it: what a camera
  // would see. The last picture stays, but pick() and read_positions() now speak of this frame.
  std::vector<Pick> pick_all(const Frame& frame, const Camera& camera, const PictureSize& size);

  // Deformed positions of an actor of the last frame, world space, one per source vertex of the
  // mesh; empty if it has none. For tests and measuring; waits for the GPU.
  std::vector<Vec3> read_positions(int actor, int mesh) const;

  struct Data;

 private:
  explicit SceneRenderer(std::unique_ptr<Data> data);
  std::unique_ptr<Data> data_;
};

}  // namespace elbowroom
