// SPDX-License-Identifier: MIT
// The way from start to a corrected file by mouse, and what comes out of it.
#include "tests/gui/window/driver/window_test.h"

namespace elbowroom::test {
namespace {

constexpr int kMostActions = 8;
const char* const kBump = "Clip time.row.Right arm.bump.0";
const char* const kBand = "Clip time.window.band";

class FirstPath : public WindowTest {
 protected:
  void find_and_plan() {
    ASSERT_TRUE(editor().wait_for(kBump, kScanSeconds)) << "no collision found";
    ASSERT_TRUE(editor().click(kBump));
    ASSERT_TRUE(editor().wait_for(kBand));
    editor().picture("chosen");
    ASSERT_TRUE(editor().click("Plan/Plan"));
    ASSERT_TRUE(editor().wait_for("Plan/Accept", kPlanSeconds)) << news();
    editor().picture("planned");
  }
  std::string correction_row() {
    for (const auto& widget : editor().widgets())
      if (widget.kind == "row" &&
          widget.path.rfind("Outliner/Right arm ", 0) == 0)  // "Right arm 1.18–2.47 s"
        return widget.path;
    return {};
  }
};

TEST_F(FirstPath, ByMouseFromTheDemoToAFreeClip) {
  ASSERT_TRUE(editor().start()) << editor().said();
  find_and_plan();
  ASSERT_TRUE(editor().click("Plan/Accept"));
  ASSERT_TRUE(editor().wait([&] { return !correction_row().empty(); }));
  ASSERT_TRUE(editor().click("File"));
  ASSERT_TRUE(editor().click("File/Export clip…"));
  editor().picture("export");
  const auto out = folder_ / "by_mouse.glb";
  editor().type(out.string());
  ASSERT_TRUE(editor().wait([&] { return editor().value("Path") == out.string(); }));
  ASSERT_TRUE(editor().click("Export the corrected clip/Export"));
  ASSERT_TRUE(editor().wait_for_words("Exported with the animation")) << news();
  std::printf("  %d actions from start to export\n", editor().actions());
  EXPECT_LE(editor().actions(), kMostActions);
  ASSERT_TRUE(editor().wait([&] { return news() == "No limb collides"; }, kScanSeconds)) << news();
  editor().picture("exported");

  // What is kept as a project comes back, and comes to the same file.
  const auto project = folder_ / "walk.elbow";
  editor().key("ctrl+s");
  take_path(project);
  ASSERT_TRUE(editor().wait([&] { return std::filesystem::exists(project); }));
  ASSERT_TRUE(editor().wait([&] { return editor().value("Menu/Document") == "walk.elbow"; }));
  const std::string row = correction_row();
  editor().key("ctrl+q");
  ASSERT_EQ(editor().ended(), 0) << "nothing is unsaved";

  const Delivered delivered = delivered_by(project, out);
  ASSERT_EQ(delivered.windows.size(), 1u);
  std::printf("  judged at %d times\n", expect_delivered(delivered));

  ASSERT_TRUE(editor().start({project.string()}));
  ASSERT_TRUE(editor().wait([&] { return correction_row() == row; })) << correction_row();
  const auto again = folder_ / "again.glb";
  editor().key("ctrl+e");
  take_path(again);
  ASSERT_TRUE(editor().wait_for_words("Exported with the animation"));
  const std::string first = bytes_of(out);
  EXPECT_FALSE(first.empty());
  EXPECT_TRUE(first == bytes_of(again)) << "the project brought back another motion";

  // Muted and deleted, nothing of it is left; undo brings it back.
  ASSERT_TRUE(editor().click(row + ".Mute"));
  const auto muted = folder_ / "muted.glb";
  editor().key("ctrl+e");
  take_path(muted);
  ASSERT_TRUE(editor().wait_for_words("Exported a copy: there is nothing corrected"));
  EXPECT_TRUE(bytes_of(muted) == bytes_of(kDemo / demo::kMannequinFile));
  ASSERT_TRUE(editor().click(row + ".Delete"));
  ASSERT_TRUE(editor().wait([&] { return correction_row().empty(); }));
  editor().picture("deleted");
  editor().key("ctrl+z");
  ASSERT_TRUE(editor().wait([&] { return correction_row() == row; }));
  editor().key("ctrl+z");
  const auto back = folder_ / "back.glb";
  editor().key("ctrl+e");
  take_path(back);
  ASSERT_TRUE(editor().wait([&] { return bytes_of(back) == first; }));
}

}  // namespace
}  // namespace elbowroom::test
