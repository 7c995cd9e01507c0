// SPDX-License-Identifier: MIT
// Several ways around by mouse: stepping through them, accepting another than the best, and the
// file that comes out is the one that was shown.
#include "tests/gui/window/driver/window_test.h"

namespace elbowroom::test {
namespace {

const char* const kBump = "Clip time.row.Right arm.bump.0";

class Ways : public WindowTest {
 protected:
  std::string card() {
    for (const auto& widget : editor().widgets())
      if (widget.kind == "card" && widget.path.rfind("Plan/", 0) == 0) return widget.value;
    return {};
  }
  void export_to(const std::filesystem::path& file) {
    editor().key("ctrl+e");
    take_path(file);
    ASSERT_TRUE(editor().wait([&] { return std::filesystem::exists(file); })) << news();
    ASSERT_TRUE(editor().settle());
  }
};

TEST_F(Ways, TheOneShownIsTheOneExported) {
  ASSERT_TRUE(editor().start()) << editor().said();
  ASSERT_TRUE(editor().wait_for(kBump, kScanSeconds));
  ASSERT_TRUE(editor().click(kBump));
  ASSERT_TRUE(editor().click("Tabs/Planner"));
  ASSERT_TRUE(editor().wait_for("Inspector/Ways around"));
  const Pixel ways = editor().find("Inspector/Ways around")->middle();
  editor().drag(ways, {ways.x + 30, ways.y});
  ASSERT_TRUE(editor().wait([&] { return editor().value("Inspector/Ways around") == "4"; }))
      << editor().value("Inspector/Ways around");
  ASSERT_TRUE(editor().click("Plan/Plan"));
  ASSERT_TRUE(editor().wait_for("Plan/Accept", 3 * kPlanSeconds)) << news();
  ASSERT_TRUE(editor().find("Plan/Later way")) << "the demo has more than one way around";
  const std::string best = card();
  editor().picture("ways_first");
  ASSERT_TRUE(editor().click("Plan/Later way"));
  ASSERT_TRUE(editor().wait([&] { return card() != best; })) << "another way has other numbers";
  const std::string second = card();
  editor().picture("ways_second");
  editor().key("Prior");
  ASSERT_TRUE(editor().wait([&] { return card() == best; }));
  editor().key("Next");
  ASSERT_TRUE(editor().wait([&] { return card() == second; }));

  ASSERT_TRUE(editor().click("Plan/Accept"));
  ASSERT_TRUE(editor().wait([&] { return !editor().find("Plan/Accept"); }));
  const auto out = folder_ / "second.glb", project = folder_ / "second.elbow";
  export_to(out);
  editor().key("ctrl+s");
  take_path(project);
  ASSERT_TRUE(editor().wait([&] { return std::filesystem::exists(project); }));
  const Delivered delivered = delivered_by(project, out);
  ASSERT_EQ(delivered.windows.size(), 1u);
  std::printf("  judged at %d times\n", expect_delivered(delivered));
  // The file's keys are those of the correction that was accepted.
  const auto saved = read_json(project)["corrections"][0];
  const auto model = read_gltf(out);
  ASSERT_TRUE(model.ok());
  const Clip& clip = (*model)->clips.back();
  for (const auto& joint : saved["joints"]) {
    const int channel = clip.find_channel(joint["node"].get<int>(), Path::rotation);
    ASSERT_GE(channel, 0);
    const auto& times = clip.channels[static_cast<std::size_t>(channel)].times;
    for (const auto& time : joint["times"])
      EXPECT_NE(std::find(times.begin(), times.end(), time.get<float>()), times.end());
  }

  // And the command line delivers the same from the project: not the best way, the accepted one.
  const auto solved = folder_ / "solved.glb";
  const ProgramRun run = run_program(ELBOWROOM_PROGRAM, {"solve", project, "-o", solved});
  ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
  EXPECT_NE(run.out.find("as accepted, verified"), std::string::npos) << run.out;
  EXPECT_TRUE(bytes_of(solved) == bytes_of(out));

  // One step takes it back; the best one, accepted instead, is another file.
  editor().key("ctrl+z");
  ASSERT_TRUE(editor().wait([&] { return editor().find("Clip time.window.band").has_value(); }));
  ASSERT_TRUE(editor().click("Plan/Plan"));
  ASSERT_TRUE(editor().wait_for("Plan/Accept", 3 * kPlanSeconds)) << news();
  editor().key("Return");
  const auto other = folder_ / "best.glb";
  export_to(other);
  EXPECT_NE(bytes_of(out), bytes_of(other));
}

}  // namespace
}  // namespace elbowroom::test
