// SPDX-License-Identifier: MIT
#include "core/scene/model.h"

#include <charconv>
#include <cstddef>

namespace elbowroom {

int Model::find_clip(const std::string& name_or_index) const {
  for (std::size_t i = 0; i < clips.size(); ++i) {
    if (clips[i].name == name_or_index) return static_cast<int>(i);
  }
  int index = -1;
  const char* end = name_or_index.data() + name_or_index.size();
  const auto [rest, failure] = std::from_chars(name_or_index.data(), end, index);
  const bool number = failure == std::errc() && rest == end && !name_or_index.empty();
  return number && index >= 0 && index < static_cast<int>(clips.size()) ? index : -1;
}

}  // namespace elbowroom
