// SPDX-License-Identifier: MIT
#include "ui/toolkit/fonts.h"

#include <stb_truetype.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>

namespace elbowroom {
namespace {

// Latin with its accents, Greek and Cyrillic (names in files), and the signs the window uses:
// dashes, quotes, bullet, ellipsis, ‹ ›, arrows, − ≈ ≤ ≥, ✓ ✗. (° × · µ are Latin-1.)
constexpr ImWchar kRanges[] = {0x0020, 0x017f, 0x0370, 0x03ff, 0x0400, 0x045f, 0x2010,
                               0x2027, 0x2030, 0x203a, 0x2190, 0x2195, 0x2212, 0x2212,
                               0x2248, 0x2248, 0x2260, 0x2265, 0x2713, 0x2717, 0};

std::vector<char> bytes_of_font(const std::filesystem::path& file) {
  std::vector<char> bytes;
  std::error_code failed;
  const auto size = std::filesystem::file_size(file, failed);
  if (failed || size < 12 || size > (64u << 20)) return bytes;
  std::ifstream in(file, std::ios::binary);
  bytes.resize(size);
  in.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!in) return {};
  // Dear ImGui asserts on what is no font, so it is tried here first.
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  const int offset = stbtt_GetFontOffsetForIndex(data, 0);
  stbtt_fontinfo info;
  if (offset < 0 || stbtt_InitFont(&info, data, offset) == 0) return {};
  return bytes;
}

bool add(ImFontAtlas& atlas, const std::filesystem::path& file, float size, ImFont*& font) {
  const std::vector<char> bytes = bytes_of_font(file);
  if (bytes.empty()) return false;
  void* copy = ImGui::MemAlloc(bytes.size());  // the atlas owns and frees it
  std::memcpy(copy, bytes.data(), bytes.size());
  ImFontConfig config;
  // Large glyphs need no oversampling, and without it 300 % still fits into one texture.
  config.OversampleH = size > 30 ? 1 : 3;
  config.OversampleV = 1;
  config.PixelSnapH = false;
  config.RasterizerMultiply = 1.1f;  // unhinted small text is otherwise too thin
  font = atlas.AddFontFromMemoryTTF(copy, static_cast<int>(bytes.size()), size, &config, kRanges);
  return font != nullptr;
}

// Dear ImGui knows no OpenType features, so the digits are set to one width by hand.
void make_figures_tabular(ImFont& font) {
  float width = 0;
  for (ImFontGlyph& glyph : font.Glyphs) {
    if (glyph.Codepoint >= '0' && glyph.Codepoint <= '9') width = std::max(width, glyph.AdvanceX);
  }
  if (width <= 0) return;
  width = std::round(width);
  for (ImFontGlyph& glyph : font.Glyphs) {
    if (glyph.Codepoint < '0' || glyph.Codepoint > '9') continue;
    const float shift = 0.5f * (width - glyph.AdvanceX);
    glyph.X0 += shift;
    glyph.X1 += shift;
    glyph.AdvanceX = width;
  }
  font.BuildLookupTable();
}

}  // namespace

std::vector<FontFiles> installed_fonts() {
  std::vector<FontFiles> found;
  const auto offer = [&found](const char* folder, const char* regular, const char* medium,
                              const char* semibold) {
    const std::filesystem::path base(folder);
    std::error_code ignored;
    if (!std::filesystem::exists(base / regular, ignored)) return;
    found.push_back({base / regular, base / medium, base / semibold});
  };
  offer("/usr/share/fonts/opentype/inter", "Inter-Regular.otf", "Inter-Medium.otf",
        "Inter-SemiBold.otf");
  offer("/usr/share/fonts/truetype/inter", "Inter-Regular.ttf", "Inter-Medium.ttf",
        "Inter-SemiBold.ttf");
  offer("/usr/share/fonts/truetype/dejavu", "DejaVuSans.ttf", "DejaVuSans.ttf",
        "DejaVuSans-Bold.ttf");
  offer("/usr/share/fonts/truetype/liberation", "LiberationSans-Regular.ttf",
        "LiberationSans-Regular.ttf", "LiberationSans-Bold.ttf");
  return found;
}

Fonts load_fonts(ImFontAtlas& atlas, const Theme& theme, double wanted_scale,
                 const std::vector<FontFiles>& files) {
  const float scale = usable_scale(wanted_scale);
  const float text = std::round(theme.metrics.text * scale);
  const float small = std::round(theme.metrics.small * scale);
  atlas.Clear();
  atlas.TexGlyphPadding = 1;
  // 16,384 texels are what every GL 4.5 driver takes; wide textures keep the height below it.
  atlas.TexDesiredWidth = scale > 1.5f ? 4096 : 2048;
  Fonts fonts;
  for (const FontFiles& set : files) {
    if (!add(atlas, set.regular, text, fonts.regular)) continue;
    fonts.file = set.regular;
    if (!add(atlas, set.medium, text, fonts.medium)) fonts.medium = fonts.regular;
    if (!add(atlas, set.semibold, text, fonts.semibold)) fonts.semibold = fonts.medium;
    if (!add(atlas, set.regular, small, fonts.small)) fonts.small = fonts.regular;
    if (!add(atlas, set.medium, small, fonts.small_medium)) fonts.small_medium = fonts.small;
    break;
  }
  if (fonts.regular == nullptr) {
    ImFontConfig config;
    config.SizePixels = text;
    fonts.regular = atlas.AddFontDefault(&config);
    fonts.medium = fonts.semibold = fonts.regular;
    config.SizePixels = small;
    fonts.small = fonts.small_medium = atlas.AddFontDefault(&config);
  }
  atlas.Build();
  for (ImFont* font : atlas.Fonts) make_figures_tabular(*font);
  return fonts;
}

}  // namespace elbowroom
