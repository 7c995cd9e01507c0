// SPDX-License-Identifier: MIT
#include "ui/toolkit/ui.h"

#include <algorithm>
#include <cmath>

#include "ui/toolkit/icons.h"
#include "ui/toolkit/text.h"

namespace elbowroom {

Ui::Ui(Theme theme, Fonts fonts, double scale) { restyle(theme, std::move(fonts), scale); }

void Ui::restyle(Theme theme, Fonts fonts, double scale) {
  theme_ = theme;
  fonts_ = std::move(fonts);
  scale_ = usable_scale(scale);
}

float Ui::px(float size) const {
  const float rounded = std::round(size * scale_);
  return size > 0 ? std::max(1.0f, rounded) : rounded;
}

void Ui::begin_frame() {
  probe_.clear();
  path_.clear();
  hint_.clear();
  takes_keys_ = takes_enter_ = false;
  if (ImGui::GetIO().MouseDown[0] == false && memory_.size() > 4096) memory_.clear();
}

void Ui::end_frame(float bottom) {
  const ImGuiIO& io = ImGui::GetIO();
  for (Toast& toast : toasts_) {
    if (toast.tone != Tone::problem) toast.seconds_left -= static_cast<double>(io.DeltaTime);
  }
  std::erase_if(toasts_, [](const Toast& toast) { return toast.seconds_left <= 0; });
  float y = (bottom > 0 ? bottom : io.DisplaySize.y) - px(12);
  for (std::size_t i = toasts_.size(); i-- > 0;) draw_toast(i, y);
  last_hint_ = hint_;
  last_takes_keys_ = takes_keys_;
  last_takes_enter_ = takes_enter_;
}

bool Ui::has_keys(int key) const {
  if (ImGui::GetKeyIndex(ImGuiKey_Enter) == key) return last_takes_enter_;
  if (!last_takes_keys_) return false;
  for (const ImGuiKey taken : {ImGuiKey_LeftArrow, ImGuiKey_RightArrow, ImGuiKey_UpArrow,
                               ImGuiKey_DownArrow, ImGuiKey_Home})
    if (ImGui::GetKeyIndex(taken) == key) return true;
  return false;
}

void Ui::toast(Tone tone, std::string text, std::string remedy) {
  // The same message again is no news: it starts anew instead of piling up.
  std::erase_if(toasts_, [&text](const Toast& toast) { return toast.what == text; });
  if (toasts_.size() >= 4) toasts_.erase(toasts_.begin());
  toasts_.push_back({tone, std::move(text), {}, std::move(remedy), 5});
}

void Ui::toast(const Error& error) {
  toast(Tone::problem, error.what, error.remedy);
  toasts_.back().where = error.where;
}

bool Ui::animating() const {
  return std::any_of(toasts_.begin(), toasts_.end(),
                     [](const Toast& toast) { return toast.tone != Tone::problem; });
}

void Ui::draw_toast(std::size_t index, float& bottom) {
  Toast& toast = toasts_[index];
  ImFont* font = fonts_.regular;
  const float display = ImGui::GetIO().DisplaySize.x;
  const float pad = px(12), line = font->FontSize, icon = px(16);
  const float most = std::max(px(120), std::min(px(560), display - px(40)));
  std::string second = toast.where;
  if (!toast.remedy.empty()) second += (second.empty() ? "" : " · ") + toast.remedy;
  const float wrap = most - 3 * pad - 2 * icon;
  const auto block = [](ImFont* with, const std::string& text) {
    return with->CalcTextSizeA(with->FontSize, std::numeric_limits<float>::max(), 0, text.c_str());
  };
  const std::string first = wrapped(font, toast.what, wrap);
  second = wrapped(fonts_.small, second, wrap);
  const ImVec2 first_size = block(font, first);
  const ImVec2 second_size = second.empty() ? ImVec2(0, 0) : block(fonts_.small, second);
  const float width = std::round(std::max(first_size.x, second_size.x) + 3 * pad + 2 * icon);
  const float height = std::round(std::max(line, first_size.y) +
                                  (second.empty() ? 0 : second_size.y + px(4)) + 2 * px(9));
  const ImVec2 at(std::floor((display - width) / 2), std::floor(bottom - height));
  bottom = at.y - px(8);

  ImGui::SetNextWindowPos(at);
  ImGui::SetNextWindowSize({width, height});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
  const std::string id = "##toast" + std::to_string(index);
  ImGui::Begin(id.c_str(), nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav |
                   ImGuiWindowFlags_NoBackground);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 end(at.x + width, at.y + height);
  list.AddRectFilled(at, end, palette().raised, px(6));
  list.AddRect(at, end, mixed(palette().line, colour(toast.tone), 0.5f), px(6));
  const float x = at.x + pad;
  const Icon sign = toast.tone == Tone::problem ? Icon::warning
                    : toast.tone == Tone::good  ? Icon::check
                                                : Icon::dot;
  draw_icon(list, sign, {x + icon / 2, at.y + px(9) + std::round(line / 2)}, icon,
            colour(toast.tone));
  list.AddText(font, font->FontSize, {x + icon + px(8), at.y + px(9)}, palette().text,
               first.c_str());
  if (!second.empty()) {
    list.AddText(fonts_.small, fonts_.small->FontSize,
                 {x + icon + px(8), at.y + px(9) + first_size.y + px(4)}, palette().quiet,
                 second.c_str());
  }
  ImGui::SetCursorScreenPos(at);
  if (ImGui::InvisibleButton("dismiss", {width, height})) toast.seconds_left = 0;
  if (ImGui::IsItemHovered()) hint("Click: dismiss");
  draw_icon(list, Icon::close, {end.x - pad - icon / 2, at.y + px(9) + std::round(line / 2)},
            px(12), ImGui::IsItemHovered() ? palette().text : palette().faint);
  record(WidgetKind::toast, toast.what, at, end, second);
  ImGui::End();
  ImGui::PopStyleVar(2);
  // A problem does not count down, so its dismissal is carried out at the next frame's end.
}

void Ui::record(WidgetKind kind, std::string_view label, ImVec2 min, ImVec2 max, std::string value,
                bool enabled, bool selected) {
  ProbedWidget widget;
  for (const std::string& part : path_) widget.path += part + '/';
  widget.name = name_part(label);
  widget.label = shown_part(label);
  widget.path += widget.name;
  widget.kind = kind;
  const ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 from = list.GetClipRectMin(), to = list.GetClipRectMax();
  widget.min = {std::max(min.x, from.x), std::max(min.y, from.y)};
  widget.max = {std::min(max.x, to.x), std::min(max.y, to.y)};
  widget.visible = widget.min.x < widget.max.x && widget.min.y < widget.max.y;
  if (!widget.visible) {
    widget.min = min;
    widget.max = max;
  }
  widget.value = std::move(value);
  widget.enabled = enabled;
  widget.selected = selected;
  probe_.add(std::move(widget));
}

Ui::Scope::Scope(Ui& ui, std::string_view name) : ui_(&ui), named_(true) {
  ui.path_.emplace_back(name_part(name));
  ImGui::PushID(name.data(), name.data() + name.size());
}

Ui::Scope::Scope(Ui& ui, int number) : ui_(&ui), named_(false) { ImGui::PushID(number); }

Ui::Scope::~Scope() {
  ImGui::PopID();
  if (named_ && !ui_->path_.empty()) ui_->path_.pop_back();
}

ImVec2 size_of(ImFont* font, std::string_view text) {
  if (text.empty()) return {0, font->FontSize};
  return font->CalcTextSizeA(font->FontSize, std::numeric_limits<float>::max(), 0, text.data(),
                             text.data() + text.size());
}

float draw_text(ImDrawList& list, ImFont* font, ImVec2 at, ImU32 colour, std::string_view text,
                float width) {
  if (text.empty()) return 0;
  const ImVec2 whole(std::round(at.x), std::round(at.y));
  const char* end = text.data() + text.size();
  float drawn = size_of(font, text).x;
  if (!(width > 0) || drawn <= width) {
    list.AddText(font, font->FontSize, whole, colour, text.data(), end);
    return drawn;
  }
  const float dots = size_of(font, "…").x;
  const char* cut = text.data();
  drawn =
      font->CalcTextSizeA(font->FontSize, std::max(0.0f, width - dots), 0, text.data(), end, &cut)
          .x;
  while (cut > text.data() && cut[-1] == ' ') --cut;
  drawn = cut > text.data()
              ? size_of(font, text.substr(0, static_cast<std::size_t>(cut - text.data()))).x
              : 0;
  if (cut > text.data()) list.AddText(font, font->FontSize, whole, colour, text.data(), cut);
  list.AddText(font, font->FontSize, {whole.x + drawn, whole.y}, colour, "…");
  return drawn + dots;
}

}  // namespace elbowroom
