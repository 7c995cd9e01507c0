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

void candidate_card(const PanelContext& context) {
  const Candidate& candidate = *context.state.candidate;
  const WindowReport& report = candidate.report;
  Ui& ui = context.ui;
  heading(ui, "Plan", "found in " + duration_text(report.total_ms));
  std::vector<CardRow> rows = {
      {"clearance in the scene", length_text(candidate.scene_clearance)},
      {"from the clip, at most", degrees_text(report.deviation_from_clip)},
      {"peak speed", number_text(report.peak_speed, 1, "rad/s")},
      {report.certified ? "proven free at all times" : "free at every key and 240 Hz", "",
       Tone::good, true},
  };
  const int ways = static_cast<int>(context.state.ways.size());
  if (ways > 1) {
    const int way = context.state.way;
    IconButtonOptions step;
    step.hint = "The way around before this one";
    if (icon_button(ui, "Earlier way", Icon::step_back, step))
      context.emit(command::ShowWay{way - 1});
    ImGui::SameLine(0, ui.px(ui.theme().metrics.gap));
    step.hint = "The next way around";
    if (icon_button(ui, "Later way", Icon::step_forward, step))
      context.emit(command::ShowWay{way + 1});
    ImGui::SameLine(0, ui.px(ui.theme().metrics.gap));
    inline_text(ui,
                "Way " + std::to_string(way + 1) + " of " + std::to_string(ways) + ", cost " +
                    number_text(report.cost, 3),
                Tone::quiet);
  }
  CardOptions options;
  options.selected = true;
  options.selected_tone = Tone::ghost;
  options.hint = "Shown as a ghost until it is accepted";
  card(ui, candidate.task.name, rows, options);
  space(ui, 4);
  ButtonOptions accept;
  accept.look = ButtonLook::primary;
  accept.shortcut = "Enter";
  accept.hint = "Lay this motion over the clip";
  if (button(ui, "Accept", accept)) context.emit(command::Accept{});
  ImGui::SameLine(0, ui.px(ui.theme().metrics.gap));
  ButtonOptions discard;
  discard.shortcut = "Del";
  discard.hint = "Forget this plan";
  if (button(ui, "Discard", discard)) context.emit(command::Discard{});
}

void failure_note(const PanelContext& context) {
  const PlanFailure& failure = *context.state.failure;
  std::string more;
  if (!failure.blocked_by.empty()) more = "Most in the way: " + failure.blocked_by + ". ";
  for (const Suggestion& suggestion : failure.suggestions)
    more += sentence(suggestion.text()) + ". ";
  const auto works = std::find_if(failure.suggestions.begin(), failure.suggestions.end(),
                                  [](const Suggestion& s) { return s.works; });
  if (works == failure.suggestions.end()) more += "Another seed may find a way.";
  inline_note(
      context.ui, Tone::problem,
      "No motion found: " + (failure.reason.empty() ? "the budget is used up" : failure.reason),
      more);
  if (works == failure.suggestions.end() || works->kind != Suggestion::Kind::wider_window) return;
  if (button(context.ui, "Use the wider window")) {
    context.emit(command::SetWindow{works->window});
    context.emit(command::Plan{});
  }
}

}  // namespace

float plan_section_height(const PanelContext& context) {
  const Ui& ui = context.ui;
  const float foot = ui.px(ui.theme().metrics.control) + ui.px(40);
  if (context.state.planning.active) return foot + ui.px(12);
  if (context.state.candidate)
    return foot + ui.px(206) + (context.state.ways.size() > 1 ? ui.px(32) : 0);
  if (context.state.failure)
    return foot + ui.px(150) + (context.state.failure->suggestions.empty() ? 0 : ui.px(90));
  return foot;
}

void draw_plan_section(const PanelContext& context) {
  Ui& ui = context.ui;
  const EditorState& state = context.state;
  const Draft& draft = state.document->draft;
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
  } else {
    ButtonOptions options;
    options.look = ButtonLook::primary;
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
  space(ui, 6);
  if (state.candidate) candidate_card(context);
  if (state.failure) failure_note(context);
}

}  // namespace elbowroom
