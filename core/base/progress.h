// SPDX-License-Identifier: MIT
// How a lengthy computation tells of itself. Called on the computing thread, at most every few
// milliseconds; must not block. Empty functions are allowed everywhere.
#pragma once

#include <functional>
#include <string>

namespace elbowroom {

struct Progress {
  std::string phase;    // "planning", "verifying", ...
  double fraction = 0;  // [0, 1], -1 if unknown
};

using ProgressSink = std::function<void(const Progress&)>;

}  // namespace elbowroom
