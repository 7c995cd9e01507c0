// SPDX-License-Identifier: MIT
// What is not on the straight way: objects in hands, the mouse as in Maya, the turning handles,
// files opened before, and a session that is killed.
#include <signal.h>

#include <cmath>

#include "tests/gui/window/driver/window_test.h"

namespace elbowroom::test {
namespace {

class Handling : public WindowTest {
 protected:
  Pixel target() {
    const auto mark = editor().find("Viewport/Hand target");
    return mark ? mark->middle() : Pixel{-1, -1};
  }
  double distance(Pixel a, Pixel b) { return std::hypot(a.x - b.x, a.y - b.y); }
  std::vector<std::string> turns() {
    std::vector<std::string> values;
    for (const char* name : {"Inspector/Turn X", "Inspector/Turn Y", "Inspector/Turn Z"})
      values.push_back(editor().value(name));
    return values;
  }
  void target_of_the_left_arm() {
    ASSERT_TRUE(editor().start()) << editor().said();
    ASSERT_TRUE(editor().wait_for("Outliner/Left arm"));
    ASSERT_TRUE(editor().click("Outliner/Left arm"));
    editor().key("t");
    ASSERT_TRUE(editor().wait_for("Viewport/Hand target"));
    ASSERT_TRUE(editor().wait_for("Inspector/Turn X"));
  }
};

TEST_F(Handling, ObjectsArePutIntoHandsByTheirMenu) {
  ASSERT_TRUE(editor().start()) << editor().said();
  ASSERT_TRUE(editor().wait_for("Outliner/posts"));
  EXPECT_EQ(editor().value("Outliner/umbrella"), "right hand");
  EXPECT_EQ(editor().value("Outliner/posts"), "obstacle");
  const auto choose = [&](const std::string& item, const std::string& held) {
    editor().click(editor().find("Outliner/umbrella")->middle(), 3);
    ASSERT_TRUE(editor().wait_for(item)) << item;
    editor().picture("object_menu");
    ASSERT_TRUE(editor().click(item));
    ASSERT_TRUE(editor().wait([&] { return editor().value("Outliner/umbrella") == held; }))
        << editor().value("Outliner/umbrella");
  };
  choose("Hold in the left hand", "left hand");
  editor().picture("left_hand");
  choose("Put down", "obstacle");
  editor().key("ctrl+z");
  editor().key("ctrl+z");
  EXPECT_TRUE(editor().wait([&] { return editor().value("Outliner/umbrella") == "right hand"; }));
}

TEST_F(Handling, TheMouseAsInMaya) {
  target_of_the_left_arm();
  ASSERT_TRUE(editor().click("View"));
  ASSERT_TRUE(editor().click("View/Mouse as in Maya"));
  const auto picture = editor().find("Viewport/Picture");
  const Pixel free{picture->min.x + 80, picture->min.y + 140};
  const auto alt_drag = [&](Pixel by, int button) {
    editor().move_to(free);
    editor().hold("alt");
    editor().press(button);
    editor().glide(free, {free.x + by.x, free.y + by.y}, 8, 0.02);
    editor().release(button);
    editor().let_go("alt");
    editor().settle(10, 0.5);
  };
  Pixel was = target();
  alt_drag({90, 40}, 2);  // the middle button
  EXPECT_NEAR(target().x - was.x, 90, 12) << "Alt and the middle button pan";
  EXPECT_NEAR(target().y - was.y, 40, 12);
  was = target();
  alt_drag({150, 0}, 1);
  EXPECT_GT(distance(target(), was), 5) << "Alt and the left button orbit";
  editor().key("Home");
  editor().settle(10, 0.5);
  was = target();
  const Pixel middle = picture->middle();
  alt_drag({120, 0}, 3);
  EXPECT_GT(distance(target(), middle), 1.1 * distance(was, middle)) << "and the right one zooms";
  editor().picture("maya");
}

TEST_F(Handling, ATargetIsTurnedByItsRings) {
  target_of_the_left_arm();
  editor().key("1");
  editor().key("r");
  editor().settle(10, 0.5);
  const auto before = turns();
  const Pixel centre = target();
  // Seen from the front the ring about Z is a circle; where it is, the status line says.
  Pixel grip{};
  for (int radius = 30; radius < 160; radius += 4) {
    const Pixel place{centre.x + static_cast<int>(0.8 * radius),
                      centre.y - static_cast<int>(0.6 * radius)};
    editor().move_to(place);
    if (editor().wait([&] { return editor().value("Status/Hint").find("turn the hand") == 8; },
                      0.3)) {
      grip = place;
      break;
    }
  }
  ASSERT_GT(grip.x, 0) << "no ring under the mouse";
  const Pixel to{centre.x + (grip.y - centre.y), centre.y + (grip.x - centre.x)};
  editor().drag(grip, to);
  ASSERT_TRUE(editor().wait([&] { return turns() != before; })) << "the ring turns nothing";
  editor().picture("turned");
  const auto after = turns();
  editor().key("ctrl+z");
  EXPECT_TRUE(editor().wait([&] { return turns() == before; })) << "one step";
  // Escape puts it back while it is dragged.
  editor().move_to(grip);
  editor().press();
  editor().glide(grip, to, 8, 0.02);
  ASSERT_TRUE(editor().wait([&] { return turns() != before; }));
  editor().key("Escape");
  EXPECT_TRUE(editor().wait([&] { return turns() == before; }));
  editor().release();
  EXPECT_EQ(turns(), before);
}

TEST_F(Handling, WhatWasOpenIsOpenedAgain) {
  const auto file = kDemo / demo::kMannequinFile;
  ASSERT_TRUE(editor().start({file.string()})) << editor().said();
  ASSERT_TRUE(editor().wait_for("Outliner/Left arm"));
  EXPECT_FALSE(editor().find("Outliner/posts"));
  editor().key("ctrl+q");
  ASSERT_EQ(editor().ended(), 0);
  ASSERT_TRUE(editor().start()) << editor().said();
  ASSERT_TRUE(editor().wait_for("Outliner/posts")) << "the demo";
  ASSERT_TRUE(editor().click("File"));
  ASSERT_TRUE(editor().wait_for("File/Open recent"));
  editor().move_to(editor().find("File/Open recent")->middle());
  const std::string entry = "Open recent/" + file.string();
  ASSERT_TRUE(editor().wait_for(entry)) << "no " << entry;
  editor().picture("recent");
  ASSERT_TRUE(editor().click(entry));
  EXPECT_TRUE(editor().wait([&] { return !editor().find("Outliner/posts"); }));
  EXPECT_TRUE(editor().wait_for("Outliner/Left arm"));
}

TEST_F(Handling, WorkOfAKilledSessionIsOffered) {
  target_of_the_left_arm();
  const auto place = turns();
  const auto kept = [&] {
    const auto folder = editor().folder() / "state" / "elbowroom" / "recovery";
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(folder, none))
      if (entry.path().extension() == ".recovery") return true;
    return false;
  };
  // Left alone: it is written without anybody touching the window.
  ASSERT_TRUE(editor().wait(kept, 20)) << "nothing is kept";
  editor().end_by(SIGKILL);
  ASSERT_TRUE(editor().start()) << editor().said();
  ASSERT_TRUE(editor().wait_for("Recover/Recover"));
  editor().picture("recover");
  ASSERT_TRUE(editor().click("Recover/Recover"));
  ASSERT_TRUE(editor().wait_for("Viewport/Hand target"));
  ASSERT_TRUE(editor().click("Tabs/Target"));
  ASSERT_TRUE(editor().wait_for("Inspector/Turn X"));
  EXPECT_EQ(turns(), place);
  editor().picture("recovered");
  editor().key("ctrl+q");
  ASSERT_TRUE(editor().wait_for_words("Save changes"));
  discard_if_asked();
  EXPECT_EQ(editor().ended(), 0);
  EXPECT_FALSE(kept()) << "given up on purpose";
}

}  // namespace
}  // namespace elbowroom::test
