// SPDX-License-Identifier: MIT
#include "render/picture.h"

#include <fcntl.h>
#include <stb_image_write.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>

namespace elbowroom {
namespace {

std::size_t offset(const Picture& picture, int x, int y) {
  return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
              static_cast<std::size_t>(x));
}

// Signed distance from a rectangle with rounded corners, negative inside, in pixels.
double rounded_distance(double px, double py, double x, double y, double width, double height,
                        double radius) {
  radius = std::min(radius, 0.5 * std::min(width, height));
  const double qx = std::abs(px - (x + 0.5 * width)) - 0.5 * width + radius;
  const double qy = std::abs(py - (y + 0.5 * height)) - 0.5 * height + radius;
  return std::hypot(std::max(qx, 0.0), std::max(qy, 0.0)) + std::min(std::max(qx, qy), 0.0) -
         radius;
}

template <typename Paint>
void for_rectangle(const Picture& picture, double x, double y, double width, double height,
                   const Paint& paint) {
  const int x0 = std::max(0, static_cast<int>(std::floor(x - 1)));
  const int y0 = std::max(0, static_cast<int>(std::floor(y - 1)));
  const int x1 = std::min(picture.width, static_cast<int>(std::ceil(x + width + 1)));
  const int y1 = std::min(picture.height, static_cast<int>(std::ceil(y + height + 1)));
  for (int py = y0; py < y1; ++py) {
    for (int px = x0; px < x1; ++px) paint(px, py);
  }
}

Error system_error(const std::string& what, const std::filesystem::path& path) {
  return Error{what + ": " + std::strerror(errno), path.string(),
               "check that the folder exists, may be written to and has room"};
}

}  // namespace

Picture::Picture(int w, int h, Rgb fill) : width(std::max(w, 0)), height(std::max(h, 0)) {
  rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (std::size_t i = 0; i < rgb.size(); i += 3) {
    rgb[i] = static_cast<std::uint8_t>(fill >> 16);
    rgb[i + 1] = static_cast<std::uint8_t>(fill >> 8);
    rgb[i + 2] = static_cast<std::uint8_t>(fill);
  }
}

Rgb Picture::pixel(int x, int y) const {
  const auto* p = &rgb[offset(*this, x, y)];
  return (Rgb{p[0]} << 16) | (Rgb{p[1]} << 8) | Rgb{p[2]};
}

void Picture::set(int x, int y, Rgb colour) {
  auto* p = &rgb[offset(*this, x, y)];
  p[0] = static_cast<std::uint8_t>(colour >> 16);
  p[1] = static_cast<std::uint8_t>(colour >> 8);
  p[2] = static_cast<std::uint8_t>(colour);
}

void Picture::blend(int x, int y, Rgb colour, double coverage) {
  if (x < 0 || y < 0 || x >= width || y >= height || !(coverage > 0)) return;
  coverage = std::min(coverage, 1.0);
  auto* p = &rgb[offset(*this, x, y)];
  for (int c = 0; c < 3; ++c) {
    const double over = static_cast<double>((colour >> (16 - 8 * c)) & 0xffu);
    p[c] = static_cast<std::uint8_t>(std::lround(p[c] + (over - p[c]) * coverage));
  }
}

void fill_rounded(Picture& picture, double x, double y, double width, double height, double radius,
                  Rgb colour, double opacity) {
  for_rectangle(picture, x, y, width, height, [&](int px, int py) {
    const double d = rounded_distance(px + 0.5, py + 0.5, x, y, width, height, radius);
    picture.blend(px, py, colour, opacity * std::clamp(0.5 - d, 0.0, 1.0));
  });
}

void outline_rounded(Picture& picture, double x, double y, double width, double height,
                     double radius, double thickness, Rgb colour) {
  for_rectangle(picture, x, y, width, height, [&](int px, int py) {
    const double d = rounded_distance(px + 0.5, py + 0.5, x, y, width, height, radius);
    const double cover = std::clamp(0.5 - d, 0.0, 1.0) * std::clamp(d + thickness + 0.5, 0.0, 1.0);
    picture.blend(px, py, colour, cover);
  });
}

void paste_rounded(Picture& picture, const Picture& source, int x, int y, double radius) {
  for_rectangle(picture, x, y, source.width, source.height, [&](int px, int py) {
    const int sx = px - x, sy = py - y;
    if (sx < 0 || sy < 0 || sx >= source.width || sy >= source.height) return;
    const double d =
        rounded_distance(px + 0.5, py + 0.5, x, y, source.width, source.height, radius);
    picture.blend(px, py, source.pixel(sx, sy), std::clamp(0.5 - d, 0.0, 1.0));
  });
}

Picture halved(const Picture& picture) {
  Picture out(picture.width / 2, picture.height / 2, 0);
  std::array<float, 256> linear;
  for (std::size_t i = 0; i < 256; ++i) linear[i] = linear_from_srgb(static_cast<float>(i) / 255);
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const auto* upper = &picture.rgb[offset(picture, 2 * x, 2 * y)];
      const auto* lower = &picture.rgb[offset(picture, 2 * x, 2 * y + 1)];
      auto* target = &out.rgb[offset(out, x, y)];
      for (int c = 0; c < 3; ++c) {
        const float mean = 0.25f * (linear[upper[c]] + linear[upper[c + 3]] + linear[lower[c]] +
                                    linear[lower[c + 3]]);
        target[c] = static_cast<std::uint8_t>(std::lround(255.0f * srgb_from_linear(mean)));
      }
    }
  }
  return out;
}

Result<std::vector<std::uint8_t>> encode_png(const Picture& picture) {
  if (picture.empty()) return Error{"the picture is empty", "PNG", "give it a size above 0"};
  std::vector<std::uint8_t> bytes;
  const auto append = [](void* context, void* data, int size) {
    const auto* first = static_cast<const std::uint8_t*>(data);
    auto* target = static_cast<std::vector<std::uint8_t>*>(context);
    target->insert(target->end(), first, first + size);
  };
  if (stbi_write_png_to_func(append, &bytes, picture.width, picture.height, 3, picture.rgb.data(),
                             3 * picture.width) == 0 ||
      bytes.empty()) {
    return Error{"out of memory", "PNG", "make a smaller picture"};
  }
  return bytes;
}

Status write_png(const Picture& picture, const std::filesystem::path& path) {
  auto bytes = encode_png(picture);
  if (!bytes) {
    Error error = bytes.error();
    error.where = path.string();
    return error;
  }
  std::string temporary = path.string() + ".XXXXXX";
  const int file = ::mkstemp(temporary.data());
  if (file < 0) return system_error("the picture cannot be written", path);
  std::size_t done = 0;
  while (done < bytes->size()) {
    const auto written = ::write(file, bytes->data() + done, bytes->size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) break;
    done += static_cast<std::size_t>(written);
  }
  // mkstemp makes it readable for its owner alone; a picture gets what any new file gets.
  const mode_t mask = ::umask(0);
  ::umask(mask);
  const bool sound =
      done == bytes->size() && ::fchmod(file, 0666 & ~mask) == 0 && ::fsync(file) == 0;
  Error failure = sound ? Error{} : system_error("the picture cannot be written", path);
  if (::close(file) != 0 || !sound || std::rename(temporary.c_str(), path.c_str()) != 0) {
    if (sound) failure = system_error("the picture cannot be written", path);
    ::unlink(temporary.c_str());
    return failure;
  }
  return Done{};
}

}  // namespace elbowroom
