// SPDX-License-Identifier: MIT
// What the mouse did between two frames, shown to the interface so that nothing of it is lost.
//
// Dear ImGui looks at the mouse once a frame. A frame may take a tenth of a second, in which a hand
// presses, drags and lets go; shown the last state alone, the interface would see a drag that ends
// where an earlier frame had it, or none. Moves are joined; a frame shows at most one change of
// buttons, a button goes down where it was pressed, and is shown still down where it was let go
// before it is shown up.
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
  // Where the mouse last moved to. Other buttons are passed over.
  void button(int button, bool down, int modifiers);

  // What the next frame is to show; further events wait for the frame after it.
  struct Shown {
    double x = 0, y = 0;
    std::array<bool, kButtons> down{};
    int modifiers = 0;  // of the press that this frame shows, 0 for none
  };
  const Shown& next();
  bool waiting() const { return !events_.empty(); }

 private:
  struct Event {
    double x = 0, y = 0;
    int button = -1;  // -1: a move
    bool down = false;
    int modifiers = 0;
  };
  std::deque<Event> events_;
  double x_ = 0, y_ = 0;
  Shown shown_;
};

}  // namespace elbowroom
