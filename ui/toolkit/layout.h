// SPDX-License-Identifier: MIT
// Where things are: panels at fixed places, splitters between them, and keys.
#pragma once

#include <string>
#include <string_view>

#include "ui/toolkit/geometry.h"
#include "ui/toolkit/ui.h"

namespace elbowroom {

enum class PanelGround { panel, ground, raised, none };  // none: what lies below shows
struct PanelOptions {
  PanelGround ground = PanelGround::panel;
  bool padded = true;
  bool scrolls = true;
};
// A panel at a place of the screen; widgets inside are named "Inspector/…". Lives until the end of
// the block:
//   Panel panel(ui, "Inspector", rect);
class Panel {
 public:
  Panel(Ui& ui, std::string_view name, const Rect& place, const PanelOptions& options = {});
  ~Panel();
  Panel(const Panel&) = delete;
  Panel& operator=(const Panel&) = delete;

 private:
  // The order counts: the names end before the window does.
  struct Window {
    Window(Ui& ui, std::string_view name, const Rect& place, const PanelOptions& options);
    ~Window();
  };
  Window window_;
  Ui::Scope scope_;
};

// What a panel's contents took in the last frame in which it was drawn, pixels on the screen with
// the air above and below; 0 before the first.
float panel_content_height(std::string_view name);

// The strip between two panels. `ratio` is the first one's share of `extent` pixels, kept within
// [least, most]; double-click sets `reset_to`. Draws a hairline; the grip reaches over both sides.
// Call after the panels (it opens a small window of its own above them).
Edit splitter_between_columns(Ui& ui, std::string_view name, float x, float top, float bottom,
                              double& ratio, float extent, double least = 0.1, double most = 0.9,
                              double reset_to = 0.5);
Edit splitter_between_rows(Ui& ui, std::string_view name, float y, float left, float right,
                           double& ratio, float extent, double least = 0.1, double most = 0.9,
                           double reset_to = 0.5);

// Whether these keys were pressed in this frame, and no text is being typed: "P", "Ctrl+S",
// "Ctrl+Shift+Z", "Space", "F1", "Left", "Delete", "?". Modifiers have to match exactly. Key codes
// are GLFW's, as Dear ImGui's backend hands them on. Repeats only where `repeat`.
bool keys_pressed(std::string_view keys, bool repeat = false);

}  // namespace elbowroom
