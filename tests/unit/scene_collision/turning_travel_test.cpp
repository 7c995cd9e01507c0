// SPDX-License-Identifier: MIT
// Chains of joints whose numbers change evenly: no point of a part gets farther than is said, and
// what is said is not much more than that where the interval is short.
#include "core/collision/turning_travel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/base/random.h"

namespace elbowroom::test {
namespace {

struct ChainJoint {
  JointModel model;
  Vec3 offset{0.0};  // in what it hangs from
  Quat residual{1, 0, 0, 0};
  std::array<double, 3> q{}, rate{};
};

Vec3 any(Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

std::vector<ChainJoint> any_chain(Random& random) {
  const JointModelKind kinds[] = {JointModelKind::ball, JointModelKind::hinge,
                                  JointModelKind::swing, JointModelKind::fixed};
  std::vector<ChainJoint> chain(1 + random.below(4));
  for (ChainJoint& joint : chain) {
    joint.model.kind = kinds[random.below(4)];
    joint.model.side = random.below(2) == 0 ? 1 : -1;
    joint.model.parent_from_zero = quat_from_rotation_vector(any(random, 2));
    joint.model.joint_from_anatomy = quat_from_rotation_vector(any(random, 2));
    joint.residual = quat_from_rotation_vector(any(random, 0.3));
    joint.offset = any(random, 0.5);
    for (double& q : joint.q) q = random.below(5) == 0 ? 0.0 : random.uniform(-1.5, 1.5);
    for (double& rate : joint.rate) rate = random.below(5) == 0 ? 0.0 : random.uniform(-3, 3);
  }
  return chain;
}

struct Placed {
  std::vector<Vec3> origin;
  std::vector<Mat3> world_from_bone;
  Mat3 rotation{1.0};  // of the last joint
  Vec3 place{0.0};
};

Placed place(const std::vector<ChainJoint>& chain, double s) {
  Placed placed;
  for (const ChainJoint& joint : chain) {
    std::array<double, 3> q = joint.q;
    for (std::size_t i = 0; i < q.size(); ++i) q[i] += s * joint.rate[i];
    placed.place += placed.rotation * joint.offset;
    placed.origin.push_back(placed.place);
    const Quat local = local_rotation(joint.model, q.data(), joint.residual);
    placed.world_from_bone.push_back(
        placed.rotation *
        glm::mat3_cast(local * joint.model.joint_from_anatomy * glm::conjugate(joint.residual)));
    placed.rotation = placed.rotation * glm::mat3_cast(local);
  }
  return placed;
}

// How far the farthest of a part's points gets, and what is said of it.
struct Reached {
  double most = 0, said = 0;
};

Reached look(const std::vector<ChainJoint>& chain, double half, bool sphere, Random& random) {
  const Placed middle = place(chain, 0);
  std::vector<TurningJoint> turns(chain.size());
  std::vector<const TurningJoint*> way;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    turns[i].origin = middle.origin[i];
    set_turn(turns[i], chain[i].model, chain[i].q.data(), chain[i].rate.data(), half,
             middle.world_from_bone[i]);
    way.push_back(&turns[i]);
  }
  // A long thin box on the last joint, or a ball.
  const Vec3 centre = any(random, 0.3);
  const Vec3 size = sphere ? Vec3(0.1) : Vec3(0.25, 0.03, 0.05);
  TurningPart part;
  part.centre = middle.place + middle.rotation * centre;
  part.radius = sphere ? 0.1 : glm::length(size);
  for (int k = 0; k < 3; ++k) part.half[k] = middle.rotation[k] * size[k];
  Reached reached;
  reached.said = turning_travel(way, part);

  std::vector<Vec3> points;
  for (int i = 0; i < 40; ++i) {
    Vec3 p = any(random, 1);
    if (i < 8) p = Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    if (sphere) p = glm::normalize(p);
    points.push_back(centre + p * size);
  }
  for (int i = -20; i <= 20; ++i) {
    const Placed then = place(chain, half * i / 20.0);
    for (const Vec3& p : points)
      reached.most = std::max(reached.most, glm::distance(then.place + then.rotation * p,
                                                          middle.place + middle.rotation * p));
  }
  return reached;
}

TEST(TurningTravel, IsNeverExceeded) {
  Random random(20261127);
  for (int i = 0; i < 4000; ++i) {
    const double half = std::pow(10.0, random.uniform(-4, -0.3));
    const auto chain = any_chain(random);
    const Reached reached = look(chain, half, i % 2 == 0, random);
    ASSERT_LE(reached.most, reached.said * (1 + 1e-9) + 1e-12) << i << " half " << half;
  }
}

// So bounds may be trusted to end a search where there is room.
TEST(TurningTravel, IsCloseWhereTheIntervalIsShort) {
  Random random(5);
  double most = 0;
  for (int i = 0; i < 1000; ++i) {
    const Reached reached = look(any_chain(random), 1e-3, false, random);
    if (reached.most > 1e-5) most = std::max(most, reached.said / reached.most);
  }
  EXPECT_LT(most, 1.1);
}

// Joints that turn against each other: each alone would carry the part far.
TEST(TurningTravel, WhatCancelsDoesNotCount) {
  std::vector<ChainJoint> chain(2);
  for (ChainJoint& joint : chain) joint.model.kind = JointModelKind::hinge;
  chain[1].offset = Vec3(0.01, 0, 0);
  chain[0].rate[0] = 1;
  chain[1].rate[0] = -1;
  Random random(1);
  const Reached reached = look(chain, 0.01, false, random);
  EXPECT_LE(reached.most, reached.said);
  EXPECT_LT(reached.said, 0.1 * 0.01 * 0.25);
}

TEST(TurningTravel, LooseTurnsAndLiftsCountInFull) {
  TurningJoint joint;
  joint.loose = 0.01;
  joint.lift = 0.002;
  TurningPart part;
  part.centre = Vec3(0, 0.5, 0);
  part.radius = 0.1;
  const TurningJoint* way[] = {&joint};
  EXPECT_NEAR(turning_travel(way, part), 0.002 + 0.01 * 0.6, 1e-12);
  EXPECT_EQ(turning_travel({}, part), 0.0);
}

// What is no number bounds nothing, and must not look as if it did.
TEST(TurningTravel, NoNumberIsNoBound) {
  TurningJoint joint;
  joint.swing = Vec3(std::nan(""), 0, 0);
  joint.swing_angle = std::nan("");
  TurningPart part;
  part.radius = 0.1;
  const TurningJoint* way[] = {&joint};
  EXPECT_FALSE(turning_travel(way, part) < 1e9);
}

}  // namespace
}  // namespace elbowroom::test
