// SPDX-License-Identifier: MIT
#include "ui/toolkit/probe.h"

#include <algorithm>

namespace elbowroom {

const char* name_of(WidgetKind kind) {
  switch (kind) {
    case WidgetKind::panel:
      return "panel";
    case WidgetKind::label:
      return "label";
    case WidgetKind::button:
      return "button";
    case WidgetKind::icon_button:
      return "icon";
    case WidgetKind::toggle:
      return "toggle";
    case WidgetKind::tab:
      return "tab";
    case WidgetKind::section:
      return "section";
    case WidgetKind::row:
      return "row";
    case WidgetKind::combo:
      return "combo";
    case WidgetKind::number:
      return "number";
    case WidgetKind::text_input:
      return "text";
    case WidgetKind::progress:
      return "progress";
    case WidgetKind::splitter:
      return "splitter";
    case WidgetKind::toast:
      return "toast";
    case WidgetKind::error:
      return "error";
    case WidgetKind::modal:
      return "dialog";
    case WidgetKind::card:
      return "card";
    case WidgetKind::menu:
      return "menu";
    case WidgetKind::menu_item:
      return "item";
    case WidgetKind::range:
      return "range";
    case WidgetKind::timeline:
      return "timeline";
    case WidgetKind::mark:
      return "mark";
    case WidgetKind::picture:
      return "picture";
  }
  return "widget";
}

std::string_view shown_part(std::string_view label) { return label.substr(0, label.find("##")); }

std::string_view name_part(std::string_view label) {
  if (const auto fixed = label.find("###"); fixed != std::string_view::npos) {
    return label.substr(fixed + 3);
  }
  const std::string_view shown = shown_part(label);
  if (!shown.empty() || label.size() < 2) return shown;
  return label.substr(2);
}

const ProbedWidget* Probe::find(std::string_view wanted) const {
  const auto ends = [wanted](const std::string& path) {
    return path.size() > wanted.size() && path.ends_with(wanted) &&
           path[path.size() - wanted.size() - 1] == '/';
  };
  const ProbedWidget* best = nullptr;
  int best_rank = 100;
  for (const ProbedWidget& widget : widgets_) {
    int rank = widget.path == wanted    ? 0
               : widget.name == wanted  ? 1
               : widget.label == wanted ? 2
               : ends(widget.path)      ? 3
                                        : 100;
    if (rank == 100) continue;
    if (widget.kind == WidgetKind::label || widget.kind == WidgetKind::panel) rank += 10;
    if (!widget.visible) rank += 20;
    if (rank < best_rank) {
      best_rank = rank;
      best = &widget;
    }
  }
  return best;
}

std::string Probe::dump() const {
  std::string text;
  for (const ProbedWidget& widget : widgets_) {
    const auto depth = std::count(widget.path.begin(), widget.path.end(), '/');
    text.append(static_cast<std::size_t>(2 * depth), ' ');
    text += name_of(widget.kind);
    text += " \"" + (widget.label.empty() ? widget.name : widget.label) + '"';
    if (!widget.label.empty() && widget.name != widget.label) text += " #" + widget.name;
    if (!widget.value.empty()) text += " = " + widget.value;
    if (widget.selected) text += " (selected)";
    if (!widget.enabled) text += " (off)";
    if (!widget.visible) text += " (out of sight)";
    text += '\n';
  }
  return text;
}

}  // namespace elbowroom
