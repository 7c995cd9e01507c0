// SPDX-License-Identifier: MIT
#include "ui/toolkit/range_slider.h"

#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "ui/toolkit/fields.h"
#include "ui/toolkit/geometry.h"
#include "ui/toolkit/text.h"

namespace elbowroom {
namespace {

// What is gripped.
constexpr int kNone = 0, kLow = 1, kHigh = 2, kBar = 3;

// What the slider keeps between frames, in Ui::memory.
enum Kept {
  kGrip,
  kMoved,
  kStartLow,
  kStartHigh,
  kStartMouse,
  kLastHandle,
  kTyping,
  kFrames,
  kHasKeys,
  kKeptCount
};

struct Track {
  double low = 0, high = 1;  // values at the ends
  float left = 0, width = 1;

  float x_of(double value) const {
    const double t = std::clamp((value - low) / (high - low), 0.0, 1.0);
    return std::round(left + static_cast<float>(t) * width);
  }
  double values_a_pixel() const {
    return (high - low) / static_cast<double>(std::max(width, 1.0f));
  }
};

// Within what pixels and steps can still tell apart.
double finite_or(double value, double otherwise) {
  return std::isfinite(value) ? std::clamp(value, -1e9, 1e9) : otherwise;
}

void order(double& low, double& high) {
  if (low > high) std::swap(low, high);
}

void keep_inside(RangeModel& m) {
  m.low = std::clamp(m.low, m.limit_low, m.limit_high);
  m.high = std::clamp(m.high, m.limit_low, m.limit_high);
}

// Whole shown steps while dragging, so that the numbers are the ones that are read.
double snapped(double value, double step) {
  return step > 0 ? std::round(value / step) * step : value;
}

std::string interval_text(const RangeModel& m, const RangeOptions& o) {
  return number_text(m.low * o.shown_per_value, o.decimals, o.unit) + " – " +
         number_text(m.high * o.shown_per_value, o.decimals, o.unit);
}

void draw(const Ui& ui, const RangeModel& m, const Track& track, float y, int grip, bool hovered,
          bool enabled) {
  const Palette& p = ui.palette();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float half = ui.px(4) / 2;
  const auto strip = [&](float from, float to, ImU32 colour) {
    list.AddRectFilled({from, y - half}, {std::max(to, from + 1), y + half}, colour, half);
  };
  strip(track.left, track.left + track.width, p.line);
  strip(track.x_of(m.limit_low), track.x_of(m.limit_high), mixed(p.line, p.text, 0.22f));
  const ImU32 bright = enabled ? p.accent : p.faint;
  strip(track.x_of(m.low), track.x_of(m.high),
        grip == kBar || (hovered && grip == kNone) ? mixed(bright, p.text, 0.2f) : bright);
  const auto tick = [&](double value, float height, float width, ImU32 colour) {
    const float x = track.x_of(value) - std::floor(width / 2);
    list.AddRectFilled({x, y - height}, {x + width, y + height}, colour);
  };
  const auto handle = [&](double value, bool held) {
    const float x = track.x_of(value);
    const ImVec2 a(x - ui.px(3), y - ui.px(6)), b(x + ui.px(4), y + ui.px(6));
    // A rim in the panel's colour keeps handles apart where they meet.
    list.AddRectFilled({a.x - 1, a.y - 1}, {b.x + 1, b.y + 1}, p.panel, ui.px(3));
    list.AddRectFilled(a, b, held ? p.accent : enabled ? p.handle : p.faint, ui.px(2));
  };
  if (m.clip) tick(*m.clip, ui.px(4), ui.px(1), p.quiet);
  handle(m.low, grip == kLow);
  handle(m.high, grip == kHigh);
  if (m.current) tick(*m.current, ui.px(7), ui.px(2), p.selection);
}

}  // namespace

void put_right(RangeModel& m) {
  m.limit_low = finite_or(m.limit_low, 0);
  m.limit_high = finite_or(m.limit_high, m.limit_low);
  order(m.limit_low, m.limit_high);
  m.low = finite_or(m.low, m.limit_low);
  m.high = finite_or(m.high, m.limit_high);
  order(m.low, m.high);
  keep_inside(m);
  m.default_low = finite_or(m.default_low, m.limit_low);
  m.default_high = finite_or(m.default_high, m.limit_high);
  order(m.default_low, m.default_high);
  m.default_low = std::clamp(m.default_low, m.limit_low, m.limit_high);
  m.default_high = std::clamp(m.default_high, m.limit_low, m.limit_high);
  if (m.current && !std::isfinite(*m.current)) m.current.reset();
  if (m.clip && !std::isfinite(*m.clip)) m.clip.reset();
  const bool given =
      std::isfinite(m.track_low) && std::isfinite(m.track_high) && m.track_low != m.track_high;
  m.track_low = finite_or(m.track_low, 0);
  m.track_high = finite_or(m.track_high, 0);
  order(m.track_low, m.track_high);
  if (!given || m.track_low == m.track_high) {
    const double air = 0.06 * (m.limit_high - m.limit_low);
    m.track_low = m.limit_low - air;
    m.track_high = m.limit_high + air;
    if (!(m.track_high > m.track_low)) {
      m.track_low -= 0.5;
      m.track_high += 0.5;
    }
  }
}

Edit range_slider(Ui& ui, std::string_view name, RangeModel& m, const RangeOptions& options) {
  Edit edit;
  put_right(m);
  const double per = std::isfinite(options.shown_per_value) && options.shown_per_value != 0
                         ? options.shown_per_value
                         : 1.0;
  const double unit_step = std::pow(10.0, -std::clamp(options.decimals, 0, 9)) / std::abs(per);
  const double before_low = m.low, before_high = m.high;
  const ImGuiIO& io = ImGui::GetIO();
  const auto pressed = [](ImGuiKey key, bool repeat) {
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), repeat);
  };

  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = std::max(ui.px(60), std::floor(ImGui::GetContentRegionAvail().x));
  ImFont* font = ui.fonts().regular;
  const float text_height = font->FontSize + ui.px(2), height = text_height + ui.px(20);
  const float y = at.y + text_height + ui.px(9);
  const float inset = ui.px(4);
  const Track track{m.track_low, m.track_high, at.x + inset, width - 2 * inset};

  ImGui::PushID(name.data(), name.data() + name.size());
  const ImGuiID id = ImGui::GetID("##track");
  std::vector<double>& kept = ui.memory(id);
  if (kept.size() != kKeptCount) {
    kept.assign(kKeptCount, 0);
    kept[kLastHandle] = kHigh;
  }

  // The numbers: a double-click types.
  const std::string numbers =
      options.right.empty() ? interval_text(m, options) : std::string(options.right);
  const float numbers_width = std::min(std::ceil(size_of(font, numbers).x), width * 0.7f);
  const Rect value_box{{at.x + width - numbers_width, at.y}, {at.x + width, at.y + text_height}};
  bool start_typing = false;
  ImGui::BeginDisabled(!options.enabled);
  if (kept[kTyping] != 0) {
    std::string& typed = ui.text_memory(id);
    if (kept[kFrames] == 0) {
      typed = number_text(m.low * per, options.decimals) + " – " +
              number_text(m.high * per, options.decimals);
      ImGui::SetKeyboardFocusHere();
    }
    const float box = std::max(numbers_width + ui.px(16), ui.px(110));
    ImGui::SetCursorScreenPos({at.x + width - box, at.y - ui.px(2)});
    ImGui::SetNextItemWidth(box);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.px(8), ui.px(2)});
    const bool entered =
        ImGui::InputText("##typed", &typed,
                         ImGuiInputTextFlags_AutoSelectAll | ImGuiInputTextFlags_EnterReturnsTrue);
    const bool left = kept[kFrames] > 1 && !ImGui::IsItemActive();
    ImGui::PopStyleVar();
    kept[kFrames] += 1;
    if (entered || left) {
      kept[kTyping] = 0;
      const std::vector<double> values = typed_numbers(typed);
      if (!pressed(ImGuiKey_Escape, false) && values.size() == 2) {
        m.low = values[0] / per;
        m.high = values[1] / per;
        order(m.low, m.high);
        keep_inside(m);
        edit.committed = m.low != before_low || m.high != before_high;
      }
    }
  } else {
    ImGui::SetCursorScreenPos(value_box.min);
    ImGui::InvisibleButton("##value", {std::max(1.0f, value_box.width()), text_height});
    const bool hovered = ImGui::IsItemHovered();
    start_typing = hovered && ImGui::IsMouseDoubleClicked(0);
    if (hovered) {
      ImGui::SetMouseCursor(ImGuiMouseCursor_TextInput);
      ui.hint("Double-click: type the interval");
    }
    draw_text(*ImGui::GetWindowDrawList(), font, value_box.min,
              hovered ? ui.palette().text : ui.palette().quiet, numbers, numbers_width);
  }
  draw_text(*ImGui::GetWindowDrawList(), font, at,
            options.enabled ? ui.palette().text : ui.palette().faint, shown_part(name),
            std::max(1.0f, width - numbers_width - ui.px(10)));

  // The track: one item; what is gripped is decided where the button goes down.
  ImGui::SetCursorScreenPos({at.x, at.y + text_height});
  ImGui::InvisibleButton("##track", {width, height - text_height});
  const bool hovered = ImGui::IsItemHovered(), active = ImGui::IsItemActive();
  if (ImGui::IsItemActivated()) kept[kHasKeys] = 1;
  if (ImGui::IsMouseClicked(0) && !hovered) kept[kHasKeys] = 0;
  ImGui::EndDisabled();

  const float low_x = track.x_of(m.low), high_x = track.x_of(m.high), mouse = io.MousePos.x;
  const float reach = ui.px(9);
  int under = kNone;
  if (std::abs(mouse - low_x) <= reach || std::abs(mouse - high_x) <= reach) {
    under = std::abs(mouse - low_x) < std::abs(mouse - high_x) ? kLow : kHigh;
    // Handles on top of each other: the side pulled to decides.
    if (low_x == high_x) under = mouse < low_x ? kLow : kHigh;
    // Against the limit only one of them can move.
    if (low_x == high_x && m.high >= m.limit_high && m.low > m.limit_low) under = kLow;
    if (low_x == high_x && m.low <= m.limit_low && m.high < m.limit_high) under = kHigh;
  } else if (mouse > low_x && mouse < high_x) {
    under = kBar;
  }
  if (ImGui::IsItemActivated() && io.MouseClicked[0]) {
    kept[kGrip] = under;
    if (under == kLow || under == kHigh) kept[kLastHandle] = under;
    kept[kMoved] = 0;
    kept[kStartLow] = m.low;
    kept[kStartHigh] = m.high;
    kept[kStartMouse] = static_cast<double>(mouse);
  }
  // Dear ImGui itself lets go of the item on Escape, where the keyboard navigates.
  const bool let_go = ImGui::IsItemDeactivated();
  const int grip = active || let_go ? static_cast<int>(kept[kGrip]) : kNone;
  if (hovered && ImGui::IsMouseDoubleClicked(0) && options.enabled) {
    m.low = m.default_low;
    m.high = m.default_high;
    edit.committed = m.low != before_low || m.high != before_high;
    kept[kGrip] = kNone;
  } else if (grip != kNone) {
    if (pressed(ImGuiKey_Escape, false)) {
      m.low = std::clamp(kept[kStartLow], m.limit_low, m.limit_high);
      m.high = std::clamp(kept[kStartHigh], m.limit_low, m.limit_high);
      edit.cancelled = kept[kMoved] != 0;
      kept[kGrip] = kNone;
      kept[kMoved] = 0;
    } else if (let_go) {
      // The value is the last frame's; the pointer may already be elsewhere.
    } else if (kept[kMoved] != 0 || std::abs(static_cast<double>(mouse) - kept[kStartMouse]) >= 1) {
      edit.began = kept[kMoved] == 0;
      kept[kMoved] = 1;
      const double fine = io.KeyShift ? 0.1 : 1.0;
      const double delta =
          (static_cast<double>(mouse) - kept[kStartMouse]) * track.values_a_pixel() * fine;
      // Back where it was gripped it is what it was, whole step or not.
      const double step = delta == 0 ? 0 : unit_step * fine;
      if (grip == kLow) {
        m.low = std::clamp(snapped(kept[kStartLow] + delta, step), m.limit_low, m.high);
      } else if (grip == kHigh) {
        m.high = std::clamp(snapped(kept[kStartHigh] + delta, step), m.low, m.limit_high);
      } else {
        const double length = kept[kStartHigh] - kept[kStartLow];
        m.low = std::clamp(snapped(kept[kStartLow] + delta, step), m.limit_low,
                           std::max(m.limit_low, m.limit_high - length));
        m.high = std::min(m.low + length, m.limit_high);
      }
    }
  }
  if (let_go && kept[kGrip] != kNone) {
    const bool same = m.low == kept[kStartLow] && m.high == kept[kStartHigh];
    edit.committed |= kept[kMoved] != 0 && !same;
    edit.cancelled |= kept[kMoved] != 0 && same;
    kept[kGrip] = kNone;
    kept[kMoved] = 0;
  }

  // Keys, for who clicked here last or came by Tab.
  const bool keys = options.enabled && !active && kept[kTyping] == 0 && !io.WantTextInput &&
                    (kept[kHasKeys] != 0 || (ImGui::IsItemFocused() && io.NavVisible)) &&
                    ImGui::IsWindowFocused(ImGuiFocusedFlags_RootAndChildWindows);
  if (keys) {
    const bool by_keyboard = ImGui::IsItemFocused() && io.NavVisible;
    ui.take_keys(by_keyboard);
    const double keys_low = m.low, keys_high = m.high;
    const double step = (options.key_step > 0 ? options.key_step / std::abs(per) : unit_step) *
                        (io.KeyShift  ? 0.1
                         : io.KeyCtrl ? 10.0
                                      : 1.0);
    const double move = (pressed(ImGuiKey_RightArrow, true) ? step : 0) -
                        (pressed(ImGuiKey_LeftArrow, true) ? step : 0);
    if (pressed(ImGuiKey_UpArrow, false)) kept[kLastHandle] = kHigh;
    if (pressed(ImGuiKey_DownArrow, false)) kept[kLastHandle] = kLow;
    if (move != 0 && kept[kLastHandle] == kLow) {
      m.low = std::clamp(m.low + move, m.limit_low, m.high);
    } else if (move != 0) {
      m.high = std::clamp(m.high + move, m.low, m.limit_high);
    }
    if (pressed(ImGuiKey_Home, false)) {
      m.low = m.default_low;
      m.high = m.default_high;
    }
    start_typing |= by_keyboard && pressed(ImGuiKey_Enter, false);
    edit.committed |= m.low != keys_low || m.high != keys_high;
  }
  if (start_typing && options.enabled) {
    kept[kTyping] = 1;
    kept[kFrames] = 0;
  }
  edit.changed = m.low != before_low || m.high != before_high;

  if (options.enabled && (hovered || active)) {
    const int shape = active ? grip : under;
    if (shape != kNone)
      ImGui::SetMouseCursor(shape == kBar ? ImGuiMouseCursor_Hand : ImGuiMouseCursor_ResizeEW);
    ui.hint(!options.hint.empty() ? options.hint
            : active              ? "Shift: fine · Esc: put back"
            : shape == kBar       ? "Drag: move the interval · Double-click: reset"
            : shape != kNone      ? "Drag: this end of the interval · Double-click: reset"
                                  : "Double-click: reset");
  }
  draw(ui, m, track, y,
       active                     ? grip
       : hovered && under != kBar ? under
                                  : kNone,
       hovered, options.enabled);
  if (keys) {
    const float x = track.x_of(kept[kLastHandle] == kLow ? m.low : m.high);
    ImGui::GetWindowDrawList()->AddRect({x - ui.px(5), y - ui.px(8)}, {x + ui.px(6), y + ui.px(8)},
                                        ui.palette().accent, ui.px(3));
  }
  ImGui::PopID();

  const std::string base(name_part(name)), value = interval_text(m, options);
  const ImVec2 end(at.x + width, at.y + height);
  const float top = y - ui.px(8), bottom = y + ui.px(8);
  const float low_now = track.x_of(m.low), high_now = track.x_of(m.high);
  ui.record(WidgetKind::range, name, at, end, value, options.enabled);
  ui.record(WidgetKind::range, "###" + base + ".value", value_box.min, value_box.max, numbers,
            options.enabled);
  ui.record(WidgetKind::range, "###" + base + ".bar", {low_now + reach, top},
            {std::max(high_now - reach, low_now + reach + 1), bottom}, {}, options.enabled);
  ui.record(WidgetKind::range, "###" + base + ".low", {low_now - ui.px(3), top},
            {low_now + ui.px(3), bottom}, number_text(m.low * per, options.decimals, options.unit),
            options.enabled);
  ui.record(WidgetKind::range, "###" + base + ".high", {high_now - ui.px(3), top},
            {high_now + ui.px(3), bottom},
            number_text(m.high * per, options.decimals, options.unit), options.enabled);
  ImGui::SetCursorScreenPos(at);
  ImGui::Dummy({width, height});
  return edit;
}

}  // namespace elbowroom
