// SPDX-License-Identifier: MIT
// Milliseconds for reports. Any thread.
#pragma once

#include <chrono>

namespace elbowroom {

inline double ms_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

}  // namespace elbowroom
