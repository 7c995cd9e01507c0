// SPDX-License-Identifier: MIT
// A user without a window: moves the mouse, clicks, drags, types, and sees every widget by name.
//
//   UiDriver driver(1600, 1000);
//   driver.show([&](Ui& ui) { draw_inspector(ui, state); });
//   driver.click("Plan");
//
// Each action runs the frames it takes. A name that is not there fails the test that asks for it.
#pragma once

#include <imgui.h>

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "ui/toolkit/ui.h"

namespace elbowroom {

struct KeyModifiers {
  bool control = false, shift = false, alt = false;
};

class UiDriver {
 public:
  UiDriver(float width, float height, double scale = 1, Theme theme = dark_theme());
  ~UiDriver();
  UiDriver(const UiDriver&) = delete;
  UiDriver& operator=(const UiDriver&) = delete;

  Ui& ui() { return *ui_; }
  void show(std::function<void(Ui&)> draw);
  void resize(float width, float height);
  // Messages pop up above that height; 0: above the window's lower edge.
  void keep_messages_above(float height) { messages_above_ = height; }

  void frame(int count = 1);
  void wait(double seconds);  // one frame that takes so long

  // nullptr and a test failure if there is none.
  const ProbedWidget* widget(std::string_view name);
  bool has(std::string_view name) const { return ui_->probe().find(name) != nullptr; }
  std::string value(std::string_view name);
  ImVec2 centre(std::string_view name);

  void move_to(ImVec2 place);
  void move_to(std::string_view name) { move_to(centre(name)); }
  void press(int mouse_button = 0);
  void release(int mouse_button = 0);
  void click(ImVec2 place, int mouse_button = 0);
  void click(std::string_view name, int mouse_button = 0) { click(centre(name), mouse_button); }
  void double_click(ImVec2 place);
  void double_click(std::string_view name) { double_click(centre(name)); }
  void drag(ImVec2 from, ImVec2 to, int steps = 8, int mouse_button = 0);
  // By that many pixels from its middle.
  void drag(std::string_view name, ImVec2 by, int steps = 8);
  void wheel(float up, float right = 0);

  // GLFW's codes, as in a real window: letters are ASCII capitals; the others below.
  void key(int code, KeyModifiers modifiers = {});
  void hold(KeyModifiers modifiers);  // until the next call
  void type(std::string_view text);

  std::string dump() const { return ui_->probe().dump(); }
  const std::string& hint() const { return ui_->hint_text(); }
  ImGuiMouseCursor cursor() const { return cursor_; }
  // Draw commands of the last frame, for who draws them.
  ImDrawData* draw_data();

 private:
  ImGuiContext* context_ = nullptr;
  std::unique_ptr<Ui> ui_;
  std::function<void(Ui&)> draw_;
  float messages_above_ = 0;
  ImGuiMouseCursor cursor_ = ImGuiMouseCursor_Arrow;
};

namespace keys {
constexpr int kEscape = 256, kEnter = 257, kTab = 258, kBackspace = 259, kDelete = 261;
constexpr int kRight = 262, kLeft = 263, kDown = 264, kUp = 265, kPageUp = 266, kPageDown = 267;
constexpr int kHome = 268, kEnd = 269, kSpace = 32;
}  // namespace keys

}  // namespace elbowroom
