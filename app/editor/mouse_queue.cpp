// SPDX-License-Identifier: MIT
#include "app/editor/mouse_queue.h"

namespace elbowroom {

void MouseQueue::moved(double x, double y) {
  x_ = x;
  y_ = y;
  if (!events_.empty() && events_.back().button < 0) events_.pop_back();
  events_.push_back({x, y});
}

void MouseQueue::button(int button, bool down, int modifiers, double time) {
  if (button < 0 || button >= kButtons) return;
  events_.push_back({x_, y_, button, down, modifiers, time});
}

const MouseQueue::Shown& MouseQueue::next() {
  shown_.modifiers = 0;
  shown_.doubled = false;
  bool moved = false;
  while (!events_.empty()) {
    const Event event = events_.front();
    const bool moves = event.x != shown_.x || event.y != shown_.y;
    if (event.button >= 0) {
      bool& down = shown_.down[static_cast<std::size_t>(event.button)];
      // The place of a button that goes up is seen with the button down first.
      if (!event.down && down && moved) break;
      events_.pop_front();
      shown_.x = event.x;
      shown_.y = event.y;
      if (down == event.down) continue;
      down = event.down;
      if (event.down) {
        shown_.modifiers = event.modifiers;
        double& before = pressed_at_[static_cast<std::size_t>(event.button)];
        shown_.doubled = event.time - before < kDoubleClick;
        before = shown_.doubled ? -1e9 : event.time;  // a third press begins anew
      }
      break;
    }
    events_.pop_front();
    shown_.x = event.x;
    shown_.y = event.y;
    moved = moved || moves;
  }
  return shown_;
}

}  // namespace elbowroom
