// SPDX-License-Identifier: MIT
// Which joint a name means where several nodes have it.
#include "core/scene/joint_name.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/scene/placeable.h"

namespace elbowroom {
namespace {

TEST(JointName, TheFiguresJointsComeFirstThenOtherNodesThenIndices) {
  Model model;
  for (const char* name : {"Hand", "Hip", "Hand", "Hand", "prop", "prop", "2", ""}) {
    Joint joint;
    joint.name = name;
    joint.parent = -1;
    model.skeleton.joints.push_back(joint);
  }
  Character character;
  character.joints = {1, 2, 3};
  const auto find = [&](const std::string& name) { return joint_of_name(model, character, name); };
  EXPECT_EQ(find("Hip").node, 1);
  EXPECT_EQ(find("Hip").namesakes, 0);
  EXPECT_EQ(find("Hand").node, 2);  // not node 0, which no skin uses
  EXPECT_EQ(find("Hand").namesakes, 1);
  EXPECT_EQ(find("prop").node, 4);
  EXPECT_EQ(find("prop").namesakes, 1);
  EXPECT_EQ(find("2").node, 6);  // a name before an index
  EXPECT_EQ(find("3").node, 3);
  EXPECT_EQ(find("3").namesakes, 0);
  for (const char* none : {"hand", "8", "-1", "3x", "99999999999999999999"})
    EXPECT_EQ(find(none).node, -1) << none;
}

TEST(Placeable, IsFiniteAndNotTooFar) {
  const double huge = std::numeric_limits<double>::max(), inf = huge * 2, none = inf - inf;
  EXPECT_TRUE(is_placeable({1e17, -1e17, 0}));
  for (const double bad : {huge, -huge, inf, -inf, none, 1e30}) {
    EXPECT_FALSE(is_placeable({bad, 0, 0}));
    EXPECT_FALSE(is_placeable({0, bad, 0}));
    EXPECT_FALSE(is_placeable({0, 0, bad}));
  }
}

}  // namespace
}  // namespace elbowroom
