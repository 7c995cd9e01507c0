// SPDX-License-Identifier: MIT
#include "app/terminal.h"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <memory>

namespace elbowroom {

void print_error(const Error& error) {
  clear_progress();
  std::fprintf(stderr, "elbowroom: %s\n", error.message().c_str());
}

void print_warnings(const std::vector<std::string>& warnings) {
  for (const auto& warning : warnings)
    std::fprintf(stderr, "elbowroom: warning: %s\n", warning.c_str());
}

ProgressSink terminal_progress() {
  if (!isatty(STDERR_FILENO)) return {};
  using Clock = std::chrono::steady_clock;
  auto last = std::make_shared<Clock::time_point>();
  return [last](const Progress& progress) {
    const auto now = Clock::now();
    if (now - *last < std::chrono::milliseconds(80)) return;
    *last = now;
    if (progress.fraction >= 0)
      std::fprintf(stderr, "\r\033[K  %s  %3.0f %%", progress.phase.c_str(),
                   100 * progress.fraction);
    else
      std::fprintf(stderr, "\r\033[K  %s ...", progress.phase.c_str());
    std::fflush(stderr);
  };
}

void clear_progress() {
  if (isatty(STDERR_FILENO)) std::fputs("\r\033[K", stderr);
}

}  // namespace elbowroom
