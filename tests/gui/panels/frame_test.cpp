// SPDX-License-Identifier: MIT
// What frames the work: the bar, the status line, the picture, the inspector without a limb; at any
// size.
#include "tests/gui/panels/panels_fixture.h"

namespace elbowroom {
namespace {

using namespace command;

TEST_F(Panels, StatusLineAndInspectorWithoutALimb) {
  EXPECT_NE(ui().value("News").find("problem"), std::string::npos);
  EXPECT_NE(ui().value("News").find(title(arm)), std::string::npos);
  // Nothing is selected: the inspector offers the limbs.
  ASSERT_LT(state().limb, 0);
  ui().click("Inspector/" + title(other));
  EXPECT_EQ(state().limb, other);
  ui().move_to("Plan/Seed");
  ui().frame(3);
  EXPECT_NE(ui().value("Hint").find("another way"), std::string::npos);
}

TEST_F(Panels, UndoAndRedoInTheBar) {
  EXPECT_FALSE(ui().widget("Menu/Undo")->enabled);
  driver().handle(SelectLimb{arm});
  ui().frame(2);
  ui().click("Menu/Undo");
  EXPECT_LT(state().limb, 0);
  ui().click("Menu/Redo");
  EXPECT_EQ(state().limb, arm);
  EXPECT_EQ(ui().value("Document").find("not saved"), std::string::npos);
  driver().handle(SetWindow{Interval{state().begin, state().end}});
  ui().frame(2);
  EXPECT_NE(ui().value("Document").find("not saved"), std::string::npos);
}

// The picture: a click chooses a limb, drags and the wheel move the camera and nothing else.
TEST_F(Panels, Viewport) {
  const Camera before = driver().view().camera;
  const Document document = driver().document();
  const ImVec2 middle = ui().centre("Picture");
  ui().drag({middle.x, middle.y - 150}, {middle.x + 80, middle.y - 120});
  EXPECT_FALSE(driver().view().camera == before) << "orbit";
  Camera last = driver().view().camera;
  ui().drag(middle, {middle.x + 50, middle.y}, 8, 1);
  EXPECT_FALSE(driver().view().camera == last) << "pan";
  last = driver().view().camera;
  ui().move_to(middle);
  ui().wheel(1);
  EXPECT_FALSE(driver().view().camera == last) << "zoom";
  EXPECT_TRUE(driver().document() == document);
  driver().view().camera = before;
  driver().said.clear();
  ui().click(middle);
  ASSERT_EQ(driver().said.size(), 1u);
  EXPECT_NE(std::get_if<Click>(&driver().said.front()), nullptr);
}

TEST(PanelSizes, AreDrawnFromTinyToHuge) {
  ScratchFolder folder;
  const Document document = demo_stretch(folder.path(), 0, 0.25, Props::none);
  EditorDriver driver;
  ASSERT_TRUE(driver.open(document));
  driver.handle(SelectLimb{0});
  for (const ImVec2 size :
       {ImVec2{1, 1}, ImVec2{320, 200}, ImVec2{800, 560}, ImVec2{1024, 700}, ImVec2{3840, 2160}})
    for (const InspectorTab tab :
         {InspectorTab::limb, InspectorTab::target, InspectorTab::planner}) {
      driver.view().tab = tab;
      driver.ui.resize(size.x, size.y);
      driver.ui.frame();
    }
}

}  // namespace
}  // namespace elbowroom
