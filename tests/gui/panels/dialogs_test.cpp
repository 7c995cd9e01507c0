// SPDX-License-Identifier: MIT
// The dialogs over the window, and what is there before anything is open.
#include <gtest/gtest.h>

#include "tests/gui/panels/demo_stretch.h"
#include "tests/gui/panels/editor_driver.h"

namespace elbowroom {
namespace {

using namespace command;

class DialogsTest : public testing::Test {
 protected:
  bool open() { return driver.open(demo_stretch(folder.path(), 0, 0.25, Props::none)); }
  void make_dirty() {
    driver.handle(SelectLimb{0});
    driver.handle(SetWindow{Interval{driver.state().begin, driver.state().end}});
    ASSERT_TRUE(driver.state().dirty);
  }
  void type_path(const std::filesystem::path& path) {
    driver.ui.key('A', {.control = true});
    driver.ui.type(path.string());
    driver.ui.key(keys::kEnter);
  }
  const EditorState& state() { return driver.state(); }

  ScratchFolder folder;
  EditorDriver driver;
};

TEST_F(DialogsTest, WelcomeOffersFilesTheDemoAndWhatWasOpenLast) {
  driver.editor.recent_files() = {"/a/b/walk.glb", "/a/c/take.elbow"};
  driver.ui.frame(3);
  EXPECT_TRUE(driver.ui.has("Welcome/Open the demo"));
  driver.said.clear();
  driver.ui.click("take.elbow");
  ASSERT_EQ(driver.said.size(), 1u);
  const auto* files = std::get_if<OpenFiles>(&driver.said.front());
  ASSERT_NE(files, nullptr);
  EXPECT_EQ(files->paths, std::vector<std::filesystem::path>{"/a/c/take.elbow"});
  ASSERT_TRUE(driver.wait_until([&] { return !state().opening.active; }));
  EXPECT_EQ(state().notices.back().kind, Notice::Kind::error) << "it is not there";
  driver.ui.click("Welcome/Open…");
  EXPECT_EQ(driver.view().dialog, Dialog::open);
  driver.ui.frame(2);
  driver.ui.key(keys::kEscape);
  EXPECT_EQ(driver.view().dialog, Dialog::none);
  EXPECT_EQ(state().limb, -1);
}

TEST_F(DialogsTest, OpenSaveAndExportByTyping) {
  const auto character = demo_stretch(folder.path(), 0, 0.25, Props::none).scene.character;
  driver.ui.key('O', {.control = true});
  ASSERT_EQ(driver.view().dialog, Dialog::open);
  type_path(character);
  EXPECT_EQ(driver.view().dialog, Dialog::none);
  ASSERT_TRUE(driver.wait_until([&] { return state().open() && !state().opening.active; }));
  EXPECT_EQ(state().document->scene.character, character);

  driver.ui.key('S', {.control = true});
  ASSERT_EQ(driver.view().dialog, Dialog::save_project);
  type_path(folder / "take");
  EXPECT_TRUE(std::filesystem::exists(folder / "take.elbow"));
  EXPECT_TRUE(state().has_project);
  make_dirty();
  driver.ui.key('S', {.control = true});
  EXPECT_EQ(driver.view().dialog, Dialog::none) << "the second time it knows where";
  EXPECT_FALSE(state().dirty);

  driver.ui.key('E', {.control = true});
  ASSERT_EQ(driver.view().dialog, Dialog::export_clip);
  type_path(folder / "out.glb");
  ASSERT_TRUE(driver.wait_until([&] { return !state().exporting.active; }));
  EXPECT_TRUE(std::filesystem::exists(folder / "out.glb"));
  // Over itself: the source is never written over.
  driver.handle(Export{character});
  ASSERT_TRUE(driver.wait_until([&] { return !state().exporting.active; }));
  EXPECT_EQ(state().notices.back().kind, Notice::Kind::error);

  driver.choose_menu("File", "Add object…");
  ASSERT_EQ(driver.view().dialog, Dialog::add_object);
  type_path(demo_scene().scene.obstacles.front());
  ASSERT_TRUE(driver.wait_until([&] { return !state().opening.active; }));
  EXPECT_EQ(state().document->scene.obstacles.size(), 1u);
  EXPECT_FALSE(state().undo_name.empty());
}

TEST_F(DialogsTest, QuitAsksForWhatIsNotSaved) {
  ASSERT_TRUE(open());
  make_dirty();
  // Cancel, by button and by Esc.
  driver.ui.key('Q', {.control = true});
  ASSERT_EQ(driver.view().dialog, Dialog::discard);
  driver.ui.frame(2);
  driver.ui.click("Cancel");
  EXPECT_EQ(driver.view().dialog, Dialog::none);
  EXPECT_FALSE(driver.editor.quitting());
  driver.ui.frame(3);
  driver.ui.key('Q', {.control = true});
  driver.ui.frame(2);
  driver.ui.key(keys::kEscape);
  EXPECT_EQ(driver.view().dialog, Dialog::none);
  EXPECT_FALSE(driver.editor.quitting());
  // Save: there is no project yet, so it asks where; giving that up gives up quitting.
  driver.ui.frame(3);
  driver.ui.key('Q', {.control = true});
  driver.ui.frame(2);
  driver.ui.click("Save");
  driver.ui.frame(2);
  ASSERT_EQ(driver.view().dialog, Dialog::save_project);
  driver.ui.key(keys::kEscape);
  EXPECT_EQ(driver.view().dialog, Dialog::none);
  EXPECT_FALSE(driver.editor.quitting());
  // Where it can't be saved nothing is lost.
  driver.ui.frame(3);
  driver.ui.key('Q', {.control = true});
  driver.ui.frame(2);
  driver.ui.key(keys::kEnter);
  driver.ui.frame(2);
  ASSERT_EQ(driver.view().dialog, Dialog::save_project);
  type_path(folder / "take.elbow");
  EXPECT_TRUE(std::filesystem::exists(folder / "take.elbow"));
  EXPECT_TRUE(driver.editor.quitting());
}

TEST_F(DialogsTest, QuitDiscardsOnlyWhenToldTo) {
  ASSERT_TRUE(open());
  make_dirty();
  driver.handle(Quit{});
  driver.ui.frame(3);
  EXPECT_FALSE(driver.editor.quitting());
  driver.ui.click("Discard");
  EXPECT_TRUE(driver.editor.quitting());
  EXPECT_FALSE(std::filesystem::exists(folder / "mannequin.elbow"));
}

TEST_F(DialogsTest, QuitSavesAProjectThatHasAPlace) {
  ASSERT_TRUE(open());
  driver.handle(SaveProject{folder / "take.elbow"});
  make_dirty();
  driver.handle(Quit{});
  driver.ui.frame(3);
  driver.ui.click("Save");
  driver.ui.frame(2);
  EXPECT_TRUE(driver.editor.quitting());
  EXPECT_FALSE(state().dirty);
}

TEST_F(DialogsTest, NothingToSaveQuitsAtOnce) {
  driver.handle(Quit{});
  EXPECT_TRUE(driver.editor.quitting());
}

TEST_F(DialogsTest, TheSheetOfShortcutsOpensAndCloses) {
  driver.ui.key('/', {.shift = true});
  ASSERT_EQ(driver.view().dialog, Dialog::shortcuts);
  driver.ui.frame(3);
  EXPECT_NE(driver.ui.dump().find("Next problem"), std::string::npos);
  driver.ui.key(keys::kEscape);
  EXPECT_EQ(driver.view().dialog, Dialog::none);
}

}  // namespace
}  // namespace elbowroom
