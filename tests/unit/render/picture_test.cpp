// SPDX-License-Identifier: MIT
// Pictures, their files and the text in them.
#include "render/picture.h"

#include <gtest/gtest.h>
#include <stb_image.h>

#include <fstream>

#include "render/text.h"

namespace elbowroom::test {
namespace {

std::filesystem::path scratch(const std::string& name) {
  const auto folder = std::filesystem::path(::testing::TempDir()) / "elbowroom_picture_test";
  std::filesystem::create_directories(folder);
  return folder / name;
}

TEST(Picture, PngHoldsTheVeryPixels) {
  Picture picture(37, 23, 0x102030);
  for (int i = 0; i < 23; ++i) picture.set(i, i, static_cast<Rgb>(0x0a0b0c * i) & 0xffffffu);
  const auto file = scratch("pixels.png");
  const auto done = write_png(picture, file);
  ASSERT_TRUE(done.ok()) << done.error().message();
  int width = 0, height = 0, channels = 0;
  unsigned char* data = stbi_load(file.c_str(), &width, &height, &channels, 3);
  ASSERT_NE(data, nullptr);
  EXPECT_EQ(width, 37);
  EXPECT_EQ(height, 23);
  EXPECT_TRUE(std::equal(picture.rgb.begin(), picture.rgb.end(), data));
  stbi_image_free(data);
}

TEST(Picture, FailedWritesLeaveNothingBehind) {
  const auto folder = scratch("none");
  std::filesystem::remove_all(folder);
  const auto failed = write_png(Picture(2, 2, 0), folder / "a.png");
  ASSERT_FALSE(failed.ok());
  EXPECT_NE(failed.error().where.find("a.png"), std::string::npos);
  EXPECT_FALSE(failed.error().remedy.empty());
  EXPECT_FALSE(write_png(Picture(), scratch("b.png")).ok());
  EXPECT_FALSE(std::filesystem::exists(scratch("b.png")));
  // A folder of that name is in the way: the temporary file goes again.
  const auto taken = scratch("taken.png");
  std::filesystem::create_directories(taken / "inside");
  EXPECT_FALSE(write_png(Picture(2, 2, 0), taken).ok());
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(taken.parent_path())) {
    if (entry.path().filename().string().rfind("taken.png", 0) == 0) ++files;
  }
  EXPECT_EQ(files, 1);
}

TEST(Picture, ShapesAreSmoothAndCutAtTheEdge) {
  Picture picture(40, 40, 0x000000);
  fill_rounded(picture, 10, 10, 20, 20, 6, 0xffffff);
  EXPECT_EQ(picture.pixel(20, 20), 0xffffffu);
  EXPECT_EQ(picture.pixel(10, 10), 0x000000u);  // the corner is round
  EXPECT_EQ(picture.pixel(5, 20), 0x000000u);
  fill_rounded(picture, -30, -30, 200, 35, 4, 0xff0000, 0.5);
  outline_rounded(picture, -5, -5, 300, 300, 8, 2, 0x00ff00);
  paste_rounded(picture, Picture(30, 30, 0x0000ff), 25, 25, 5);
  EXPECT_EQ(picture.pixel(38, 38), 0x0000ffu);
  picture.blend(-1, 99, 0xffffff, 1);
  EXPECT_TRUE(Picture(-3, 5, 0).empty());
}

TEST(Picture, HalvingAveragesLight) {
  Picture picture(4, 2, 0x000000);
  picture.set(0, 0, 0xffffff);
  picture.set(1, 1, 0xffffff);
  const Picture half = halved(picture);
  ASSERT_EQ(half.width, 2);
  ASSERT_EQ(half.height, 1);
  EXPECT_EQ(half.pixel(0, 0) & 0xffu, 188u);  // half the light, not half the level
  EXPECT_EQ(half.pixel(1, 0), 0x000000u);
}

TEST(Text, FiguresAreTabular) {
  const Font font = Font::load(Weight::medium);
  if (!font.found()) GTEST_SKIP() << "no font installed: " << font_remedy();
  EXPECT_DOUBLE_EQ(font.width("1.11 s", 20), font.width("0.08 s", 20));
  EXPECT_GT(font.width("12.00 s", 20), font.width("2.00 s", 20));
  EXPECT_NEAR(font.width("abc", 40), 2 * font.width("abc", 20), 1e-9);
  EXPECT_GT(font.cap_height(20), 10);
  EXPECT_LT(font.cap_height(20), 20);
}

TEST(Text, DrawsWithinItsMeasure) {
  const Font font = Font::load(Weight::regular);
  if (!font.found()) GTEST_SKIP() << "no font installed: " << font_remedy();
  Picture picture(200, 40, 0x000000);
  const double width = font.draw(picture, 10, 30, "1.24 s", 24, 0xffffff);
  int first = 200, last = -1;
  for (int x = 0; x < 200; ++x) {
    for (int y = 0; y < 40; ++y) {
      if (picture.pixel(x, y) != 0) first = std::min(first, x), last = std::max(last, x);
    }
  }
  EXPECT_GE(first, 9);
  EXPECT_LE(last, 10 + width + 1);
  EXPECT_GT(last - first, 0.8 * width);
}

TEST(Text, TakesAnyBytesAndAnyPlace) {
  const Font font = Font::load(Weight::regular);
  Picture picture(20, 20, 0);
  const std::string odd = "\xff\xc3\x28\xe2\x82 \xf0\x9f\x98\x80 日本 é";
  EXPECT_NEAR(font.draw(picture, -4, 10, odd, 12, 0xffffff), font.width(odd, 12), 1e-9);
  font.draw(picture, 1e4, -1e4, "far", 12, 0xffffff);
  font.draw(picture, 2, 2, "huge", 1e9, 0xffffff);
  font.draw(picture, 2, 2, "", 12, 0xffffff);
}

TEST(Text, WithoutAFontNothingIsDrawn) {
  const auto not_a_font = scratch("text.ttf");
  std::ofstream(not_a_font) << "this is no font at all";
  const Font font = Font::load_files({scratch("missing.ttf"), not_a_font});
  EXPECT_FALSE(font.found());
  Picture picture(20, 20, 0x123456);
  EXPECT_EQ(font.draw(picture, 2, 15, "1.24 s", 12, 0xffffff), 0);
  EXPECT_EQ(picture.pixel(4, 10), 0x123456u);
  EXPECT_NE(std::string(font_remedy()).find("fonts-inter"), std::string::npos);
}

}  // namespace
}  // namespace elbowroom::test
