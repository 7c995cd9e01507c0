// SPDX-License-Identifier: MIT
// Every widget at every size: it draws, and nothing of it is lost. With ELBOWROOM_GALLERY set to a
// folder, the pictures are written there to be looked at.
#include <gtest/gtest.h>

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

INSTANTIATE_TEST_SUITE_P(Sizes, GalleryAt,
                         testing::Values(Size{1600, 1000, 1, true}, Size{1024, 700, 1, true},
                                         Size{1600, 1000, 2, true}, Size{1600, 1000, 1, false}));

}  // namespace
}  // namespace elbowroom
