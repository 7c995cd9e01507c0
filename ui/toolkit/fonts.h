// SPDX-License-Identifier: MIT
// The fonts of the window: Inter (Debian fonts-inter) in three weights where it is installed, else
// DejaVu or Liberation, else Dear ImGui's own. Figures are tabular: every digit takes the same
// width, so that numbers do not jump while they change.
#pragma once

#include <imgui.h>

#include <filesystem>
#include <vector>

#include "ui/toolkit/theme.h"

namespace elbowroom {

struct Fonts {
  ImFont* regular = nullptr;
  ImFont* medium = nullptr;
  ImFont* semibold = nullptr;
  ImFont* small = nullptr;         // regular, in the smaller size
  ImFont* small_medium = nullptr;  // badges, headings of tables
  std::filesystem::path file;      // of `regular`; empty: Dear ImGui's own font, ASCII only
};

// Where the fonts are looked for, best first: regular, medium and semibold files lie in the same
// folder or are all the one file.
struct FontFiles {
  std::filesystem::path regular, medium, semibold;
};
std::vector<FontFiles> installed_fonts();

// Clears the atlas, puts the fonts in and builds it. Call before the first frame and again, outside
// a frame, when the scale changes; a renderer then has to make its texture anew. Files that are
// missing or no fonts are passed over. Takes some 50 ms at 100 %.
Fonts load_fonts(ImFontAtlas& atlas, const Theme& theme, double scale,
                 const std::vector<FontFiles>& files = installed_fonts());

}  // namespace elbowroom
