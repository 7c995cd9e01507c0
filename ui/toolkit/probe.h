// SPDX-License-Identifier: MIT
// A record of every widget of the frame: what it is called, where it is, what it shows. Tests find
// and click widgets by name without a window, `dump` prints the whole window as text, and the
// command palette can list what there is.
#pragma once

#include <imgui.h>

#include <string>
#include <string_view>
#include <vector>

namespace elbowroom {

enum class WidgetKind {
  panel,
  label,
  button,
  icon_button,
  toggle,
  tab,
  section,
  row,
  combo,
  number,
  text_input,
  progress,
  splitter,
  toast,
  error,
  modal,
  card,
  menu,
  menu_item,
  range,
  timeline,
  mark,
  picture
};
const char* name_of(WidgetKind kind);

struct ProbedWidget {
  std::string path;   // the names of the scopes around it and its own, "Inspector/Limb/Plan"
  std::string name;   // the last part: stable from frame to frame
  std::string label;  // as shown
  WidgetKind kind = WidgetKind::label;
  ImVec2 min, max;    // on the screen, cut off at the panel's edge
  std::string value;  // as shown: "85° – 140°", "on", "34 %"
  bool enabled = true;
  bool selected = false;
  bool visible = true;  // false: scrolled out of sight, or covered by nothing but not drawn

  ImVec2 centre() const { return {0.5f * (min.x + max.x), 0.5f * (min.y + max.y)}; }
};

class Probe {
 public:
  void clear() { widgets_.clear(); }
  void add(ProbedWidget widget) { widgets_.push_back(std::move(widget)); }

  const std::vector<ProbedWidget>& widgets() const { return widgets_; }
  // The first widget with that path, name, label or end of path ("Limb/Plan"), in this order of
  // preference; visible before not visible; labels of text come last. nullptr: none.
  const ProbedWidget* find(std::string_view wanted) const;
  // One line a widget: indentation by depth, kind, label, value, "off" and "selected".
  std::string dump() const;

 private:
  std::vector<ProbedWidget> widgets_;
};

// The parts of a Dear ImGui label. "Plan 1.2 s###plan" shows "Plan 1.2 s" and is named "plan";
// "Delete##3" shows "Delete" and is named so; "##speed" shows nothing and is named "speed".
std::string_view shown_part(std::string_view label);
std::string_view name_part(std::string_view label);

}  // namespace elbowroom
