// SPDX-License-Identifier: MIT
// Which view of the world is looked at next while a window is planned, by what came of those
// before.
//
// In the order of planning_views(), but: a view is looked at again, taught by motions that were
// planned in it and touch on the skin (skin_lesson.h); where rigid parts find such motions and
// margins don't help, others would as likely be in vain, and what is left of the skin comes first;
// what the skin has taught goes for all views of it; and where a view so taught finds no way, the
// character may come nearer to itself.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/editing/planning_views.h"
#include "core/editing/skin_lesson.h"

namespace elbowroom {

class ViewOrder {
 public:
  explicit ViewOrder(std::vector<PlanningView> views);

  struct Look {
    PlanningView view;
    std::size_t index = 0;         // its place among the views given
    SkinLesson* lesson = nullptr;  // takes what motions that touch teach; null: no more of that
  };
  // Nothing: all has been looked at. A lesson stands until the next call.
  std::optional<Look> next();
  // The last look found what it was for: its view is not looked at again.
  void found() { looking_ = false; }

 private:
  SkinLesson& lesson() { return view_.on_skin ? of_skin_ : of_parts_; }
  Look look();
  bool look_again();

  std::vector<PlanningView> views_;
  std::vector<std::size_t> left_;
  bool skin_decides_ = false;  // rigid parts were no help
  SkinLesson of_skin_;
  int skin_lessons_;  // left

  // The view that is being looked at.
  bool looking_ = false;
  std::size_t index_ = 0;
  PlanningView view_;
  SkinLesson of_parts_;
  int looks_ = 0;
  std::size_t known_ = 0;  // how much had been learnt before the last look
};

}  // namespace elbowroom
