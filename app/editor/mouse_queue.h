// SPDX-License-Identifier: MIT
// What the mouse did between two frames, shown to the interface so that nothing of it is lost.
//
// Dear ImGui looks at the mouse once a frame. A frame may take a tenth of a second, in which a hand
// presses, drags and lets go; shown the last state alone, the interface would see a drag that ends
// where an earlier frame had it, or none. Moves are joined; a frame shows at most one change of
// buttons, a button goes down where it was pressed, and is shown still down where it was let go
// before it is shown up. Two presses are a double click by when they happened, not by when slow
// frames come to show them.
//
// Window coordinates. Not for several threads.
#pragma once

#include <array>
#include <cstddef>
#include <deque>

namespace elbowroom {

class MouseQueue {
 public:
  static constexpr int kButtons = 3;  // left, right, middle, as GLFW counts them

  void moved(double x, double y);
  static constexpr double kDoubleClick = 0.3;  // s, at most between its presses

  // Where the mouse last moved to; `time` in seconds of any steady clock. Other buttons are passed
  // over.
  void button(int button, bool down, int modifiers, double time);

  // What the next frame is to show; further events wait for the frame after it.
  struct Shown {
    double x = 0, y = 0;
    std::array<bool, kButtons> down{};
    int modifiers = 0;     // of the press that this frame shows, 0 for none
    bool doubled = false;  // that press is the second one of a double click, if it is at its place
  };
  const Shown& next();
  bool waiting() const { return !events_.empty(); }

 private:
  struct Event {
    double x = 0, y = 0;
    int button = -1;  // -1: a move
    bool down = false;
    int modifiers = 0;
    double time = 0;
  };
  std::deque<Event> events_;
  double x_ = 0, y_ = 0;
  std::array<double, kButtons> pressed_at_{-1e9, -1e9, -1e9};
  Shown shown_;
};

}  // namespace elbowroom
