// SPDX-License-Identifier: MIT
#include "ui/toolkit/file_dialog.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "tests/gui/driver/ui_driver.h"
#include "ui/toolkit/layout.h"

namespace elbowroom {
namespace {

namespace fs = std::filesystem;

class FileDialogTest : public testing::Test {
 protected:
  FileDialogTest() : driver(1024, 700) {
    folder = fs::temp_directory_path() / ("elbowroom-dialog-" + std::to_string(getpid()));
    fs::remove_all(folder);
    fs::create_directories(folder / "takes" / "deep");
    for (const char* name : {"walk2.glb", "walk10.glb", "Ada.GLB", "notes.txt", ".secret.glb",
                             "a##b.glb", "takes/jump.gltf"}) {
      std::ofstream(folder / name) << "x";
    }
    options.extensions = {".glb", ".gltf", ".vrm", ".elbow"};
    open_dialog(dialog, folder);
    driver.show([this](Ui& ui) {
      const Panel panel(ui, "Editor", {{0, 0}, {1024, 700}});
      if (auto path = file_dialog(ui, dialog, options)) chosen.push_back(*path);
    });
  }
  ~FileDialogTest() override { fs::remove_all(folder); }
  void type_path(const std::string& text) {
    driver.click("Path");
    driver.key('A', {.control = true});
    driver.type(text);
  }

  UiDriver driver;
  fs::path folder;
  FileDialog dialog;
  FileDialogOptions options;
  std::vector<fs::path> chosen;
};

TEST_F(FileDialogTest, ListsFoldersFirstThenFilesThatFit) {
  std::vector<std::string> names;
  for (const FileEntry& entry : dialog.entries) names.push_back(entry.name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"takes", "a##b.glb", "Ada.GLB", "walk2.glb", "walk10.glb"}));
  driver.click("All files");
  EXPECT_TRUE(driver.has("notes.txt"));
  driver.click("Hidden");
  EXPECT_TRUE(driver.has(".secret.glb"));
}

TEST_F(FileDialogTest, ADoubleClickTakesAFile) {
  driver.double_click("walk2.glb");
  ASSERT_EQ(chosen.size(), 1u);
  EXPECT_EQ(chosen[0], folder / "walk2.glb");
  EXPECT_FALSE(dialog.open);
  ASSERT_FALSE(dialog.recent.empty());
  EXPECT_EQ(dialog.recent[0], folder);
}

TEST_F(FileDialogTest, AClickAndTheButton) {
  driver.click("walk10.glb");
  EXPECT_TRUE(chosen.empty());
  driver.click("Open/Open");
  ASSERT_EQ(chosen.size(), 1u);
  EXPECT_EQ(chosen[0], folder / "walk10.glb");
}

TEST_F(FileDialogTest, FoldersAreEnteredAndLeft) {
  driver.double_click("takes");
  driver.frame(2);
  EXPECT_TRUE(driver.has("jump.gltf"));
  EXPECT_TRUE(chosen.empty());
  driver.click("Up");
  driver.frame(2);
  EXPECT_TRUE(driver.has("walk2.glb"));
}

TEST_F(FileDialogTest, KeysAlone) {
  driver.key(keys::kDown);  // takes
  driver.key(keys::kEnter);
  driver.frame(3);
  EXPECT_EQ(dialog.folder, folder / "takes");
  driver.key(keys::kDown);  // deep
  driver.key(keys::kDown);  // jump.gltf
  driver.key(keys::kEnter);
  ASSERT_EQ(chosen.size(), 1u);
  EXPECT_EQ(chosen[0], folder / "takes" / "jump.gltf");
}

TEST_F(FileDialogTest, TabCompletesThePath) {
  type_path((folder / "ta").string());
  driver.key(keys::kTab);
  driver.type("j");
  driver.key(keys::kTab);
  driver.key(keys::kEnter);
  ASSERT_EQ(chosen.size(), 1u);
  EXPECT_EQ(chosen[0], folder / "takes" / "jump.gltf");
}

TEST_F(FileDialogTest, AMissingFileIsSaidInside) {
  type_path("no-such.glb");
  driver.key(keys::kEnter);
  driver.frame(2);
  EXPECT_TRUE(driver.has("There is no such file"));
  EXPECT_TRUE(chosen.empty());
  EXPECT_TRUE(dialog.open);
}

TEST_F(FileDialogTest, AFolderThatCannotBeReadIsSaidInside) {
  fs::remove_all(folder);
  dialog.stale = true;
  driver.frame(2);
  EXPECT_TRUE(driver.has("There is no such folder"));
}

TEST_F(FileDialogTest, EscapeCloses) {
  driver.key(keys::kEscape);
  EXPECT_FALSE(dialog.open);
  EXPECT_TRUE(chosen.empty());
  driver.frame(3);
  EXPECT_FALSE(driver.has("Path"));
}

TEST_F(FileDialogTest, SavingAddsTheExtension) {
  options.purpose = FilePurpose::save;
  options.extensions = {".elbow"};
  type_path((folder / "mine").string());
  driver.key(keys::kEnter);
  ASSERT_EQ(chosen.size(), 1u);
  EXPECT_EQ(chosen[0], folder / "mine.elbow");
}

TEST_F(FileDialogTest, SavingOverAFileAsksFirst) {
  options.purpose = FilePurpose::save;
  type_path((folder / "walk2.glb").string());
  driver.key(keys::kEnter);
  driver.frame(2);
  EXPECT_TRUE(chosen.empty());
  EXPECT_TRUE(driver.has("Replace walk2.glb?"));
  driver.key(keys::kEscape);  // takes back the question only
  EXPECT_TRUE(dialog.open);
  EXPECT_FALSE(driver.has("Replace walk2.glb?"));
  driver.click("Open/Open");
  driver.frame(2);
  driver.click("Replace");
  ASSERT_EQ(chosen.size(), 1u);
  EXPECT_EQ(chosen[0], folder / "walk2.glb");
}

TEST_F(FileDialogTest, StartsWhereItCan) {
  open_dialog(dialog, folder / "gone" / "deeper" / "x.glb");
  EXPECT_EQ(dialog.folder, folder);
  open_dialog(dialog, folder / "new.elbow");
  EXPECT_EQ(dialog.path_text, (folder / "new.elbow").string());
}

TEST(FileListing, SortsAsPeopleDo) {
  EXPECT_TRUE(comes_before("walk2", "walk10"));
  EXPECT_TRUE(comes_before("ada", "Bob"));
  EXPECT_TRUE(comes_before("a", "ab"));
  EXPECT_FALSE(comes_before("a", "a"));
  EXPECT_NE(comes_before("01", "1"), comes_before("1", "01"));
  EXPECT_EQ(size_text(999), "999 B");
  EXPECT_EQ(size_text(1234567), "1.2 MB");
  EXPECT_EQ(size_text(999999), "1.0 MB");
}

}  // namespace
}  // namespace elbowroom
