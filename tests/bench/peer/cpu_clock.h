// SPDX-License-Identifier: MIT
// Computing time of this thread: both sides run on one, and others may work on the machine.
#pragma once

#include <ctime>

namespace elbowroom::bench {

inline double cpu_milliseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

// What `work()` returns, and what it took.
template <typename Work>
auto timed(double& milliseconds, Work&& work) {
  const double start = cpu_milliseconds();
  auto result = work();
  milliseconds = cpu_milliseconds() - start;
  return result;
}

}  // namespace elbowroom::bench
