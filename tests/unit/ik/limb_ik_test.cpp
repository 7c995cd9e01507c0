// SPDX-License-Identifier: MIT
// Analytic IK on a body of known proportions: what the swivel means, branches, keyed offsets,
// mirrors and scales, targets and bones that are none.
#include <gtest/gtest.h>

#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "core/ik/limit_excess.h"
#include "core/ik/swivel_search.h"
#include "tests/unit/anatomy/synthetic_body.h"

namespace elbowroom {
namespace {

using test::Body;
using test::BodyOptions;

constexpr double kDegree = kPi / 180;
const std::array<Quat, 3> kNoResidual = {Quat(1, 0, 0, 0), Quat(1, 0, 0, 0), Quat(1, 0, 0, 0)};

struct Placed {
  Body body;
  LimbModel limb;
  Pose pose;
  std::vector<Mat4> globals;
  Mat4 world_from_file{1.0};

  explicit Placed(const BodyOptions& options, LimbKind kind, const Mat4& placement = Mat4(1.0))
      : body(test::make_body(options)), limb(test::fit(body, kind)), world_from_file(placement) {
    pose = rest_pose(body.model.skeleton);
  }
  LimbIk ik(const std::array<Quat, 3>& residual = kNoResidual) {
    compute_globals(body.model.skeleton, pose, world_from_file, globals);
    const int parent = body.model.skeleton.joints[static_cast<std::size_t>(limb.limb.root)].parent;
    const auto built = LimbIk::build(limb, body.model.skeleton, pose,
                                     globals[static_cast<std::size_t>(parent)], residual);
    EXPECT_TRUE(built.ok()) << (built.ok() ? "" : built.error().message());
    return *built;
  }
  Mat4 end(const LimbState& state) {
    Pose posed = pose;
    apply_limb_state(limb, state, posed);
    compute_globals(body.model.skeleton, posed, world_from_file, globals);
    return globals[static_cast<std::size_t>(limb.limb.end)];
  }
};

Dofs middle_of(const DofSpace& space, Random& random) {
  Dofs q;
  q.count = space.count();
  do {
    for (int i = 0; i < q.count; ++i) {
      const Dof& dof = space.dofs[static_cast<std::size_t>(i)];
      q[i] = random.uniform(dof.lower, dof.upper);
    }
  } while (!space.within_limits(q));
  return q;
}

void expect_round_trips(Placed& placed, const std::array<Quat, 3>& residual, double orientation) {
  const LimbIk ik = placed.ik(residual);
  Random random(3);
  for (int i = 0; i < 300; ++i) {
    const Dofs q = middle_of(placed.limb.space, random);
    const Mat4 made = placed.end({q, residual});
    // The solver's own forward kinematics are those of the skeleton.
    const auto points = ik.points(q);
    EXPECT_LT(glm::distance(points.end, Vec3(made[3])), 1e-9 * ik.length());
    EXPECT_LT(angle_between(points.end_rotation, rotation_of(made)), 1e-6);

    const double swivel = ik.swivel_of(q);
    const auto solutions = ik.solve_at_swivel({Vec3(made[3]), rotation_of(made)}, swivel, q);
    double nearest = 1e9;
    for (int k = 0; k < solutions.count; ++k) {
      const auto& one = solutions.one[static_cast<std::size_t>(k)];
      EXPECT_EQ(one.miss, 0);
      const Mat4 reached = placed.end({one.q, residual});
      EXPECT_LT(glm::distance(Vec3(reached[3]), Vec3(made[3])), 1e-8 * ik.length());
      EXPECT_LT(angle_between(rotation_of(reached), rotation_of(made)), orientation);
      EXPECT_NEAR(std::remainder(ik.swivel_of(one.q) - swivel, 2 * kPi), 0, 1e-6);
      double distance = 0;
      for (int d = 0; d < q.count; ++d) distance = std::max(distance, std::abs(one.q[d] - q[d]));
      nearest = std::min(nearest, distance);
    }
    EXPECT_LT(nearest, 1e-4) << "the posture itself is one of the solutions";
  }
}

TEST(LimbIk, FindsThePostureAgain) {
  for (const LimbKind kind :
       {LimbKind::left_arm, LimbKind::right_arm, LimbKind::left_leg, LimbKind::right_leg}) {
    Placed placed({}, kind);
    expect_round_trips(placed, kNoResidual, 1e-8);
  }
}

TEST(LimbIk, WithResidualsThatTiltBones) {
  Placed placed({}, LimbKind::right_arm);
  const std::array<Quat, 3> residual = {Quat(1, 0, 0, 0),
                                        quat_from_rotation_vector({0, 12 * kDegree, -5 * kDegree}),
                                        quat_from_rotation_vector({10 * kDegree, 0, 0})};
  expect_round_trips(placed, residual, 1e-8);
}

TEST(LimbIk, WithKeyedOffsetsAndDrivenJoints) {
  BodyOptions options;
  options.left_twist = "upperarm_twist_l";
  options.axes_seed = 5;
  Placed placed(options, LimbKind::left_arm);
  ASSERT_FALSE(placed.limb.driven.empty());
  const auto local = [&](int joint) -> Transform& {
    return placed.pose.local[static_cast<std::size_t>(joint)];
  };
  local(placed.limb.limb.middle).translation *= 1.2;
  local(placed.limb.limb.end).translation += Vec3(0.02, -0.01, 0.015);
  local(placed.body.left_twist).rotation = glm::normalize(
      local(placed.body.left_twist).rotation * quat_from_rotation_vector({0.2, -0.1, 0.15}));
  expect_round_trips(placed, kNoResidual, 1e-8);
}

TEST(LimbIk, UnderMirrorsUniformScaleAndTurns) {
  BodyOptions options;
  options.axes_seed = 9;
  options.yaw = 0.7;
  for (const Vec3& scale : {Vec3(-1, 1, 1), Vec3(100, 100, 100), Vec3(-0.01, -0.01, 0.01)}) {
    options.root_scale = scale;
    Placed placed(options, LimbKind::left_arm);
    EXPECT_TRUE(placed.ik().uniform());
    expect_round_trips(placed, kNoResidual, 1e-7);
  }
}

TEST(LimbIk, UnderScaleThatIsNotUniformThePositionIsExact) {
  BodyOptions options;
  options.root_scale = Vec3(1, 1.3, 0.9);
  Placed placed(options, LimbKind::left_arm);
  placed.pose.local[static_cast<std::size_t>(placed.limb.limb.root)].scale = Vec3(1.1, 1, 0.9);
  const LimbIk ik = placed.ik();
  EXPECT_FALSE(ik.uniform());
  Random random(4);
  int reached = 0;
  for (int i = 0; i < 300; ++i) {
    const Dofs q = middle_of(placed.limb.space, random);
    const Vec3 position(placed.end({q, kNoResidual})[3]);
    const auto solutions = ik.solve_at_swivel({position, {}}, ik.swivel_of(q), q);
    for (int k = 0; k < solutions.count; ++k) {
      const auto& one = solutions.one[static_cast<std::size_t>(k)];
      if (one.miss != 0) continue;
      ++reached;
      EXPECT_LT(glm::distance(Vec3(placed.end({one.q, kNoResidual})[3]), position),
                1e-6 * ik.length());
    }
  }
  EXPECT_GE(reached, 290);
}

TEST(Swivel, IsZeroWithTheElbowDownAndPositiveOutwardOnBothSides) {
  for (const LimbKind kind : {LimbKind::left_arm, LimbKind::right_arm}) {
    Placed placed({}, kind);
    const LimbIk ik = placed.ik();
    const double outward = kind == LimbKind::left_arm ? 1 : -1;
    const Vec3 root = ik.points(ik.current()).root;
    const IkTarget ahead{root + Vec3(0.05 * outward, -0.05, 0.35), {}};
    const auto elbow_at = [&](double swivel) {
      const auto solutions = ik.solve_at_swivel(ahead, swivel, ik.current());
      EXPECT_GE(solutions.count, 1);
      for (int k = 0; k < solutions.count; ++k)
        if (solutions.one[static_cast<std::size_t>(k)].q[3] > 0)
          return ik.points(solutions.one[static_cast<std::size_t>(k)].q).middle - root;
      ADD_FAILURE() << "no posture that bends";
      return Vec3(0.0);
    };
    // Carried forward from the zero pose, down is still near to down.
    const Vec3 across = elbow_at(0);
    EXPECT_LT(across.y, -0.1);
    EXPECT_GT(outward * elbow_at(60 * kDegree).x, outward * across.x + 0.05);
    EXPECT_GT(outward * elbow_at(90 * kDegree).x, 0.1);
  }
}

TEST(Swivel, MirroredPosturesHaveEqualSwivels) {
  Placed left({}, LimbKind::left_arm), right({}, LimbKind::right_arm);
  const LimbIk left_ik = left.ik(), right_ik = right.ik();
  Random random(8);
  for (int i = 0; i < 100; ++i) {
    const Dofs q = middle_of(left.limb.space, random);
    EXPECT_NEAR(std::remainder(left_ik.swivel_of(q) - right_ik.swivel_of(q), 2 * kPi), 0, 1e-9);
  }
}

TEST(Swivel, GoesOnThroughTheStraightArm) {
  Placed placed({}, LimbKind::left_arm);
  const LimbIk ik = placed.ik();
  Dofs q = ik.current();
  double last = 0;
  for (int i = 0; i <= 40; ++i) {
    q[3] = (8 - 0.4 * i) * kDegree;  // from flexion to hyperextension
    const double swivel = ik.swivel_of(q);
    if (i > 0) {
      EXPECT_NEAR(std::remainder(swivel - last, 2 * kPi), 0, 1 * kDegree);
    }
    last = swivel;
  }
}

TEST(SwivelSearch, SaysWhatIsInTheWay) {
  Placed placed({}, LimbKind::left_arm);
  const LimbIk ik = placed.ik();
  const Vec3 root = ik.points(ik.current()).root;

  const auto far = search_swivel(ik, {root + Vec3(0, 0, 2), {}});
  EXPECT_EQ(far.status, IkStatus::out_of_reach);
  EXPECT_NEAR(far.miss, 2 - ik.length(), 1e-6);
  EXPECT_NEAR(ik.points(far.state.q).end.z, root.z + ik.length(), 0.02) << "stretched towards it";

  // So near that the elbow would have to bend by more than it can.
  const auto close = search_swivel(ik, {root + Vec3(0, 0, 0.08), {}});
  EXPECT_EQ(close.status, IkStatus::at_limit);
  ASSERT_GE(close.dof, 0);
  EXPECT_EQ(placed.limb.space.dofs[static_cast<std::size_t>(close.dof)].name, "Elbow, flexion");
  EXPECT_GT(close.excess, 0);
  EXPECT_TRUE(placed.limb.space.within_limits(close.state.q, 1e-6));

  const IkTarget ahead{root + Vec3(0.05, 0, 0.35), {}};
  const auto blocked = search_swivel(ik, ahead, {}, [](const LimbState&) { return false; });
  EXPECT_EQ(blocked.status, IkStatus::in_collision);
  EXPECT_GT(blocked.checked, 100);
  EXPECT_LT(glm::distance(ik.points(blocked.state.q).end, ahead.position), 1e-9);
  SwivelSearch few;
  few.max_checks = 20;
  EXPECT_EQ(search_swivel(ik, ahead, few, [](const LimbState&) { return false; }).checked, 20);
}

TEST(SwivelSearch, TakesTheNearestValidSwivelOfTheGreedyPaper) {
  Placed placed({}, LimbKind::left_arm);
  const LimbIk ik = placed.ik();
  const Vec3 root = ik.points(ik.current()).root;
  const IkTarget ahead{root + Vec3(0.05, 0, 0.35), {}};
  SwivelSearch settings;
  settings.initial = 0.1;
  const auto first = search_swivel(ik, ahead, settings);
  ASSERT_TRUE(first.solved());
  EXPECT_EQ(first.swivel, 0.1);
  // A wall beside the elbow pushes the swivel to the other side, no farther than it must.
  const double wall = ik.points(first.state.q).middle.x - 0.02;
  const auto beside = search_swivel(ik, ahead, settings, [&](const LimbState& state) {
    return ik.points(state.q).middle.x < wall;
  });
  ASSERT_TRUE(beside.solved());
  EXPECT_LT(ik.points(beside.state.q).middle.x, wall);
  EXPECT_LT(std::abs(beside.swivel - 0.1), 50 * kDegree);
  // Same bytes again.
  const auto again = search_swivel(ik, ahead, settings, [&](const LimbState& state) {
    return ik.points(state.q).middle.x < wall;
  });
  EXPECT_EQ(std::memcmp(&again.state.q.value, &beside.state.q.value, sizeof again.state.q.value),
            0);
  // A range that leaves that side out.
  settings.lower = 0.05;
  settings.upper = 0.5;
  const auto bounded = search_swivel(ik, ahead, settings, [&](const LimbState& state) {
    return ik.points(state.q).middle.x < wall;
  });
  EXPECT_FALSE(bounded.solved());
  EXPECT_GE(bounded.swivel, 0.05);
  EXPECT_LE(bounded.swivel, 0.5);
}

TEST(SwivelSearch, HostileTargets) {
  Placed placed({}, LimbKind::right_leg);
  const LimbIk ik = placed.ik();
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Vec3 root = ik.points(ik.current()).root;
  for (const IkTarget& target :
       {IkTarget{Vec3(kNaN, 0, 0), {}}, IkTarget{Vec3(0, kInfinity, 0), {}},
        IkTarget{Vec3(1e300), {}}, IkTarget{root + Vec3(0, -0.5, 0), Quat(0, 0, 0, 0)},
        IkTarget{root + Vec3(0, -0.5, 0), Quat(kNaN, 0, 0, 0)}, IkTarget{root, {}}}) {
    const auto result = search_swivel(ik, target);
    EXPECT_FALSE(result.solved());
    EXPECT_TRUE(placed.limb.space.within_limits(result.state.q, 1e-6));
  }
  SwivelSearch odd;
  odd.initial = kNaN;
  odd.step = kNaN;
  odd.growth = -3;
  odd.lower = kNaN;
  odd.resolution = -1;
  EXPECT_GE(search_swivel(ik, {root + Vec3(0.02, -0.7, 0.1), {}}, odd).tried, 1);
  EXPECT_EQ(ik.solve_at_swivel({root, {}}, kNaN, ik.current()).count, 0);
  EXPECT_EQ(ik.solve_at_swivel({root, {}}, 0, Dofs{}).count, 0);
}

TEST(LimbIk, BonesWithoutLength) {
  // At this time the clip keys the lower bone to nothing: the end is where the middle is.
  Placed placed({}, LimbKind::left_arm);
  placed.pose.local[static_cast<std::size_t>(placed.limb.limb.end)].translation = Vec3(0.0);
  const LimbIk ik = placed.ik();
  const Vec3 root = ik.points(ik.current()).root;
  const auto result =
      search_swivel(ik, {root + glm::normalize(Vec3(0.3, -0.2, 1)) * ik.length(), {}});
  ASSERT_TRUE(result.solved());
  EXPECT_FALSE(search_swivel(ik, {root + Vec3(0, 0, 0.5 * ik.length()), {}}).solved());
  // Nothing at all: only its own place can be reached, and nothing crashes.
  placed.pose.local[static_cast<std::size_t>(placed.limb.limb.middle)].translation = Vec3(0.0);
  const LimbIk point = placed.ik();
  EXPECT_EQ(point.length(), 0);
  EXPECT_FALSE(search_swivel(point, {root + Vec3(0, 0, 0.1), {}}).solved());
}

TEST(LimbIk, ASpaceWithoutVolumeIsAnError) {
  Placed placed({}, LimbKind::left_arm);
  const auto flat = LimbIk::build(placed.limb, placed.body.model.skeleton, placed.pose,
                                  glm::scale(Mat4(1.0), Vec3(1, 0, 1)), kNoResidual);
  EXPECT_FALSE(flat.ok());
  const auto no_rotation =
      LimbIk::build(placed.limb, placed.body.model.skeleton, placed.pose, Mat4(1.0),
                    {Quat(0, 0, 0, 0), Quat(1, 0, 0, 0), Quat(1, 0, 0, 0)});
  EXPECT_FALSE(no_rotation.ok());
}

TEST(LimitExcess, IsNegativeInsideAndClampingKeepsLimits) {
  DofSpace space;
  space.dofs = {{"a", DofRole::swing, -1, 1, -1, 1, 1},
                {"b", DofRole::swing, -1, 1, -1, 1, 1},
                {"c", DofRole::twist, 0.2, 0.4, 0.2, 0.4, 1}};
  space.ellipses = {{0, 1, 1, 0.5}};
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    Dofs q;
    q.count = 3;
    for (int d = 0; d < 3; ++d) q[d] = random.uniform(-2, 2);
    EXPECT_EQ(limit_excess(space, q).radians <= 1e-9, space.within_limits(q));
    EXPECT_TRUE(space.within_limits(clamp_to_limits(space, q)));
  }
  // A range that only just meets the ellipse.
  space.dofs[0].lower = 0.9;
  for (int i = 0; i < 200; ++i) {
    Dofs q;
    q.count = 3;
    for (int d = 0; d < 3; ++d) q[d] = random.uniform(-2, 2);
    EXPECT_TRUE(space.within_limits(clamp_to_limits(space, q), 1e-9));
  }
}

}  // namespace
}  // namespace elbowroom
