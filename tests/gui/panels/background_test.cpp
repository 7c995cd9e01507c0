// SPDX-License-Identifier: MIT
// Jobs come one after another, are stopped each by itself, and none outlives its thread.
#include "app/editor/background.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace elbowroom {
namespace {

using namespace std::chrono_literals;

bool eventually(const std::function<bool()>& holds) {
  for (int i = 0; i < 5000 && !holds(); ++i) std::this_thread::sleep_for(1ms);
  return holds();
}

TEST(Mailbox, KeepsTheOrderAndWakesForEachLetter) {
  std::atomic<int> woken = 0;
  Mailbox mailbox([&] { ++woken; });
  std::vector<int> read;
  for (int i = 0; i < 100; ++i) mailbox.post([&read, i] { read.push_back(i); });
  EXPECT_EQ(woken, 100);
  EXPECT_TRUE(read.empty()) << "letters are run by who collects them";
  for (const auto& letter : mailbox.collect()) letter();
  ASSERT_EQ(read.size(), 100u);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(read[static_cast<std::size_t>(i)], i);
  EXPECT_TRUE(mailbox.collect().empty());
}

TEST(Mailbox, LosesNoLetterOfManyThreads) {
  Mailbox mailbox;
  int count = 0;
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < 4; ++t)
      threads.emplace_back([&] {
        for (int i = 0; i < 1000; ++i) mailbox.post([&count] { ++count; });
      });
    while (count < 4000)
      for (const auto& letter : mailbox.collect()) letter();
  }
  EXPECT_EQ(count, 4000);
}

TEST(BackgroundThread, OneJobAfterAnother) {
  std::vector<int> order;
  std::atomic<int> running = 0, done = 0;
  BackgroundThread thread;
  for (int i = 0; i < 50; ++i)
    thread.run([&, i](const std::stop_token&) {
      EXPECT_EQ(++running, 1);
      order.push_back(i);
      --running;
      ++done;
    });
  ASSERT_TRUE(eventually([&] { return done == 50; }));
  for (int i = 0; i < 50; ++i) EXPECT_EQ(order[static_cast<std::size_t>(i)], i);
}

TEST(BackgroundThread, AStopIsForOneJobAlone) {
  std::atomic<bool> first_stopped = false, second_ran = false, second_stopped = false;
  BackgroundThread thread;
  auto stop = thread.run([&](const std::stop_token& token) {
    first_stopped = eventually([&] { return token.stop_requested(); });
  });
  thread.run([&](const std::stop_token& token) {
    second_stopped = token.stop_requested();
    second_ran = true;
  });
  stop.request_stop();
  ASSERT_TRUE(eventually([&] { return second_ran.load(); }));
  EXPECT_TRUE(first_stopped);
  EXPECT_FALSE(second_stopped);
}

TEST(BackgroundThread, AJobStoppedBeforeItBeganSeesTheStopAtOnce) {
  std::atomic<bool> go = false, saw = false, ran = false;
  BackgroundThread thread;
  thread.run([&](const std::stop_token&) { eventually([&] { return go.load(); }); });
  auto stop = thread.run([&](const std::stop_token& token) {
    saw = token.stop_requested();
    ran = true;
  });
  stop.request_stop();
  go = true;
  ASSERT_TRUE(eventually([&] { return ran.load(); }));
  EXPECT_TRUE(saw);
}

TEST(BackgroundThread, DestructionStopsTheRunningJobAndForgetsTheOthers) {
  std::atomic<bool> began = false, ended = false;
  std::atomic<int> others = 0;
  const auto start = std::chrono::steady_clock::now();
  {
    BackgroundThread thread;
    thread.run([&](const std::stop_token& token) {
      began = true;
      ended = eventually([&] { return token.stop_requested(); });
    });
    for (int i = 0; i < 5; ++i) thread.run([&](const std::stop_token&) { ++others; });
    ASSERT_TRUE(eventually([&] { return began.load(); }));
  }
  EXPECT_TRUE(ended);
  EXPECT_EQ(others, 0);
  EXPECT_LT(std::chrono::steady_clock::now() - start, 4s);
}

TEST(BackgroundThread, ComesAndGoesWithoutWork) {
  for (int i = 0; i < 50; ++i) {
    BackgroundThread thread;
    if (i % 2) thread.run([](const std::stop_token&) {});
  }
}

}  // namespace
}  // namespace elbowroom
