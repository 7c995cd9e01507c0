// SPDX-License-Identifier: MIT
// How long whoever does something waits to see it, while the planner is at work.
#include "tests/gui/window/driver/window_test.h"

namespace elbowroom::test {
namespace {

const char* const kBump = "Clip time.row.Right arm.bump.0";
const char* const kBand = "Clip time.window.band";

// The window answers while a plan is being computed. Times are printed; what is asked of them here
// is only that nobody waits for the planner.
TEST_F(WindowTest, AnswersWhilePlanning) {
  ASSERT_TRUE(editor().start()) << editor().said();
  ASSERT_TRUE(editor().wait_for(kBump, kScanSeconds)) << "no collision found";
  ASSERT_TRUE(editor().click(kBump));
  ASSERT_TRUE(editor().wait_for(kBand));
  const auto ruler = editor().find("Clip time.ruler");
  ASSERT_TRUE(ruler);
  const auto at = [&](double share) {
    return Pixel{ruler->min.x + static_cast<int>(share * (ruler->max.x - ruler->min.x)),
                 ruler->middle().y};
  };
  std::vector<double> waits;
  // Plans are short: one after the other until there is enough to say.
  for (int plan = 0; plan < 6 && waits.size() < 100; ++plan) {
    const std::size_t before = editor().frame_count();
    editor().move_to(at(0.3));
    editor().key(plan == 0 ? "p" : "Delete");
    if (plan > 0) {
      ASSERT_TRUE(editor().click("Plan/Seed"));
    }
    editor().move_to(at(0.3));
    editor().press();
    for (int i = 0; i < 40 && !editor().find("Plan/Accept"); ++i) {
      editor().glide(at(0.3), at(0.5), 15, 0.012);
      editor().glide(at(0.5), at(0.3), 15, 0.012);
    }
    editor().release();
    ASSERT_TRUE(editor().wait_for("Plan/Accept", kPlanSeconds)) << news();
    const auto frames = editor().frames();
    for (std::size_t i = before; i < frames.size(); ++i)
      if (frames[i].doing == "planning" && frames[i].from_event >= 0)
        waits.push_back(frames[i].from_event);
  }
  ASSERT_GE(waits.size(), 20u);
  std::sort(waits.begin(), waits.end());
  const auto share = [&](double s) {
    return waits[static_cast<std::size_t>(s * static_cast<double>(waits.size() - 1))];
  };
  std::printf("  event to submitted frame while planning: median %.1f ms, p99 %.1f ms, of %zu\n",
              share(0.5), share(0.99), waits.size());
  EXPECT_LT(share(0.5), 250);
}

}  // namespace
}  // namespace elbowroom::test
