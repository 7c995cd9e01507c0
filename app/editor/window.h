// SPDX-License-Identifier: MIT
// The editor in a window: GLFW and OpenGL around the Editor and its user interface.
//
// Draws on demand: without input, playback or news from the background it waits for events and
// costs nothing.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace elbowroom {

struct WindowOptions {
  std::vector<std::filesystem::path> files;  // none: the demo scene
  // Writes a line for each frame submitted: when (s), how long after the event that asked for it
  // (ms), how long it took (ms), what was going on. For tests and measuring; empty: none.
  std::filesystem::path frame_log;
  // Rewritten after each frame whose widgets differ from the last one's: a line a widget, its path,
  // kind, rectangle in pixels, value. So tests find with the mouse what they know by name.
  std::filesystem::path widget_log;
};

// Opens the window and runs until it is closed. Error: no display, or no OpenGL 4.5.
Status run_editor(const WindowOptions& options);

}  // namespace elbowroom
