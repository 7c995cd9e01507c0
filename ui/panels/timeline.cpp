// SPDX-License-Identifier: MIT
// Time: the transport, and the timeline with a row of contacts for each limb, the window, the
// targets and the clearance of the selected limb, before and after.
#include "ui/toolkit/timeline.h"

#include <algorithm>
#include <cmath>

#include "ui/panels/panel.h"
#include "ui/toolkit/buttons.h"
#include "ui/toolkit/fields.h"
#include "ui/toolkit/text.h"

namespace elbowroom {
namespace {

constexpr int kMostCurvePoints = 2000;

// A depth at which a bump fills its row, × the character's height.
constexpr double kFullDepth = 0.04;
// However shallow, a bump is to be seen.
constexpr double kLeastBump = 0.2;

// The local measure of depth jumps from vertex to vertex; a mean over a tenth of a second shows
// what the eye would call the depth.
std::vector<float> depth_curve(const LimbStrip& strip, double begin, double end, double full) {
  constexpr int kReach = 3;  // samples to each side
  std::vector<double> heights;
  for (const StripSample& sample : strip.samples)
    if (sample.t >= begin && sample.t <= end)
      heights.push_back(sample.contact ? std::clamp(std::sqrt(sample.depth / full), kLeastBump, 1.0)
                                       : 0.0);
  std::vector<float> curve;
  const int count = static_cast<int>(heights.size());
  for (int i = 0; i < count; ++i) {
    double sum = 0, weights = 0;
    for (int k = std::max(0, i - kReach); k <= std::min(count - 1, i + kReach); ++k) {
      const double weight = 1 + kReach - std::abs(k - i);
      sum += weight * heights[static_cast<std::size_t>(k)];
      weights += weight;
    }
    curve.push_back(static_cast<float>(sum / weights));
  }
  return curve;
}

std::vector<TimelineBump> bumps_of(const EditorState& state, const LimbStrip& strip) {
  std::vector<TimelineBump> bumps;
  const double full = kFullDepth * state.session->character().height;
  for (const ProposedWindow& window : strip.windows) {
    TimelineBump bump;
    bump.begin = window.contacts.front().begin;
    bump.end = window.contacts.front().end;
    const ContactInterval* deepest = &window.contacts.front();
    for (const ContactInterval& contact : window.contacts) {
      bump.begin = std::min(bump.begin, contact.begin);
      bump.end = std::max(bump.end, contact.end);
      if (contact.deepest.depth > deepest->deepest.depth) deepest = &contact;
    }
    bump.peak = deepest->time_of_deepest;
    bump.depth = depth_curve(strip, bump.begin, bump.end, full);
    bump.tooltip =
        deepest->deepest.part_a + " with " + deepest->deepest.part_b +
        (deepest->deepest.depth > 0 ? "\n" + length_text(deepest->deepest.depth) : "\nFirst") +
        " at " + number_text(bump.peak, 2, "s");
    bumps.push_back(std::move(bump));
  }
  return bumps;
}

TimelineCurve curve_of(const std::vector<StripSample>& samples, const std::string& name,
                       bool dashed, Tone tone) {
  TimelineCurve curve;
  curve.name = name;
  curve.dashed = dashed;
  curve.tone = tone;
  const std::size_t step = std::max<std::size_t>(1, samples.size() / kMostCurvePoints);
  for (std::size_t i = 0; i < samples.size(); i += step) {
    const StripSample& sample = samples[i];
    curve.samples.push_back({sample.t, sample.contact ? -sample.depth : sample.clearance});
  }
  return curve;
}

// The room of a limb's motion with a plan laid over it.
std::vector<StripSample> with_plan(const std::vector<StripSample>& now,
                                   const std::vector<StripSample>& planned) {
  if (planned.empty()) return now;
  std::vector<StripSample> all;
  const double begin = planned.front().t, end = planned.back().t;
  for (const StripSample& sample : now)
    if (sample.t < begin) all.push_back(sample);
  all.insert(all.end(), planned.begin(), planned.end());
  for (const StripSample& sample : now)
    if (sample.t > end) all.push_back(sample);
  return all;
}

// What has been done on this clip by its corrections' names, and tasks that nothing came of yet.
void add_marks_of_work(const EditorState& state, TimelineModel& model) {
  const Document& document = *state.document;
  const auto add = [&model](const std::string& name, double time) {
    TimelineMark mark;
    mark.time = time;
    mark.label = name;
    mark.movable = false;
    model.marks.push_back(mark);
  };
  const auto task_time = [](const Task& task) -> std::optional<double> {
    if (task.kind == TaskKind::reach && task.target) return task.target->time;
    if (task.window) return 0.5 * (task.window->lower + task.window->upper);
    return std::nullopt;
  };
  for (const Correction& correction : document.corrections) {
    if (!state.session->is_of_clip(correction.clip)) continue;
    double time = 0.5 * static_cast<double>(correction.begin + correction.end);
    for (const Task& task : document.tasks)
      if (task.name == correction.task && !correction.task.empty())
        time = task_time(task).value_or(time);
    add(correction.name, time);
  }
  for (const Task& task : document.tasks) {
    const auto time = task_time(task);
    const bool done = std::any_of(document.corrections.begin(), document.corrections.end(),
                                  [&](const Correction& c) { return c.task == task.name; });
    if (time && !done && state.session->is_of_clip(task.clip)) add(task.name, *time);
  }
}

TimelineModel model_of(const EditorState& state, const ViewState& view) {
  TimelineModel model;
  model.begin = state.begin;
  model.end = state.end;
  model.frame_rate = state.frame_rate;
  model.show_frames = view.frames;
  model.time = state.time;
  const Draft& draft = state.document->draft;
  const auto& strip = state.strip;
  for (std::size_t i = 0; i < state.session->limbs.size(); ++i) {
    TimelineRow row;
    row.label = limb_title(state.session->limbs[i].limb.name);
    row.selected = state.limb == static_cast<int>(i);
    if (strip && i < strip->limbs.size()) {
      if (strip->complete()) row.bumps = bumps_of(state, strip->limbs[i]);
      const double length = strip->end - strip->begin;
      if (!strip->complete() && length > 0)
        row.computing = (strip->computed_to - strip->begin) / length;
    } else if (state.scanning.active) {
      row.computing = 0;
    }
    for (const Correction& correction : state.document->corrections)
      if (correction.limb == state.session->limbs[i].limb.name &&
          state.session->is_of_clip(correction.clip))
        row.spans.push_back({static_cast<double>(correction.begin),
                             static_cast<double>(correction.end), !correction.muted});
    model.rows.push_back(std::move(row));
  }
  if (draft.window && state.limb >= 0)
    model.window = TimelineWindow{draft.window->lower, draft.window->upper, state.limb};
  if (draft.target && state.limb >= 0) {
    TimelineMark mark;
    mark.time = draft.target->time;
    mark.label = "target";
    mark.selected = true;
    model.marks.push_back(mark);
  }
  add_marks_of_work(state, model);
  const int limb = state.limb;
  const auto has = [&](const std::shared_ptr<const CollisionStrip>& s) {
    return s && limb >= 0 && static_cast<std::size_t>(limb) < s->limbs.size();
  };
  model.curves_label = "Clearance";
  const auto samples = [&](const CollisionStrip& s) -> const std::vector<StripSample>& {
    return s.limbs[static_cast<std::size_t>(limb)].samples;
  };
  const auto& candidate = state.candidate;
  const bool planned =
      candidate && limb >= 0 && has(state.strip) &&
      candidate->task.limb == state.session->limbs[static_cast<std::size_t>(limb)].limb.name;
  const bool differs = state.strip != state.source_strip && has(state.strip);
  if (planned) {
    model.curves.push_back(curve_of(samples(*state.strip), "before", true, Tone::problem));
    model.curves.push_back(
        curve_of(with_plan(samples(*state.strip), candidate->room), "planned", false, Tone::ghost));
  } else {
    if (differs && has(state.source_strip))
      model.curves.push_back(curve_of(samples(*state.source_strip), "before", true, Tone::problem));
    if (has(state.strip))
      model.curves.push_back(
          curve_of(samples(*state.strip), differs ? "after" : "now", false, Tone::good));
  }
  model.threshold = 0.0;
  return model;
}

Phase phase_of(TimelineEvent::Phase phase) {
  switch (phase) {
    case TimelineEvent::Phase::began:
      return Phase::begin;
    case TimelineEvent::Phase::changing:
      return Phase::changing;
    case TimelineEvent::Phase::committed:
      return Phase::committed;
    case TimelineEvent::Phase::cancelled:
      return Phase::cancelled;
  }
  return Phase::committed;
}

void carry_out(const PanelContext& context, const TimelineEvent& event) {
  const EditorState& state = context.state;
  using Kind = TimelineEvent::Kind;
  const Phase phase = phase_of(event.phase);
  switch (event.kind) {
    case Kind::scrub_to:
      context.emit(command::Scrub{event.time});
      break;
    case Kind::window_drawn:
    case Kind::window_changed:
      context.emit(command::SetWindow{Interval{event.begin, event.end}, phase, event.row});
      break;
    case Kind::mark_moved:
      if (event.mark == 0 && state.document->draft.target) {
        HandTarget target = *state.document->draft.target;
        target.time = std::clamp(event.time, state.begin, state.end);
        context.emit(command::SetTarget{target, phase, "Time of hand target"});
      }
      break;
    case Kind::mark_clicked:
      if (state.document->draft.target && event.mark == 0)
        context.emit(command::Scrub{state.document->draft.target->time});
      break;
    case Kind::bump_clicked:
    case Kind::bump_double_clicked:
      context.emit(command::SelectProblem{event.row, event.bump});
      break;
    case Kind::row_clicked:
      context.emit(command::SelectLimb{event.row});
      break;
  }
}

void transport(const PanelContext& context, const Rect& rect) {
  Ui& ui = context.ui;
  const EditorState& state = context.state;
  const float pad = ui.px(ui.theme().metrics.padding);
  const float size = ui.px(28);
  const float top = rect.min.y + std::floor(0.5f * (rect.height() - size));
  float x = rect.min.x + pad;
  const auto press = [&](const char* name, Icon icon, const char* keys, bool on = false,
                         ButtonLook look = ButtonLook::secondary) {
    ImGui::SetCursorScreenPos({x, top});
    x += size + ui.px(6);
    IconButtonOptions options;
    options.look = look;
    options.shortcut = keys;
    options.on = on;
    options.enabled = state.source != nullptr;
    return icon_button(ui, name, icon, options);
  };
  if (press("First frame", Icon::first, "Shift ←")) context.emit(command::GoToEnd{false});
  if (press("Previous frame", Icon::step_back, "←")) context.emit(command::StepFrames{-1});
  if (press(state.playing ? "Pause" : "Play", state.playing ? Icon::pause : Icon::play, "Space",
            false, ButtonLook::primary))
    context.emit(command::TogglePlay{});
  if (press("Next frame", Icon::step_forward, "→")) context.emit(command::StepFrames{1});
  if (press("Last frame", Icon::last, "Shift →")) context.emit(command::GoToEnd{true});
  if (press("Loop", Icon::loop, "", state.loop)) context.emit(command::ToggleLoop{});

  ImDrawList& list = *ImGui::GetWindowDrawList();
  x += ui.px(8);
  ImFont* font = ui.fonts().medium;
  const std::string time = number_text(state.time, 2, "s");
  draw_text(list, font, {x, middle(rect.min.y, rect.height(), font)}, ui.colour(Tone::text), time);
  ui.record(WidgetKind::label, "Time", {x, rect.min.y}, {x + ui.px(60), rect.max.y}, time);
  x += size_of(font, "000.00 s").x + ui.px(8);
  const auto frame = std::lround((state.time - state.begin) * state.frame_rate);
  const auto frames = std::lround((state.end - state.begin) * state.frame_rate);
  ImFont* quiet = ui.fonts().small;
  const std::string where = "frame " + std::to_string(frame) + " / " + std::to_string(frames) +
                            " · " + number_text(state.frame_rate, 0, "fps");
  const float wide = rect.width();
  if (wide > ui.px(820))
    draw_text(list, quiet, {x, middle(rect.min.y, rect.height(), quiet)}, ui.colour(Tone::quiet),
              where);

  // From the right: speed, clip, problems.
  float right = rect.max.x - pad;
  const auto place = [&](float width, float height) {
    right -= width;
    ImGui::SetCursorScreenPos(
        {std::floor(right), rect.min.y + std::floor(0.5f * (rect.height() - ui.px(height)))});
    right -= ui.px(8);
  };
  const float control = ui.theme().metrics.control;
  constexpr float kList = 28;  // a list's height, pixels at 100 %
  static constexpr double kSpeeds[] = {0.25, 0.5, 1, 2};
  std::vector<std::string> speeds;
  int chosen = -1;
  for (std::size_t i = 0; i < std::size(kSpeeds); ++i) {
    speeds.push_back(number_text(kSpeeds[i], kSpeeds[i] < 1 ? 2 : 0) + "×");
    if (state.speed == kSpeeds[i]) chosen = static_cast<int>(i);
  }
  ComboOptions speed;
  speed.width = 76;
  speed.hint = "How fast the clip plays";
  place(ui.px(speed.width), kList);
  if (combo(ui, "##Speed", chosen, speeds, speed)) context.emit(command::SetSpeed{kSpeeds[chosen]});
  const auto& clips = state.session->scene.model().clips;
  if (clips.size() > 1) {
    std::vector<std::string> names;
    int clip = state.session->scene.clip;
    for (std::size_t i = 0; i < clips.size(); ++i)
      names.push_back(clips[i].name.empty() ? "Clip " + std::to_string(i) : clips[i].name);
    ComboOptions options;
    options.width = wide > ui.px(1100) ? 190 : 120;
    options.hint = "Which clip of the file is played and corrected";
    place(ui.px(options.width), kList);
    if (combo(ui, "##Clip", clip, names, options))
      context.emit(command::ChooseClip{std::to_string(clip)});
  }
  ButtonOptions next;
  next.icon = Icon::chevron_right;
  next.shortcut = "N";
  next.hint = "Go to the next problem and choose its window";
  next.enabled = state.strip != nullptr;
  place(button_width(ui, "Problem###Next problem", next), control);
  if (button(ui, "Problem###Next problem", next)) context.emit(command::GoToProblem{1});
  IconButtonOptions previous;
  previous.look = ButtonLook::secondary;
  previous.shortcut = "B";
  previous.enabled = state.strip != nullptr;
  place(ui.px(28), 28);
  if (icon_button(ui, "Previous problem", Icon::chevron_left, previous))
    context.emit(command::GoToProblem{-1});
}

}  // namespace

void draw_timeline(const PanelContext& context, const Rect& rect) {
  Ui& ui = context.ui;
  const Panel panel(ui, "Timeline", rect, {PanelGround::panel, false, false});
  if (!context.state.open()) return;
  const float bar = ui.px(kTransportHeight);
  transport(context, {rect.min, {rect.max.x, rect.min.y + bar}});
  if (!context.state.source) {
    ImGui::SetCursorScreenPos({rect.min.x + ui.px(12), rect.min.y + bar});
    note(ui, "This file has no clip.");
    return;
  }
  ImGui::SetCursorScreenPos({rect.min.x, rect.min.y + bar});
  TimelineOptions options;
  options.width = rect.width();
  options.height = rect.height() - bar;
  const TimelineModel model = model_of(context.state, context.view);
  for (const TimelineEvent& event :
       timeline(ui, "Clip time", model, context.view.timeline, options))
    carry_out(context, event);
}

}  // namespace elbowroom
