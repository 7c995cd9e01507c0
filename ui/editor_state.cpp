// SPDX-License-Identifier: MIT
#include "ui/editor_state.h"

#include <algorithm>

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

}  // namespace elbowroom
