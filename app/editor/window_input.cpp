// SPDX-License-Identifier: MIT
#include "app/editor/window_input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace elbowroom {
namespace {

WindowInput& input_of(GLFWwindow* window) {
  return *static_cast<WindowInput*>(glfwGetWindowUserPointer(window));
}

}  // namespace

void WindowInput::note() {
  ++events;
  if (first_event < 0) first_event = glfwGetTime();
}

void watch_events(GLFWwindow* window, WindowInput& input) {
  glfwSetWindowUserPointer(window, &input);
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int modifiers) {
    if (action != GLFW_RELEASE && key >= 0)
      input_of(w).keys.push_back({key, modifiers, action == GLFW_REPEAT});
    input_of(w).note();
  });
  glfwSetCharCallback(window, [](GLFWwindow* w, unsigned) { input_of(w).note(); });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int modifiers) {
    input_of(w).mouse.button(button, action == GLFW_PRESS, modifiers, glfwGetTime());
    input_of(w).note();
  });
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
    input_of(w).mouse.moved(x, y);
    input_of(w).note();
  });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double, double) { input_of(w).note(); });
  glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int) { input_of(w).note(); });
  glfwSetCursorEnterCallback(window, [](GLFWwindow* w, int) { input_of(w).note(); });
  glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { input_of(w).note(); });
  glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { input_of(w).note(); });
  glfwSetWindowCloseCallback(window, [](GLFWwindow* w) { input_of(w).note(); });
  glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
    for (int i = 0; i < count; ++i) input_of(w).dropped.emplace_back(paths[i]);
    input_of(w).note();
  });
}

}  // namespace elbowroom
