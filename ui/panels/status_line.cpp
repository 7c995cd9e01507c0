// SPDX-License-Identifier: MIT
// The line under all: what goes on, how the clip fares, and what a click would do here.
#include <cmath>

#include "ui/panels/panel.h"
#include "ui/toolkit/icons.h"
#include "ui/toolkit/text.h"

namespace elbowroom {
namespace {

std::string job_text(const JobState& job) {
  std::string text = sentence(job.what);
  if (job.fraction >= 0) text += " " + std::to_string(std::lround(100 * job.fraction)) + " %";
  return text + "…";
}

struct Word {
  std::string text;
  Tone tone = Tone::quiet;
  Icon icon = Icon::none;
};

Word news(const EditorState& state) {
  for (const JobState* job : {&state.opening, &state.planning, &state.exporting, &state.scanning})
    if (job->active) return {job_text(*job), Tone::accent, Icon::none};
  if (state.candidate)
    return {state.candidate->task.name + ": planned and verified in " +
                duration_text(state.candidate->report.total_ms),
            Tone::ghost, Icon::check};
  if (state.failure)
    return {limb_title(state.failure->limb) + ": no motion found", Tone::problem, Icon::warning};
  if (!state.strip || !state.strip->complete()) return {};
  std::size_t problems = 0;
  const LimbStrip* first = nullptr;
  std::string limb;
  for (std::size_t i = 0; i < state.strip->limbs.size(); ++i) {
    const LimbStrip& strip = state.strip->limbs[i];
    problems += strip.windows.size();
    if (!first && !strip.windows.empty()) {
      first = &strip;
      limb = limb_title(state.session->limbs[i].limb.name);
    }
  }
  if (problems == 0) return {"No limb collides", Tone::good, Icon::check};
  return {std::to_string(problems) + (problems == 1 ? " problem, " : " problems, the first on ") +
              limb + " at " + number_text(first->windows.front().contacts.front().begin, 2, "s"),
          Tone::problem, Icon::warning};
}

}  // namespace

void draw_status_line(const PanelContext& context, const Rect& rect) {
  Ui& ui = context.ui;
  const Panel panel(ui, "Status", rect, {PanelGround::panel, false, false});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  ImFont* font = ui.fonts().small;
  const float y = middle(rect.min.y, rect.height(), font);
  const float pad = ui.px(ui.theme().metrics.padding);
  float x = rect.min.x + pad;
  const Word word = news(context.state);
  if (word.icon != Icon::none) {
    draw_icon(list, word.icon, {x + ui.px(6), rect.min.y + 0.5f * rect.height()}, ui.px(14),
              ui.colour(word.tone));
    x += ui.px(18);
  }
  const float news_width =
      draw_text(list, font, {x, y}, ui.colour(word.tone), word.text, 0.5f * rect.width());
  ui.record(WidgetKind::label, "News", {x, rect.min.y}, {x + news_width, rect.max.y}, word.text);
  std::string hint = ui.hint_text();
  if (hint.empty() && context.state.open())
    hint = "Click a limb or a red mark in the timeline · P: plan · ?: shortcuts";
  const float room = rect.max.x - pad - (x + news_width + 2 * pad);
  const float width = std::min(size_of(font, hint).x, room);
  if (width > ui.px(40)) {
    draw_text(list, font, {std::floor(rect.max.x - pad - width), y}, ui.colour(Tone::quiet), hint,
              width + 1);
    ui.record(WidgetKind::label, "Hint", {rect.max.x - pad - width, rect.min.y},
              {rect.max.x - pad, rect.max.y}, hint);
  }
}

}  // namespace elbowroom
