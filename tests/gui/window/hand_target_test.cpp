// SPDX-License-Identifier: MIT
// The hand target by mouse: a limb by a click on the body, a target by key, a drag of its handle,
// a plan that goes there, and where the wrist is in the file that comes out.
#include <cmath>

#include "tests/gui/window/driver/window_test.h"
#include "tests/judge/judge_motion.h"

namespace elbowroom::test {
namespace {

constexpr int kOnArrow = 60;       // pixels from the gizmo's middle, on the arrow
constexpr double kReached = 1e-4;  // m, of the exported wrist from its target: keys are float32

class HandTargetByMouse : public WindowTest {
 protected:
  // As the panel shows it, metres.
  std::array<double, 3> shown_place() {
    std::array<double, 3> place{};
    const char* names[3] = {"Inspector/X", "Inspector/Y", "Inspector/Z"};
    for (std::size_t i = 0; i < 3; ++i) {
      std::string text = editor().value(names[i]);
      // The minus sign is a typographer's.
      if (text.rfind("−", 0) == 0) text.replace(0, std::string("−").size(), "-");
      place[i] = std::atof(text.c_str());
    }
    return place;
  }
  Pixel gizmo() {
    const auto mark = editor().find("Viewport/Hand target");
    return mark ? mark->middle() : Pixel{};
  }
  std::string status() {
    for (const auto& widget : editor().widgets())
      if (widget.kind == "error" && widget.path.rfind("Inspector/", 0) == 0) return widget.path;
    return {};
  }
  bool wait_for_status(const std::string& words, double seconds = 20) {
    return editor().wait([&] { return status().find(words) != std::string::npos; }, seconds);
  }
};

TEST_F(HandTargetByMouse, DraggedPlannedAndExported) {
  ASSERT_TRUE(editor().start()) << editor().said();
  ASSERT_TRUE(editor().wait_for("Clip time.ruler"));
  // A time at which the walk passes nothing.
  const auto ruler = editor().find("Clip time.ruler");
  editor().click(Pixel{ruler->min.x + 7 * (ruler->max.x - ruler->min.x) / 10, ruler->middle().y});
  editor().key("1");

  // Where the left hand is in the picture is known from a target put there; a click there chooses
  // the arm.
  ASSERT_TRUE(editor().click("Outliner/Left arm"));
  editor().key("t");
  ASSERT_TRUE(editor().wait_for("Viewport/Hand target"));
  const Pixel hand = gizmo();
  ASSERT_TRUE(editor().click("Outliner/Right leg"));
  ASSERT_TRUE(editor().wait_for("Inspector/Right leg"));
  editor().click(hand);
  ASSERT_TRUE(editor().wait_for("Inspector/Left arm")) << "the click chose no arm";
  editor().key("t");
  ASSERT_TRUE(editor().wait_for("Viewport/Hand target"));
  ASSERT_TRUE(wait_for_status("Reached, free", kScanSeconds)) << status();
  editor().picture("target");

  // Escape in the middle of a drag puts it back.
  const auto begin = shown_place();
  const Pixel middle = gizmo(), handle{middle.x + kOnArrow, middle.y};
  editor().move_to(handle);
  editor().press();
  editor().glide(handle, {handle.x + 40, handle.y}, 8, 0.02);
  ASSERT_TRUE(editor().wait([&] { return shown_place()[0] > begin[0] + 0.02; }));
  EXPECT_EQ(shown_place()[1], begin[1]) << "the X arrow moves along X alone";
  editor().picture("target_dragged");
  editor().key("Escape");
  EXPECT_TRUE(editor().wait([&] { return shown_place() == begin; }));
  editor().release();
  EXPECT_EQ(shown_place(), begin);

  // Far away: said so, and one step of undo takes it back.
  editor().drag(handle, {handle.x + 400, handle.y});
  ASSERT_TRUE(editor().wait([&] { return shown_place()[0] > begin[0] + 0.3; }));
  ASSERT_TRUE(wait_for_status("reach")) << status();
  EXPECT_EQ(status().find("Reached"), std::string::npos) << status();
  editor().picture("target_out_of_reach");
  editor().key("ctrl+z");
  ASSERT_TRUE(editor().wait([&] { return shown_place() == begin; }));

  // Where it can be, planned and exported.
  editor().drag(handle, {handle.x + 25, handle.y});
  ASSERT_TRUE(editor().wait([&] { return shown_place()[0] > begin[0] + 0.02; }));
  ASSERT_TRUE(wait_for_status("Reached, free")) << status();
  editor().key("p");
  ASSERT_TRUE(editor().wait_for("Plan/Accept", kPlanSeconds)) << news();
  editor().picture("reach_planned");
  editor().key("Return");
  ASSERT_TRUE(editor().wait([&] { return !editor().find("Plan/Accept"); }));
  const auto out = folder_ / "reach.glb", project = folder_ / "reach.elbow";
  editor().key("ctrl+e");
  take_path(out);
  ASSERT_TRUE(editor().wait_for_words("Exported with the animation")) << news();
  editor().key("ctrl+s");
  take_path(project);
  ASSERT_TRUE(editor().wait([&] { return std::filesystem::exists(project); }));

  const Delivered delivered = delivered_by(project, out);
  ASSERT_FALSE(delivered.windows.empty());
  std::printf("  judged at %d times\n", expect_delivered(delivered));
  const auto target = read_json(project)["tasks"][0]["target"];
  ASSERT_TRUE(target.is_object()) << read_json(project)["tasks"];
  const judge::File file = judge::load(out);
  const auto& position = target["position"];
  const judge::State state =
      judge::state_at(file, &file.animation(delivered.animation), target["time"].get<double>());
  const auto wrist =
      state.world[static_cast<std::size_t>(file.node(delivered.windows[0].limb_joints.back()))];
  const glm::dvec3 wanted(position[0], position[1], position[2]);
  const double off = glm::length(glm::dvec3(wrist[3]) - wanted);
  std::printf("  the wrist is %.2g m from its target at %.3f s\n", off,
              target["time"].get<double>());
  EXPECT_LT(off, kReached);
}

TEST_F(HandTargetByMouse, PlacedOnASurface) {
  ASSERT_TRUE(editor().start()) << editor().said();
  ASSERT_TRUE(editor().wait_for("Outliner/Right leg"));
  editor().key("1");
  // The other hand's place in the picture is a surface to click.
  ASSERT_TRUE(editor().click("Outliner/Left arm"));
  editor().key("t");
  ASSERT_TRUE(editor().wait_for("Viewport/Hand target"));
  const Pixel hand = gizmo();
  ASSERT_TRUE(editor().click("Outliner/Right arm"));
  ASSERT_TRUE(editor().wait([&] { return !editor().find("Viewport/Hand target"); }));
  editor().key("shift+t");
  editor().picture("placing");
  editor().click(hand);
  ASSERT_TRUE(editor().wait_for("Viewport/Hand target"));
  // In front of what was clicked, seen from the front: at the same place in the picture.
  EXPECT_LT(std::hypot(gizmo().x - hand.x, gizmo().y - hand.y), 80);
  ASSERT_TRUE(editor().wait([&] { return !status().empty(); }));
  editor().picture("placed");
  // Beside everything there is nothing to put it on: it stays where it is.
  const auto place = shown_place();
  editor().key("shift+t");
  const auto picture = editor().find("Viewport/Picture");
  editor().click(Pixel{picture->min.x + 40, picture->min.y + 100});
  ASSERT_TRUE(editor().wait_for_words("no surface"));
  EXPECT_EQ(shown_place(), place);
}

}  // namespace
}  // namespace elbowroom::test
