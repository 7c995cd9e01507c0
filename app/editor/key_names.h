// SPDX-License-Identifier: MIT
// GLFW's keys as the table of actions names them, and what pressing them does.
#pragma once

#include "ui/actions.h"
#include "ui/toolkit/ui.h"

namespace elbowroom {

// Without modifiers. Shortcut::none for keys that no action may have.
Shortcut shortcut_of_glfw(int key);

// Carries out the shortcuts of the keys pressed in this frame of the current Dear ImGui context,
// whose key codes are GLFW's; none while a text is being typed, a dialog is open, or a widget has
// the keyboard. After ImGui::NewFrame.
void press_keys(const Ui& ui, const EditorState& state, ViewState& view, Commands& commands);

}  // namespace elbowroom
