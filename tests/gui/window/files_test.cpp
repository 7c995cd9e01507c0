// SPDX-License-Identifier: MIT
// Files that are broken, files that are no scene, and leaving.
#include "tests/gui/window/driver/window_test.h"

namespace elbowroom::test {
namespace {

class Files : public WindowTest {
 protected:
  // A note that something went wrong, in the window.
  bool told_of_error() {
    for (const auto& widget : editor().widgets())
      if (widget.kind == "toast" || widget.kind == "error") return true;
    return false;
  }
  // Opens by the dialog and expects an error, with what was open left as it was.
  void expect_refused(const std::filesystem::path& file) {
    editor().key("ctrl+o");
    take_path(file);
    EXPECT_TRUE(editor().wait([&] { return told_of_error(); })) << file << " is taken silently";
    EXPECT_TRUE(editor().running()) << file;
    EXPECT_EQ(editor().value("Menu/Document").substr(0, 9), "mannequin") << file;
    EXPECT_TRUE(editor().find("Outliner/Left arm")) << file;
    // It stays until it is clicked; the next one is to be seen for itself.
    for (int tries = 0; tries < 5 && told_of_error(); ++tries) {
      for (const auto& widget : editor().widgets())
        if (widget.kind == "toast") {
          editor().click(widget.middle());
          break;
        }
      editor().wait([&] { return !told_of_error(); }, 2);
    }
    ASSERT_FALSE(told_of_error());
  }
};

TEST_F(Files, WhatCannotBeReadIsToldAndLeavesTheDocument) {
  ASSERT_TRUE(editor().start()) << editor().said();
  ASSERT_TRUE(editor().wait_for("Outliner/Left arm"));
  const std::string whole = bytes_of(kDemo / demo::kMannequinFile);
  std::ofstream(folder_ / "no_gltf.glb") << "this is no glTF";
  std::ofstream(folder_ / "cut.glb", std::ios::binary) << whole.substr(0, whole.size() / 3);
  std::ofstream(folder_ / "broken.elbow") << "{\"version\": 1, \"scene\": ";
  std::ofstream(folder_ / "empty.gltf") << "";
  for (const char* name : {"no_gltf.glb", "cut.glb", "broken.elbow", "empty.gltf"})
    expect_refused(folder_ / name);
  editor().picture("refused");

  // Leaving with something unsaved asks first.
  ASSERT_TRUE(editor().click("Outliner/Left arm"));
  editor().key("t");
  ASSERT_TRUE(editor().wait_for("Hand target"));
  editor().key("ctrl+q");
  ASSERT_TRUE(editor().wait_for_words("Save changes"));
  editor().picture("unsaved");
  EXPECT_TRUE(editor().running());
  editor().key("Escape");
  ASSERT_TRUE(editor().wait([&] { return !editor().shows("Save changes"); }));
  EXPECT_TRUE(editor().find("Hand target"));
  editor().key("ctrl+q");
  ASSERT_TRUE(editor().wait_for_words("Save changes"));
  discard_if_asked();
  EXPECT_EQ(editor().ended(), 0);
}

TEST_F(Files, AnObjectAloneIsToldToBeNoCharacter) {
  ASSERT_TRUE(editor().start({(kDemo / demo::kPostsFile).string()})) << editor().said();
  EXPECT_TRUE(editor().wait_for_words("no character")) << editor().said();
  editor().picture("object_alone");
  EXPECT_TRUE(editor().running());
  editor().key("ctrl+q");
  EXPECT_EQ(editor().ended(), 0);
}

}  // namespace
}  // namespace elbowroom::test
