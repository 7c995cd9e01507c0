// SPDX-License-Identifier: MIT
#include "ui/toolkit/text.h"

#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "ui/toolkit/geometry.h"

namespace elbowroom {
namespace {

struct LineLook {
  ImFont* font;
  ImFont* right_font;
  ImU32 colour, right_colour;
  float height;
};

void line(Ui& ui, std::string_view text, std::string_view right, const LineLook& look) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = std::max(1.0f, std::floor(ImGui::GetContentRegionAvail().x));
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const std::string_view shown = shown_part(text);
  // The text on the left comes first; where it leaves only a stump of the right one, that goes.
  const float gap = ui.px(8), rest = width - std::ceil(size_of(look.font, shown).x) - gap;
  float right_width = right.empty() ? 0 : std::min(size_of(look.right_font, right).x, rest);
  if (right_width < ui.px(24) && right_width < size_of(look.right_font, right).x) right_width = 0;
  const float room = std::max(1.0f, width - (right_width > 0 ? right_width + gap : 0));
  draw_text(list, look.font, {at.x, middle(at.y, look.height, look.font)}, look.colour, shown,
            room);
  if (right_width > 0) {
    draw_text(list, look.right_font,
              {at.x + width - right_width, middle(at.y, look.height, look.right_font)},
              look.right_colour, right, right_width + 0.5f);
  }
  ImGui::Dummy({width, look.height});
  const bool cut = size_of(look.font, shown).x > room;
  if (cut && ImGui::IsItemHovered()) explain(ui, {}, shown);
  ui.record(WidgetKind::label, text, at, {at.x + width, at.y + look.height}, std::string(right));
}

// Takes the usual gap back, so that what follows stands directly below.
void close_up() { ImGui::SetCursorPosY(ImGui::GetCursorPosY() - ImGui::GetStyle().ItemSpacing.y); }

}  // namespace

void label(Ui& ui, std::string_view text, std::string_view right, Tone tone, Tone right_tone) {
  line(ui, text, right,
       {ui.fonts().regular, ui.fonts().regular, ui.colour(tone), ui.colour(right_tone),
        ui.fonts().regular->FontSize + ui.px(2)});
}

void heading(Ui& ui, std::string_view text, std::string_view right) {
  line(ui, text, right,
       {ui.fonts().small_medium, ui.fonts().small, ui.palette().quiet, ui.palette().faint,
        ui.px(ui.theme().metrics.row)});
  close_up();
}

void title(Ui& ui, std::string_view text, std::string_view right) {
  line(ui, text, right,
       {ui.fonts().semibold, ui.fonts().small, ui.palette().text, ui.palette().quiet,
        ui.px(ui.theme().metrics.row)});
}

std::string wrapped(ImFont* font, std::string_view text, float width) {
  std::string result;
  float line = 0;  // pixels of the line so far
  const float blank = size_of(font, " ").x;
  const auto end_line = [&] {
    result += '\n';
    line = 0;
  };
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find_first_of(" \n", at), text.size());
    std::string_view word = text.substr(at, end - at);
    if (line > 0 && line + blank + size_of(font, word).x > width) {
      end_line();
    } else if (line > 0) {
      result += ' ';
      line += blank;
    }
    // What is wider than a whole line goes over several, at least a sign on each.
    while (!word.empty() && size_of(font, word).x > width) {
      const char* cut = nullptr;
      font->CalcTextSizeA(font->FontSize, std::max(width, 1.0f), 0, word.data(),
                          word.data() + word.size(), &cut);
      std::size_t fits = static_cast<std::size_t>(cut - word.data());
      if (fits == 0)
        for (fits = 1; fits < word.size() && (word[fits] & 0xc0) == 0x80;) ++fits;
      if (fits >= word.size()) break;
      result += word.substr(0, fits);
      word.remove_prefix(fits);
      end_line();
    }
    result += word;
    line += size_of(font, word).x;
    if (end < text.size() && text[end] == '\n') end_line();
    at = end + 1;
  }
  return result;
}

void note(Ui& ui, std::string_view text, Tone tone) {
  ImFont* font = ui.fonts().small;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = std::max(ui.px(40), ImGui::GetContentRegionAvail().x);
  const std::string lines = wrapped(font, text, width);
  const ImVec2 size = font->CalcTextSizeA(font->FontSize, std::numeric_limits<float>::max(), 0,
                                          lines.data(), lines.data() + lines.size());
  ImGui::GetWindowDrawList()->AddText(font, font->FontSize, at, ui.colour(tone), lines.data(),
                                      lines.data() + lines.size());
  ImGui::Dummy({width, std::max(size.y, font->FontSize)});
  ui.record(WidgetKind::label, text, at, {at.x + width, at.y + size.y});
}

void inline_text(Ui& ui, std::string_view text, Tone tone) {
  ImFont* font = ui.fonts().regular;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float height = ui.px(ui.theme().metrics.control);
  const std::string_view shown = shown_part(text);
  const ImVec2 size(std::ceil(size_of(font, shown).x), height);
  draw_text(*ImGui::GetWindowDrawList(), font, {at.x, middle(at.y, height, font)}, ui.colour(tone),
            shown);
  ImGui::Dummy(size);
  ui.record(WidgetKind::label, text, at, {at.x + size.x, at.y + size.y});
}

void separator(Ui& ui) {
  space(ui, 5);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  // Dear ImGui cuts drawings off at half the panel's padding; this goes to the edges.
  const ImRect inner = ImGui::GetCurrentWindow()->InnerRect;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.PushClipRect({inner.Min.x, list.GetClipRectMin().y}, {inner.Max.x, list.GetClipRectMax().y});
  list.AddRectFilled({inner.Min.x, at.y}, {inner.Max.x, at.y + ui.px(1)}, ui.palette().line);
  list.PopClipRect();
  ImGui::Dummy({1, ui.px(1)});
  space(ui, 1);
}

void space(Ui& ui, float pixels) { ImGui::SetCursorPosY(ImGui::GetCursorPosY() + ui.px(pixels)); }

ImVec2 key_cap_size(const Ui& ui, std::string_view keys) {
  ImFont* font = ui.fonts().small;
  return {std::ceil(size_of(font, keys).x) + 2 * ui.px(6), font->FontSize + 2 * ui.px(2)};
}

void draw_key_cap(const Ui& ui, ImDrawList& list, ImVec2 right_centre, std::string_view keys) {
  const ImVec2 size = key_cap_size(ui, keys);
  const ImVec2 at(std::round(right_centre.x - size.x), std::round(right_centre.y - size.y / 2));
  list.AddRectFilled(at, {at.x + size.x, at.y + size.y}, ui.palette().panel, ui.px(4));
  list.AddRect(at, {at.x + size.x, at.y + size.y},
               mixed(ui.palette().line, ui.palette().text, 0.1f), ui.px(4));
  draw_text(list, ui.fonts().small, {at.x + ui.px(6), at.y + ui.px(2)}, ui.palette().quiet, keys);
}

ImVec2 key_cap(Ui& ui, std::string_view keys) {
  const ImVec2 size = key_cap_size(ui, keys);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  draw_key_cap(ui, *ImGui::GetWindowDrawList(), {at.x + size.x, at.y + size.y / 2}, keys);
  ImGui::Dummy(size);
  return size;
}

void explain(Ui& ui, std::string_view hint, std::string_view tooltip, std::string_view keys) {
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  if (!hint.empty()) ui.hint(hint);
  const std::string_view text = tooltip.empty() ? hint : tooltip;
  // At rest only: a tooltip under a moving pointer is in the way.
  if (text.empty() || ImGui::IsMouseDown(0) || ImGui::GetIO().MouseDelta.x != 0) return;
  if (!ImGui::IsMouseHoveringRect(ImGui::GetItemRectMin(), ImGui::GetItemRectMax())) return;
  ImFont* font = ui.fonts().small;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(9), ui.px(6)});
  ImGui::BeginTooltip();
  ImGui::PushFont(font);
  ImGui::PushTextWrapPos(ui.px(340));
  ImGui::TextUnformatted(text.data(), text.data() + text.size());
  ImGui::PopTextWrapPos();
  if (!keys.empty()) {
    ImGui::SameLine();
    key_cap(ui, keys);
  }
  ImGui::PopFont();
  ImGui::EndTooltip();
  ImGui::PopStyleVar();
}

std::string number_text(double value, int decimals, std::string_view unit) {
  if (!std::isfinite(value)) return "–";
  char buffer[400];
  std::snprintf(buffer, sizeof buffer, "%.*f", std::clamp(decimals, 0, 12), std::abs(value));
  const bool zero = std::string_view(buffer).find_first_not_of("0.") == std::string_view::npos;
  std::string text = (value < 0 && !zero ? "−" : "") + std::string(buffer);
  if (!unit.empty() && unit != "°" && unit != "×") text += ' ';
  text += unit;
  return text;
}

}  // namespace elbowroom
