// SPDX-License-Identifier: MIT
// What a frame is shown of the mouse: nothing is lost, whatever happened since the last one.
#include "app/editor/mouse_queue.h"

#include <gtest/gtest.h>

#include <vector>

namespace elbowroom {
namespace {

struct Seen {
  double x;
  bool left;
};
void expect_next(MouseQueue& queue, Seen seen) {
  const auto& shown = queue.next();
  EXPECT_EQ(shown.x, seen.x);
  EXPECT_EQ(shown.down[0], seen.left);
}

TEST(MouseQueue, JoinsMoves) {
  MouseQueue queue;
  for (int i = 1; i <= 5; ++i) queue.moved(i, 0);
  expect_next(queue, {5, false});
  EXPECT_FALSE(queue.waiting());
  expect_next(queue, {5, false});
}

TEST(MouseQueue, AWholeDragBetweenTwoFramesGoesFromItsBeginToItsEnd) {
  MouseQueue queue;
  queue.moved(10, 0);
  queue.button(0, true, 0, 0);
  queue.moved(20, 0);
  queue.moved(60, 0);
  queue.button(0, false, 0, 0);
  queue.moved(90, 0);
  expect_next(queue, {10, true});
  expect_next(queue, {60, true});
  expect_next(queue, {60, false});
  expect_next(queue, {90, false});
  EXPECT_FALSE(queue.waiting());
}

TEST(MouseQueue, TheLastMoveBeforeAButtonGoesUpIsSeenWithItDown) {
  MouseQueue queue;
  queue.button(0, true, 0, 0);
  expect_next(queue, {0, true});
  queue.moved(30, 0);
  queue.button(0, false, 0, 0);
  expect_next(queue, {30, true});
  EXPECT_TRUE(queue.waiting());
  expect_next(queue, {30, false});
}

TEST(MouseQueue, ADoubleClickStaysTwoClicks) {
  MouseQueue queue;
  for (int i = 0; i < 2; ++i) {
    queue.button(0, true, 0, 0);
    queue.button(0, false, 0, 0);
  }
  for (int i = 0; i < 2; ++i) {
    expect_next(queue, {0, true});
    expect_next(queue, {0, false});
  }
  EXPECT_FALSE(queue.waiting());
}

TEST(MouseQueue, ModifiersAreThoseOfThePressAndOfItsFrameAlone) {
  MouseQueue queue;
  queue.button(1, true, 4, 0);
  EXPECT_EQ(queue.next().modifiers, 4);
  EXPECT_TRUE(queue.next().down[1]);
  EXPECT_EQ(queue.next().modifiers, 0);
}

TEST(MouseQueue, ButtonsThatNobodyHasArePassedOver) {
  MouseQueue queue;
  queue.button(-1, true, 0, 0);
  queue.button(7, true, 0, 0);
  EXPECT_FALSE(queue.waiting());
}

// However long the frames between them take.
TEST(MouseQueue, TwoQuickPressesAreADoubleClick) {
  MouseQueue queue;
  queue.moved(10, 10);
  const auto press = [&](double time, int button = 0) {
    queue.button(button, true, 0, time);
    queue.button(button, false, 0, time + 0.05);
  };
  const auto presses = [&] {
    std::vector<bool> doubled;
    bool was_down = false;
    while (queue.waiting()) {
      const auto& shown = queue.next();
      const bool down = shown.down[0] || shown.down[1];
      if (down && !was_down)
        doubled.push_back(shown.doubled);
      else
        EXPECT_FALSE(shown.doubled) << "only the press itself";
      was_down = down;
    }
    return doubled;
  };
  press(1.0);
  press(1.2);
  press(1.4);
  press(1.6);
  EXPECT_EQ(presses(), (std::vector<bool>{false, true, false, true}));
  press(3.0);
  press(3.4);
  EXPECT_EQ(presses(), (std::vector<bool>{false, false}));
  press(5.0);
  press(5.1, 1);
  EXPECT_EQ(presses(), (std::vector<bool>{false, false})) << "of two buttons";
}

}  // namespace
}  // namespace elbowroom
