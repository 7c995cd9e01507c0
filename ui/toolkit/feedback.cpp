// SPDX-License-Identifier: MIT
#include "ui/toolkit/feedback.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ui/toolkit/buttons.h"
#include "ui/toolkit/geometry.h"
#include "ui/toolkit/text.h"

namespace elbowroom {

bool progress(Ui& ui, std::string_view label, std::optional<double> fraction,
              const ProgressOptions& options) {
  const auto scope = ui.scope(label);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float all = std::max(ui.px(60), std::floor(ImGui::GetContentRegionAvail().x));
  ImFont* font = ui.fonts().small;
  const float bar = ui.px(6), height = font->FontSize + ui.px(6) + bar;
  const float side = ui.px(28);
  const float width = options.can_cancel ? all - side - ui.px(6) : all;
  const Palette& p = ui.palette();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  std::string right(options.right);
  double share = 0;
  if (fraction) {
    share = std::clamp(std::isfinite(*fraction) ? *fraction : 0.0, 0.0, 1.0);
    right = number_text(std::floor(100 * share), 0, "%") + (right.empty() ? "" : " · ") + right;
  }
  const float right_width = size_of(font, right).x;
  draw_text(list, font, {at.x + width - right_width, at.y}, p.quiet, right);
  draw_text(list, font, at, p.text, shown_part(label),
            std::max(1.0f, width - right_width - ui.px(8)));
  const ImVec2 from(at.x, at.y + height - bar), to(at.x + width, at.y + height);
  list.AddRectFilled(from, to, p.line, bar / 2);
  if (fraction) {
    const float filled = std::max(bar, static_cast<float>(share) * width);
    list.AddRectFilled(from, {from.x + filled, to.y}, ui.colour(options.tone), bar / 2);
  } else {
    const double turn = std::fmod(ImGui::GetTime() * 0.6, 1.0);
    const float piece = 0.25f * width;
    const float x = from.x + static_cast<float>(turn) * (width + piece) - piece;
    list.AddRectFilled({std::max(from.x, x), from.y}, {std::min(to.x, x + piece), to.y},
                       ui.colour(options.tone), bar / 2);
  }
  ui.record(WidgetKind::progress, label, at, to, right);
  bool cancelled = false;
  if (options.can_cancel) {
    ImGui::SetCursorScreenPos({at.x + all - side, at.y + std::floor((height - side) / 2)});
    cancelled = icon_button(ui, "Cancel", Icon::close, {.hint = "Cancel", .size = 28});
    ImGui::SetCursorScreenPos(at);
  }
  ImGui::Dummy({all, height});
  return cancelled;
}

bool inline_note(Ui& ui, Tone tone, std::string_view what_text, std::string_view more_text,
                 bool can_dismiss) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = std::max(ui.px(80), std::floor(ImGui::GetContentRegionAvail().x));
  const float pad = ui.px(10), icon = ui.px(16);
  ImFont* font = ui.fonts().regular;
  ImFont* small = ui.fonts().small;
  const float wrap = width - 2 * pad - icon - ui.px(8) - (can_dismiss ? ui.px(22) : 0);
  const std::string what = wrapped(font, what_text, wrap), more = wrapped(small, more_text, wrap);
  const auto block = [](ImFont* with, const std::string& text) {
    return text.empty() ? 0.0f
                        : with->CalcTextSizeA(with->FontSize, std::numeric_limits<float>::max(), 0,
                                              text.data(), text.data() + text.size())
                              .y;
  };
  const float first = block(font, what), second = block(small, more);
  const float height = std::round(first + (more.empty() ? 0 : second + ui.px(3)) + 2 * ui.px(8));
  const ImVec2 end(at.x + width, at.y + height);
  const Palette& p = ui.palette();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float rounding = ui.px(ui.theme().metrics.rounding);
  list.AddRectFilled(at, end, mixed(p.panel, ui.colour(tone), 0.1f), rounding);
  const Icon sign = tone == Tone::problem ? Icon::warning
                    : tone == Tone::good  ? Icon::check
                                          : Icon::dot;
  draw_icon(list, sign, {at.x + pad + icon / 2, at.y + ui.px(8) + font->FontSize / 2}, icon,
            ui.colour(tone));
  const float x = at.x + pad + icon + ui.px(8);
  if (!what.empty()) {
    list.AddText(font, font->FontSize, {x, at.y + ui.px(8)}, p.text, what.data(),
                 what.data() + what.size());
  }
  if (!more.empty()) {
    list.AddText(small, small->FontSize, {x, at.y + ui.px(8) + first + ui.px(3)}, p.quiet,
                 more.data(), more.data() + more.size());
  }
  ui.record(WidgetKind::error, what_text, at, end, std::string(more_text));
  bool dismissed = false;
  if (can_dismiss) {
    const auto scope = ui.scope(what_text);
    ImGui::SetCursorScreenPos({end.x - ui.px(30), at.y + ui.px(4)});
    dismissed = icon_button(ui, "Dismiss", Icon::close, {.size = 26});
    ImGui::SetCursorScreenPos(at);
  }
  ImGui::Dummy({width, height});
  return dismissed;
}

bool inline_error(Ui& ui, const Error& error, bool can_dismiss) {
  std::string more = error.where;
  if (!error.remedy.empty()) more += (more.empty() ? "" : "\n") + error.remedy;
  return inline_note(ui, Tone::problem, error.what, more, can_dismiss);
}

bool begin_dialog(Ui& ui, std::string_view title, bool& open, ImVec2 size, bool escape_closes) {
  const std::string id = std::string(shown_part(title)) + "###" + std::string(name_part(title));
  if (open && !ImGui::IsPopupOpen(id.c_str())) ImGui::OpenPopup(id.c_str());
  if (!open && !ImGui::IsPopupOpen(id.c_str())) return false;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float edge = ui.px(12);
  const ImVec2 fits(std::max(1.0f, std::min(ui.px(size.x), display.x - 2 * edge)),
                    size.y > 0 ? std::max(1.0f, std::min(ui.px(size.y), display.y - 2 * edge)) : 0);
  ImGui::SetNextWindowSize(fits);
  ImGui::SetNextWindowPos({std::floor((display.x - fits.x) / 2),
                           std::floor(fits.y > 0 ? (display.y - fits.y) / 2 : display.y * 0.3f)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(18), ui.px(14)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, ui.px(8));
  ImGui::PushStyleColor(ImGuiCol_PopupBg, ui.palette().panel);
  const bool shown = ImGui::BeginPopupModal(
      id.c_str(), nullptr,
      ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
          ImGuiWindowFlags_NoSavedSettings |
          (size.y > 0 ? 0 : ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoScrollbar));
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(2);
  if (!shown) return false;
  const ImVec2 at = ImGui::GetWindowPos(), extent = ImGui::GetWindowSize();
  ui.record(WidgetKind::modal, title, at, {at.x + extent.x, at.y + extent.y});
  ui.enter(title);
  // A popup inside (a list) takes the first Escape.
  if (open && escape_closes && ImGui::IsWindowFocused(ImGuiFocusedFlags_RootAndChildWindows) &&
      !ImGui::IsAnyItemActive() &&
      ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false)) {
    open = false;
  }
  elbowroom::title(ui, shown_part(title));
  if (!open) ImGui::CloseCurrentPopup();
  return true;
}

void end_dialog(Ui& ui) {
  ui.leave();
  ImGui::EndPopup();
}

std::optional<int> ask(Ui& ui, bool& open, const Question& question) {
  const int count = static_cast<int>(question.answers.size());
  if (!open || count == 0) return std::nullopt;
  std::optional<int> answer;
  if (!begin_dialog(ui, question.title, open, {460, 0}, false)) return std::nullopt;
  if (!question.text.empty()) note(ui, question.text);
  space(ui, 10);
  // The primary answer stands at the right edge, where the eye ends.
  float total = 0;
  const auto look = [&question](int i) {
    return i == 0                    ? ButtonLook::primary
           : i == question.dangerous ? ButtonLook::danger
                                     : ButtonLook::secondary;
  };
  for (int i = 0; i < count; ++i) {
    total += button_width(ui, question.answers[static_cast<std::size_t>(i)], {.look = look(i)}) +
             (i > 0 ? ui.px(ui.theme().metrics.gap) : 0);
  }
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() +
                       std::max(0.0f, ImGui::GetContentRegionAvail().x - total));
  for (int i = count - 1; i >= 0; --i) {
    if (button(ui, question.answers[static_cast<std::size_t>(i)], {.look = look(i)})) answer = i;
    if (i > 0) ImGui::SameLine();
  }
  const auto pressed = [](ImGuiKey key) {
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), false);
  };
  // Not in the frame it appears in: the key that brought it up is still down.
  if (!ImGui::IsWindowAppearing() && !answer) {
    if (pressed(ImGuiKey_Enter) || pressed(ImGuiKey_KeyPadEnter)) answer = 0;
    if (pressed(ImGuiKey_Escape)) {
      answer =
          question.on_escape >= 0 && question.on_escape < count ? question.on_escape : count - 1;
    }
  }
  if (answer) {
    open = false;
    ImGui::CloseCurrentPopup();
  }
  end_dialog(ui);
  return answer;
}

}  // namespace elbowroom
