// SPDX-License-Identifier: MIT
// Each panel: what it shows of the editor's state, and what mouse and keys on it do to the
// document, one step of undo for one drag.
#include <gtest/gtest.h>

#include "app/editor/key_names.h"
#include "core/editing/sampling_presets.h"
#include "core/io/project_file.h"
#include "tests/gui/panels/demo_stretch.h"
#include "tests/gui/panels/editor_driver.h"
#include "ui/toolkit/fields.h"

namespace elbowroom {
namespace {

using namespace command;

// One driver with the demo between the posts for all tests of a run; each begins with the document
// as it was opened.
class Panels : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new ScratchFolder;
    driver_ = new EditorDriver;
    ASSERT_TRUE(
        driver_->open(demo_stretch(folder_->path(), kStretchBegin, kStretchEnd, Props::all)));
    ASSERT_TRUE(driver_->wait_until(
        [] { return driver_->state().strip && driver_->state().strip->complete(); }));
    ASSERT_TRUE(driver_->settle());
  }
  static void TearDownTestSuite() {
    delete driver_;
    delete folder_;
  }
  void SetUp() override {
    ASSERT_TRUE(driver_ && driver_->colliding_limb() >= 0);
    for (int i = 0; i < 500 && !state().undo_name.empty(); ++i) driver_->editor.handle(Undo{});
    driver_->editor.handle(Discard{});
    driver_->editor.handle(Scrub{state().begin});
    driver_->view().tab = InspectorTab::limb;
    driver_->view().dialog = Dialog::none;
    driver_->view().timeline = {};
    driver_->view().placing_target = false;
    driver_->ui.move_to(ImVec2{-1000, -1000});
    driver_->ui.frame(3);
    arm = driver_->colliding_limb();
    other = arm == 0 ? 1 : 0;
  }
  EditorDriver& driver() { return *driver_; }
  UiDriver& ui() { return driver_->ui; }
  const EditorState& state() const { return driver_->state(); }
  const Draft& draft() const { return driver_->draft(); }
  std::string title(int limb) const {
    return limb_title(state().session->limbs[static_cast<std::size_t>(limb)].limb.name);
  }
  PlanningWishes wishes() const {
    const auto found = draft().wishes.find(draft().limb);
    return found == draft().wishes.end() ? PlanningWishes{} : found->second;
  }
  // Exactly one step: one undo gives the document before.
  template <typename Act>
  void expect_one_step(Act act, const char* what) {
    const Document before = driver_->document();
    act();
    EXPECT_FALSE(driver_->document() == before) << what << " changes something";
    driver_->handle(Undo{});
    EXPECT_TRUE(driver_->document() == before) << what << " is one step";
    driver_->handle(Redo{});
  }
  template <typename Act>
  void expect_no_step(Act act, const char* what) {
    const Document before = driver_->document();
    const std::string undo = state().undo_name;
    act();
    EXPECT_TRUE(driver_->document() == before) << what;
    EXPECT_EQ(state().undo_name, undo) << what;
  }
  // A drag that Escape ends while the button is down.
  void drag_and_escape(const std::string& name, ImVec2 by) {
    const ImVec2 from = ui().centre(name);
    ui().wait(1);
    ui().move_to(from);
    ui().press();
    for (int i = 1; i <= 4; ++i) {
      const float t = static_cast<float>(i) / 4;
      ImGui::GetIO().MousePos = {from.x + t * by.x, from.y + t * by.y};
      ui().frame();
    }
    ui().key(keys::kEscape);
    ui().release();
  }

  static inline ScratchFolder* folder_ = nullptr;
  static inline EditorDriver* driver_ = nullptr;
  int arm = -1, other = -1;
};

TEST_F(Panels, OutlinerListsLimbsWithTheirProblems) {
  for (std::size_t i = 0; i < state().session->limbs.size(); ++i) {
    const auto problems = state().strip->limbs[i].windows.size();
    EXPECT_EQ(ui().value("Outliner/" + title(static_cast<int>(i))),
              problems == 0
                  ? "clear"
                  : std::to_string(problems) + (problems == 1 ? " problem" : " problems"));
  }
  ui().click("Outliner/" + title(other));
  EXPECT_EQ(state().limb, other);
  EXPECT_FALSE(draft().window.has_value());
  EXPECT_TRUE(ui().widget("Outliner/" + title(other))->selected);
  ui().double_click("Outliner/" + title(arm));
  EXPECT_EQ(state().limb, arm);
  EXPECT_TRUE(draft().window.has_value());
  // A double-click on a limb without problems chooses the limb.
  ui().double_click("Outliner/" + title(other));
  EXPECT_EQ(state().limb, other);
}

TEST_F(Panels, OutlinerHoldsObjectsInHands) {
  const auto held = state().document->scene.attachments.front();
  const std::string name = held.file.stem().string();
  ui().click("Outliner/" + name, 1);
  ui().frame(2);
  EXPECT_TRUE(ui().has("Put down"));
  EXPECT_TRUE(ui().has("Hold in the left hand"));
  driver().said.clear();
  driver().carry_out = false;
  ui().click("Hold in the left hand");
  driver().carry_out = true;
  ASSERT_EQ(driver().said.size(), 1u);
  const auto* attach = std::get_if<AttachObject>(&driver().said.front());
  ASSERT_NE(attach, nullptr);
  EXPECT_EQ(attach->file, held.file);
  EXPECT_NE(attach->joint, held.joint);
  // An obstacle can be taken, not put down.
  ui().click("Outliner/" + state().document->scene.obstacles.front().stem().string(), 1);
  ui().frame(2);
  EXPECT_FALSE(ui().has("Put down"));
  EXPECT_TRUE(ui().has("Remove from the scene"));
  ui().key(keys::kEscape);
  ui().click(ImVec2{800, 300});
}

TEST_F(Panels, LimbTabRangesArePresetsOrOwn) {
  driver().handle(SelectLimb{arm});
  ASSERT_FALSE(state().dofs.empty());
  const DofView dof = state().dofs[1];
  const LimbModel& limb = *state().limb_model();
  EXPECT_EQ(ui().value("Preset"), preset_title(SamplingPreset::paper, limb.limb));
  const auto sampling = [&] { return wishes().sampling; };
  EXPECT_TRUE(sampling().empty());

  expect_one_step([&] { ui().drag(dof.name + ".low", {25, 0}); }, "a range's drag");
  ASSERT_TRUE(sampling().contains(dof.name));
  EXPECT_GT(sampling().at(dof.name).lower, dof.default_lower);
  EXPECT_NEAR(sampling().at(dof.name).upper, dof.default_upper, 1e-9);
  EXPECT_EQ(ui().value("Preset"), "Own");
  EXPECT_TRUE(state().dofs[1].custom);
  expect_no_step([&] { drag_and_escape(dof.name + ".high", {-20, 0}); }, "Esc puts it back");
  expect_no_step(
      [&] {
        const ImVec2 at = ui().centre(dof.name + ".high");
        ui().wait(1);
        ui().move_to(at);
        ui().press();
        for (const float x : {-5.0f, -15.0f, 0.0f}) {
          ImGui::GetIO().MousePos = {at.x + x, at.y};
          ui().frame();
        }
        ui().release();
      },
      "a drag that comes back");
  // Arrows belong to the slider that was clicked last, not to the clip.
  const double time = state().time;
  expect_one_step([&] { ui().key(keys::kLeft); }, "an arrow key");
  EXPECT_EQ(state().time, time);
  // A double-click gives the limb's own interval back, and the preset with it.
  ui().double_click(dof.name + ".bar");
  EXPECT_FALSE(sampling().contains(dof.name));
  EXPECT_EQ(ui().value("Preset"), preset_title(SamplingPreset::paper, limb.limb));
  // Presets by the list.
  for (const SamplingPreset preset : {SamplingPreset::low, SamplingPreset::high,
                                      SamplingPreset::close_to_body, SamplingPreset::paper}) {
    ui().click("Preset");
    ui().frame(2);
    expect_one_step([&] { ui().click("Preset/" + preset_title(preset, limb.limb)); }, "a preset");
    EXPECT_EQ(sampling(), preset_intervals(limb, preset));
    EXPECT_EQ(ui().value("Preset"), preset_title(preset, limb.limb));
  }
}

TEST_F(Panels, PlannerTabNumbersAreOneStepEach) {
  driver().handle(SelectProblem{arm, 0});
  driver().view().tab = InspectorTab::planner;
  ui().frame(3);
  const PlanningWishes before = wishes();
  expect_one_step([&] { ui().drag("Inspector/Seed", {9, 0}); }, "Seed");
  EXPECT_GT(wishes().seed, before.seed);
  expect_one_step([&] { ui().drag("Clearance", {30, 0}); }, "Clearance");
  EXPECT_GT(wishes().clearance, 0);
  expect_one_step([&] { ui().drag("Iterations", {-20, 0}); }, "Iterations");
  EXPECT_LT(wishes().max_iterations, before.max_iterations);
  expect_one_step([&] { ui().drag("Ways around", {40, 0}); }, "Ways around");
  EXPECT_GT(wishes().alternatives, before.alternatives);
  const Interval window = *draft().window;
  expect_one_step([&] { ui().drag("From", {20, 0}); }, "From");
  EXPECT_GT(draft().window->lower, window.lower);
  expect_one_step([&] { ui().drag("To", {-20, 0}); }, "To");
  EXPECT_LT(draft().window->upper, window.upper);
  for (const char* name :
       {"Inspector/Seed", "Clearance", "Iterations", "Ways around", "From", "To"}) {
    expect_no_step([&] { drag_and_escape(name, {15, 0}); }, name);
    expect_no_step(
        [&] {
          const ImVec2 at = ui().centre(name);
          ui().wait(1);
          ui().move_to(at);
          ui().press();
          for (const float x : {6.0f, 12.0f, 6.0f, 0.0f}) {
            ImGui::GetIO().MousePos = {at.x + x, at.y};
            ui().frame();
          }
          ui().release();
        },
        name);
  }
  // Slowly, a pixel a frame, a coarse number still follows.
  const int ways = wishes().alternatives;
  expect_one_step(
      [&] {
        const ImVec2 at = ui().centre("Ways around");
        ui().drag(at, {at.x - 30, at.y}, 30);
      },
      "Ways around, slowly");
  EXPECT_LT(wishes().alternatives, ways);
  // Typed.
  ui().double_click("Inspector/Seed");
  ui().key('A', {.control = true});
  ui().type("4711");
  ui().key(keys::kEnter);
  EXPECT_EQ(wishes().seed, 4711u);
  // What is typed is no shortcut.
  EXPECT_FALSE(state().planning.active);
}

TEST_F(Panels, TargetTab) {
  driver().handle(SelectLimb{arm});
  ui().click("Tabs/Target");
  EXPECT_EQ(driver().view().tab, InspectorTab::target);
  ui().click("Place on a surface");
  EXPECT_TRUE(driver().view().placing_target);
  ui().key(keys::kEscape);
  EXPECT_FALSE(driver().view().placing_target);
  expect_one_step([&] { ui().click("Target here"); }, "Target here");
  ASSERT_TRUE(draft().target.has_value());
  EXPECT_EQ(draft().target->time, state().time);
  EXPECT_TRUE(draft().target->orientation.has_value());
  EXPECT_NE(state().target.status, TargetView::Status::none);
  const HandTarget before = *draft().target;
  const char* names[] = {"X", "Y", "Z"};
  for (int i = 0; i < 3; ++i) {
    expect_one_step([&] { ui().drag(std::string("Inspector/") + names[i], {10, 0}); }, names[i]);
    EXPECT_GT(draft().target->position[i], before.position[i]) << names[i];
    expect_no_step(
        [&] {
          drag_and_escape(std::string("Inspector/") + names[i], {15, 0});
        },
        names[i]);
  }
  expect_one_step([&] { ui().drag("Turn X", {50, 0}); }, "Turn X");
  EXPECT_NE(draft().target->orientation, before.orientation);
  EXPECT_NEAR(glm::length(*draft().target->orientation), 1, 1e-9);
  expect_one_step([&] { ui().click("Keep the hand's orientation"); }, "free");
  EXPECT_FALSE(draft().target->orientation.has_value());
  EXPECT_FALSE(ui().has("Turn X"));
  // Its time.
  driver().handle(Scrub{0.5 * (state().begin + state().end)});
  ui().frame(2);
  expect_one_step([&] { ui().click("Set to now"); }, "Set to now");
  EXPECT_EQ(draft().target->time, state().time);
  EXPECT_FALSE(ui().widget("Go there")->enabled);
  driver().handle(Scrub{state().begin});
  ui().frame(2);
  ui().click("Go there");
  EXPECT_EQ(state().time, draft().target->time);
  expect_one_step([&] { ui().drag("At", {15, 0}); }, "At");
  EXPECT_GT(draft().target->time, state().time);
  ui().click("Gizmo/Turn  R");
  EXPECT_EQ(driver().view().gizmo_mode, GizmoMode::rotate);
  ui().click("Own axes");
  EXPECT_EQ(driver().view().gizmo_space, GizmoSpace::local);
  driver().view().gizmo_space = GizmoSpace::world;
  driver().view().gizmo_mode = GizmoMode::translate;
  // Dragged along the timeline.
  expect_one_step([&] { ui().drag("Clip time.mark.0", {-60, 0}); }, "the target's mark");
  expect_no_step([&] { drag_and_escape("Clip time.mark.0", {50, 0}); }, "Esc on the mark");
  driver().handle(Scrub{state().begin});
  ui().click("Clip time.mark.0");
  EXPECT_EQ(state().time, draft().target->time);
  expect_one_step([&] { ui().click("Remove target"); }, "Remove target");
  EXPECT_FALSE(draft().target.has_value());
  EXPECT_EQ(state().target.status, TargetView::Status::none);
  ASSERT_TRUE(driver().settle());
  EXPECT_EQ(state().target.status, TargetView::Status::none);
}

// Typed or dragged, beyond ±90° too: the other fields stay, and so does the one that is edited.
TEST_F(Panels, TurnFieldsNeverMoveEachOther) {
  driver().handle(SelectLimb{arm});
  ui().click("Tabs/Target");
  ui().click("Target here");
  ui().frame(2);
  const std::vector<std::string> names = {"Turn X", "Turn Y", "Turn Z"};
  const auto shown = [&] {
    std::vector<std::string> values;
    for (const auto& name : names) values.push_back(ui().value(name));
    return values;
  };
  const auto expect_others_stay = [&](std::size_t edited, const std::vector<std::string>& before) {
    const auto after = shown();
    for (std::size_t i = 0; i < names.size(); ++i)
      if (i != edited) {
        EXPECT_EQ(after[i], before[i]) << names[i] << " moved with " << names[edited];
      }
  };
  for (const char* typed : {"150", "-120", "90", "271", "-400", "12.5"})
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto before = shown();
      ui().double_click(names[i]);
      ui().frame(2);
      ui().type(typed);
      ui().key(keys::kEnter);
      ui().frame(2);
      EXPECT_EQ(*typed_number(ui().value(names[i])), *typed_number(typed)) << names[i];
      expect_others_stay(i, before);
    }
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto before = shown();
    const double from = *typed_number(before[i]);
    ui().hold({.control = true});  // faster: a degree a pixel
    expect_one_step([&] { ui().drag(names[i], {170, 0}, 40); }, names[i].c_str());
    ui().hold({});
    ui().frame(2);
    EXPECT_GT(*typed_number(ui().value(names[i])), from + 90);
    expect_others_stay(i, before);
    ui().wait(1);
    expect_no_step([&] { drag_and_escape(names[i], {60, 0}); }, "Esc");
    ui().frame(2);
    expect_others_stay(i, before);
  }
  // Off and on again: the hand's own orientation, as when the target was made.
  const Quat made = *[&] {
    driver().handle(TargetFromPosture{});
    return draft().target->orientation;
  }();
  ui().frame(2);
  ui().click("Keep the hand's orientation");
  EXPECT_FALSE(draft().target->orientation.has_value());
  ui().frame(2);
  expect_one_step([&] { ui().click("Keep the hand's orientation"); }, "keep");
  ASSERT_TRUE(draft().target->orientation.has_value());
  EXPECT_NEAR(std::abs(glm::dot(*draft().target->orientation, made)), 1, 1e-12);
}

// The hand target by its gizmo in the picture: the drag is one step, Esc takes it back.
TEST_F(Panels, GizmoDrag) {
  driver().handle(SelectLimb{arm});
  driver().handle(TargetFromPosture{});
  driver().handle(Undo{});
  driver().handle(Redo{});
  ui().frame(3);
  ASSERT_TRUE(ui().has("Hand target"));
  expect_one_step([&] { ui().drag("Hand target", {40, -25}); }, "the gizmo's drag");
  expect_no_step([&] { drag_and_escape("Hand target", {30, 30}); }, "Esc on the gizmo");
  EXPECT_FALSE(driver().panels.dragging());
  ASSERT_TRUE(driver().settle());
}

TEST_F(Panels, PlanSectionInAllStates) {
  driver().handle(SelectLimb{arm});
  ui().frame(2);
  EXPECT_EQ(ui().widget("Plan/Plan")->label, "Plan first problem");
  driver().handle(SelectProblem{arm, 0});
  ui().frame(2);
  EXPECT_NE(ui().widget("Plan/Plan")->label.find("–"), std::string::npos) << "names the window";
  driver().handle(TargetFromPosture{});
  ui().frame(2);
  EXPECT_NE(ui().widget("Plan/Plan")->label.find("reach"), std::string::npos);
  driver().handle(Undo{});
  // Planning: no button, progress, cancel.
  ui().click("Plan/Plan");
  ASSERT_TRUE(state().planning.active);
  ui().frame(2);
  EXPECT_FALSE(ui().has("Plan/Plan"));
  EXPECT_NE(ui().value("News"), "");
  ui().click("Cancel");
  EXPECT_FALSE(state().planning.active);
  ui().frame(2);
  EXPECT_TRUE(ui().has("Plan/Plan"));
  // A failure says why, what was in the way and what to try.
  {
    EditorState failed = state();
    failed.failure = PlanFailure{draft().limb, "the way is blocked", "hand with post", 1, 2};
    ViewState view = driver().view();
    EditorUi panels;
    Commands commands;
    UiDriver window(1600, 1000);
    window.show([&](Ui& toolkit) { panels.draw(toolkit, failed, view, commands); });
    EXPECT_NE(window.value("News").find("no motion found"), std::string::npos);
    const ProbedWidget* note = window.widget("No motion found: the way is blocked");
    ASSERT_NE(note, nullptr);
    EXPECT_NE(note->value.find("hand with post"), std::string::npos);
    EXPECT_FALSE(window.has("Accept"));
    EXPECT_TRUE(window.has("Plan/Plan"));
  }
  ui().frame();  // back in the first context
  // A candidate: a card with numbers; Del forgets it, Enter takes it.
  ASSERT_TRUE(driver().plan(arm));
  ui().frame(2);
  EXPECT_TRUE(ui().has("Accept"));
  EXPECT_TRUE(ui().has("Discard"));
  EXPECT_TRUE(ui().has(state().candidate->task.name));
  EXPECT_NE(ui().value("News").find("planned and verified"), std::string::npos);
  const Candidate candidate = *state().candidate;
  expect_one_step([&] { ui().key(keys::kEnter); }, "Accept");
  ASSERT_EQ(state().document->corrections.size(), 1u);
  EXPECT_FALSE(ui().has("Accept"));

  // The stack of corrections in the outliner.
  const std::string name = state().document->corrections.front().name;
  ui().frame(2);
  const std::string row = "Outliner/" + name;
  ui().click(row);
  EXPECT_EQ(state().selected_correction, 0);
  ui().frame(2);
  expect_one_step([&] { ui().click(name + ".Mute"); }, "Mute");
  EXPECT_TRUE(state().document->corrections.front().muted);
  EXPECT_EQ(state().clip, state().source);
  ui().click(name + ".Mute");
  EXPECT_FALSE(state().document->corrections.front().muted);
  ui().click(ui().centre(row), 1);
  ui().frame(2);
  ui().click("Go to its beginning");
  EXPECT_NEAR(state().time, static_cast<double>(candidate.correction.begin), 1e-6);
  ui().frame(2);
  ui().click(name + ".Replan");
  EXPECT_TRUE(state().document->corrections.empty());
  EXPECT_TRUE(state().planning.active);
  EXPECT_NEAR(draft().window->lower, static_cast<double>(candidate.correction.begin), 1e-6);
  ui().key(keys::kEscape);
  EXPECT_FALSE(state().planning.active);
  driver().handle(Undo{});
  ASSERT_EQ(state().document->corrections.size(), 1u);
  ui().frame(2);
  expect_one_step([&] { ui().click(name + ".Delete"); }, "Delete");
  EXPECT_TRUE(state().document->corrections.empty());
  EXPECT_TRUE(state().document->tasks.empty());
  ASSERT_TRUE(driver().settle());
}

TEST_F(Panels, CorrectionsAreRenamedInTheirRow) {
  ASSERT_TRUE(driver().plan(arm));
  driver().handle(Accept{});
  ui().frame(2);
  const auto name = [&] { return state().document->corrections.front().name; };
  const std::string first = name();
  const auto type = [&](const std::string& text) {
    ui().frame(3);
    ASSERT_TRUE(ui().has("Correction name"));
    ui().key('A', {.control = true});
    ui().type(text);
  };
  // By a double click; Enter keeps it, and is not taken for Accept.
  expect_one_step(
      [&] {
        ui().double_click("Outliner/" + first);
        type("Past the post");
        ui().key(keys::kEnter);
        ui().frame(2);
      },
      "rename");
  EXPECT_EQ(name(), "Past the post");
  ui().frame(2);
  EXPECT_FALSE(ui().has("Correction name"));
  EXPECT_TRUE(ui().has("Outliner/Past the post"));
  EXPECT_EQ(ui().value("Clip time.mark.0"), "Past the post") << "the timeline says so too";
  // By F2; Esc gives it up.
  ui().click("Outliner/Past the post");
  ui().wait(1);
  expect_no_step(
      [&] {
        ui().key(291);  // F2
        type("no");
        ui().key(keys::kEscape);
        ui().frame(2);
      },
      "Esc");
  EXPECT_FALSE(ui().has("Correction name"));
  EXPECT_EQ(name(), "Past the post");
  EXPECT_EQ(driver().view().dialog, Dialog::none);
  // Nothing is no name; the same one is no step; a click elsewhere keeps what is typed.
  expect_no_step(
      [&] {
        ui().key(291);
        ui().frame(3);
        ui().key('A', {.control = true});
        ui().key(keys::kBackspace);
        ui().key(keys::kEnter);
        ui().frame(2);
      },
      "no name");
  expect_no_step(
      [&] {
        ui().key(291);
        ui().frame(3);
        ui().key(keys::kEnter);
        ui().frame(2);
      },
      "the same name");
  EXPECT_FALSE(ui().has("Correction name"));
  expect_one_step(
      [&] {
        ui().key(291);
        type("Around it");
        ui().click("Outliner/Scene");
        ui().frame(2);
      },
      "a click elsewhere");
  EXPECT_EQ(name(), "Around it");
  // It is kept in the project, and when the correction is planned anew.
  const auto file = folder_->path() / "renamed.elbow";
  ASSERT_TRUE(write_project(file, *state().document).ok());
  const auto read = read_project(file);
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read->corrections.front().name, "Around it");
  driver().handle(ReplanCorrection{0});
  ASSERT_TRUE(driver().wait_until([&] { return !state().planning.active; }));
  ASSERT_TRUE(state().candidate.has_value());
  driver().handle(Accept{});
  EXPECT_EQ(name(), "Around it");
  // The next test finds the clip as it is in the file.
  while (!state().undo_name.empty()) driver().handle(Undo{});
  ASSERT_TRUE(driver().settle());
}

// A window that begins in contact can't be planned; what would do instead is one click away.
TEST_F(Panels, AFailureOffersWhatWorks) {
  const ProposedWindow& problem =
      state().strip->limbs[static_cast<std::size_t>(arm)].windows.front();
  const ContactInterval& contact = problem.contacts.front();
  const double third = (contact.end - contact.begin) / 3;
  driver().handle(
      SetWindow{Interval{contact.begin + third, contact.end - third}, Phase::committed, arm});
  driver().handle(Plan{});
  ASSERT_TRUE(driver().wait_until([&] { return !state().planning.active; }));
  ASSERT_TRUE(state().failure.has_value());
  ASSERT_FALSE(state().failure->suggestions.empty());
  const Suggestion suggestion = state().failure->suggestions.back();
  ASSERT_TRUE(suggestion.works);
  ASSERT_EQ(suggestion.kind, Suggestion::Kind::wider_window);
  ui().frame(2);
  expect_one_step([&] { ui().click("Use the wider window"); }, "the wider window");
  driver().handle(Plan{});
  EXPECT_EQ(*draft().window, suggestion.window);
  ASSERT_TRUE(driver().wait_until([&] { return !state().planning.active; }));
  EXPECT_TRUE(state().candidate.has_value()) << "what was tried works";
}

// Several ways: stepping through them changes what is shown and nothing else; what is accepted is
// the one shown, in one step.
TEST_F(Panels, WaysAreSteppedThrough) {
  ASSERT_TRUE(driver().plan(arm));
  ASSERT_TRUE(driver().settle());
  // How many a scene holds is not the question here.
  EditorState several = state();
  several.ways = {*state().candidate, *state().candidate, *state().candidate};
  several.ways[1].report.peak_speed += 1;
  several.ways[2].report.peak_speed += 2;
  ViewState view = driver().view();
  EditorUi panels;
  Commands commands;
  UiDriver window(1600, 1000);
  ImGui::GetIO().ConfigFlags &= ~ImGuiConfigFlags_NavEnableKeyboard;
  window.show([&](Ui& toolkit) {
    press_keys(toolkit, several, view, commands);
    panels.draw(toolkit, several, view, commands);
  });
  window.frame(3);
  const auto wanted = [&]() -> std::optional<int> {
    if (commands.size() != 1) return std::nullopt;
    const auto* way = std::get_if<ShowWay>(&commands.front());
    commands.clear();
    return way ? std::optional(way->index) : std::nullopt;
  };
  EXPECT_EQ(window.widget("Plan/Way")->label, "Way 1 of 3");
  window.click("Later way");
  EXPECT_EQ(wanted(), 1);
  window.click("Earlier way");
  EXPECT_EQ(wanted(), -1) << "before the first comes the last";
  window.key(keys::kPageDown);
  EXPECT_EQ(wanted(), 1);
  window.key(keys::kPageUp);
  EXPECT_EQ(wanted(), -1);
  ui().frame();
}

TEST_F(Panels, TimelineScrubsAndDrawsWindows) {
  const double middle = 0.5 * (state().begin + state().end);
  const float y = ui().centre("Clip time.ruler").y;
  driver().said.clear();
  ui().drag({driver().x_of(state().begin), y}, {driver().x_of(middle), y});
  EXPECT_NEAR(state().time, middle, 0.02);
  EXPECT_TRUE(state().undo_name.empty()) << "time is no step";

  // A window on an empty part of a row of another limb.
  const double a = state().begin + 0.1, b = state().begin + 0.6;
  ui().drag(driver().on_row(other, a), driver().on_row(other, b));
  EXPECT_EQ(state().limb, other);
  ASSERT_TRUE(draft().window.has_value());
  EXPECT_NEAR(draft().window->lower, a, 0.02);
  EXPECT_NEAR(draft().window->upper, b, 0.02);
  expect_one_step([&] { ui().drag("Clip time.window.low", {30, 0}); }, "the low handle");
  EXPECT_GT(draft().window->lower, a + 0.01);
  expect_one_step([&] { ui().drag("Clip time.window.high", {-30, 0}); }, "the high handle");
  const Interval window = *draft().window;
  expect_one_step([&] { ui().drag("Clip time.window.band", {40, 0}); }, "the band");
  EXPECT_NEAR(draft().window->upper - draft().window->lower, window.upper - window.lower, 1e-6);
  expect_no_step([&] { drag_and_escape("Clip time.window.high", {50, 0}); }, "Esc");
  // A click on a bump.
  ui().click(driver().row_name(arm) + ".bump.0");
  EXPECT_EQ(state().limb, arm);
  const auto& problem = state().strip->limbs[static_cast<std::size_t>(arm)].windows.front();
  EXPECT_EQ(draft().window, (Interval{problem.begin, problem.end}));
  // A click on an empty row.
  ui().click(driver().on_row(other, state().end - 0.02));
  EXPECT_EQ(state().limb, other);

  // The transport.
  ui().click("First frame");
  EXPECT_EQ(state().time, state().begin);
  ui().click("Next frame");
  EXPECT_NEAR(state().time, state().begin + 1 / state().frame_rate, 1e-6);
  ui().click("Previous frame");
  EXPECT_NEAR(state().time, state().begin, 1e-6);
  ui().click("Last frame");
  EXPECT_EQ(state().time, state().end);
  const bool loop = state().loop;
  ui().click("Timeline/Loop");
  EXPECT_NE(state().loop, loop);
  ui().click("Timeline/Loop");
  ui().click("Play");
  EXPECT_TRUE(state().playing);
  ui().click("Pause");
  EXPECT_FALSE(state().playing);
  ui().click("Speed");
  ui().frame(2);
  ui().click("Speed/2×");
  EXPECT_EQ(state().speed, 2);
  driver().handle(SetSpeed{1});
  ui().click("Next problem");
  EXPECT_EQ(state().limb, arm);
}

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
