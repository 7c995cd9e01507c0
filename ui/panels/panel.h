// SPDX-License-Identifier: MIT
// What a panel is handed: the toolkit, the editor's state to read, the view to change, and where
// its commands go. A panel is a function of this that draws one region of the window; to add one,
// copy status_line.cpp.
#pragma once

#include <string>

#include "ui/commands.h"
#include "ui/editor_state.h"
#include "ui/toolkit/geometry.h"
#include "ui/toolkit/layout.h"
#include "ui/toolkit/ui.h"

namespace elbowroom {

struct PanelContext {
  Ui& ui;
  const EditorState& state;
  ViewState& view;
  Commands& commands;

  template <typename T>
  void emit(T command) const {
    commands.emplace_back(std::move(command));
  }
};

// "1.62 s", or "49" as a frame number.
std::string time_text(const EditorState& state, const ViewState& view, double t);
// A length for people, in metres or smaller: "3.1 cm", "0.8 mm". Scene units are taken as metres.
std::string length_text(double metres);
std::string degrees_text(double radians, int decimals = 0);
// How long something took: "240 ms", "8.7 s".
std::string duration_text(double milliseconds);
Phase phase_of(const Edit& edit);
// With a capital at its beginning, if that is a plain letter.
std::string sentence(std::string text);

void draw_menu_bar(const PanelContext& context, const Rect& rect);
void draw_outliner(const PanelContext& context, const Rect& rect);
void draw_inspector(const PanelContext& context, const Rect& rect);
void draw_limb_tab(const PanelContext& context);
void draw_swing_section(const PanelContext& context);
void draw_joints_section(const PanelContext& context);
void draw_target_tab(const PanelContext& context);
void draw_planner_tab(const PanelContext& context);
// The button, progress, the plan's card: always in sight at the inspector's foot.
float plan_section_height(const PanelContext& context);
void draw_plan_section(const PanelContext& context);
constexpr float kTransportHeight = 40;  // the bar above the timeline, pixels at 100 %
void draw_timeline(const PanelContext& context, const Rect& rect);
void draw_status_line(const PanelContext& context, const Rect& rect);
void draw_welcome(const PanelContext& context,
                  const Rect& rect);  // in the viewport, while nothing is open

}  // namespace elbowroom
