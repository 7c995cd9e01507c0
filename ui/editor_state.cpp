// SPDX-License-Identifier: MIT
#include "ui/editor_state.h"

#include <algorithm>
#include <cmath>

namespace elbowroom {

std::string limb_title(const std::string& limb) {
  std::string title = limb;
  if (limb == limb_id(LimbKind::left_arm) || limb == limb_id(LimbKind::right_arm) ||
      limb == limb_id(LimbKind::left_leg) || limb == limb_id(LimbKind::right_leg)) {
    std::replace(title.begin(), title.end(), '_', ' ');
    title[0] = static_cast<char>(title[0] - 'a' + 'A');
  }
  return title;
}

bool made_otherwise(const EditorState& state) {
  if (!state.candidate || state.document == nullptr) return false;
  const Task& task = state.candidate->task;
  const Draft& draft = state.document->draft;
  const auto set = draft.wishes.find(task.limb);
  if (!((set == draft.wishes.end() ? PlanningWishes{} : set->second) == task.wishes)) return true;
  if (draft.limb != task.limb) return false;
  if (task.kind == TaskKind::reach) return draft.target && !(draft.target == task.target);
  // Windows may have been put right by less than a key's time can tell.
  constexpr double kSame = 1e-4;  // s
  return draft.window && task.window &&
         (std::abs(draft.window->lower - task.window->lower) > kSame ||
          std::abs(draft.window->upper - task.window->upper) > kSame);
}

}  // namespace elbowroom
