// SPDX-License-Identifier: MIT
// Every widget at every size: it draws, and nothing of it is lost. With ELBOWROOM_GALLERY set to a
// folder, the pictures are written there to be looked at.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <set>

#include "tests/gui/driver/snapshot.h"
#include "tests/gui/toolkit/gallery.h"

namespace elbowroom {
namespace {

struct Size {
  float width, height;
  double scale;
  bool dark;
};

void PrintTo(const Size& size, std::ostream* out) {
  *out << size.width << "x" << size.height << " at " << 100 * size.scale << " %";
}

class GalleryAt : public testing::TestWithParam<Size> {};

TEST_P(GalleryAt, DrawsInManyColours) {
  const Size size = GetParam();
  UiDriver driver(size.width, size.height, size.scale, size.dark ? dark_theme() : light_theme());
  Gallery gallery = make_gallery();
  driver.ui().toast(Tone::good, "Exported walk-corrected.glb", "Checked again after writing");
  driver.show([&](Ui& ui) { draw_gallery(ui, gallery); });
  const auto picture = snapshot(driver);
  if (!picture) GTEST_SKIP() << picture.error().message();
  std::set<std::uint32_t> colours;
  for (std::size_t i = 0; i + 2 < picture->rgb.size(); i += 3) {
    colours.insert(picture->rgb[i] | picture->rgb[i + 1] << 8 | picture->rgb[i + 2] << 16);
  }
  EXPECT_GT(colours.size(), 500u);  // text and lines are smoothed
  if (const char* folder = std::getenv("ELBOWROOM_GALLERY")) {
    const std::string name = std::to_string(static_cast<int>(size.width)) + "-" +
                             std::to_string(static_cast<int>(100 * size.scale)) +
                             (size.dark ? "" : "-light") + ".png";
    const auto written = write_png(*picture, std::filesystem::path(folder) / name);
    EXPECT_TRUE(written.ok());
  }
}

TEST(GalleryDialogs, AreDrawnOverTheRest) {
  UiDriver driver(1024, 700);
  Gallery gallery = make_gallery();
  FileDialog dialog;
  dialog.recent = {"/usr/share", "/usr/share/fonts"};
  open_dialog(dialog, "/usr");
  driver.show([&](Ui& ui) {
    draw_gallery(ui, gallery);
    file_dialog(ui, dialog, {.title = "Open", .extensions = {".glb", ".elbow"}});
  });
  driver.move_to("Open/Open");
  driver.frame(4);
  const auto files = snapshot(driver);
  if (!files) GTEST_SKIP() << files.error().message();
  driver.key(keys::kEscape);
  gallery.asking = true;
  driver.frame(4);
  const auto question = snapshot(driver);
  ASSERT_TRUE(question.ok());
  EXPECT_NE(files->rgb, question->rgb);
  gallery.asking = false;
  if (const char* folder = std::getenv("ELBOWROOM_GALLERY")) {
    EXPECT_TRUE(write_png(*files, std::filesystem::path(folder) / "files.png").ok());
    EXPECT_TRUE(write_png(*question, std::filesystem::path(folder) / "question.png").ok());
  }
}

TEST(GalleryCost, AFrameOfAllWidgetsTakesAFractionOfAFrame) {
  UiDriver driver(1600, 1000);
  Gallery gallery = make_gallery();
  driver.show([&](Ui& ui) { draw_gallery(ui, gallery); });
  const auto start = std::chrono::steady_clock::now();
  driver.frame(50);
  const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
  RecordProperty("milliseconds_a_frame", std::to_string(taken.count() / 50));
  EXPECT_LT(taken.count() / 50, 16);
}

INSTANTIATE_TEST_SUITE_P(Sizes, GalleryAt,
                         testing::Values(Size{1600, 1000, 1, true}, Size{1024, 700, 1, true},
                                         Size{1600, 1000, 2, true}, Size{1600, 1000, 1, false}));

}  // namespace
}  // namespace elbowroom
