// SPDX-License-Identifier: MIT
#include "core/editing/motion.h"

#include <algorithm>

namespace elbowroom {

Motion motion_of(const Skeleton& skeleton, const std::shared_ptr<const Clip>& source,
                 const std::vector<Correction>& corrections) {
  Motion motion;
  motion.clip = source;
  motion.problems.resize(corrections.size());
  for (std::size_t i = 0; i < corrections.size(); ++i) {
    if (corrections[i].muted) continue;
    auto laid = lay_over(skeleton, *motion.clip, {corrections[i]});
    if (laid)
      motion.clip = std::make_shared<const Clip>(std::move(*laid));
    else
      motion.problems[i] = laid.error();
  }
  return motion;
}

std::optional<Interval> changed_between(const std::vector<Correction>& a,
                                        const std::vector<Correction>& b) {
  std::optional<Interval> changed;
  const auto widen = [&changed](const Correction& c) {
    const Interval window{static_cast<double>(c.begin), static_cast<double>(c.end)};
    if (!changed) changed = window;
    changed->lower = std::min(changed->lower, window.lower);
    changed->upper = std::max(changed->upper, window.upper);
  };
  // Names do not show; everything else that differs at a place of the two lists does.
  const std::size_t most = std::max(a.size(), b.size());
  for (std::size_t i = 0; i < most; ++i) {
    if (i < a.size() && i < b.size() && a[i].muted == b[i].muted && a[i].joints == b[i].joints &&
        a[i].begin == b[i].begin && a[i].end == b[i].end)
      continue;
    if (i < a.size()) widen(a[i]);
    if (i < b.size()) widen(b[i]);
  }
  return changed;
}

}  // namespace elbowroom
