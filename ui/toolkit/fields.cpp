// SPDX-License-Identifier: MIT
#include "ui/toolkit/fields.h"

#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "ui/toolkit/buttons.h"
#include "ui/toolkit/geometry.h"

namespace elbowroom {
namespace {

// Where a field's label ends and its box begins; the label takes the left 45 %.
struct FieldLine {
  Rect label, box;
};

FieldLine field_line(const Ui& ui, std::string_view shown, float wanted_width) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float all = wanted_width > 0
                        ? ui.px(wanted_width)
                        : std::max(ui.px(40), std::floor(ImGui::GetContentRegionAvail().x));
  const float height = ui.px(ui.theme().metrics.control - 4);
  const float text = shown.empty() ? 0 : std::max(std::floor(all * 0.45f), 0.0f);
  return {{at, {at.x + text, at.y + height}}, {{at.x + text, at.y}, {at.x + all, at.y + height}}};
}

void draw_field_label(const Ui& ui, const FieldLine& line, std::string_view shown, bool enabled) {
  if (shown.empty()) return;
  ImFont* font = ui.fonts().regular;
  draw_text(*ImGui::GetWindowDrawList(), font,
            {line.label.min.x, middle(line.label.min.y, line.label.height(), font)},
            enabled ? ui.palette().text : ui.palette().faint, shown,
            std::max(1.0f, line.label.width() - ui.px(8)));
}

double put_right(double value, const NumberOptions& options) {
  double low = std::isfinite(options.minimum) ? options.minimum : -1e12;
  double high = std::isfinite(options.maximum) ? options.maximum : 1e12;
  if (low > high) std::swap(low, high);
  return std::clamp(std::isfinite(value) ? value : 0.0, low, high);
}

}  // namespace

std::vector<double> typed_numbers(std::string_view text) {
  // The minus sign and the dashes people see become the hyphen that is parsed.
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::string_view rest = text.substr(i);
    if (rest.starts_with("−") || rest.starts_with("–") || rest.starts_with("—")) {
      plain += '-';
      i += 2;
    } else {
      plain += text[i] == ',' ? '.' : text[i];
    }
  }
  std::vector<double> numbers;
  bool after_number = false;  // then a hyphen separates
  for (std::size_t i = 0; i < plain.size();) {
    const char c = plain[i];
    const bool digit = c >= '0' && c <= '9';
    // "85-140" and "85 - 140" are two numbers, "85 -140" has a minus.
    const bool stands_off =
        i > 0 && plain[i - 1] == ' ' && i + 1 < plain.size() && plain[i + 1] != ' ';
    const bool sign = c == '-' && (!after_number || stands_off);
    if (!digit && !sign && c != '.') {
      // A word or a comma starts anew; blanks and units' signs between number and dash do not.
      if (c == ';' || c == '/' || c == '-') after_number = false;
      ++i;
      continue;
    }
    double value = 0;
    const auto [end, error] = std::from_chars(plain.data() + i, plain.data() + plain.size(), value);
    if (error == std::errc() && std::isfinite(value)) {
      numbers.push_back(value);
      after_number = true;
      i = static_cast<std::size_t>(end - plain.data());
    } else {
      // Too large a number is passed over whole; what is none, a character at a time.
      i = std::max(i + 1, static_cast<std::size_t>(end - plain.data()));
    }
  }
  return numbers;
}

std::optional<double> typed_number(std::string_view text) {
  const std::vector<double> numbers = typed_numbers(text);
  if (numbers.size() != 1) return std::nullopt;
  return numbers.front();
}

Edit number_input(Ui& ui, std::string_view label, double& value, const NumberOptions& options) {
  Edit edit;
  const double given = value;
  const double per = std::isfinite(options.shown_per_value) && options.shown_per_value != 0
                         ? options.shown_per_value
                         : 1.0;
  value = put_right(value, options);
  const std::string_view shown = shown_part(label);
  const FieldLine line = field_line(ui, shown, options.width);
  draw_field_label(ui, line, shown, options.enabled);
  const auto scope =
      ui.scope(static_cast<int>(ImGui::GetID(label.data(), label.data() + label.size())));

  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImGuiID id = ImGui::GetID("##number");
  // [0] 1 while typing, [1] value at the beginning, [2] 1 while dragged, [3] frames typed,
  // [4] the value dragged to: the caller may round what it is given
  std::vector<double>& memory = ui.memory(id);
  if (memory.size() != 5) memory.assign(5, 0);
  const std::string text = number_text(value * per, options.decimals, options.unit);
  ImGuiIO& io = ImGui::GetIO();

  ImGui::SetCursorScreenPos(line.box.min);
  if (memory[0] != 0) {
    std::string& typed = ui.text_memory(id);
    if (memory[3] == 0) typed = number_text(value * per, options.decimals);
    ImGui::PushFont(ui.fonts().regular);
    ImGui::SetNextItemWidth(line.box.width());
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding,
                        {ui.px(8), std::floor((line.box.height() - ImGui::GetFontSize()) / 2)});
    if (memory[3] == 0) ImGui::SetKeyboardFocusHere();
    const bool entered =
        ImGui::InputText("##typed", &typed,
                         ImGuiInputTextFlags_AutoSelectAll | ImGuiInputTextFlags_EnterReturnsTrue);
    const bool left = memory[3] > 1 && !ImGui::IsItemActive();
    const bool escaped = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
    ImGui::PopStyleVar();
    ImGui::PopFont();
    memory[3] += 1;
    if (entered || left) {
      memory[0] = 0;
      const std::optional<double> number = typed_number(typed);
      if (!escaped && number) {
        value = put_right(*number / per, options);
        edit.changed = edit.committed = value != memory[1];
      }
    }
  } else {
    ImGui::BeginDisabled(!options.enabled);
    ImGui::InvisibleButton("##number", {line.box.width(), line.box.height()});
    const bool hovered = ImGui::IsItemHovered();
    if (hovered && options.enabled) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (ImGui::IsItemActivated()) {
      memory[1] = value;
      memory[2] = 0;
    }
    const bool type = (hovered && ImGui::IsMouseDoubleClicked(0)) ||
                      (ImGui::IsItemFocused() && io.NavVisible &&
                       ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false));
    // Dear ImGui itself lets go of the item on Escape, where the keyboard navigates.
    const bool escaped = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
    if (escaped && memory[2] == 1 && (ImGui::IsItemActive() || ImGui::IsItemDeactivated())) {
      value = memory[1];
      edit.changed = edit.cancelled = true;
      memory[2] = 2;
    }
    if (ImGui::IsItemActive() && !type) {
      if (memory[2] == 0 && ImGui::IsMouseDragging(0, ui.px(3))) {
        memory[2] = 1;
        memory[4] = value;
        edit.began = true;
      }
      if (memory[2] == 1) {
        if (io.MouseDelta.x != 0) {
          const double step = options.drag_step > 0
                                  ? options.drag_step
                                  : std::pow(10.0, -std::clamp(options.decimals, 0, 12));
          const double speed = io.KeyShift ? 0.1 : io.KeyCtrl ? 10.0 : 1.0;
          const double by = static_cast<double>(io.MouseDelta.x) / static_cast<double>(ui.scale());
          value = memory[4] = put_right(memory[4] + by * step * speed / per, options);
          edit.changed = value != given;
        }
      }
    }
    if (ImGui::IsItemDeactivated()) {
      if (memory[2] == 1) {
        edit.committed = value != memory[1];
        edit.cancelled = value == memory[1];
      }
      memory[2] = 0;
    }
    if (hovered && options.reset_to && ImGui::IsMouseClicked(1)) {
      const double reset = put_right(*options.reset_to, options);
      edit.changed = edit.committed = reset != value;
      value = reset;
    }
    if (type && options.enabled) {
      memory = {1, value, 0, 0, 0};
      ImGui::ClearActiveID();
    }
    ImGui::EndDisabled();
    const Palette& p = ui.palette();
    list.AddRectFilled(line.box.min, line.box.max,
                       mixed(p.raised, p.text, hovered && options.enabled ? 0.06f : 0),
                       ui.px(ui.theme().metrics.rounding));
    ImFont* font = ui.fonts().regular;
    const float width = std::min(size_of(font, text).x, line.box.width() - ui.px(12));
    draw_text(list, font,
              {line.box.max.x - ui.px(8) - width, middle(line.box.min.y, line.box.height(), font)},
              options.enabled ? p.text : p.faint, text, line.box.width() - ui.px(12));
    explain(ui, options.hint.empty() ? std::string_view("Drag: change · Double-click: type")
                                     : options.hint);
  }
  ui.record(WidgetKind::number, label, line.box.min, line.box.max,
            number_text(value * per, options.decimals, options.unit), options.enabled);
  return edit;
}

TextEdit text_input(Ui& ui, std::string_view label, std::string& text, const TextOptions& options) {
  TextEdit edit;
  const std::string_view shown = options.label_shown ? shown_part(label) : std::string_view();
  const FieldLine line = field_line(ui, shown, options.width);
  draw_field_label(ui, line, shown, options.enabled);
  ImGui::SetCursorScreenPos(line.box.min);
  ImGui::PushID(label.data(), label.data() + label.size());
  ImGui::BeginDisabled(!options.enabled);
  ImGui::SetNextItemWidth(line.box.width());
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding,
                      {ui.px(8), std::floor((line.box.height() - ImGui::GetFontSize()) / 2)});
  // Whoever is led to a field types over what it proposes; the focus comes a frame later.
  ImGuiStorage& storage = *ImGui::GetStateStorage();
  const ImGuiID led_here = ImGui::GetID("led here");
  if (options.focus) {
    ImGui::SetKeyboardFocusHere();
    storage.SetBool(led_here, true);
  }
  const std::string before = text;
  const std::string placeholder(options.placeholder);
  ImGuiInputTextFlags flags = ImGuiInputTextFlags_EnterReturnsTrue;
  if (storage.GetBool(led_here)) flags |= ImGuiInputTextFlags_AutoSelectAll;
  if (options.complete) flags |= ImGuiInputTextFlags_CallbackCompletion;
  const auto complete = [](ImGuiInputTextCallbackData* data) {
    const auto& completion = static_cast<const TextOptions*>(data->UserData)->complete;
    const std::string whole =
        completion(std::string(data->Buf, static_cast<std::size_t>(data->BufTextLen)));
    data->DeleteChars(0, data->BufTextLen);
    data->InsertChars(0, whole.data(), whole.data() + whole.size());
    return 0;
  };
  edit.entered = ImGui::InputTextWithHint(
      "##text", placeholder.c_str(), &text, flags,
      options.complete ? static_cast<ImGuiInputTextCallback>(complete) : nullptr,
      const_cast<TextOptions*>(&options));
  edit.began = ImGui::IsItemActivated();
  if (edit.began) storage.SetBool(led_here, false);
  edit.changed = text != before;
  // Escape reverts the text by itself, and then there is nothing to commit.
  const bool escaped = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
  edit.cancelled = ImGui::IsItemDeactivated() && escaped;
  edit.committed =
      (ImGui::IsItemDeactivatedAfterEdit() || (edit.entered && edit.changed)) && !escaped;
  ImGui::PopStyleVar();
  ImGui::EndDisabled();
  // Over what is being typed a tooltip would be in the way: the status line has it meanwhile.
  if (ImGui::IsItemActive())
    ui.hint(options.hint);
  else
    explain(ui, options.hint);
  ImGui::PopID();
  ui.record(WidgetKind::text_input, label, line.box.min, line.box.max, text, options.enabled);
  return edit;
}

bool combo(Ui& ui, std::string_view label, int& chosen, const std::vector<std::string>& entries,
           const ComboOptions& options) {
  const int count = static_cast<int>(entries.size());
  const std::string preview =
      chosen >= 0 && chosen < count ? entries[static_cast<std::size_t>(chosen)] : std::string("–");
  const std::string_view shown = options.quiet ? std::string_view() : shown_part(label);
  FieldLine line = field_line(ui, shown, options.width);
  ImFont* font = options.quiet ? ui.fonts().small_medium : ui.fonts().regular;
  const float chevron = ui.px(10), pad = options.quiet ? ui.px(4) : ui.px(8);
  if (options.quiet) {
    const float wanted = size_of(font, preview).x + ui.px(6) + chevron + 2 * pad;
    line.box.min.x = std::max(line.box.min.x, std::floor(line.box.max.x - wanted));
    line.box.max.y = line.box.min.y + ui.px(ui.theme().metrics.row);
  }
  draw_field_label(ui, line, shown, options.enabled);
  ui.record(WidgetKind::combo, label, line.box.min, line.box.max, preview, options.enabled);
  const auto scope = ui.scope(label);
  ImGui::SetCursorScreenPos(line.box.min);
  ImGui::BeginDisabled(!options.enabled);
  const bool clicked = ImGui::InvisibleButton("##combo", {line.box.width(), line.box.height()});
  const bool hovered = ImGui::IsItemHovered();
  ImGui::EndDisabled();
  if (hovered && options.enabled) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
  explain(ui, options.hint);
  const Palette& p = ui.palette();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 ink = !options.enabled ? p.faint : options.quiet ? p.accent : p.text;
  if (!options.quiet || hovered) {
    list.AddRectFilled(line.box.min, line.box.max,
                       mixed(p.raised, p.text, hovered && options.enabled ? 0.06f : 0),
                       ui.px(ui.theme().metrics.rounding));
  }
  draw_text(list, font, {line.box.min.x + pad, middle(line.box.min.y, line.box.height(), font)},
            ink, preview, line.box.width() - 2 * pad - chevron - ui.px(6));
  draw_icon(list, Icon::chevron_down,
            {line.box.max.x - pad - chevron / 2, line.box.min.y + line.box.height() / 2}, chevron,
            options.quiet ? ink : p.quiet);
  if (clicked && options.enabled) ImGui::OpenPopup("##list");
  bool changed = false;
  ImGui::SetNextWindowSizeConstraints({std::max(line.box.width(), ui.px(120)), 0},
                                      {ui.px(480), ui.px(420)});
  ImGui::SetNextWindowPos(
      {options.quiet ? line.box.max.x : line.box.min.x, line.box.max.y + ui.px(2)},
      ImGuiCond_Appearing, {options.quiet ? 1.0f : 0.0f, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(4), ui.px(4)});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
  if (ImGui::BeginPopup("##list")) {
    float widest = line.box.width() - 2 * ui.px(4);
    for (const std::string& entry : entries) {
      widest = std::max(widest, size_of(ui.fonts().regular, shown_part(entry)).x + ui.px(40));
    }
    for (int i = 0; i < count; ++i) {
      const std::string& entry = entries[static_cast<std::size_t>(i)];
      const auto row = ui.scope(i);
      const ImVec2 at = ImGui::GetCursorScreenPos();
      const ImVec2 end(at.x + widest, at.y + ui.px(ui.theme().metrics.row));
      if (ImGui::InvisibleButton("##entry", {widest, end.y - at.y})) {
        changed = i != chosen;
        chosen = i;
        ImGui::CloseCurrentPopup();
      }
      ImDrawList& popup = *ImGui::GetWindowDrawList();
      if (ImGui::IsItemHovered() || ImGui::IsItemFocused()) {
        popup.AddRectFilled(at, end, mixed(p.raised, p.accent, 0.22f), ui.px(4));
      }
      ImFont* text = ui.fonts().regular;
      draw_text(popup, text, {at.x + ui.px(26), middle(at.y, end.y - at.y, text)}, p.text,
                shown_part(entry), widest - ui.px(32));
      if (i == chosen) {
        draw_icon(popup, Icon::check, {at.x + ui.px(13), at.y + (end.y - at.y) / 2}, ui.px(12),
                  p.accent);
      }
      ui.record(WidgetKind::menu_item, entry, at, end, {}, true, i == chosen);
    }
    if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false)) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
  }
  ImGui::PopStyleVar(2);
  return changed;
}

bool heading_combo(Ui& ui, std::string_view text, std::string_view name, int& chosen,
                   const std::vector<std::string>& entries, std::string_view hint) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = std::floor(ImGui::GetContentRegionAvail().x);
  const bool inside = chosen >= 0 && chosen < static_cast<int>(entries.size());
  const std::string_view preview =
      inside ? std::string_view(entries[static_cast<std::size_t>(chosen)]) : "–";
  const float choice =
      std::min(std::ceil(size_of(ui.fonts().small_medium, preview).x) + ui.px(28), width);
  const float height = ui.px(ui.theme().metrics.row);
  ImFont* font = ui.fonts().small_medium;
  if (width - choice > ui.px(40)) {
    draw_text(*ImGui::GetWindowDrawList(), font, {at.x, middle(at.y, height, font)},
              ui.palette().quiet, shown_part(text), width - choice - ui.px(4));
  }
  ui.record(WidgetKind::label, text, at, {at.x + width - choice, at.y + height});
  return combo(ui, name, chosen, entries, {.quiet = true, .hint = hint});
}

}  // namespace elbowroom
