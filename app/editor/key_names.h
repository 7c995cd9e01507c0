// SPDX-License-Identifier: MIT
// GLFW's keys as the table of actions names them.
#pragma once

#include "ui/actions.h"

namespace elbowroom {

// Without modifiers. Shortcut::none for keys that no action may have.
Shortcut shortcut_of_glfw(int key);

}  // namespace elbowroom
