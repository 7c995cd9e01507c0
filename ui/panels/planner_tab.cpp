// SPDX-License-Identifier: MIT
// The planner's own settings: window, seed, clearance, budget.
#include <cmath>

#include "ui/panels/panel.h"
#include "ui/toolkit/fields.h"
#include "ui/toolkit/text.h"

namespace elbowroom {

void draw_planner_tab(const PanelContext& context) {
  Ui& ui = context.ui;
  const EditorState& state = context.state;
  const Draft& draft = state.document->draft;
  PlanningWishes wishes;
  if (const auto found = draft.wishes.find(draft.limb); found != draft.wishes.end())
    wishes = found->second;

  heading(ui, "Window", draft.window ? "" : "not chosen");
  if (draft.window) {
    Interval window = *draft.window;
    NumberOptions options;
    options.unit = "s";
    options.decimals = 3;
    options.minimum = state.begin;
    options.maximum = state.end;
    options.hint = "Where the plan leaves the clip, and where it is back on it";
    Edit edit = number_input(ui, "From", window.lower, options);
    const Edit to = number_input(ui, "To", window.upper, options);
    if (!edit && !edit.cancelled) edit = to;
    if (edit.cancelled)
      context.emit(command::SetWindow{window, Phase::cancelled});
    else if (edit)
      context.emit(command::SetWindow{window, edit.committed ? Phase::committed : Phase::changing});
  } else {
    note(ui, "Drag on the limb's row in the timeline, or click a red mark.");
  }

  heading(ui, "Search");
  const auto changed = [&](const Edit& edit, const std::string& what) {
    if (edit.cancelled)
      context.emit(command::SetWishes{wishes, what, Phase::cancelled});
    else if (edit)
      context.emit(
          command::SetWishes{wishes, what, edit.committed ? Phase::committed : Phase::changing});
  };
  double seed = static_cast<double>(wishes.seed);
  NumberOptions seed_options;
  seed_options.decimals = 0;
  seed_options.minimum = 1;
  seed_options.maximum = 1e9;
  seed_options.hint = "The same seed and settings give the same motion again";
  const Edit seed_edit = number_input(ui, "Seed", seed, seed_options);
  // What is not edited stays as it is, be it beyond what can be entered here.
  if (seed_edit) wishes.seed = static_cast<std::uint64_t>(std::llround(seed));
  changed(seed_edit, "Seed " + std::to_string(wishes.seed));

  double clearance = wishes.clearance;
  const double usual = CollisionSettings{}.clearance * state.session->character().height;
  if (clearance <= 0) clearance = usual;
  NumberOptions clearance_options;
  clearance_options.unit = "mm";
  clearance_options.shown_per_value = 1000;
  clearance_options.decimals = 1;
  clearance_options.minimum = 0.1 * usual;
  clearance_options.maximum = 100 * usual;
  clearance_options.reset_to = usual;
  clearance_options.hint = "How much room the motion keeps, where there is room";
  const Edit clearance_edit = number_input(ui, "Clearance", clearance, clearance_options);
  if (clearance_edit) wishes.clearance = clearance;
  changed(clearance_edit, "Clearance");

  double iterations = wishes.max_iterations;
  NumberOptions budget;
  budget.decimals = 0;
  budget.minimum = 100;
  budget.maximum = 1e6;
  budget.drag_step = 50;
  budget.hint = "How long to search before giving up, in rounds of the search";
  const Edit budget_edit = number_input(ui, "Iterations", iterations, budget);
  if (budget_edit) wishes.max_iterations = static_cast<int>(std::lround(iterations));
  changed(budget_edit, "Iterations");

  double alternatives = wishes.alternatives;
  NumberOptions ways;
  ways.decimals = 0;
  ways.minimum = 1;
  ways.maximum = 16;
  ways.drag_step = 0.1;
  ways.hint = "How many different ways around to look for; the best comes first";
  const Edit ways_edit = number_input(ui, "Ways around", alternatives, ways);
  if (ways_edit) wishes.alternatives = static_cast<int>(std::lround(alternatives));
  changed(ways_edit, std::to_string(wishes.alternatives) + " ways around");
}

}  // namespace elbowroom
