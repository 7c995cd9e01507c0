// SPDX-License-Identifier: MIT
#include "ui/toolkit/theme.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "tests/gui/driver/ui_driver.h"
#include "ui/toolkit/fonts.h"

namespace elbowroom {
namespace {

TEST(Palette, ContrastIsWcags) {
  EXPECT_NEAR(contrast(colour_of(0x000000), colour_of(0xffffff)), 21, 1e-9);
  EXPECT_NEAR(contrast(colour_of(0x777777), colour_of(0xffffff)), 4.48, 0.01);
}

TEST(Palette, EveryTextIsLegibleOnEveryGround) {
  for (const Theme& theme : {dark_theme(), light_theme()}) {
    const Palette& p = theme.palette;
    for (const ImU32 ground : {p.ground, p.panel, p.raised}) {
      for (const Tone tone : {Tone::text, Tone::quiet, Tone::faint, Tone::accent, Tone::problem,
                              Tone::good, Tone::selection, Tone::ghost}) {
        EXPECT_GE(contrast(p.of(tone), ground), 4.5)
            << (p.dark ? "dark" : "light") << ", tone " << static_cast<int>(tone);
      }
    }
    EXPECT_GE(contrast(p.on_accent, p.accent), 4.5);
    // Text on a badge and on a selected row.
    EXPECT_GE(contrast(p.problem, mixed(p.panel, p.problem, 0.13f)), 4.5);
    EXPECT_GE(contrast(p.text, mixed(p.panel, p.accent, 0.19f)), 4.5);
  }
}

TEST(Palette, TheThreeStrengthsOfTextDiffer) {
  for (const Theme& theme : {dark_theme(), light_theme()}) {
    const Palette& p = theme.palette;
    EXPECT_GT(contrast(p.text, p.panel), contrast(p.quiet, p.panel) + 1);
    EXPECT_GT(contrast(p.quiet, p.panel), contrast(p.faint, p.panel) + 0.5);
  }
}

TEST(Palette, ProblemAndGoodDifferWithoutColour) {
  for (const Theme& theme : {dark_theme(), light_theme()}) {
    EXPECT_GT(contrast(theme.palette.problem, theme.palette.good), 1.02);
  }
}

TEST(Theme, ScaleIsPutRight) {
  EXPECT_EQ(usable_scale(0.1), 0.75f);
  EXPECT_EQ(usable_scale(99), 3.0f);
  EXPECT_EQ(usable_scale(std::numeric_limits<double>::quiet_NaN()), 1.0f);
}

TEST(Theme, SizesAreWholePixels) {
  for (const double scale : {0.75, 1.0, 1.25, 1.5, 3.0}) {
    UiDriver driver(800, 600, scale);
    const ImGuiStyle& style = ImGui::GetStyle();
    for (const float size : {style.WindowPadding.x, style.FramePadding.y, style.ItemSpacing.y,
                             style.ScrollbarSize, driver.ui().px(1), driver.ui().px(27)}) {
      EXPECT_EQ(size, std::round(size));
    }
    EXPECT_GE(driver.ui().px(1), 1);
  }
}

class FontsAt : public testing::TestWithParam<double> {};

TEST_P(FontsAt, HaveTheSignsAndTabularFigures) {
  if (installed_fonts().empty()) GTEST_SKIP() << "no font is installed";
  ImFontAtlas atlas;
  const Fonts fonts = load_fonts(atlas, dark_theme(), GetParam());
  ASSERT_FALSE(fonts.file.empty());
  EXPECT_LE(atlas.TexWidth, 8192);
  EXPECT_LE(atlas.TexHeight, 8192);
  for (ImFont* font : {fonts.regular, fonts.medium, fonts.semibold, fonts.small}) {
    ASSERT_NE(font, nullptr);
    const float zero = font->FindGlyph('0')->AdvanceX;
    for (ImWchar digit = '0'; digit <= '9'; ++digit) {
      EXPECT_EQ(font->FindGlyph(digit)->AdvanceX, zero);
      EXPECT_EQ(font->GetCharAdvance(digit), zero);
    }
    for (const ImWchar sign :
         {0x00b0, 0x00d7, 0x00b7, 0x2013, 0x2039, 0x203a, 0x2713, 0x00b5, 0x2026, 0x2212, 0x2192}) {
      EXPECT_NE(font->FindGlyphNoFallback(sign), nullptr) << std::hex << sign;
    }
  }
  EXPECT_NE(fonts.regular->FindGlyph('a')->AdvanceX, fonts.semibold->FindGlyph('a')->AdvanceX);
}
INSTANTIATE_TEST_SUITE_P(Scales, FontsAt, testing::Values(0.75, 1.0, 3.0));

TEST(Fonts, FilesThatAreNoFontsArePassedOver) {
  const auto folder = std::filesystem::temp_directory_path() / "elbowroom-fonts-test";
  std::filesystem::create_directories(folder);
  const auto junk = folder / "junk.otf";
  std::ofstream(junk) << "this is no font, whatever its name says, and it is long enough to try";
  ImFontAtlas atlas;
  const Fonts fonts = load_fonts(atlas, dark_theme(), 1, {{junk, junk, junk}, {"/none", "", ""}});
  EXPECT_TRUE(fonts.file.empty());
  ASSERT_NE(fonts.regular, nullptr);  // Dear ImGui's own
  EXPECT_NE(fonts.small, nullptr);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace elbowroom
