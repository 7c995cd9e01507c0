// SPDX-License-Identifier: MIT
// Fitted limb models: numbers mean the same on every rig.
#include "core/anatomy/limb_model.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/anatomy/limb_clip.h"
#include "core/anatomy/limits.h"
#include "tests/unit/anatomy/synthetic_body.h"

namespace elbowroom {
namespace {

using test::Body;
using test::BodyOptions;
using test::fit;
using test::make_body;
using test::posed;

constexpr double kDegree = kPi / 180.0;
constexpr std::array kFour = {LimbKind::left_arm, LimbKind::right_arm, LimbKind::left_leg,
                              LimbKind::right_leg};

Dofs random_within(const DofSpace& space, Random& random) {
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

int beyond(const Body& body, LimbKind kind) {
  const bool left = kind == LimbKind::left_arm || kind == LimbKind::left_leg;
  const bool arm = kind == LimbKind::left_arm || kind == LimbKind::right_arm;
  return (left ? body.left : body.right)[arm ? test::kIndex : test::kToes];
}

TEST(LimbModel, EqualNumbersGiveEqualPosesWhateverTheRig) {
  const Body plain = make_body({});
  std::vector<BodyOptions> variants(6);
  variants[0].axes_seed = 11;
  variants[1].arms_down = kPi / 4;
  variants[1].axes_seed = 12;
  variants[2].arms_down = 80 * kDegree;
  variants[2].elbows_bent = 25 * kDegree;
  variants[3].elbows_bent = 40 * kDegree;
  variants[3].axes_seed = 13;
  variants[4].left_twist = "upperarm_twist_01_l";
  variants[4].axes_seed = 14;
  for (std::size_t i = 0; i < variants[5].left.size(); ++i) {
    variants[5].left[i] = "hero:" + variants[5].left[i];
    variants[5].right[i] = "hero:" + variants[5].right[i];
  }
  Random random(20);
  for (const BodyOptions& options : variants) {
    const Body body = make_body(options);
    for (const LimbKind kind : kFour) {
      const LimbModel a = fit(plain, kind), b = fit(body, kind);
      ASSERT_EQ(a.dof_count(), 7);
      ASSERT_EQ(b.dof_count(), 7);
      for (int n = 0; n < 50; ++n) {
        const Dofs q = random_within(a.space, random);
        const auto p = posed(plain, a, q, beyond(plain, kind));
        const auto r = posed(body, b, q, beyond(body, kind));
        for (std::size_t i = 0; i < p.size(); ++i) {
          // The bind pose of a bent elbow shows its axis; that of a straight one is the body's.
          EXPECT_LT(glm::distance(p[i], r[i]), 1e-9) << limb_id(kind) << " point " << i;
        }
      }
    }
  }
}

TEST(LimbModel, MirroredLimbsHaveMirroredPoses) {
  BodyOptions options;
  options.axes_seed = 5;
  options.elbows_bent = 20 * kDegree;
  const Body body = make_body(options);
  Random random(21);
  for (const auto& [left, right] : {std::pair(LimbKind::left_arm, LimbKind::right_arm),
                                    std::pair(LimbKind::left_leg, LimbKind::right_leg)}) {
    const LimbModel a = fit(body, left), b = fit(body, right);
    for (int n = 0; n < 200; ++n) {
      const Dofs q = random_within(a.space, random);
      const auto p = posed(body, a, q, beyond(body, left));
      const auto r = posed(body, b, q, beyond(body, right));
      for (std::size_t i = 0; i < p.size(); ++i) {
        EXPECT_LT(glm::distance(p[i], Vec3(-r[i].x, r[i].y, r[i].z)), 1e-9);
      }
    }
  }
}

TEST(LimbModel, ScaleMirrorAndPlaceOfTheWholeRigDontMatter) {
  const Body plain = make_body({});
  std::vector<BodyOptions> variants(4);
  variants[0].root_scale = Vec3(100);
  variants[1].root_scale = Vec3(0.01);
  variants[2].root_scale = Vec3(-1, 1, 1);  // the body turns into its mirror image
  variants[3].yaw = kPi / 2;
  for (std::size_t v = 0; v < variants.size(); ++v) {
    variants[v].axes_seed = 30 + v;
    const Body body = make_body(variants[v]);
    // Where a point of the plain body comes to lie.
    const Mat4 placed = body.model.skeleton.joints[0].rest.matrix();
    Random random(22);
    for (const LimbKind kind : kFour) {
      const LimbModel a = fit(plain, kind), b = fit(body, kind);
      ASSERT_EQ(b.dof_count(), 7) << v;
      for (int n = 0; n < 50; ++n) {
        const Dofs q = random_within(a.space, random);
        const auto p = posed(plain, a, q, beyond(plain, kind));
        const auto r = posed(body, b, q, beyond(body, kind));
        const double size = std::abs(variants[v].root_scale.x);
        for (std::size_t i = 0; i < p.size(); ++i) {
          const Vec3 expected(placed * glm::dvec4(p[i], 1));
          EXPECT_LT(glm::distance(expected, r[i]), 1e-9 * size) << v << " " << limb_id(kind);
        }
      }
    }
  }
}

TEST(LimbModel, NumbersReadAsAnatomy) {
  BodyOptions options;
  options.axes_seed = 6;
  const Body body = make_body(options);
  const LimbModel arm = fit(body, LimbKind::left_arm);
  ASSERT_EQ(arm.dof_count(), 7);
  EXPECT_EQ(arm.space.dofs[0].name, "Shoulder, swing up");
  EXPECT_EQ(arm.space.dofs[3].name, "Elbow, flexion");
  EXPECT_EQ(arm.space.dofs[3].role, DofRole::flexion);
  EXPECT_EQ(arm.space.dofs[5].role, DofRole::secondary_swing);

  // The bind pose is a T-pose: straight, untwisted, level, to the side.
  const LimbState t_pose = limb_state(arm, rest_pose(body.model.skeleton));
  EXPECT_NEAR(t_pose.q[2], 0, 1e-12) << "shoulder twist";
  EXPECT_NEAR(t_pose.q[3], 0, 1e-12) << "elbow flexion";
  EXPECT_NEAR(t_pose.q[4], 0, 1e-12) << "forearm twist";
  Elevation e = elevation(arm, t_pose.q);
  EXPECT_NEAR(e.raise, kPi / 2, 1e-12);
  EXPECT_NEAR(e.forward, 0, 1e-12);

  // The zero pose: 45° forward, 20° below level.
  Dofs q;
  q.count = 7;
  e = elevation(arm, q);
  EXPECT_NEAR(e.raise, 70 * kDegree, 1e-12);
  EXPECT_NEAR(e.forward, 45 * kDegree, 1e-12);
  auto points = posed(body, arm, q, body.left[test::kIndex]);
  EXPECT_NEAR(points[1].y - points[0].y, -0.28 * std::sin(20 * kDegree), 1e-12);
  EXPECT_NEAR(glm::distance(points[0], points[2]), 0.28 + 0.25, 1e-12) << "straight";

  // More of the first number raises, more of the second goes forward, on both sides.
  for (const LimbKind kind : {LimbKind::left_arm, LimbKind::right_arm}) {
    const LimbModel side = fit(body, kind);
    Dofs up = q, ahead = q, bent = q;
    up[0] = 0.2;
    ahead[1] = 0.2;
    bent[3] = 0.5;
    EXPECT_NEAR(elevation(side, up).raise, 70 * kDegree + 0.2, 0.01);
    EXPECT_GT(elevation(side, ahead).forward, 45 * kDegree + 0.15);
    // From the T-pose elbows bend to the front, with the hand on the level of the shoulder.
    const LimbState level = limb_state(side, rest_pose(body.model.skeleton));
    Dofs flexed = level.q;
    flexed[3] = kPi / 2;
    points = posed(body, side, flexed, beyond(body, kind));
    EXPECT_NEAR(points[2].z - points[1].z, 0.25, 1e-9);
    EXPECT_NEAR(points[2].y, points[0].y, 1e-9);
    // Twist inward turns the bent forearm down.
    flexed[2] += 0.3;
    points = posed(body, side, flexed, beyond(body, kind));
    EXPECT_LT(points[2].y, points[0].y - 0.05);
    // The palm bends down from level, and sideways is towards the thumb.
    Dofs hand = level.q;
    hand[6] += 0.4;
    points = posed(body, side, hand, beyond(body, kind));
    EXPECT_LT(points[3].y, points[2].y - 0.03);
    hand = level.q;
    hand[5] += 0.4;
    points = posed(body, side, hand, beyond(body, kind));
    EXPECT_GT(points[3].z, points[2].z + 0.02);
  }
}

TEST(LimbModel, LegsReadAsAnatomy) {
  BodyOptions options;
  options.axes_seed = 7;
  const Body body = make_body(options);
  for (const LimbKind kind : {LimbKind::left_leg, LimbKind::right_leg}) {
    const LimbModel leg = fit(body, kind);
    ASSERT_EQ(leg.dof_count(), 7);
    const LimbState standing = limb_state(leg, rest_pose(body.model.skeleton));
    const int toes = beyond(body, kind);
    const auto at = [&](int dof, double change) {
      Dofs q = standing.q;
      q[dof] += change;
      return posed(body, leg, q, toes);
    };
    const auto rest = at(0, 0);
    const double outward = rest[0].x > 0 ? 1 : -1;
    EXPECT_LT(elevation(leg, standing.q).raise, 3 * kDegree);
    EXPECT_GT((at(0, 0.2)[1].x - rest[1].x) * outward, 0.05) << "hip swings out";
    EXPECT_GT(at(1, 0.2)[1].z - rest[1].z, 0.05) << "hip swings forward";
    EXPECT_LT(at(3, 0.5)[2].z - rest[2].z, -0.1) << "knee bends back";
    EXPECT_LT((at(2, 0.3)[3].x - rest[3].x) * outward, -0.02) << "hip twists inward";
    EXPECT_GT(at(6, 0.3)[3].y - rest[3].y, 0.03) << "ankle bends up";
    EXPECT_NEAR(standing.q[5], 0, 1e-12);
    EXPECT_NEAR(standing.q[6], 0, 1e-12);
    EXPECT_GT(standing.q[3], 0);
    EXPECT_TRUE(leg.space.within_limits(standing.q));
  }
}

TEST(LimbModel, DefaultLimitsAreSane) {
  const Body body = make_body({});
  for (const LimbKind kind : kFour) {
    const LimbModel limb = fit(body, kind);
    Dofs zero;
    zero.count = limb.dof_count();
    EXPECT_TRUE(limb.space.within_limits(zero)) << "the zero pose lies inside";
    EXPECT_EQ(limb.space.ellipses.size(), 2u);
    for (const EllipseLimit& ellipse : limb.space.ellipses) {
      EXPECT_LT(ellipse.half_first, kPi);
      EXPECT_LT(ellipse.half_second, kPi);
    }
    for (const Dof& dof : limb.space.dofs) {
      EXPECT_FALSE(dof.name.empty());
      EXPECT_LT(dof.lower, dof.upper);
      EXPECT_LE(dof.lower, dof.sample_lower);
      EXPECT_GE(dof.upper, dof.sample_upper);
      EXPECT_GT(dof.speed_limit, 0);
      if (dof.role == DofRole::secondary_swing) {
        EXPECT_LT(dof.sample_upper - dof.sample_lower, 0.7 * (dof.upper - dof.lower)) << dof.name;
      } else {
        EXPECT_EQ(dof.sample_lower, dof.lower) << dof.name;
        EXPECT_EQ(dof.sample_upper, dof.upper) << dof.name;
      }
    }
    EXPECT_LT(limb.space.dofs[3].lower, 0) << "slight hyperextension";
    EXPECT_GT(limb.space.dofs[3].lower, -20 * kDegree);
  }
  // Ranges of motion [Boone, Azen 1979], as poses of the left arm: bone direction by raise and
  // forward; inside the shoulder's ellipse.
  const LimbModel arm = fit(body, LimbKind::left_arm);
  const struct {
    double raise, forward;
    bool inside;
  } poses[] = {{0, 0, true},      {90, 0, true},     {90, 90, true},    {180, 0, true},
               {45, -90, true},   {90, 130, true},   {90, -40, true},   {120, 90, true},
               {90, -135, false}, {60, -150, false}, {120, -120, false}};
  for (const auto& pose : poses) {
    const double raise = pose.raise * kDegree, forward = pose.forward * kDegree;
    const Vec3 bone(std::sin(raise) * std::cos(forward), -std::cos(raise),
                    std::sin(raise) * std::sin(forward));
    const Vec3 zero = arm.joints[0].parent_from_zero * Vec3(1, 0, 0);
    const Quat swing = glm::conjugate(arm.joints[0].parent_from_zero) *
                       shortest_rotation(zero, bone) * arm.joints[0].parent_from_zero;
    const Vec3 v = rotation_vector_from_quat(swing);
    Dofs q;
    q.count = 7;
    q[0] = v.y;
    q[1] = v.z;
    EXPECT_NEAR(elevation(arm, q).raise, raise, 1e-6);
    EXPECT_EQ(arm.space.within_limits(q), pose.inside) << pose.raise << " " << pose.forward;
  }
}

// A clip that turns the left forearm about an axis given at the bind pose (world space).
Clip bending_clip(const Body& body, int joint, const Vec3& world_axis, double from, double to,
                  int keys) {
  std::vector<Mat4> globals = bind_globals(body.model, body.character());
  const int parent = body.model.skeleton.joints[static_cast<std::size_t>(joint)].parent;
  const Quat parent_rotation = rotation_of(globals[static_cast<std::size_t>(parent)]);
  const Vec3 axis = glm::conjugate(parent_rotation) * world_axis;
  const Quat rest = body.model.skeleton.joints[static_cast<std::size_t>(joint)].rest.rotation;
  Clip clip;
  Channel channel;
  channel.joint = joint;
  for (int i = 0; i < keys; ++i) {
    const double u = static_cast<double>(i) / (keys - 1);
    const Quat q = glm::angleAxis(from + (to - from) * u, axis) * rest;
    channel.times.push_back(static_cast<float>(u));
    for (const double c : {q.x, q.y, q.z, q.w}) channel.values.push_back(static_cast<float>(c));
  }
  clip.channels.push_back(channel);
  clip.begin = 0;
  clip.end = 1;
  return clip;
}

TEST(LimbModel, TheFlexionAxisIsWhatTheClipsDo) {
  BodyOptions options;
  options.axes_seed = 8;
  Body body = make_body(options);
  // A thumb would tell where the palm is.
  std::erase(body.model.characters[0].joints, body.left[test::kThumb]);
  // Bound straight with the arm turned: its elbow bends down instead of forward.
  const int forearm = body.left[test::kForearm];
  body.model.clips.push_back(bending_clip(body, forearm, Vec3(0, 0, -1), 0, 1.5, 30));
  const LimbModel arm = fit(body, LimbKind::left_arm);
  EXPECT_EQ(arm.joints[1].kind, JointModelKind::hinge);
  EXPECT_NE(arm.flexion_axis_from.find("clips"), std::string::npos) << arm.flexion_axis_from;
  const LimbState bent = limb_state_at(arm, body.model, body.model.clips[0], 1.0);
  EXPECT_NEAR(bent.q[3], 1.5, 1e-6);
  EXPECT_NEAR(bent.q[4], 0, 1e-6);
  EXPECT_LT(glm::length(rotation_vector_from_quat(bent.residual[1])), 1e-6);
}

TEST(LimbModel, AJointThatIsNoHingeBecomesABallAndSaysSo) {
  BodyOptions options;
  options.axes_seed = 9;
  Body body = make_body(options);
  const int forearm = body.left[test::kForearm], hand = body.left[test::kHand];
  body.model.clips.push_back(bending_clip(body, forearm, Vec3(0, -1, 0), -1, 1, 30));
  body.model.clips.push_back(bending_clip(body, forearm, Vec3(0, 0, -1), -1, 1, 30));
  body.model.clips.push_back(bending_clip(body, hand, Vec3(1, 0, 0), -1, 1, 30));
  const LimbModel arm = fit(body, LimbKind::left_arm);
  EXPECT_EQ(arm.joints[1].kind, JointModelKind::ball);
  EXPECT_EQ(arm.joints[2].kind, JointModelKind::ball);
  EXPECT_EQ(arm.dof_count(), 9);
  ASSERT_EQ(arm.notes.size(), 2u);
  EXPECT_NE(arm.notes[0].find("lowerarm_l"), std::string::npos);
  for (const Clip& clip : body.model.clips) {
    for (double t = 0; t <= 1; t += 0.05) {
      const LimbState state = limb_state_at(arm, body.model, clip, t);
      for (const Quat& residual : state.residual) {
        EXPECT_LT(glm::length(rotation_vector_from_quat(residual)), 1e-9);
      }
    }
  }
}

TEST(LimbModel, AConstantTwistOfTheWristIsCentredAway) {
  Body body = make_body({});
  const int hand = body.left[test::kHand];
  body.model.clips.push_back(bending_clip(body, hand, Vec3(1, 0, 0), 0.7, 0.75, 20));
  const LimbModel arm = fit(body, LimbKind::left_arm);
  EXPECT_EQ(arm.joints[2].kind, JointModelKind::swing);
  const LimbState state = limb_state_at(arm, body.model, body.model.clips[0], 0.5);
  EXPECT_LT(glm::length(rotation_vector_from_quat(state.residual[2])), 0.05);
}

TEST(LimbState, NumbersGoOnPastAHalfTurn) {
  const Body body = make_body({});
  const LimbModel arm = fit(body, LimbKind::left_arm);
  // Twist of the shoulder, flexion of the elbow and a swing, each through three turns.
  for (const int dof : {0, 2, 3, 4}) {
    LimbState state;
    state.q.count = 7;
    for (int i = 0; i <= 600; ++i) {
      LimbState wanted;
      wanted.q.count = 7;
      wanted.q[dof] = i * 0.01 * (dof == 0 ? 0.9 : 3);
      Pose pose = rest_pose(body.model.skeleton);
      apply_limb_state(arm, wanted, pose);
      state = limb_state(arm, pose, &state);
      for (int k = 0; k < 7; ++k) ASSERT_NEAR(state.q[k], wanted.q[k], 1e-7) << dof << " at " << i;
    }
  }
}

TEST(LimbState, WithoutPreviousItIsWithinLimitsWhereItCanBe) {
  const Body body = make_body({});
  const LimbModel arm = fit(body, LimbKind::left_arm);
  Random random(23);
  for (int n = 0; n < 2000; ++n) {
    LimbState wanted;
    wanted.q = random_within(arm.space, random);
    Pose pose = rest_pose(body.model.skeleton);
    apply_limb_state(arm, wanted, pose);
    const LimbState found = limb_state(arm, pose);
    for (int k = 0; k < 7; ++k) EXPECT_NEAR(found.q[k], wanted.q[k], 1e-8);
  }
}

TEST(LimbClip, RatesAreTheCurvesOwnOnEitherSide) {
  Body body = make_body({});
  const int forearm = body.left[test::kForearm];
  body.model.clips.push_back(bending_clip(body, forearm, Vec3(0, -1, 0), 0.2, 1.2, 3));
  const LimbModel arm = fit(body, LimbKind::left_arm);
  const Clip& clip = body.model.clips[0];
  // One radian a second, up to the last key; nothing after it.
  for (const int side : {-1, 1}) {
    const Dofs rates = limb_rates_at(arm, body.model, clip, 0.3, side);
    EXPECT_NEAR(rates[3], 1, 1e-4);
    EXPECT_NEAR(rates[0], 0, 1e-6);
  }
  EXPECT_NEAR(limb_rates_at(arm, body.model, clip, 1, -1)[3], 1, 1e-4);
  EXPECT_NEAR(limb_rates_at(arm, body.model, clip, 1, 1)[3], 0, 1e-6);
  EXPECT_NEAR(limb_rates_at(arm, body.model, clip, 0, -1)[3], 0, 1e-6);

  // A step is no speed, on either side of it.
  Clip stepping = clip;
  stepping.channels[0].interpolation = Interpolation::step;
  for (const int side : {-1, 1}) {
    EXPECT_NEAR(limb_rates_at(arm, body.model, stepping, 0.5, side)[3], 0, 1e-6);
  }
}

TEST(LimbModel, SwingsMayBeBoundedByPolygons) {
  const Body body = make_body({});
  LimbModel arm = fit(body, LimbKind::left_arm);
  const auto corners = polygon_of_ellipse(arm, LimbJointRole::root, 16);
  ASSERT_EQ(corners.size(), 16u);
  const DofSpace before = arm.space;
  ASSERT_TRUE(set_swing_polygon(arm, LimbJointRole::root, corners).ok());
  EXPECT_EQ(arm.space.ellipses.size(), before.ellipses.size() - 1);
  ASSERT_EQ(arm.space.polygons.size(), 1u);
  // It lies inside the ellipse it was made of, and holds most of it.
  Random random(31);
  int inside = 0, both = 0;
  for (int n = 0; n < 4000; ++n) {
    const Dofs q = random_within(before, random);
    ++inside;
    both += arm.space.within_limits(q);
    const Dofs p = random_within(arm.space, random);
    EXPECT_TRUE(before.within_limits(p, 1e-6));
  }
  EXPECT_GT(both, inside * 0.93);
  // Edited again: the old one is gone. A narrower one narrows the ranges and sampling intervals.
  ASSERT_TRUE(
      set_swing_polygon(arm, LimbJointRole::root, {{0.5, -0.4}, {0.5, 0.4}, {-0.3, 0}}).ok());
  EXPECT_EQ(arm.space.polygons.size(), 1u);
  EXPECT_NEAR(arm.space.dofs[0].upper, 0.5, 1e-12);
  EXPECT_NEAR(arm.space.dofs[0].sample_lower, -0.3, 1e-12);
  EXPECT_NEAR(arm.space.dofs[1].lower, -0.4, 1e-12);
  EXPECT_EQ(arm.space.dofs[2].upper, before.dofs[2].upper);
  // What can't be changes nothing.
  const DofSpace kept = arm.space;
  EXPECT_FALSE(set_swing_polygon(arm, LimbJointRole::middle, corners).ok());
  EXPECT_FALSE(set_swing_polygon(arm, LimbJointRole::root, {{1, 1}, {2, 1}, {2, 2}}).ok());
  EXPECT_FALSE(set_swing_polygon(arm, LimbJointRole::root, {{3.2, 0}, {0, 1}, {-1, -1}}).ok());
  EXPECT_EQ(arm.space.polygons[0].corners, kept.polygons[0].corners);
}

// Whatever joint swings can be edited as a polygon, with as many corners as one likes.
TEST(LimbModel, EverySwingHasAPolygonToBeginWith) {
  const Body body = make_body({});
  for (const LimbKind kind : {LimbKind::left_arm, LimbKind::right_leg}) {
    const LimbModel limb = fit(body, kind);
    for (const LimbJointRole role : {LimbJointRole::root, LimbJointRole::end}) {
      if (limb.joints[static_cast<std::size_t>(role)].kind == JointModelKind::fixed) continue;
      for (const int corners : {3, 8, 10, 12, 72, 96, 360}) {
        const SwingPolygon polygon = swing_polygon_of(limb, role, corners);
        ASSERT_GE(polygon.size(), 3u) << limb.limb.name << " with " << corners;
        LimbModel edited = limb;
        EXPECT_TRUE(set_swing_polygon(edited, role, polygon).ok());
      }
    }
    EXPECT_TRUE(swing_polygon_of(limb, LimbJointRole::middle).empty()) << "a hinge has none";
  }
}

TEST(LimbModel, DegenerateRigsAreRefusedWithAReason) {
  Body body = make_body({});
  const LimbFindings findings = find_limbs(body.model, body.character());
  const Limb arm = *limb_by_name(body.model, body.character(), "left_arm");

  Body flat = body;
  for (Skin& skin : flat.model.skins) {
    const auto& joints = skin.joints;
    std::size_t fore = 0, upper = 0;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      if (joints[i] == arm.middle) fore = i;
      if (joints[i] == arm.root) upper = i;
    }
    skin.inverse_bind[fore] = skin.inverse_bind[upper];
  }
  const auto no_bone = fit_limb_model(flat.model, flat.character(), arm, findings);
  ASSERT_FALSE(no_bone);
  EXPECT_NE(no_bone.error().message().find("upperarm_l"), std::string::npos);

  Body matrix = body;
  matrix.model.skeleton.joints[static_cast<std::size_t>(arm.middle)].rest_matrix = Mat4(1.0);
  const auto not_animated = fit_limb_model(matrix.model, matrix.character(), arm, findings);
  ASSERT_FALSE(not_animated);
  EXPECT_NE(not_animated.error().message().find("lowerarm_l"), std::string::npos);

  Limb nowhere = arm;
  nowhere.end = 10000;
  EXPECT_FALSE(fit_limb_model(body.model, body.character(), nowhere, findings));
  nowhere.end = -1;
  EXPECT_FALSE(fit_limb_model(body.model, body.character(), nowhere, findings));

  // Rotations that are no numbers count as nothing.
  Body bad = body;
  bad.model.clips.push_back(bending_clip(body, arm.middle, Vec3(0, -1, 0), 0.1, 1.4, 10));
  bad.model.clips[0].channels[0].values[5] = std::numeric_limits<float>::quiet_NaN();
  const auto fitted = fit_limb_model(bad.model, bad.character(), arm, findings);
  ASSERT_TRUE(fitted);
  EXPECT_TRUE(std::isfinite(fitted->joints[1].parent_from_zero.w));
}

TEST(LimbModel, AnEndThatTurnsNothingIsFixed) {
  Body body = make_body({});
  // Take the hand and all below it out of the skin: a bare leaf, as exporters leave them.
  Character& character = body.model.characters[0];
  std::vector<int> kept;
  for (const int joint : character.joints) {
    if (!body.model.skeleton.is_within(joint, body.left[test::kHand])) kept.push_back(joint);
  }
  character.joints = kept;
  const LimbModel arm = fit(body, LimbKind::left_arm);
  EXPECT_EQ(arm.joints[2].kind, JointModelKind::fixed);
  EXPECT_EQ(arm.dof_count(), 5);
  ASSERT_EQ(arm.notes.size(), 1u);
  const Pose rest = rest_pose(body.model.skeleton);
  const LimbState state = limb_state(arm, rest);
  Pose pose = rest;
  apply_limb_state(arm, state, pose);
  const auto hand = static_cast<std::size_t>(body.left[test::kHand]);
  EXPECT_LT(angle_between(pose.local[hand].rotation, rest.local[hand].rotation), 1e-12);
}

}  // namespace
}  // namespace elbowroom
