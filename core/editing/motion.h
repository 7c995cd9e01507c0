// SPDX-License-Identifier: MIT
// The motion that a document shows: the source clip with every correction that still fits laid over
// it. Unlike lay_over, which refuses, this tells which corrections don't fit and goes on without
// them: an editor must show something after a mute, a reorder or a change of files.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/editing/correct.h"

namespace elbowroom {

struct Motion {
  std::shared_ptr<const Clip> clip;
  std::vector<std::optional<Error>> problems;  // by correction; none: it fits (or is muted)
};

// Muted corrections are passed over. If none applies, `clip` is `source` itself.
Motion motion_of(const Skeleton& skeleton, const std::shared_ptr<const Clip>& source,
                 const std::vector<Correction>& corrections);

// The time over which two lists of corrections differ in what they show; none: nowhere.
std::optional<Interval> changed_between(const std::vector<Correction>& a,
                                        const std::vector<Correction>& b);

}  // namespace elbowroom
