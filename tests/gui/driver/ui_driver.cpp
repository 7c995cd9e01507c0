// SPDX-License-Identifier: MIT
#include "tests/gui/driver/ui_driver.h"

#include <gtest/gtest.h>

#include <utility>

namespace elbowroom {
namespace {

void map_keys(ImGuiIO& io) {
  const std::pair<ImGuiKey, int> pairs[] = {{ImGuiKey_Tab, keys::kTab},
                                            {ImGuiKey_LeftArrow, keys::kLeft},
                                            {ImGuiKey_RightArrow, keys::kRight},
                                            {ImGuiKey_UpArrow, keys::kUp},
                                            {ImGuiKey_DownArrow, keys::kDown},
                                            {ImGuiKey_PageUp, keys::kPageUp},
                                            {ImGuiKey_PageDown, keys::kPageDown},
                                            {ImGuiKey_Home, keys::kHome},
                                            {ImGuiKey_End, keys::kEnd},
                                            {ImGuiKey_Delete, keys::kDelete},
                                            {ImGuiKey_Backspace, keys::kBackspace},
                                            {ImGuiKey_Space, keys::kSpace},
                                            {ImGuiKey_Enter, keys::kEnter},
                                            {ImGuiKey_Escape, keys::kEscape},
                                            {ImGuiKey_A, 'A'},
                                            {ImGuiKey_C, 'C'},
                                            {ImGuiKey_V, 'V'},
                                            {ImGuiKey_X, 'X'},
                                            {ImGuiKey_Y, 'Y'},
                                            {ImGuiKey_Z, 'Z'}};
  for (const auto& [key, code] : pairs) io.KeyMap[key] = code;
}

}  // namespace

UiDriver::UiDriver(float width, float height, double scale, Theme theme) {
  context_ = ImGui::CreateContext();
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  io.DisplaySize = {width, height};
  io.DeltaTime = 1.0f / 60;
  io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset | ImGuiBackendFlags_HasMouseCursors;
  io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  io.MousePos = {-1000, -1000};
  map_keys(io);
  ui_ = std::make_unique<Ui>(theme, load_fonts(*io.Fonts, theme, scale), scale);
  apply(theme, scale);
}

UiDriver::~UiDriver() { ImGui::DestroyContext(context_); }

void UiDriver::show(std::function<void(Ui&)> draw) {
  draw_ = std::move(draw);
  frame(2);  // windows find their size in the first one
}

void UiDriver::resize(float width, float height) {
  ImGui::SetCurrentContext(context_);
  ImGui::GetIO().DisplaySize = {width, height};
  frame(2);
}

void UiDriver::frame(int count) {
  ImGui::SetCurrentContext(context_);
  for (int i = 0; i < count; ++i) {
    ImGui::NewFrame();
    ui_->begin_frame();
    if (draw_) draw_(*ui_);
    ui_->end_frame(messages_above_);
    cursor_ = ImGui::GetMouseCursor();
    ImGui::Render();
  }
}

void UiDriver::wait(double seconds) {
  ImGui::SetCurrentContext(context_);
  ImGui::GetIO().DeltaTime = static_cast<float>(seconds);
  frame();
  ImGui::GetIO().DeltaTime = 1.0f / 60;
}

const ProbedWidget* UiDriver::widget(std::string_view name) {
  const ProbedWidget* found = ui_->probe().find(name);
  if (found == nullptr) ADD_FAILURE() << "no widget \"" << name << "\" in\n" << dump();
  return found;
}

std::string UiDriver::value(std::string_view name) {
  const ProbedWidget* found = widget(name);
  return found == nullptr ? std::string() : found->value;
}

ImVec2 UiDriver::centre(std::string_view name) {
  const ProbedWidget* found = widget(name);
  if (found == nullptr) return {-1000, -1000};
  EXPECT_TRUE(found->visible) << '"' << name << "\" is out of sight";
  return found->centre();
}

void UiDriver::move_to(ImVec2 place) {
  ImGui::SetCurrentContext(context_);
  ImGui::GetIO().MousePos = place;
  frame(2);  // what is hovered is known one frame later
}

void UiDriver::press(int mouse_button) {
  ImGui::SetCurrentContext(context_);
  ImGui::GetIO().MouseDown[mouse_button] = true;
  frame();
}

void UiDriver::release(int mouse_button) {
  ImGui::SetCurrentContext(context_);
  ImGui::GetIO().MouseDown[mouse_button] = false;
  frame(2);
}

void UiDriver::click(ImVec2 place, int mouse_button) {
  wait(1);  // or two clicks in a test would be one double-click
  move_to(place);
  press(mouse_button);
  release(mouse_button);
}

void UiDriver::double_click(ImVec2 place) {
  click(place);
  press();
  release();
}

void UiDriver::drag(ImVec2 from, ImVec2 to, int steps, int mouse_button) {
  wait(1);
  move_to(from);
  press(mouse_button);
  for (int i = 1; i <= steps; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(steps);
    ImGui::GetIO().MousePos = {from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)};
    frame();
  }
  release(mouse_button);
}

void UiDriver::drag(std::string_view name, ImVec2 by, int steps) {
  const ImVec2 from = centre(name);
  drag(from, {from.x + by.x, from.y + by.y}, steps);
}

void UiDriver::wheel(float up, float right) {
  ImGui::SetCurrentContext(context_);
  ImGui::GetIO().MouseWheel = up;
  ImGui::GetIO().MouseWheelH = right;
  frame();
  ImGui::GetIO().MouseWheel = ImGui::GetIO().MouseWheelH = 0;
  frame();
}

void UiDriver::hold(KeyModifiers modifiers) {
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  io.KeyCtrl = modifiers.control;
  io.KeyShift = modifiers.shift;
  io.KeyAlt = modifiers.alt;
}

void UiDriver::key(int code, KeyModifiers modifiers) {
  hold(modifiers);
  ImGui::GetIO().KeysDown[code] = true;
  frame();
  ImGui::GetIO().KeysDown[code] = false;
  hold({});
  frame(2);
}

void UiDriver::type(std::string_view text) {
  ImGui::SetCurrentContext(context_);
  ImGui::GetIO().AddInputCharactersUTF8(std::string(text).c_str());
  frame(2);
}

ImDrawData* UiDriver::draw_data() {
  ImGui::SetCurrentContext(context_);
  return ImGui::GetDrawData();
}

}  // namespace elbowroom
