// SPDX-License-Identifier: MIT
#include "ui/toolkit/lists.h"

#include <imgui_internal.h>

#include <algorithm>

#include "ui/toolkit/geometry.h"
#include "ui/toolkit/text.h"

namespace elbowroom {
namespace {

// The panel's strip at the cursor, from edge to edge (the scroll bar excepted).
Rect strip(float height) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImRect inner = ImGui::GetCurrentWindow()->InnerRect;
  return {{inner.Min.x, at.y}, {inner.Max.x, at.y + height}};
}

// Dear ImGui cuts drawings off at half the panel's padding; a strip goes to the very edge.
class EdgeToEdge {
 public:
  explicit EdgeToEdge(ImDrawList& list) : list_(list) {
    const ImRect inner = ImGui::GetCurrentWindow()->InnerRect;
    const ImVec2 from = list.GetClipRectMin(), to = list.GetClipRectMax();
    list.PushClipRect({inner.Min.x, from.y}, {inner.Max.x, to.y});
  }
  ~EdgeToEdge() { list_.PopClipRect(); }

 private:
  ImDrawList& list_;
};

// Draws the pill with its right edge at `right`; returns its width.
float badge(const Ui& ui, ImDrawList& list, float right, float top, float height,
            std::string_view text, Tone tone) {
  ImFont* font = ui.fonts().small;
  const float width = std::ceil(size_of(font, text).x) + 2 * ui.px(7);
  const float tall = font->FontSize + ui.px(3);
  const float y = std::floor(top + (height - tall) / 2);
  const Palette& p = ui.palette();
  // The ground stays near the panel's, so that the words keep their contrast.
  list.AddRectFilled({right - width, y}, {right, y + tall}, mixed(p.panel, ui.colour(tone), 0.13f),
                     tall / 2);
  draw_text(list, font, {right - width + ui.px(7), middle(y, tall, font)}, ui.colour(tone), text);
  return width;
}

}  // namespace

RowResult list_row(Ui& ui, std::string_view label, const RowOptions& options) {
  RowResult result;
  const float height = ui.px(ui.theme().metrics.row);
  const Rect row = strip(height);
  const float pad = ui.px(ui.theme().metrics.padding);
  const std::string_view shown = shown_part(label);
  const ImVec2 cursor = ImGui::GetCursorScreenPos();

  ImGui::PushID(label.data(), label.data() + label.size());
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
  ImGui::SetCursorScreenPos(row.min);
  ImGui::BeginDisabled(!options.enabled);
  const bool pressed = ImGui::InvisibleButton("##row", {std::max(1.0f, row.width()), height});
  result.hovered = ImGui::IsItemHovered();
  const bool focused = ImGui::IsItemFocused() && ImGui::GetIO().NavVisible;
  ImGui::EndDisabled();

  const Palette& p = ui.palette();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const EdgeToEdge edges(list);
  ImU32 ground = p.panel;
  if (options.selected) ground = mixed(p.panel, ui.colour(options.selected_tone), 0.19f);
  if (result.hovered && options.enabled) ground = mixed(ground, p.text, 0.05f);
  if (ground != p.panel) list.AddRectFilled(row.min, row.max, ground);
  if (focused) list.AddRect(row.min, row.max, p.accent);

  const ImVec2 mouse = ImGui::GetIO().MousePos;
  bool elsewhere = false;  // the pointer is on a part with a click of its own
  float left = row.min.x + pad + static_cast<float>(std::max(0, options.indent)) * ui.px(16);
  const float centre = row.min.y + height / 2;
  if (options.expanded) {
    const Rect chevron{{left - ui.px(4), row.min.y}, {left + ui.px(14), row.max.y}};
    const bool over = result.hovered && chevron.contains(mouse);
    draw_icon(list, *options.expanded ? Icon::chevron_down : Icon::chevron_right,
              {left + ui.px(5), centre}, ui.px(11), over ? p.text : p.quiet);
    elsewhere |= over;
    result.toggled = pressed && over;
    left += ui.px(15);
    if (focused) {
      const int key =
          ImGui::GetKeyIndex(*options.expanded ? ImGuiKey_LeftArrow : ImGuiKey_RightArrow);
      result.toggled |= ImGui::IsKeyPressed(key, false);
    }
  }
  if (options.icon != Icon::none) {
    draw_icon(list, options.icon, {left + ui.px(6), centre},
              options.icon == Icon::dot ? ui.px(15) : ui.px(13),
              options.enabled ? ui.colour(options.icon_tone) : p.faint);
    left += ui.px(20);
  }

  float right = row.max.x - pad;
  const float beside = row.max.x - pad - ui.px(22) * static_cast<float>(options.actions.size());
  const bool fits = left + size_of(ui.fonts().regular, shown).x <= beside;
  for (std::size_t i = options.actions.size(); i-- > 0;) {
    const RowAction& action = options.actions[i];
    const bool shown_now = result.hovered || (options.selected && fits) || action.on || focused;
    const float from =
        row.max.x - pad + ui.px(4) - ui.px(22) * static_cast<float>(options.actions.size() - i);
    const Rect spot{{from, row.min.y}, {from + ui.px(22), row.max.y}};
    const bool over = result.hovered && spot.contains(mouse);
    if (shown_now) {
      draw_icon(list, action.icon, {(spot.min.x + spot.max.x) / 2, centre}, ui.px(14),
                !action.enabled ? with_opacity(p.faint, 0.5f)
                : over          ? p.text
                : action.on     ? p.accent
                                : p.quiet);
    }
    if (over) {
      elsewhere = true;
      ui.hint(action.name);
      if (pressed && action.enabled) result.action = static_cast<int>(i);
      explain(ui, action.name);
    }
    ui.record(WidgetKind::icon_button,
              std::string(action.name) + "###" + std::string(name_part(label)) + "." + action.name,
              spot.min, spot.max, action.on ? "on" : "", action.enabled && options.enabled,
              action.on);
    // Hidden actions leave their place to the text.
    if (shown_now) right = std::min(right, spot.min.x - ui.px(4));
  }

  ImFont* font = ui.fonts().regular;
  // The name comes first: what stands at the right gives way to it, and goes where only a stump of
  // it would be left. A badge is worth cutting the name to half the row.
  const float room = right - left - ui.px(8);
  const float rest = room - std::ceil(size_of(font, shown).x);
  const auto badge_width = [&ui](std::string_view text) {
    return std::ceil(size_of(ui.fonts().small, text).x) + 2 * ui.px(7);
  };
  std::string_view pill = options.badge;
  // "2 problems" becomes "2" before it goes: the colour of the dot is not to be the only signal.
  if (badge_width(pill) > std::max(rest, room / 2)) pill = pill.substr(0, pill.find(' '));
  if (!pill.empty() && badge_width(pill) <= std::max(rest, room / 2)) {
    right -= badge(ui, list, right, row.min.y, height, pill, options.badge_tone) + ui.px(8);
  } else if (!options.right.empty() && options.badge.empty() && rest > ui.px(28)) {
    const float width = std::min(std::ceil(size_of(ui.fonts().small, options.right).x), rest);
    draw_text(list, ui.fonts().small, {right - width, middle(row.min.y, height, ui.fonts().small)},
              ui.colour(options.right_tone), options.right, width);
    right -= width + ui.px(8);
  }
  draw_text(list, font, {left, middle(row.min.y, height, font)},
            options.enabled ? ui.colour(options.tone) : p.faint, shown,
            std::max(1.0f, right - left));

  result.clicked = pressed && !elsewhere;
  result.double_clicked = result.hovered && !elsewhere && ImGui::IsMouseDoubleClicked(0);
  result.context = result.hovered && ImGui::IsMouseReleased(1);
  if (!elsewhere && result.hovered && !options.hint.empty()) ui.hint(options.hint);
  if (!elsewhere && size_of(font, shown).x > right - left) explain(ui, {}, shown);
  ImGui::PopStyleVar();
  ImGui::PopID();
  // The next item goes on below, at the panel's own left edge and without a gap between rows.
  ImGui::SetCursorScreenPos({cursor.x, row.max.y});
  ui.record(WidgetKind::row, label, row.min, row.max,
            std::string(options.badge.empty() ? options.right : options.badge), options.enabled,
            options.selected);
  return result;
}

bool section(Ui& ui, std::string_view label, bool& open, std::string_view right) {
  const float height = ui.px(ui.theme().metrics.row);
  const ImVec2 cursor = ImGui::GetCursorScreenPos();
  const Rect row = strip(height);
  const float pad = ui.px(ui.theme().metrics.padding);
  ImGui::PushID(label.data(), label.data() + label.size());
  ImGui::SetCursorScreenPos(row.min);
  if (ImGui::InvisibleButton("##section", {std::max(1.0f, row.width()), height})) open = !open;
  const bool hovered = ImGui::IsItemHovered();
  ImGui::PopID();
  const Palette& p = ui.palette();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const EdgeToEdge edges(list);
  ImFont* font = ui.fonts().small_medium;
  if (hovered) ui.hint(open ? "Click: fold" : "Click: unfold");
  draw_icon(list, open ? Icon::chevron_down : Icon::chevron_right,
            {row.min.x + pad + ui.px(5), row.min.y + height / 2}, ui.px(11),
            hovered ? p.text : p.quiet);
  draw_text(list, font, {row.min.x + pad + ui.px(16), middle(row.min.y, height, font)},
            hovered ? p.text : p.quiet, shown_part(label));
  const float width = size_of(ui.fonts().small, right).x;
  draw_text(list, ui.fonts().small,
            {row.max.x - pad - width, middle(row.min.y, height, ui.fonts().small)}, p.faint, right);
  ImGui::SetCursorScreenPos({cursor.x, row.max.y});
  ui.record(WidgetKind::section, label, row.min, row.max, open ? "open" : "folded");
  return open;
}

float card_width(const Ui& ui, int columns) {
  const float count = static_cast<float>(std::max(1, columns));
  const float room = ImGui::GetContentRegionAvail().x - (count - 1) * ui.px(ui.theme().metrics.gap);
  return std::max(ui.px(60), std::floor(room / count));
}

CardResult card(Ui& ui, std::string_view title, const std::vector<CardRow>& rows,
                const CardOptions& options) {
  CardResult result;
  ImFont* font = ui.fonts().small;
  ImFont* head = ui.fonts().semibold;
  const float line = font->FontSize + ui.px(3), pad = ui.px(10);
  const float width = options.width > 0 ? std::floor(options.width) : card_width(ui, 1);
  const float height =
      2 * ui.px(8) + head->FontSize + ui.px(3) + line * static_cast<float>(rows.size());
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 end(at.x + width, at.y + height);
  ImGui::PushID(title.data(), title.data() + title.size());
  ImGui::BeginDisabled(!options.enabled);
  result.clicked = ImGui::InvisibleButton("##card", {width, height});
  result.hovered = ImGui::IsItemHovered();
  result.double_clicked = result.hovered && ImGui::IsMouseDoubleClicked(0);
  const bool focused = ImGui::IsItemFocused() && ImGui::GetIO().NavVisible;
  ImGui::EndDisabled();
  ImGui::PopID();
  if (result.hovered) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);

  const Palette& p = ui.palette();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float rounding = ui.px(ui.theme().metrics.rounding);
  list.AddRectFilled(at, end, mixed(p.raised, p.text, result.hovered ? 0.04f : 0), rounding);
  const ImU32 edge = options.selected ? ui.colour(options.selected_tone)
                     : focused        ? p.accent
                     : result.hovered ? mixed(p.line, p.text, 0.2f)
                                      : p.line;
  list.AddRect(at, end, edge, rounding, 0, options.selected ? 1.5f * ui.scale() : 1.0f);
  float y = at.y + ui.px(8);
  draw_text(list, head, {at.x + pad, y}, options.enabled ? p.text : p.faint, shown_part(title),
            width - 2 * pad);
  y += head->FontSize + ui.px(3);
  std::string values;
  for (const CardRow& row : rows) {
    const ImU32 ink = ui.colour(options.enabled ? row.tone : Tone::faint);
    float right = end.x - pad;
    if (row.check) {
      draw_icon(list, Icon::check, {right - ui.px(6), y + font->FontSize / 2}, ui.px(12), ink);
      right -= ui.px(14);
    } else {
      const float value = std::min(size_of(font, row.value).x, width - 2 * pad);
      draw_text(list, font, {right - value, y}, row.tone == Tone::quiet ? p.text : ink, row.value,
                width - 2 * pad);
      right -= value;
    }
    draw_text(list, font, {at.x + pad, y}, ink, row.name,
              std::max(1.0f, right - ui.px(6) - at.x - pad));
    values += (values.empty() ? "" : ", ") + row.name + ' ' + (row.check ? "✓" : row.value);
    y += line;
  }
  explain(ui, options.hint);
  ui.record(WidgetKind::card, title, at, end, values, options.enabled, options.selected);
  return result;
}

}  // namespace elbowroom
