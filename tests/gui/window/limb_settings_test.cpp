// SPDX-License-Identifier: MIT
// What the character's limbs are and how far they swing, set by mouse in the real window: each is a
// step of undo, and the saved project has it.
#include "tests/gui/window/driver/window_test.h"

namespace elbowroom::test {
namespace {

const char* const kMap = "Inspector/Swing map";
const char* const kDialog = "Joints of the limbs/";

class LimbSettingsByMouse : public WindowTest {
 protected:
  // The wheel over the inspector until it is wholly in sight.
  bool bring_into_sight(const std::string& name) {
    const auto panel = editor().find("Inspector");
    if (!panel) return false;
    for (int i = 0; i < 30; ++i) {
      const auto widget = editor().find(name);
      if (widget && widget->visible && widget->max.y <= panel->max.y) return true;
      editor().scroll({panel->middle().x, panel->max.y - 60}, -1);
    }
    return false;
  }
  // Under a name of its own each time: a second save asks nothing.
  nlohmann::json saved(const std::string& name) {
    const auto file = folder_ / (name + ".elbow");
    editor().key("ctrl+shift+s");
    take_path(file);
    EXPECT_TRUE(editor().wait([&] {
      return std::filesystem::exists(file) && !editor().find("Path");
    })) << news();
    // What is typed next is for the window again, not for the dialog's field.
    editor().settle(3, 0.4);
    return read_json(file);
  }
  Pixel corner(int index) {
    const auto found = editor().find("Swing map.corner." + std::to_string(index));
    return found ? found->middle() : Pixel{};
  }
};

TEST_F(LimbSettingsByMouse, ASwingLimitIsDrawnDraggedAndTakenBack) {
  ASSERT_TRUE(editor().start()) << editor().said();
  ASSERT_TRUE(editor().click("Outliner/Left arm"));
  ASSERT_TRUE(bring_into_sight("Draw as polygon"));
  EXPECT_EQ(editor().value(kMap), "own limit");
  ASSERT_TRUE(editor().click("Draw as polygon"));
  ASSERT_TRUE(editor().wait_for("Swing map.corner.0"));
  ASSERT_TRUE(bring_into_sight(kMap));
  ASSERT_TRUE(editor().settle());
  const Pixel before = corner(0);
  editor().picture("swing_polygon");
  const auto drawn = saved("drawn")["swing_limits"]["left_arm"]["root"];
  ASSERT_GE(drawn.size(), 6u);

  // Escape in the middle of a drag puts the corner back.
  editor().move_to(before);
  editor().press();
  editor().glide(before, {before.x - 10, before.y + 18}, 6, 0.02);
  ASSERT_TRUE(editor().wait([&] { return corner(0).y > before.y + 8; }));
  editor().key("Escape");
  EXPECT_TRUE(editor().wait([&] { return std::abs(corner(0).y - before.y) <= 1; }));
  editor().release();
  ASSERT_TRUE(editor().settle());

  // Inwards: the map stays as large as it is.
  editor().drag(before, {before.x - 10, before.y - 18});
  ASSERT_TRUE(editor().wait([&] { return corner(0).y < before.y - 8; }));
  editor().picture("swing_corner_dragged");
  // Other limits than before, at that corner alone; they are the session's when it is opened.
  const auto project = saved("dragged");
  const auto dragged = project["swing_limits"]["left_arm"]["root"];
  ASSERT_EQ(dragged.size(), drawn.size());
  int moved = 0;
  for (std::size_t i = 0; i < drawn.size(); ++i) moved += drawn[i] != dragged[i];
  EXPECT_EQ(moved, 1) << drawn << "\n" << dragged;

  EXPECT_EQ(project["swing_limits"].size(), 1u);

  // One step for the drag, one for the polygon.
  editor().key("ctrl+z");
  ASSERT_TRUE(editor().wait([&] { return std::abs(corner(0).y - before.y) <= 1; }));
  EXPECT_EQ(saved("undone")["swing_limits"]["left_arm"]["root"], drawn);
  editor().key("ctrl+z");
  ASSERT_TRUE(editor().wait([&] { return editor().value(kMap) == "own limit"; }));
  editor().key("ctrl+shift+z");
  editor().key("ctrl+shift+z");
  ASSERT_TRUE(editor().wait([&] { return corner(0).y < before.y - 8; }));
  ASSERT_TRUE(bring_into_sight("Back to own limit"));
  ASSERT_TRUE(editor().click("Back to own limit"));
  ASSERT_TRUE(editor().wait([&] { return editor().value(kMap) == "own limit"; }));
  EXPECT_TRUE(saved("none")["swing_limits"].empty());
}

TEST_F(LimbSettingsByMouse, JointsAreChosenOrALimbIsNone) {
  ASSERT_TRUE(editor().start()) << editor().said();
  ASSERT_TRUE(editor().click("Outliner/Left arm"));
  ASSERT_TRUE(bring_into_sight("Choose joints…"));
  ASSERT_TRUE(editor().click("Choose joints…"));
  ASSERT_TRUE(editor().wait_for("Use these joints"));
  EXPECT_FALSE(editor().find("Use these joints")->enabled) << "they are its joints already";
  editor().picture("limb_joints");

  // Root, middle and end, each by the row and then by the list.
  const auto choose = [&](const std::string& slot, const std::string& joint) {
    ASSERT_TRUE(editor().click(kDialog + slot));
    ASSERT_TRUE(editor().click("Search joints"));
    editor().type(joint);
    ASSERT_TRUE(editor().wait([&] { return editor().value("Search joints") == joint; }));
    ASSERT_TRUE(editor().click(kDialog + joint));
    ASSERT_TRUE(editor().wait([&] { return editor().value(kDialog + slot) == joint; }))
        << editor().value(kDialog + slot);
  };
  choose("Shoulder", "LeftShoulder");
  choose("Elbow", "LeftLowerArm");
  choose("Wrist", "LeftHand");
  editor().picture("limb_joints_chosen");
  ASSERT_TRUE(editor().click("Use these joints"));
  ASSERT_TRUE(editor().wait([&] { return !editor().find("Use these joints"); }));
  const auto chosen = saved("chosen")["limbs"];
  EXPECT_EQ(chosen, nlohmann::json({{"left_arm", {"LeftShoulder", "LeftLowerArm", "LeftHand"}}}));
  EXPECT_TRUE(editor().find("Outliner/Left arm"));

  editor().key("ctrl+z");
  ASSERT_TRUE(
      editor().wait([&] { return editor().value("Inspector/Shoulder") == "LeftUpperArm"; }));

  // What the character hasn't.
  ASSERT_TRUE(editor().click("Outliner/Left leg"));
  ASSERT_TRUE(bring_into_sight("Choose joints…"));
  ASSERT_TRUE(editor().settle());
  ASSERT_TRUE(editor().click("Choose joints…"));
  ASSERT_TRUE(editor().click("Not a limb"));
  ASSERT_TRUE(editor().wait([&] { return !editor().find("Outliner/Left leg"); }, kScanSeconds));
  editor().picture("limb_none");
  EXPECT_EQ(saved("none")["limbs"], nlohmann::json({{"left_leg", "none"}}));
  editor().key("ctrl+z");
  EXPECT_TRUE(editor().wait_for("Outliner/Left leg", kScanSeconds));
}

}  // namespace
}  // namespace elbowroom::test
