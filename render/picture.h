// SPDX-License-Identifier: MIT
// A picture in memory: 8-bit sRGB pixels, and what a filmstrip is put together with. No GL.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/base/result.h"
#include "render/colour.h"

namespace elbowroom {

struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  // 3 a pixel, rows from the top

  Picture() = default;
  // Filled with one colour. Sizes below 0 count as 0.
  Picture(int width, int height, Rgb fill);

  bool empty() const { return rgb.empty(); }
  // Requires 0 ≤ x < width, 0 ≤ y < height.
  Rgb pixel(int x, int y) const;
  void set(int x, int y, Rgb colour);
  // Mixes a colour in; coverage [0, 1]; outside the picture nothing happens.
  void blend(int x, int y, Rgb colour, double coverage);
};

// Fills a rectangle with rounded, smooth corners. What lies outside the picture is cut off.
void fill_rounded(Picture& picture, double x, double y, double width, double height, double radius,
                  Rgb colour, double opacity = 1);
// A smooth line of that thickness along the rectangle's inside.
void outline_rounded(Picture& picture, double x, double y, double width, double height,
                     double radius, double thickness, Rgb colour);
// Copies `source` with its upper left at (x, y), its corners rounded.
void paste_rounded(Picture& picture, const Picture& source, int x, int y, double radius);

// Half the size in both directions, by the mean in linear light.
Picture halved(const Picture& picture);

// Writes a PNG under a temporary name beside `path`, syncs it and renames it, so that the path
// never holds half a file. Error: empty picture, or the system's reason.
Status write_png(const Picture& picture, const std::filesystem::path& path);
// The PNG's bytes.
Result<std::vector<std::uint8_t>> encode_png(const Picture& picture);

}  // namespace elbowroom
