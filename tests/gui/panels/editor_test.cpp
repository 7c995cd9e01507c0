// SPDX-License-Identifier: MIT
// The editor without its window: every change of the document can be taken back, results of what
// is no longer shown are passed over, and commands that make no sense change nothing.
#include "app/editor/editor.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <limits>
#include <random>

#include "assets/demo.h"
#include "core/io/project_file.h"
#include "tests/gui/panels/demo_stretch.h"
#include "tests/gui/panels/editor_driver.h"

namespace elbowroom {
namespace {

using namespace command;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

class EditorTest : public testing::Test {
 protected:
  // The demo's first few keys, nothing around: cheap.
  bool open_alone() { return driver.open(demo_stretch(folder.path(), 0, 0.25, Props::none)); }
  // Between the posts, with a collision.
  bool open_stretch() {
    return driver.open(demo_stretch(folder.path(), kStretchBegin, kStretchEnd, Props::all));
  }
  const EditorState& state() { return driver.state(); }
  bool told(const std::string& part) {
    for (const Notice& notice : state().notices)
      if (notice.text.message().find(part) != std::string::npos) return true;
    return false;
  }
  bool ready() {
    return driver.wait_until([&] { return state().strip && state().strip->complete(); }) &&
           driver.settle();
  }
  // Plans in a window that is drawn, and accepts.
  bool correct(int limb, double begin, double end) {
    driver.handle(SelectLimb{limb});
    driver.handle(SetWindow{Interval{begin, end}});
    driver.handle(Plan{});
    if (!driver.wait_until([&] { return !state().planning.active; }) || !state().candidate) {
      ADD_FAILURE() << (state().failure ? state().failure->reason : "no plan");
      return false;
    }
    driver.handle(Accept{});
    return true;
  }

  ScratchFolder folder;
  EditorDriver driver;
};

// With two real corrections: planned without obstacles, so at once.
TEST_F(EditorTest, AnyCommandsCanBeTakenBackAndDoneAgain) {
  ASSERT_TRUE(open_alone());
  ASSERT_TRUE(ready());
  const Document first = driver.document();
  const double begin = state().begin, end = state().end, length = end - begin;
  ASSERT_TRUE(correct(0, begin + 0.1 * length, begin + 0.9 * length));
  ASSERT_TRUE(correct(1, begin + 0.1 * length, begin + 0.9 * length));
  const Document corrected = driver.document();
  ASSERT_EQ(corrected.corrections.size(), 2u);

  std::mt19937 random(20071101);
  const auto number = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  const auto whole = [&](int a, int b) { return std::uniform_int_distribution<int>(a, b)(random); };
  const auto phase = [&] { return static_cast<Phase>(whole(0, 3)); };
  // Plans are asked for and given up, so that the same commands give the same document.
  int changes = 0;
  for (int i = 0; i < 300; ++i) {
    const std::uint64_t revision = state().revision;
    switch (whole(0, 17)) {
      case 0:
        driver.editor.handle(SelectLimb{whole(-1, 4)});
        break;
      case 1:
        driver.editor.handle(SetWindow{Interval{number(begin, end), number(begin, end)}, phase()});
        break;
      case 2:
        driver.editor.handle(SetWindow{std::nullopt});
        break;
      case 3:
      case 4: {
        if (state().dofs.empty()) break;
        const DofView& dof = state().dofs[static_cast<std::size_t>(
            whole(0, static_cast<int>(state().dofs.size()) - 1))];
        const double a = number(dof.lower, dof.upper), b = number(a, dof.upper);
        std::optional<Interval> interval = Interval{a, b};
        if (whole(0, 4) == 0) interval.reset();
        driver.editor.handle(SetSampling{dof.name, interval, phase()});
        break;
      }
      case 5:
        driver.editor.handle(ChoosePreset{kSamplingPresets[whole(0, 3)]});
        break;
      case 6: {
        PlanningWishes wishes;
        wishes.seed = static_cast<std::uint64_t>(whole(1, 1000000));
        wishes.clearance = number(0, 0.1);
        wishes.max_iterations = whole(1, 9000);
        driver.editor.handle(SetWishes{wishes, "Seed", phase()});
        break;
      }
      case 7:
        driver.editor.handle(MuteCorrection{whole(-1, 2)});
        break;
      case 8:
        if (whole(0, 3) == 0) driver.editor.handle(DeleteCorrection{whole(-1, 2)});
        break;
      case 9:
        driver.editor.handle(RenameCorrection{whole(-1, 2), "take " + std::to_string(i)});
        break;
      case 10:
        if (whole(0, 3) == 0) {
          driver.editor.handle(ReplanCorrection{whole(-1, 2)});
          driver.editor.handle(CancelPlan{});
        }
        break;
      case 11: {
        HandTarget target;
        target.time = number(begin - 1, end + 1);
        target.position = {number(-1, 1), number(0, 2), number(-1, 1)};
        driver.editor.handle(SetTarget{target, phase()});
        break;
      }
      case 12:
        driver.editor.handle(SetTarget{std::nullopt});
        break;
      case 13:
        driver.editor.handle(TargetFromPosture{});
        break;
      case 14:
        driver.editor.handle(Undo{});
        break;
      case 15:
        driver.editor.handle(Redo{});
        break;
      case 16:
        driver.editor.handle(Scrub{number(begin, end)});
        break;
      default:
        driver.editor.handle(SelectProblem{whole(-1, 4), whole(-1, 1)});
    }
    changes += revision != state().revision;
    // What panels are handed is the document, whatever has happened.
    ASSERT_EQ(state().corrections.size(), driver.document().corrections.size()) << i;
    ASSERT_LT(state().selected_correction, static_cast<int>(driver.document().corrections.size()));
    if (i % 20 == 0) driver.ui.frame();
  }
  EXPECT_GT(changes, 100);
  driver.editor.handle(SetWindow{Interval{begin, end}});  // ends what is still being dragged
  const Document last = driver.document();
  int steps = 0;
  while (!state().undo_name.empty()) {
    driver.editor.handle(Undo{});
    ASSERT_LT(++steps, 400);
  }
  EXPECT_TRUE(driver.document() == first);
  EXPECT_EQ(state().clip, state().source);
  EXPECT_FALSE(state().dirty);
  while (!state().redo_name.empty()) driver.editor.handle(Redo{});
  EXPECT_TRUE(driver.document() == last);
  EXPECT_TRUE(driver.settle());
}

TEST_F(EditorTest, CommandsThatMakeNoSenseChangeNothing) {
  // With nothing open.
  const auto hostile = [&] {
    std::vector<Command> list = {Scrub{kNone},
                                 Scrub{kInfinite},
                                 SetSpeed{kNone},
                                 StepFrames{std::numeric_limits<int>::min()},
                                 SelectLimb{-7},
                                 SelectLimb{999},
                                 SelectProblem{-1, -1},
                                 SelectProblem{0, 999},
                                 SelectProblem{999, 0},
                                 SetWindow{Interval{kNone, 1}},
                                 SetWindow{Interval{0, kInfinite}},
                                 SetSampling{"no such DOF", Interval{0, 1}},
                                 SetSampling{"", Interval{0, 1}},
                                 SelectCorrection{5},
                                 MuteCorrection{-1},
                                 MuteCorrection{7},
                                 DeleteCorrection{99},
                                 DeleteCorrection{-3},
                                 RenameCorrection{4, "x"},
                                 ReplanCorrection{12},
                                 SetTarget{HandTarget{kNone, Vec3(0.0), {}, false}},
                                 SetTarget{HandTarget{0, Vec3(kNone), {}, false}},
                                 SetTarget{HandTarget{0, Vec3(0.0), Quat(0, 0, 0, 0), false}},
                                 SetTarget{HandTarget{0, Vec3(0.0), Quat(kNone, 0, 0, 0), false}},
                                 Click{Vec3(kNone), Vec3(0, 0, -1), true},
                                 Click{Vec3(0.0), Vec3(0.0), true},
                                 Click{Vec3(0.0), Vec3(kInfinite), false},
                                 Export{{}},
                                 Accept{},
                                 Discard{},
                                 CancelPlan{},
                                 OpenFiles{},
                                 RemoveObject{"nothing.glb"}};
    for (const char* bad : {"clearance", "seconds", "iterations", "ways"}) {
      PlanningWishes wishes;
      if (bad[0] == 'c') wishes.clearance = kNone;
      if (bad[0] == 's') wishes.max_seconds = -1;
      if (bad[0] == 'i') wishes.max_iterations = 0;
      if (bad[0] == 'w') wishes.alternatives = -4;
      list.push_back(SetWishes{wishes, bad});
    }
    return list;
  }();
  for (const Command& command : hostile) driver.editor.handle(command);
  driver.editor.handle(AttachObject{"nothing.glb", "Hand"});
  driver.editor.handle(ChooseClip{"x"});
  driver.editor.handle(Plan{});
  driver.editor.handle(SaveProject{folder / "nothing.elbow"});
  driver.ui.frame(2);
  EXPECT_FALSE(state().open());
  EXPECT_FALSE(std::filesystem::exists(folder / "nothing.elbow"));
  EXPECT_FALSE(state().dirty);

  ASSERT_TRUE(open_alone());
  const Document before = driver.document();
  for (std::size_t i = 0; i < hostile.size(); ++i) {
    driver.editor.handle(hostile[i]);
    ASSERT_TRUE(driver.document() == before) << "command " << i << ", no limb chosen";
  }
  driver.editor.handle(SelectLimb{0});
  const Document chosen = driver.document();
  const DofView dof = state().dofs.front();
  std::vector<Command> more = hostile;
  more.push_back(SetSampling{dof.name, Interval{kNone, 1}});
  more.push_back(SetSampling{dof.name, Interval{0, kInfinite}});
  more.push_back(SetSampling{dof.name, Interval{dof.upper + 1, dof.upper + 2}});
  more.push_back(SetSampling{dof.name, Interval{dof.upper, dof.lower}});
  for (std::size_t i = 0; i < more.size(); ++i) {
    for (const Phase phase : {Phase::committed, Phase::changing}) {
      Command command = more[i];
      if (auto* c = std::get_if<SetWindow>(&command)) c->phase = phase;
      if (auto* c = std::get_if<SetSampling>(&command)) c->phase = phase;
      if (auto* c = std::get_if<SetTarget>(&command)) c->phase = phase;
      if (auto* c = std::get_if<SetWishes>(&command)) c->phase = phase;
      driver.editor.handle(command);
      ASSERT_TRUE(driver.document() == chosen) << "command " << i;
    }
  }
  EXPECT_TRUE(std::isfinite(state().time));
  // An empty window, one the wrong way round, one outside the clip: put right.
  for (const Interval& window : {Interval{state().begin, state().begin}, Interval{5e8, -3},
                                 Interval{1e9, 2e9}, Interval{-1e300, -1e299}}) {
    driver.editor.handle(SetWindow{window});
    ASSERT_TRUE(driver.draft().window.has_value());
    EXPECT_GE(driver.draft().window->lower, state().begin);
    EXPECT_LE(driver.draft().window->upper, state().end);
    EXPECT_LT(driver.draft().window->lower, driver.draft().window->upper);
  }
  PlanningWishes wishes;
  wishes.seed = std::numeric_limits<std::uint64_t>::max();
  driver.editor.handle(SetWishes{wishes, "Seed"});
  EXPECT_EQ(driver.draft().wishes.at(driver.draft().limb).seed, wishes.seed);
  driver.ui.frame(3);  // and panels show it without changing it
  EXPECT_EQ(driver.draft().wishes.at(driver.draft().limb).seed, wishes.seed);
  driver.editor.update(kNone);
  driver.ui.frame();
}

TEST_F(EditorTest, APlanIsGivenUpWhenTheMotionUnderItChanges) {
  ASSERT_TRUE(open_stretch());
  ASSERT_TRUE(ready());
  const int limb = driver.colliding_limb();
  ASSERT_GE(limb, 0);
  const int other = limb == 0 ? 1 : 0;
  ASSERT_TRUE(correct(other, state().begin + 0.05, state().begin + 0.4));
  ASSERT_TRUE(ready());

  // A change that the plan rests on.
  driver.handle(SelectProblem{limb, 0});
  driver.handle(Plan{});
  ASSERT_TRUE(state().planning.active);
  driver.handle(MuteCorrection{0});
  EXPECT_FALSE(state().planning.active);
  ASSERT_TRUE(ready());
  EXPECT_FALSE(state().candidate.has_value());

  // Cancelled: at once on the screen, and the thread is free for the next within a moment.
  driver.handle(Plan{});
  ASSERT_TRUE(driver.wait_until([&] { return state().planning.fraction >= 0; }));
  driver.ui.key(keys::kEscape);
  EXPECT_FALSE(state().planning.active);
  const auto start = std::chrono::steady_clock::now();
  driver.handle(MuteCorrection{0});  // a look at 0.35 s of the clip, behind the plan
  ASSERT_TRUE(ready());
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(8));
  EXPECT_FALSE(state().candidate.has_value());
  EXPECT_FALSE(state().failure.has_value());

  // Another file while planning: nothing of the old plan arrives.
  driver.handle(Plan{});
  ASSERT_TRUE(state().planning.active);
  ASSERT_TRUE(open_alone());
  EXPECT_FALSE(state().planning.active);
  ASSERT_TRUE(ready());
  EXPECT_FALSE(state().candidate.has_value());
  EXPECT_TRUE(driver.document().corrections.empty());
  EXPECT_TRUE(state().undo_name.empty());
}

TEST_F(EditorTest, AnotherFileWhileScanningHasItsOwnStrip) {
  ASSERT_TRUE(open_stretch());
  ASSERT_TRUE(driver.wait_until([&] { return state().strip != nullptr; }));
  // A file of which nothing can be looked at: no clip.
  Document still = demo_stretch(folder.path(), 0, 0.25, Props::none);
  still.scene.clip.clear();
  const auto file = folder / "still.glb";
  {
    std::ifstream in(still.scene.character, std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(in)), {});
    const auto at = bytes.find("\"animations\":");
    ASSERT_NE(at, std::string::npos);
    bytes.replace(at, 12, "\"animationz\"");
    std::ofstream(file, std::ios::binary) << bytes;
  }
  still.scene.character = file;
  driver.editor.open(still);
  ASSERT_TRUE(driver.wait_until([&] { return !state().opening.active; }));
  ASSERT_EQ(state().source, nullptr);
  ASSERT_TRUE(driver.settle());
  driver.ui.frame(5);
  EXPECT_EQ(state().strip, nullptr);
  EXPECT_EQ(state().source_strip, nullptr);
  EXPECT_TRUE(told("no animation"));
  // Neither planning nor export has anything to do, and says so or does nothing.
  driver.handle(Plan{});
  driver.handle(SelectLimb{0});
  driver.handle(SetWindow{Interval{0, 1}});
  driver.handle(TogglePlay{});
  driver.ui.key('P');
  EXPECT_FALSE(state().planning.active);
  EXPECT_FALSE(driver.draft().window.has_value());
}

TEST_F(EditorTest, SceneChangesAreStepsOfUndo) {
  ASSERT_TRUE(driver.open(demo_stretch(folder.path(), 0, 0.25, Props::all)));
  const SceneDescription first = driver.document().scene;
  const std::string joint = first.attachments.front().joint;
  const auto umbrella = first.attachments.front().file;
  const auto posts = first.obstacles.front();
  const auto wait = [&] { return driver.wait_until([&] { return !state().opening.active; }); };
  const auto actors = [&] { return state().session->scene.world.actors.size(); };
  const std::size_t all = actors();

  driver.handle(AttachObject{umbrella, ""});  // put down
  ASSERT_TRUE(wait());
  EXPECT_EQ(driver.document().scene.obstacles.size(), 2u);
  EXPECT_TRUE(driver.document().scene.attachments.empty());
  EXPECT_TRUE(state().dirty);
  driver.handle(RemoveObject{posts});
  ASSERT_TRUE(wait());
  EXPECT_EQ(driver.document().scene.obstacles.size(), 1u);
  EXPECT_LT(actors(), all);
  driver.handle(ChooseClip{"Idle"});
  ASSERT_TRUE(wait());
  EXPECT_EQ(state().source->name, "Idle");
  const SceneDescription last = driver.document().scene;

  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(state().undo_name.empty()) << i;
    driver.handle(Undo{});
    ASSERT_TRUE(wait());
    EXPECT_EQ(state().session->document.scene, driver.document().scene);
  }
  EXPECT_TRUE(state().undo_name.empty());
  EXPECT_EQ(driver.document().scene, first);
  EXPECT_EQ(actors(), all);
  EXPECT_FALSE(state().dirty);
  for (int i = 0; i < 3; ++i) {
    driver.handle(Redo{});
    ASSERT_TRUE(wait());
  }
  EXPECT_EQ(driver.document().scene, last);
  EXPECT_TRUE(state().redo_name.empty());
  EXPECT_EQ(state().source->name, "Idle");

  // Back and forth faster than files are read: no step is made of it, none is lost.
  driver.editor.handle(Undo{});
  driver.editor.handle(Redo{});
  ASSERT_TRUE(wait());
  driver.ui.frame(3);
  EXPECT_EQ(driver.document().scene, last);
  EXPECT_EQ(state().session->document.scene, last);
  for (int i = 0; i < 3; ++i) driver.editor.handle(Undo{});
  ASSERT_TRUE(wait());
  EXPECT_EQ(driver.document().scene, first);
  EXPECT_EQ(state().session->document.scene, first);

  // What can't be done says so and leaves all as it was.
  driver.handle(AttachObject{umbrella, "no such joint"});
  ASSERT_TRUE(wait());
  EXPECT_EQ(driver.document().scene, first);
  driver.handle(ChooseClip{"no such clip"});
  ASSERT_TRUE(wait());
  EXPECT_EQ(driver.document().scene, first);
  driver.handle(OpenFiles{{folder / "missing.glb"}});
  ASSERT_TRUE(wait());
  EXPECT_EQ(driver.document().scene, first);
  EXPECT_FALSE(state().notices.empty());
  EXPECT_EQ(state().notices.back().kind, Notice::Kind::error);
}

// What is not saved is asked about before something else takes its place.
TEST_F(EditorTest, OpeningAsksAboutUnsavedWork) {
  ASSERT_TRUE(open_alone());
  ASSERT_TRUE(ready());
  driver.handle(SelectLimb{0});
  driver.handle(SetWindow{Interval{state().begin + 0.1, state().begin + 0.3}, Phase::committed});
  ASSERT_TRUE(state().dirty);
  const Document before = driver.document();
  driver.editor.open(demo_scene());
  EXPECT_EQ(driver.editor.view().dialog, Dialog::discard_for_opening);
  driver.editor.view().dialog = Dialog::none;
  driver.handle(AnswerOpening{false});
  EXPECT_FALSE(state().opening.active);
  EXPECT_EQ(driver.document(), before);
  driver.editor.open(demo_scene());
  driver.editor.view().dialog = Dialog::none;
  driver.handle(AnswerOpening{true});
  ASSERT_TRUE(driver.wait_until([&] { return !state().opening.active; }));
  EXPECT_FALSE(state().dirty);
  EXPECT_FALSE(driver.document().draft.window.has_value());
}

TEST_F(EditorTest, CorrectionsThatNoLongerFitAreFlaggedAndStopAnExport) {
  ASSERT_TRUE(open_alone());
  ASSERT_TRUE(ready());
  const double begin = state().begin, length = state().end - begin;
  ASSERT_TRUE(correct(0, begin + 0.1 * length, begin + 0.7 * length));
  const Correction made = driver.document().corrections.front();
  // A second one, made for a figure with other joints.
  Document document = driver.document();
  document.corrections.push_back(made);
  document.corrections.back().name = "stranger";
  for (JointKeys& joint : document.corrections.back().joints) joint.node = 1 << 20;
  ASSERT_TRUE(driver.open(document));
  ASSERT_EQ(state().corrections.size(), 2u);
  EXPECT_TRUE(state().corrections[0].fits);
  EXPECT_FALSE(state().corrections[1].fits);
  EXPECT_FALSE(state().corrections[1].problem.empty());
  EXPECT_NE(state().clip, state().source) << "the one that fits is still shown";
  const auto file = folder / "out.glb";
  driver.handle(Export{file});
  EXPECT_TRUE(told("no longer fits"));
  EXPECT_FALSE(state().exporting.active);
  driver.ui.frame(3);
  EXPECT_FALSE(std::filesystem::exists(file));
  // Muted it stands in nobody's way.
  driver.handle(MuteCorrection{1});
  EXPECT_TRUE(state().corrections[1].fits);
  driver.handle(Export{file});
  ASSERT_TRUE(driver.wait_until([&] { return !state().exporting.active; }));
  EXPECT_TRUE(std::filesystem::exists(file));

  // Saved and opened again: the same document, clean, under the project's name.
  driver.handle(RenameCorrection{0, "the good one"});
  driver.handle(SelectLimb{0});
  driver.handle(TargetFromPosture{});
  driver.handle(ChoosePreset{SamplingPreset::low});
  EXPECT_TRUE(state().dirty);
  const Document saved = driver.document();
  driver.handle(SaveProject{folder / "take.elbow"});
  EXPECT_FALSE(state().dirty);
  EXPECT_TRUE(state().has_project);
  EXPECT_EQ(state().name, "take.elbow");
  driver.handle(SetWindow{std::nullopt});
  EditorDriver again;
  again.handle(OpenFiles{{folder / "take.elbow"}});
  ASSERT_TRUE(again.wait_until([&] { return !again.state().opening.active; }));
  ASSERT_TRUE(again.state().open());
  EXPECT_FALSE(again.state().dirty);
  EXPECT_EQ(again.state().name, "take.elbow");
  EXPECT_TRUE(again.state().undo_name.empty());
  EXPECT_EQ(again.document().corrections, saved.corrections);
  EXPECT_EQ(again.document().tasks, saved.tasks);
  EXPECT_EQ(again.document().draft, saved.draft);
  EXPECT_TRUE(again.document() == saved);
  ASSERT_FALSE(again.state().recent_files.empty());
  EXPECT_EQ(std::filesystem::path(again.state().recent_files.front()).filename(), "take.elbow");
  // Where it can't be saved the document stays unsaved, and that is said.
  again.handle(MuteCorrection{0});
  again.handle(SaveProject{folder / "no folder" / "x.elbow"});
  EXPECT_TRUE(again.state().dirty);
  EXPECT_EQ(again.state().notices.back().kind, Notice::Kind::error);
}

// Those of another clip wait for it: they neither apply here nor stop an export.
TEST_F(EditorTest, CorrectionsBelongToTheirClip) {
  ASSERT_TRUE(open_alone());
  ASSERT_TRUE(ready());
  const auto& clips = state().session->scene.model().clips;
  ASSERT_GE(clips.size(), 2u);
  const int first = state().session->scene.clip;
  const int second = first == 0 ? 1 : 0;
  const double begin = state().begin, length = state().end - begin;
  ASSERT_TRUE(correct(0, begin + 0.1 * length, begin + 0.7 * length));
  const Correction made = driver.document().corrections.front();
  EXPECT_EQ(made.clip, clips[static_cast<std::size_t>(first)].name);
  EXPECT_EQ(driver.document().tasks.front().clip, made.clip);
  driver.handle(SetWindow{Interval{begin, begin + 0.5 * length}, Phase::committed, 0});
  const auto choose = [&](int clip) {
    driver.handle(ChooseClip{std::to_string(clip)});
    ASSERT_TRUE(driver.wait_until([&] { return !state().opening.active; }));
    ASSERT_EQ(state().session->scene.clip, clip);
    ASSERT_TRUE(ready());
  };
  const auto exported = [&](const std::string& name) {
    driver.handle(Export{folder / name});
    EXPECT_TRUE(driver.wait_until([&] { return !state().exporting.active; }));
    return std::filesystem::exists(folder / name);
  };
  ASSERT_TRUE(exported("first.glb"));

  choose(second);
  EXPECT_EQ(driver.document().corrections, std::vector{made}) << "kept";
  ASSERT_EQ(state().corrections.size(), 1u);
  EXPECT_FALSE(state().corrections[0].of_this_clip);
  EXPECT_TRUE(state().corrections[0].fits);
  EXPECT_EQ(state().clip, state().source);
  EXPECT_EQ(state().selected_correction, -1);
  EXPECT_FALSE(driver.draft().window.has_value()) << "its times were the other clip's";
  driver.ui.frame(2);
  EXPECT_FALSE(driver.ui.has("Outliner/" + made.name));
  EXPECT_FALSE(driver.ui.has("Clip time.mark.0"));
  EXPECT_NE(driver.ui.dump().find("kept for another clip"), std::string::npos);
  EXPECT_TRUE(exported("second.glb"));
  EXPECT_TRUE(told("nothing corrected"));
  driver.handle(ReplanCorrection{0});
  EXPECT_FALSE(state().planning.active) << "there is nothing to replan here";

  // One of its own, beside it, and all of it by way of a project.
  ASSERT_TRUE(correct(0, state().begin + 0.1 * length, state().begin + 0.7 * length));
  ASSERT_EQ(driver.document().corrections.size(), 2u);
  EXPECT_TRUE(state().corrections[1].of_this_clip);
  EXPECT_NE(state().clip, state().source);
  EXPECT_TRUE(exported("second_corrected.glb"));
  driver.handle(SaveProject{folder / "two.elbow"});
  const Document saved = driver.document();
  driver.handle(OpenFiles{{folder / "two.elbow"}});
  ASSERT_TRUE(driver.wait_until([&] { return state().name == "two.elbow" && !state().dirty; }));
  ASSERT_TRUE(driver.wait_until([&] { return !state().opening.active; }));
  EXPECT_EQ(driver.document().corrections, saved.corrections);
  ASSERT_EQ(state().corrections.size(), 2u);
  EXPECT_FALSE(state().corrections[0].of_this_clip);

  // Back again: what was made for the first clip lies over it, as before.
  choose(first);
  EXPECT_TRUE(state().corrections[0].of_this_clip);
  EXPECT_FALSE(state().corrections[1].of_this_clip);
  EXPECT_NE(state().clip, state().source);
  ASSERT_TRUE(exported("first_again.glb"));
  const auto bytes = [&](const std::string& name) {
    std::ifstream in(folder / name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  EXPECT_EQ(bytes("first.glb"), bytes("first_again.glb"));
  EXPECT_NE(bytes("first.glb"), bytes("second_corrected.glb"));
  // A choice of clip is a step like any other.
  driver.handle(Undo{});
  ASSERT_TRUE(driver.wait_until([&] { return state().session->scene.clip == second; }));
  EXPECT_FALSE(state().corrections[0].of_this_clip);
  EXPECT_TRUE(state().corrections[1].of_this_clip);
}

TEST_F(EditorTest, TimeStaysInTheClip) {
  ASSERT_TRUE(open_alone());
  driver.handle(Scrub{1e9});
  EXPECT_EQ(state().time, state().end);
  driver.handle(StepFrames{1});
  EXPECT_EQ(state().time, state().end);
  driver.handle(GoToEnd{false});
  EXPECT_EQ(state().time, state().begin);
  driver.handle(StepFrames{2});
  EXPECT_NEAR(state().time, state().begin + 2 / state().frame_rate, 1e-9);
  driver.handle(StepFrames{std::numeric_limits<int>::max()});
  EXPECT_EQ(state().time, state().end);
  // Played from the end it begins anew, loops, and without a loop stops at the end.
  driver.handle(TogglePlay{});
  EXPECT_TRUE(state().playing);
  driver.ui.frame(60);
  EXPECT_TRUE(state().playing);
  EXPECT_GE(state().time, state().begin);
  EXPECT_LE(state().time, state().end);
  driver.handle(ToggleLoop{});
  driver.ui.frame(60);
  EXPECT_FALSE(state().playing);
  EXPECT_EQ(state().time, state().end);
}

// Each of two changes within one look at the scene is seen.
TEST_F(EditorTest, TheStripSeesEveryChange) {
  ASSERT_TRUE(open_stretch());
  ASSERT_TRUE(ready());
  const int limb = driver.colliding_limb();
  const int other = limb == 0 ? 1 : 0;
  ASSERT_TRUE(driver.plan(limb));
  driver.handle(Accept{});
  ASSERT_TRUE(correct(other, state().begin + 0.02, state().begin + 0.3));
  ASSERT_TRUE(ready());
  EXPECT_TRUE(state().strip->limbs[static_cast<std::size_t>(limb)].windows.empty());
  driver.editor.handle(MuteCorrection{0});
  driver.editor.handle(MuteCorrection{1});
  driver.editor.handle(MuteCorrection{1});
  ASSERT_TRUE(ready());
  EXPECT_FALSE(state().strip->limbs[static_cast<std::size_t>(limb)].windows.empty());
}

TEST(EditorDestruction, WhileOpeningAndScanning) {
  ScratchFolder folder;
  const Document document = demo_stretch(folder.path(), 0, 0.25, Props::all);
  for (int frames : {0, 1, 5, 20}) {
    EditorDriver driver;
    driver.editor.open(document);
    driver.ui.frame(frames);
  }
}

}  // namespace
}  // namespace elbowroom
