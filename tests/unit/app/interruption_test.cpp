// SPDX-License-Identifier: MIT
// When a SIGINT stops a run, when it ends the program, and when it does nothing any more.
#include "app/interruption.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <thread>

namespace elbowroom {
namespace {

using std::chrono::milliseconds;

constexpr int kHeld = 0, kNot = 1;

// In a process of its own, since signals are the whole process's. Its exit code.
int in_a_child(const std::function<bool()>& holds) {
  const pid_t child = fork();
  if (child == 0) _exit(holds() ? kHeld : kNot);
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

void interrupt() { kill(getpid(), SIGINT); }

bool soon(const std::function<bool()>& holds) {
  for (int i = 0; i < 500 && !holds(); ++i) std::this_thread::sleep_for(milliseconds(10));
  return holds();
}

TEST(Interruption, StopsARunThatHasNotSettled) {
  EXPECT_EQ(in_a_child([] {
              Interruption interruption;
              if (interruption.token().stop_requested()) return false;
              interrupt();
              return soon([&] { return interruption.token().stop_requested(); }) &&
                     !interruption.settle() && !interruption.settle();
            }),
            kHeld);
}

TEST(Interruption, ChangesNothingAfterwards) {
  EXPECT_EQ(in_a_child([] {
              Interruption interruption;
              if (!interruption.settle()) return false;
              for (int i = 0; i < 3; ++i) {
                interrupt();
                std::this_thread::sleep_for(milliseconds(30));
              }
              return !interruption.token().stop_requested() && interruption.settle();
            }),
            kHeld);
}

TEST(Interruption, ASecondOneEndsTheProgram) {
  EXPECT_EQ(in_a_child([] {
              Interruption interruption;
              interrupt();
              if (!soon([&] { return interruption.token().stop_requested(); })) return false;
              interrupt();
              std::this_thread::sleep_for(milliseconds(5000));
              return false;
            }),
            130);
  // But not while a report of it is written.
  EXPECT_EQ(in_a_child([] {
              Interruption interruption;
              interrupt();
              if (!soon([&] { return interruption.token().stop_requested(); })) return false;
              if (interruption.settle()) return false;
              interrupt();
              std::this_thread::sleep_for(milliseconds(100));
              return true;
            }),
            kHeld);
}

TEST(Interruption, TheFirstOneEndsACommandThatLooksAtNoToken) {
  EXPECT_EQ(in_a_child([] {
              Interruption interruption(1);
              interrupt();
              std::this_thread::sleep_for(milliseconds(5000));
              return false;
            }),
            130);
}

}  // namespace
}  // namespace elbowroom
