// SPDX-License-Identifier: MIT
// Which view is next, by what came of those before; no world is looked at.
#include "core/editing/view_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace elbowroom {
namespace {

constexpr double kClearance = 0.005;

std::vector<PlanningView> views() { return planning_views(kClearance, 2e-5, 1.75, false); }

// The places of the views that are given while nothing is ever found, told to `see`.
template <typename See>
std::vector<std::size_t> all_of(ViewOrder& order, const See& see) {
  std::vector<std::size_t> given;
  while (const auto look = order.next()) {
    given.push_back(look->index);
    see(*look);
    if (given.size() > 100) break;
  }
  return given;
}

TEST(ViewOrder, GivesEachInTurnWhereNothingTouches) {
  ViewOrder order(views());
  const auto given = all_of(order, [&](const ViewOrder::Look& look) {
    EXPECT_EQ(look.view.text(), views()[look.index].text());
    EXPECT_EQ(look.lesson != nullptr, look.view.lessons > 0);
  });
  ASSERT_EQ(given.size(), views().size());
  for (std::size_t k = 0; k < given.size(); ++k) EXPECT_EQ(given[k], k);
  EXPECT_FALSE(order.next()) << "nothing more, however often it is asked";
  EXPECT_FALSE(ViewOrder({}).next());
}

TEST(ViewOrder, LooksAgainTaughtAndThenAtTheSkin) {
  ViewOrder order(views());
  auto look = order.next();
  ASSERT_TRUE(look);
  ASSERT_FALSE(look->view.on_skin);
  look->lesson->learn({"arm", "chest", 0.02});
  look = order.next();
  ASSERT_TRUE(look);
  EXPECT_EQ(look->index, 0u);
  ASSERT_EQ(look->view.pair_margins.size(), 1u);
  EXPECT_GE(look->view.pair_margins.front().margin, 0.02);
  EXPECT_EQ(look->lesson, nullptr) << "margins are learnt once";
  // It was no help: all of the skin comes before what is left of rigid parts.
  bool rigid_again = false;
  std::vector<std::size_t> given = all_of(order, [&](const ViewOrder::Look& next) {
    if (!next.view.on_skin) rigid_again = true;
    EXPECT_FALSE(next.view.on_skin && rigid_again) << next.view.text();
    EXPECT_TRUE(next.view.pair_margins.empty()) << "of that view alone";
  });
  std::sort(given.begin(), given.end());
  EXPECT_EQ(given.size(), views().size() - 1);
  EXPECT_TRUE(std::adjacent_find(given.begin(), given.end()) == given.end());
}

TEST(ViewOrder, StaysInOrderWhereWhatWasTaughtHelps) {
  ViewOrder order(views());
  order.next()->lesson->learn({"arm", "chest", 0.02});
  order.next();
  order.found();
  const auto look = order.next();
  ASSERT_TRUE(look);
  EXPECT_EQ(look->index, 1u);
  EXPECT_TRUE(look->view.pair_margins.empty());
}

TEST(ViewOrder, WhatTheSkinTeachesGoesForAllOfIt) {
  ViewOrder order(views());
  int lessons = 0;
  double time = 0;
  std::size_t moments = 0;
  const auto given = all_of(order, [&](const ViewOrder::Look& look) {
    if (!look.view.on_skin) return;
    EXPECT_GE(look.view.moments.size(), moments);
    moments = look.view.moments.size();
    EXPECT_EQ(moments == 0, lessons == 0);
    if (look.lesson == nullptr) return;
    look.lesson->learn(time += 0.1);
    ++lessons;
  });
  EXPECT_GT(lessons, 1);
  EXPECT_LE(lessons, 4) << "a window does not go on for ever";
  EXPECT_LE(given.size(), 2 * views().size());
}

TEST(ViewOrder, ATaughtViewOfTheSkinComesNearerToItselfWhereItFindsNoWay) {
  const auto all = views();
  const auto skin = static_cast<std::size_t>(
      std::find_if(all.begin(), all.end(), [](const auto& view) { return view.on_skin; }) -
      all.begin());
  ViewOrder order(all);
  auto look = order.next();
  while (look && look->index != skin) look = order.next();
  ASSERT_TRUE(look);
  EXPECT_EQ(look->view.body_clearance, kClearance);
  look->lesson->learn(0.5);
  look = order.next();
  ASSERT_TRUE(look);
  EXPECT_EQ(look->index, skin);
  EXPECT_TRUE(look->view.as_verified);
  EXPECT_EQ(look->view.body_clearance, kClearance) << "as asked for, if there is a way";
  look = order.next();
  ASSERT_TRUE(look);
  EXPECT_EQ(look->index, skin);
  EXPECT_LT(look->view.body_clearance, 0.5 * kClearance);
  EXPECT_EQ(look->view.clearance, kClearance) << "from the world as before";
  look = order.next();
  ASSERT_TRUE(look);
  EXPECT_NE(look->index, skin);
}

}  // namespace
}  // namespace elbowroom
