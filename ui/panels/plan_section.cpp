// SPDX-License-Identifier: MIT
// The foot of the inspector: plan, watch, accept or discard.
#include <algorithm>

#include "ui/panels/panel.h"
#include "ui/toolkit/buttons.h"
#include "ui/toolkit/feedback.h"
#include "ui/toolkit/lists.h"
#include "ui/toolkit/text.h"

namespace elbowroom {
namespace {

// "left arm" for left_arm.
std::string words_of(const std::string& limb) {
  std::string words = limb_title(limb);
  if (!words.empty() && words[0] >= 'A' && words[0] <= 'Z' && words != limb)
    words[0] = static_cast<char>(words[0] - 'A' + 'a');
  return words;
}

// What the section shows, which its height depends on.
enum class Contents { plan, planning, candidate, several_ways, failure };
constexpr float kUsualHeight[] = {74, 68, 232, 270, 208};  // pixels at 100 %
constexpr ImGuiID kMemory = 0x504c414e;

Contents contents_of(const EditorState& state) {
  if (state.planning.active) return Contents::planning;
  if (state.candidate) return state.ways.size() > 1 ? Contents::several_ways : Contents::candidate;
  return state.failure ? Contents::failure : Contents::plan;
}

void accept_or_discard(const PanelContext& context) {
  Ui& ui = context.ui;
  ButtonOptions accept;
  accept.look = made_otherwise(context.state) ? ButtonLook::secondary : ButtonLook::primary;
  accept.shortcut = "Enter";
  accept.hint = "Lay this motion over the clip";
  if (button(ui, "Accept", accept)) context.emit(command::Accept{});
  ImGui::SameLine(0, ui.px(ui.theme().metrics.gap));
  ButtonOptions discard;
  discard.shortcut = "Del";
  discard.hint = "Forget this plan";
  if (button(ui, "Discard", discard)) context.emit(command::Discard{});
}

// Which of several ways is shown, and steps to the others.
void ways_row(const PanelContext& context) {
  Ui& ui = context.ui;
  const int ways = static_cast<int>(context.state.ways.size()), way = context.state.way;
  const float gap = ui.px(ui.theme().metrics.gap);
  IconButtonOptions step;
  step.look = ButtonLook::secondary;
  step.size = ui.theme().metrics.control;
  step.hint = "The way around before this one";
  step.shortcut = "PgUp";
  if (icon_button(ui, "Earlier way", Icon::chevron_left, step))
    context.emit(command::ShowWay{way - 1});
  ImGui::SameLine(0, gap);
  step.hint = "The next way around";
  step.shortcut = "PgDn";
  if (icon_button(ui, "Later way", Icon::chevron_right, step))
    context.emit(command::ShowWay{way + 1});
  ImGui::SameLine(0, gap);
  inline_text(ui, "Way " + std::to_string(way + 1) + " of " + std::to_string(ways) + "###Way");
}

void candidate_card(const PanelContext& context) {
  const Candidate& candidate = *context.state.candidate;
  const WindowReport& report = candidate.report;
  Ui& ui = context.ui;
  std::vector<CardRow> rows = {
      {"clearance in the scene", length_text(candidate.scene_clearance)},
      {"from the clip, at most", degrees_text(report.deviation_from_clip)},
      {"peak speed", number_text(report.peak_speed, 1, "rad/s")},
      {"found in", duration_text(report.total_ms)},
      {report.certified ? "proven free at all times" : "free at every key and 240 Hz", "",
       Tone::good, true},
  };
  std::string hint = "Shown as a ghost until it is accepted";
  const PlanningWishes& wishes = candidate.task.wishes;
  if (wishes.clearance > 0 && report.planned_clearance < wishes.clearance) {
    rows.insert(rows.end() - 2,
                {"less room than asked for", length_text(report.planned_clearance), Tone::problem});
    hint += "\n\nNo way was found that keeps " + length_text(wishes.clearance) +
            " from the scene; this one was planned with " + length_text(report.planned_clearance) +
            ".";
  }
  if (const auto ways = context.state.ways.size(); static_cast<int>(ways) < wishes.alternatives)
    rows.insert(rows.end() - 2,
                {"ways found, of " + std::to_string(wishes.alternatives), std::to_string(ways)});
  if (const auto& widened = report.limits_widened; !widened.empty()) {
    const CardRow row{"beyond the usual limits", std::to_string(widened.size())};
    rows.insert(rows.end() - 2, row);
    hint += "\n\nBeyond the usual limits, as the clip is or for want of time:";
    for (const std::string& name : widened) hint += "\n" + name;
  }
  if (made_otherwise(context.state)) {
    rows.push_back({"made with other settings", "P plans anew", Tone::problem});
    hint += "\n\nSettings, window or target have been changed since it was planned.";
  }
  CardOptions options;
  options.selected = true;
  options.selected_tone = Tone::ghost;
  options.hint = hint;
  card(ui, candidate.task.name, rows, options);
}

// A button for what has been tried and works.
void use_suggestion(const PanelContext& context, const Suggestion& works) {
  Ui& ui = context.ui;
  ButtonOptions options;
  options.hint = "Sets it and plans again";
  switch (works.kind) {
    case Suggestion::Kind::wider_window:
      if (!button(ui, "Use the wider window", options)) return;
      context.emit(command::SetWindow{works.window});
      break;
    case Suggestion::Kind::wider_intervals:
      if (!button(ui, "Use the limb's own intervals", options)) return;
      context.emit(command::ChoosePreset{SamplingPreset::paper});
      break;
    case Suggestion::Kind::another_limb: {
      if (!button(ui, "Correct the " + words_of(works.limb) + " instead###Another limb", options))
        return;
      const auto& limbs = context.state.session->limbs;
      for (std::size_t i = 0; i < limbs.size(); ++i)
        if (limbs[i].limb.name == works.limb)
          context.emit(command::SetWindow{works.window, Phase::committed, static_cast<int>(i)});
      break;
    }
  }
  context.emit(command::Plan{});
}

void failure_note(const PanelContext& context) {
  const PlanFailure& failure = *context.state.failure;
  std::string more;
  const auto line = [&more](const std::string& text) { more += (more.empty() ? "" : "\n") + text; };
  if (!failure.blocked_by.empty()) line("Most in the way: " + failure.blocked_by + ".");
  for (const Suggestion& suggestion : failure.suggestions) line(sentence(suggestion.text()) + ".");
  const auto works = std::find_if(failure.suggestions.begin(), failure.suggestions.end(),
                                  [](const Suggestion& s) { return s.works; });
  if (works == failure.suggestions.end()) {
    if (!failure.hopeless)
      line("Another seed may find a way.");
    else if (failure.reach)
      line(failure.turning ? "Move the target, or let the hand turn freely." : "Move the target.");
  }
  inline_note(
      context.ui, Tone::problem,
      "No motion found: " + (failure.reason.empty() ? "the budget is used up" : failure.reason),
      more);
  if (works != failure.suggestions.end()) use_suggestion(context, *works);
}

void plan_row(const PanelContext& context) {
  Ui& ui = context.ui;
  const EditorState& state = context.state;
  const Draft& draft = state.document->draft;
  ButtonOptions options;
  // What is planned already waits to be accepted first.
  options.look =
      state.candidate && !made_otherwise(state) ? ButtonLook::secondary : ButtonLook::primary;
  options.shortcut = "P";
  std::string text = "Plan";
  if (draft.target) {
    text = "Plan reach at " + number_text(draft.target->time, 2, "s");
    options.hint = "Find a motion that reaches the target and comes back";
  } else if (draft.window) {
    text = "Plan " + number_text(draft.window->lower, 2) + "–" +
           number_text(draft.window->upper, 2, "s");
    options.hint = "Find a motion around what the limb collides with in this window";
  } else {
    text = "Plan first problem";
    options.hint = "Choose the limb's first problem and find a motion around it";
    const auto limb = static_cast<std::size_t>(state.limb);
    if (state.strip && state.strip->complete() && limb < state.strip->limbs.size() &&
        state.strip->limbs[limb].windows.empty()) {
      text = "Plan";
      options.enabled = false;
      options.why_not =
          "This limb collides nowhere. Drag on its row in the timeline to choose a window.";
    }
  }
  if (button(ui, text + "###Plan", options)) context.emit(command::Plan{});
  // The seed, beside it: another seed is another way.
  PlanningWishes wishes;
  if (const auto found = draft.wishes.find(draft.limb); found != draft.wishes.end())
    wishes = found->second;
  ImGui::SameLine(0, ui.px(ui.theme().metrics.gap));
  ButtonOptions seed;
  seed.icon = Icon::refresh;
  seed.hint = "The seed; click to plan with the next one: another way around, if there is one";
  if (button(ui, std::to_string(wishes.seed) + "###Seed", seed)) {
    ++wishes.seed;
    context.emit(command::SetWishes{wishes, "Seed " + std::to_string(wishes.seed)});
    context.emit(command::Plan{});
  }
}

}  // namespace

float plan_section_height(const PanelContext& context) {
  Ui& ui = context.ui;
  // What its contents took in the last frame holds as long as they are of the same kind; when they
  // change, a good guess keeps buttons from jumping in the frame after.
  const Contents now = contents_of(context.state);
  const std::vector<double>& last = ui.memory(kMemory);
  const float measured = panel_content_height("Plan");
  if (measured > 0 && last == std::vector{static_cast<double>(now)}) return measured + ui.px(2);
  return ui.px(kUsualHeight[static_cast<std::size_t>(now)]);
}

void draw_plan_section(const PanelContext& context) {
  Ui& ui = context.ui;
  const EditorState& state = context.state;
  space(ui, 6);
  if (state.planning.active) {
    ProgressOptions options;
    const std::string seconds = number_text(state.planning.seconds, 1, "s");
    options.right = seconds;
    std::optional<double> fraction;
    if (state.planning.fraction >= 0) fraction = state.planning.fraction;
    // One name for all phases: a click on Cancel holds while the phase changes under it.
    if (progress(ui, sentence(state.planning.what) + "###Planning", fraction, options))
      context.emit(command::CancelPlan{});
  } else if (state.candidate) {
    // First what is to be decided: it stays in sight however little room there is.
    accept_or_discard(context);
    if (state.ways.size() > 1) ways_row(context);
    candidate_card(context);
    plan_row(context);
  } else {
    plan_row(context);
    if (state.failure) failure_note(context);
  }
  space(ui, 6);
  ui.memory(kMemory) = {static_cast<double>(contents_of(state))};
}

}  // namespace elbowroom
