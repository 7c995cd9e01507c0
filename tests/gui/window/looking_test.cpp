// SPDX-License-Identifier: MIT
// Time and camera: play, scrub, step; orbit, pan, zoom, frame. And a window left alone costs
// nothing.
#include <cmath>
#include <thread>

#include "tests/gui/window/driver/window_test.h"

namespace elbowroom::test {
namespace {

class Looking : public WindowTest {
 protected:
  double time() { return std::atof(editor().value("Timeline/Time").c_str()); }
  // Where the left arm's hand is in the picture.
  Pixel hand() {
    const auto mark = editor().find("Hand target");
    return mark ? mark->middle() : Pixel{-1, -1};
  }
  bool hand_moved(Pixel from) {
    return editor().wait(
        [&] { return std::hypot(hand().x - from.x, hand().y - from.y) > 5 && hand().x >= 0; }, 5);
  }
};

TEST_F(Looking, TimeAndCamera) {
  ASSERT_TRUE(editor().start()) << editor().said();
  ASSERT_TRUE(editor().wait_for("Clip time.ruler"));
  EXPECT_EQ(time(), 0);
  const auto ruler = editor().find("Clip time.ruler");
  editor().drag({ruler->min.x + 50, ruler->middle().y}, ruler->middle());
  ASSERT_TRUE(editor().wait([&] { return time() > 1.5 && time() < 2.7; })) << time();
  const double scrubbed = time();
  editor().key("Right");
  EXPECT_TRUE(editor().wait([&] { return time() > scrubbed; }, 5));
  editor().key("Left");
  editor().key("Left");
  EXPECT_TRUE(editor().wait([&] { return time() < scrubbed; }, 5));
  ASSERT_TRUE(editor().click("First frame"));
  EXPECT_TRUE(editor().wait([&] { return time() == 0; }, 5));
  editor().key("space");
  EXPECT_TRUE(editor().wait([&] { return time() > 0.3; }, 10)) << "it does not play";
  editor().key("space");
  const double stopped = time();
  EXPECT_FALSE(editor().wait([&] { return time() != stopped; }, 0.5)) << "it does not stop";

  // The camera, by where a mark in the world is seen.
  ASSERT_TRUE(editor().click("Outliner/Left arm"));
  editor().key("t");
  ASSERT_TRUE(editor().wait_for("Hand target"));
  const auto picture = editor().find("Viewport/Picture");
  const Pixel free{picture->min.x + 60, picture->min.y + 120};
  Pixel was = hand();
  editor().drag(free, {free.x + 150, free.y}, 2);
  EXPECT_TRUE(hand_moved(was)) << "no orbit";
  was = hand();
  editor().drag(free, {free.x + 80, free.y + 30}, 3);
  EXPECT_TRUE(hand_moved(was)) << "no pan";
  EXPECT_NEAR(hand().x - was.x, 80, 12) << "what is panned stays under the mouse";
  EXPECT_NEAR(hand().y - was.y, 30, 12);
  was = hand();
  editor().scroll(free, 4);
  EXPECT_TRUE(hand_moved(was)) << "no zoom";
  was = hand();
  editor().key("Home");
  EXPECT_TRUE(hand_moved(was)) << "no framing";
  was = hand();
  editor().key("1");
  EXPECT_TRUE(hand_moved(was)) << "no front view";
  editor().picture("front");
  was = hand();
  editor().key("f");
  EXPECT_TRUE(hand_moved(was)) << "no framing of the limb";
  editor().picture("framed_limb");
}

// Another theme and another size: everything is still painted, again and again.
TEST_F(Looking, ThemeAndSize) {
  ASSERT_TRUE(editor().start()) << editor().said();
  ASSERT_TRUE(editor().wait_for("Outliner/Left arm"));
  const auto colours_of = [&](const std::string& panel, const std::string& name) {
    editor().picture(name);
    const auto seen = editor().find(panel);
    if (!seen) return 0;
    const auto count = run_program(
        "/usr/bin/env",
        {"convert", std::filesystem::path(ELBOWROOM_PICTURES) / (name + ".png"), "-crop",
         std::to_string(seen->max.x - seen->min.x) + "x" +
             std::to_string(seen->max.y - seen->min.y) + "+" + std::to_string(seen->min.x) + "+" +
             std::to_string(seen->min.y),
         "-format", "%k", "info:"});
    return std::atoi(count.out.c_str());
  };
  // Text on a ground is some dozen shades; a panel without text is one.
  ASSERT_GT(colours_of("Outliner", "theme_dark"), 20);
  for (int turn = 0; turn < 2; ++turn) {
    const float wide =
        static_cast<float>(editor().find("Menu/Undo")->max.x - editor().find("Menu/Undo")->min.x);
    ASSERT_TRUE(editor().click("View"));
    ASSERT_TRUE(editor().click("View/Light theme"));
    ASSERT_TRUE(editor().wait([&] { return !editor().find("View/Light theme"); }));
    editor().move_to({800, 300 + turn});
    EXPECT_GT(colours_of("Outliner", turn ? "theme_dark_again" : "theme_light"), 20);
    EXPECT_GT(colours_of("Timeline", turn ? "theme_dark_again" : "theme_light"), 20);
    ASSERT_TRUE(editor().click("View"));
    ASSERT_TRUE(editor().click("View/Larger interface"));
    ASSERT_TRUE(editor().wait([&] {
      const auto undo = editor().find("Menu/Undo");
      return undo && static_cast<float>(undo->max.x - undo->min.x) > wide;
    }));
    editor().move_to({800, 310 + turn});
    EXPECT_GT(colours_of("Outliner", turn ? "larger_again" : "larger"), 20);
  }
}

TEST_F(Looking, AWindowLeftAloneCostsNothing) {
  ASSERT_TRUE(editor().start()) << editor().said();
  ASSERT_TRUE(editor().wait_for_words("bump.0", kScanSeconds));
  ASSERT_TRUE(editor().settle());
  const std::size_t frames = editor().frame_count();
  const double cpu = editor().cpu_seconds();
  // Time that passes is what is tested here.
  std::this_thread::sleep_for(std::chrono::seconds(2));
  const double used = editor().cpu_seconds() - cpu;
  std::printf("  idle: %zu frames and %.0f ms of CPU in 2 s\n", editor().frame_count() - frames,
              1e3 * used);
  EXPECT_EQ(editor().frame_count(), frames);
  EXPECT_LE(used, 0.03);
  editor().move_to({800, 400});
  EXPECT_GT(editor().frame_count(), frames) << "it does not wake up";
}

}  // namespace
}  // namespace elbowroom::test
