// SPDX-License-Identifier: MIT
// The plan section: before, while and after something is planned, and where it fails.
#include <algorithm>

#include "app/editor/key_names.h"
#include "tests/gui/panels/panels_fixture.h"

namespace elbowroom {
namespace {

using namespace command;

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
    EXPECT_NE(note->value.find("Another seed"), std::string::npos);
    EXPECT_FALSE(window.has("Accept"));
    EXPECT_TRUE(window.has("Plan/Plan"));
    // Where nothing was searched another seed is no help, and is not offered.
    failed.failure->hopeless = failed.failure->reach = true;
    window.frame(2);
    note = window.widget("No motion found: the way is blocked");
    ASSERT_NE(note, nullptr);
    EXPECT_EQ(note->value.find("Another seed"), std::string::npos);
    EXPECT_NE(note->value.find("Move the target"), std::string::npos);
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
  // Its room all over the window, for the timeline's curve.
  ASSERT_GT(candidate.room.size(), 10u);
  EXPECT_EQ(candidate.room.front().t, candidate.task.window->lower);
  EXPECT_EQ(candidate.room.back().t, candidate.task.window->upper);
  const auto nearest = std::min_element(
      candidate.room.begin(), candidate.room.end(),
      [](const StripSample& a, const StripSample& b) { return a.clearance < b.clearance; });
  EXPECT_EQ(nearest->clearance, candidate.scene_clearance);
  EXPECT_GT(candidate.scene_clearance, 0);
  // What it goes beyond is said on the card.
  const auto card_of = [&](std::vector<std::string> widened) {
    EditorState other = state();
    other.candidate->report.limits_widened = std::move(widened);
    ViewState view = driver().view();
    EditorUi panels;
    Commands commands;
    UiDriver window(1600, 1000);
    window.show([&](Ui& toolkit) { panels.draw(toolkit, other, view, commands); });
    const ProbedWidget* card = window.widget(candidate.task.name);
    return card ? card->value : std::string("no card");
  };
  EXPECT_EQ(card_of({}).find("beyond"), std::string::npos);
  EXPECT_NE(card_of({"Elbow, flexion (speed)"}).find("beyond the usual limits 1,"),
            std::string::npos);
  EXPECT_NE(
      card_of({"Elbow, flexion", "Wrist, bend (acceleration)"}).find("beyond the usual limits 2,"),
      std::string::npos);
  ui().frame();  // back in the first context
  // A slider that was clicked keeps arrows, but Enter is the plan's.
  ui().click("Shoulder, swing up.low");
  expect_one_step([&] { ui().key(keys::kEnter); }, "Accept");
  ASSERT_EQ(state().document->corrections.size(), 1u);
  EXPECT_FALSE(ui().has("Accept"));

  // Its stretch of time lies on the limb's row, fainter while it is muted.
  ui().frame(2);
  const std::string stretch = driver().row_name(arm) + ".span.0";
  ASSERT_TRUE(ui().has(stretch));
  EXPECT_EQ(ui().value(stretch).find("off"), std::string::npos);
  // The stack of corrections in the outliner.
  const std::string name = state().document->corrections.front().name;
  ui().frame(2);
  const std::string row = "Outliner/" + name;
  ui().click(row);
  EXPECT_EQ(state().selected_correction, 0);
  ui().frame(2);
  expect_one_step([&] { ui().click(name + ".Mute"); }, "Mute");
  EXPECT_TRUE(state().document->corrections.front().muted);
  ui().frame(2);
  EXPECT_NE(ui().value(stretch).find("off"), std::string::npos);
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

// What is shown is what the settings say: another interval plans it anew, and what isn't says so.
TEST_F(Panels, APlanFollowsItsSettings) {
  ASSERT_TRUE(driver().plan(arm));
  const Candidate before = *state().candidate;
  EXPECT_FALSE(made_otherwise(state()));
  const DofView dof = state().dofs.front();
  const Interval narrower{dof.sample_lower, 0.5 * (dof.sample_lower + dof.sample_upper)};
  driver().handle(SetSampling{dof.name, narrower, Phase::changing});
  EXPECT_TRUE(made_otherwise(state()));
  EXPECT_FALSE(state().planning.active) << "not while it is dragged";
  // The card says so, and no other plan is offered as this one.
  ui().frame(2);
  const ProbedWidget* card = ui().widget(before.task.name);
  ASSERT_NE(card, nullptr);
  EXPECT_NE(card->value.find("made with other settings"), std::string::npos) << card->value;
  driver().handle(SetSampling{dof.name, narrower, Phase::committed});
  if (before.report.total_ms < 2000) {
    EXPECT_TRUE(state().planning.active);
  } else {
    driver().handle(Plan{});
  }
  ASSERT_TRUE(driver().wait_until([&] { return !state().planning.active; }));
  if (state().candidate) {
    EXPECT_EQ(state().candidate->task.wishes.sampling.at(dof.name), narrower);
    EXPECT_FALSE(made_otherwise(state()));
  }
  driver().handle(Undo{});
  EXPECT_EQ(made_otherwise(state()), state().candidate.has_value());
  ui().frame(2);
}

// A plan that lacks what was asked for says what.
TEST_F(Panels, APlanSaysWhatItLacks) {
  ASSERT_TRUE(driver().plan(arm));
  EditorState lacking = state();
  lacking.candidate->task.wishes.clearance = 0.3;
  lacking.candidate->task.wishes.alternatives = 4;
  lacking.candidate->report.planned_clearance = 0.01;
  ViewState view = driver().view();
  EditorUi panels;
  Commands commands;
  UiDriver window(1600, 1000);
  window.show([&](Ui& toolkit) { panels.draw(toolkit, lacking, view, commands); });
  const ProbedWidget* card = window.widget(lacking.candidate->task.name);
  ASSERT_NE(card, nullptr);
  EXPECT_NE(card->value.find("less room than asked for 1"), std::string::npos) << card->value;
  EXPECT_NE(card->value.find("ways found, of 4 1"), std::string::npos) << card->value;
  ui().frame();
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

}  // namespace
}  // namespace elbowroom
