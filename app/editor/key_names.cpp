// SPDX-License-Identifier: MIT
#include "app/editor/key_names.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace elbowroom {

Shortcut shortcut_of_glfw(int key) {
  Shortcut shortcut;
  if ((key >= GLFW_KEY_A && key <= GLFW_KEY_Z) || (key >= GLFW_KEY_0 && key <= GLFW_KEY_9)) {
    shortcut.key = key;
    return shortcut;
  }
  if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9) {
    shortcut.key = '0' + (key - GLFW_KEY_KP_0);
    return shortcut;
  }
  switch (key) {
    case GLFW_KEY_SPACE:
      shortcut.key = Shortcut::space;
      break;
    case GLFW_KEY_ESCAPE:
      shortcut.key = Shortcut::escape;
      break;
    case GLFW_KEY_ENTER:
    case GLFW_KEY_KP_ENTER:
      shortcut.key = Shortcut::enter;
      break;
    case GLFW_KEY_TAB:
      shortcut.key = Shortcut::tab;
      break;
    case GLFW_KEY_HOME:
      shortcut.key = Shortcut::home;
      break;
    case GLFW_KEY_END:
      shortcut.key = Shortcut::end;
      break;
    case GLFW_KEY_LEFT:
      shortcut.key = Shortcut::left;
      break;
    case GLFW_KEY_RIGHT:
      shortcut.key = Shortcut::right;
      break;
    case GLFW_KEY_PAGE_UP:
      shortcut.key = Shortcut::page_up;
      break;
    case GLFW_KEY_PAGE_DOWN:
      shortcut.key = Shortcut::page_down;
      break;
    case GLFW_KEY_DELETE:
    case GLFW_KEY_BACKSPACE:
      shortcut.key = Shortcut::del;
      break;
    case GLFW_KEY_F1:
      shortcut.key = Shortcut::f1;
      break;
    case GLFW_KEY_F2:
      shortcut.key = Shortcut::f2;
      break;
    case GLFW_KEY_SLASH:
      shortcut.key = '/';
      break;
    case GLFW_KEY_EQUAL:
    case GLFW_KEY_KP_ADD:
      shortcut.key = '+';
      break;
    case GLFW_KEY_MINUS:
    case GLFW_KEY_KP_SUBTRACT:
      shortcut.key = '-';
      break;
    default:
      break;
  }
  return shortcut;
}

void press_keys(const Ui& ui, const EditorState& state, ViewState& view, Commands& commands) {
  const ImGuiIO& io = ImGui::GetIO();
  // A text that is typed, a drag under way, an open list or menu: the key is theirs.
  if (io.WantTextInput || ImGui::IsAnyItemActive() ||
      ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel))
    return;
  for (int key = 0; key <= GLFW_KEY_LAST; ++key) {
    if (view.dialog != Dialog::none) return;
    if (!ImGui::IsKeyPressed(key, true)) continue;
    Shortcut pressed = shortcut_of_glfw(key);
    if (pressed.key == Shortcut::none || ui.has_keys(key)) continue;
    pressed.ctrl = io.KeyCtrl;
    // A plus is typed with the shift key on some keyboards, without on others and on the keypad.
    pressed.shift = io.KeyShift && pressed.key != '+';
    pressed.alt = io.KeyAlt;
    pressed.repeats = !ImGui::IsKeyPressed(key, false);
    press(pressed, state, view, commands);
  }
}

}  // namespace elbowroom
