// SPDX-License-Identifier: MIT
// Captions in pictures: Inter (Debian fonts-inter) where it is installed, else DejaVu or
// Liberation; drawn on the CPU.
//
// Text is UTF-8; what is not valid UTF-8 or has no glyph in any font found is drawn as "?". Figures
// are tabular: all digits take the same width, so that times line up. Sizes are in pixels an em.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "render/picture.h"

namespace elbowroom {

enum class Weight { regular, medium, semibold };

class Font {
 public:
  // The best font installed in that weight. A font without a file draws nothing: found() is false
  // and a picture goes without captions.
  static Font load(Weight weight);
  // The first of these files that is a font; characters it lacks come from the following ones.
  static Font load_files(const std::vector<std::filesystem::path>& files);

  bool found() const;
  // The file in use; empty if there is none.
  std::filesystem::path file() const;

  double width(std::string_view text, double size) const;
  // From the baseline: up to the capitals' top, and the whole line's height.
  double cap_height(double size) const;
  double line_height(double size) const;

  // Draws with the baseline's left end at (x, y); returns the width. Parts outside the picture are
  // cut off.
  double draw(Picture& picture, double x, double y, std::string_view text, double size,
              Rgb colour) const;

 private:
  struct Data;
  std::shared_ptr<const Data> data_;  // shared: fonts are copied freely
};

// What to do about a missing font, for warnings.
const char* font_remedy();

}  // namespace elbowroom
