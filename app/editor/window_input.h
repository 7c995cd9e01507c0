// SPDX-License-Identifier: MIT
// What happens to a window between two frames, in the order of GLFW's callbacks: that something
// did, when first, and what would be lost if only the state at the next frame counted.
#pragma once

#include <filesystem>
#include <vector>

#include "app/editor/mouse_queue.h"

struct GLFWwindow;

namespace elbowroom {

struct WindowInput {
  int events = 0;
  double first_event = -1;  // time of the oldest one that no frame has shown yet
  std::vector<std::filesystem::path> dropped;
  // What happened faster than a frame takes and must not be lost: keys pressed since the last frame
  // (with their modifiers), and what the mouse did.
  struct Key {
    int key = 0, modifiers = 0;
    bool repeated = false;
  };
  std::vector<Key> keys;
  MouseQueue mouse;

  void note();
};

// Has the window tell `input`, which must live as long. Before Dear ImGui's backend is set up,
// which chains to these callbacks. Takes the window's user pointer.
void watch_events(GLFWwindow* window, WindowInput& input);

}  // namespace elbowroom
