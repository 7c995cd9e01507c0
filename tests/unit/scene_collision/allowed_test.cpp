// SPDX-License-Identifier: MIT
// Allowed contacts are patches to a depth, never whole pairs of parts (DESIGN.md).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/collision/allowed_patches.h"
#include "core/collision/body_parts.h"
#include "core/collision/scene_collision_data.h"
#include "core/collision/surface_patches.h"
#include "tests/unit/scene_collision/figure.h"

namespace elbowroom::test {
namespace {

TEST(BodyParts, TrianglesFollowTheJointThatWeighsMost) {
  const auto figure = make_figure();
  const Mesh& skin = figure->meshes[0];
  const auto joints = joints_of_triangles(skin);
  ASSERT_EQ(joints.size(), skin.triangles.size());
  for (std::size_t t = 0; t < joints.size(); ++t) {
    double x = 0;
    for (int k = 0; k < 3; ++k)
      x += static_cast<double>(skin.positions[skin.triangles[t][k]].x) / 3;
    if (x > 0.55 && x < 0.7) {
      EXPECT_EQ(joints[t], kFore);
    } else if (x > 0.25 && x < 0.45) {
      EXPECT_EQ(joints[t], kUpper);
    } else if (x < 0.15) {
      EXPECT_EQ(joints[t], kHips);
    }
  }
  const auto sides = limb_sides(figure->skeleton, {arm_of(*figure).limb});
  EXPECT_EQ(sides[kHips].limb, -1);
  EXPECT_EQ(sides[kUpper].segment, kUpperSegment);
  EXPECT_EQ(sides[kFore].segment, kLowerSegment);
  EXPECT_EQ(sides[kFinger].segment, kEndSegment);
  EXPECT_EQ(joint_part_name("Ada", figure->skeleton, kFore), "Ada/ForeArm");
  EXPECT_EQ(joint_part_name("", figure->skeleton, 77), "character/unknown joint");
}

TEST(SurfacePatches, AreConnectedSmallAndCoverEverything) {
  const Shape sphere = sphere_shape(0.2f, 24, 32);
  const std::vector<Vec3> positions(sphere.positions.begin(), sphere.positions.end());
  const WeldedSurface surface = weld(positions, sphere.triangles, 1e-7);
  const std::vector<int> group(sphere.triangles.size(), 0);
  const Patches patches = cut_into_patches(surface, group, 0.05);
  EXPECT_GT(patches.count, 80);
  EXPECT_LT(patches.count, 900);
  std::vector<Vec3> low(static_cast<std::size_t>(patches.count), Vec3(1e9)), high = low;
  for (auto& h : high) h = -h;
  for (std::size_t t = 0; t < sphere.triangles.size(); ++t) {
    ASSERT_LT(patches.of_triangle[t], patches.count);
    for (int k = 0; k < 3; ++k) {
      const Vec3 p(positions[sphere.triangles[t][k]]);
      low[patches.of_triangle[t]] = glm::min(low[patches.of_triangle[t]], p);
      high[patches.of_triangle[t]] = glm::max(high[patches.of_triangle[t]], p);
    }
  }
  for (std::size_t p = 0; p < low.size(); ++p) EXPECT_LT(glm::distance(low[p], high[p]), 0.15);
  // From pole to pole along the surface, a fifth longer at most than it is.
  const std::vector<std::uint32_t> source = {surface.point_of[0]};
  const auto distance = distance_along(surface, source, 10);
  EXPECT_NEAR(*std::max_element(distance.begin(), distance.end()), kPi * 0.2, 0.2 * kPi * 0.2);
}

TEST(SurfacePatches, ASoupBeyondNumberIsGatheredByPlace) {
  std::vector<Vec3> positions;
  std::vector<glm::uvec3> triangles;
  for (std::uint32_t i = 0; i < 30000; ++i) {
    const Vec3 at(i % 100, (i / 100) % 100, i / 10000.0);
    for (const Vec3& corner : {Vec3(0.0), Vec3(0.1, 0, 0), Vec3(0, 0.1, 0)})
      positions.push_back(at + corner);
    triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  const WeldedSurface surface = weld(positions, triangles, 1e-6);
  const std::vector<int> group(triangles.size(), 0);
  const Patches patches = cut_into_patches(surface, group, 0.01);
  EXPECT_LE(patches.count, 4096);
  EXPECT_GT(patches.count, 100);
}

// The hanging hand runs 1 cm into the thigh's side in the clip.
struct Brushing {
  std::shared_ptr<Model> figure = make_figure({.thigh_side = 0.16});
  std::shared_ptr<Clip> clip = swing_clip({0, 1}, {-0.4, -kPi / 2});
  SceneCollision scene = scene_of(world_of(figure, clip));
};

TEST(AllowedContacts, WhatTheClipHasIsAllowedAndListed) {
  Brushing b;
  EXPECT_TRUE(b.scene.scan(0, 1, 60, 0, false).empty());
  EXPECT_FALSE(b.scene.limb_in_contact(1, 0, kEpsilon));
  const auto listed = b.scene.scan(0, 1, 60, 0, true);
  const bool clip = std::any_of(listed.begin(), listed.end(), [](const auto& interval) {
    return interval.deepest.allowed && interval.deepest.reason == AllowedReason::clip &&
           interval.deepest.part_b == "Ada/Hips";
  });
  EXPECT_TRUE(clip);
  double depth = 0;
  for (const auto& entry : b.scene.allowed_contacts().entries)
    if (entry.reason == AllowedReason::clip) {
      depth = std::max(depth, entry.depth);
      EXPECT_GT(entry.patches, 0);
    }
  EXPECT_NEAR(depth, 0.01, 0.004);
}

TEST(AllowedContacts, TheHandThatBrushesTheThighMayNotGoThroughIt) {
  Brushing b;
  // A centimetre and a half deeper, at the same place and time.
  const double deeper = -kPi / 2 - 0.015 / 0.6;
  b.scene.set_clip(swing_clip({0, 1}, {-0.4, deeper}));
  EXPECT_TRUE(b.scene.limb_in_contact(1, 0, kEpsilon));
  EXPECT_TRUE(touches(b.scene, 1, "Hips"));
  // Right through.
  b.scene.set_clip(swing_clip({0, 1}, {-0.4, -kPi / 2 - 0.2}));
  EXPECT_TRUE(b.scene.limb_in_contact(1, 0, kEpsilon));
  // As the clip has it, in another copy of the clip.
  b.scene.set_clip(std::make_shared<Clip>(*b.clip));
  for (int i = 0; i <= 240; ++i) EXPECT_FALSE(b.scene.limb_in_contact(i / 240.0, 0, kEpsilon)) << i;
  // A shade less deep, too.
  b.scene.set_clip(swing_clip({0, 1}, {-0.4, -kPi / 2 + 0.004}));
  EXPECT_FALSE(b.scene.limb_in_contact(1, 0, kEpsilon));
}

TEST(AllowedContacts, TheThighIsBrushedWhenTheClipBrushesItAndNotBefore) {
  Brushing b;
  LimbState as_deep;
  as_deep.q.count = 7;
  as_deep.q[1] = -kPi / 2;
  b.scene.pose_limb(0, &as_deep);
  EXPECT_FALSE(b.scene.limb_in_contact(1, 0, kEpsilon));
  EXPECT_FALSE(b.scene.limb_in_contact(0.95, 0, kEpsilon)) << "a little earlier in its own time";
  EXPECT_TRUE(b.scene.limb_in_contact(0.3, 0, kEpsilon)) << "the clip's hand is far away then";
}

TEST(AllowedContacts, PartsTouchAboutTheTimesTheClipHasThemTouch) {
  AllowedPatches allowed(2, 3);
  allowed.clip_depths[{7, 9}] = {{0.2, 0.01}, {0.25, 0.02}, {0.3, 0.01}, {0.9, 0.03}};
  const double memory = 0.1;
  EXPECT_FALSE(allowed.clip_touches(7, 9, 0.05, 0.05, memory));
  EXPECT_TRUE(allowed.clip_touches(7, 9, 0.11, 0.29, memory));
  EXPECT_FALSE(allowed.clip_touches(7, 9, 0.11, 0.5, memory)) << "not throughout";
  EXPECT_FALSE(allowed.clip_touches(7, 9, 0.6, 0.6, memory));
  EXPECT_FALSE(allowed.clip_touches(9, 7, 0.25, 0.25, memory)) << "another pair";
  EXPECT_FALSE(allowed.clip_touches(7, 9, std::nan(""), 0.25, memory));
  EXPECT_EQ(allowed.depth_about(7, 9, 0.35, memory), 0.02);
  EXPECT_LT(allowed.depth_about(7, 9, 0.6, memory), 0);
  allowed.allow(1, 2, AllowedPatches::kClip);
  allowed.allow(1, 2, AllowedPatches::kClip);
  EXPECT_EQ(allowed.clip_pairs, (std::vector<std::uint32_t>{5}));
}

TEST(AllowedContacts, AnotherPartOfTheThighIsNotAllowed) {
  Brushing b;
  // The arm comes at the thigh's front instead of its side: swing about y as well.
  LimbState state;
  state.q.count = 7;
  state.q[1] = -kPi / 2 - 0.12;
  state.q[2] = 0;
  state.q[0] = 0.35;
  b.scene.pose_limb(0, &state);
  LimbState as_clip;
  as_clip.q.count = 7;
  as_clip.q[1] = -kPi / 2;
  EXPECT_TRUE(b.scene.limb_in_contact(1, 0, kEpsilon));
  b.scene.pose_limb(0, &as_clip);
  EXPECT_FALSE(b.scene.limb_in_contact(1, 0, kEpsilon));
  b.scene.pose_limb(0, nullptr);
  EXPECT_FALSE(b.scene.limb_in_contact(1, 0, kEpsilon));
}

TEST(AllowedContacts, FinalVerdictsAreNeverLaxerThanPlanning) {
  Brushing b;
  LimbState state;
  state.q.count = 7;
  for (int i = 0; i <= 80; ++i) {
    const double forward = 0.01 * (i % 2 ? -i : i) / 2;
    state.q[0] = forward;
    state.q[1] = -kPi / 2 + (i == 0 ? 0 : 0.004);
    b.scene.pose_limb(0, &state);
    b.scene.allow_beside_clip_contacts(true);
    const bool while_planning = b.scene.limb_in_contact(1, 0, kEpsilon);
    b.scene.allow_beside_clip_contacts(false);
    const bool at_last = b.scene.limb_in_contact(1, 0, kEpsilon);
    EXPECT_TRUE(at_last || !while_planning) << forward << ": never laxer";
    if (forward == 0) {
      EXPECT_FALSE(at_last) << "as the clip has it";
    }
    std::vector<ContactSample> contacts;
    b.scene.contacts_at(1, 0, false, contacts);
    EXPECT_EQ(contacts.empty(), !at_last) << forward << ": what is listed is what is said";
  }
}

TEST(AllowedContacts, TrianglesOfOnePatchAreToldApart) {
  Brushing b;
  int tested = 0;
  for (const auto& [bodies, allowed] : b.scene.data().allowed_pairs) {
    const ClipTouching& touching = allowed.touching;
    if (touching.empty()) continue;
    const auto& a = b.scene.data().bodies[static_cast<std::size_t>(bodies.first)];
    const auto& other = b.scene.data().bodies[static_cast<std::size_t>(bodies.second)];
    const auto none = touching.allowed_where(std::vector<bool>(touching.parts().size(), false));
    const auto all = touching.allowed_where(std::vector<bool>(touching.parts().size(), true));
    int apart = 0;
    for (std::uint32_t t = 0; t < a.triangles().size(); ++t)
      for (std::uint32_t u = 0; u < other.triangles().size(); ++u) {
        const std::uint8_t reasons = allowed.reasons_of(a.patch_of()[t], other.patch_of()[u]);
        const bool lasting = reasons & (AllowedPatches::kShared | AllowedPatches::kBind);
        EXPECT_EQ(touching.filter(none).allows(t, u), lasting);
        EXPECT_EQ(touching.filter(all).allows(t, u), touching.allows(t, u));
        if (touching.allows(t, u)) {
          EXPECT_NE(reasons, 0) << "planning may do what the verdict allows";
        } else {
          apart += (reasons & AllowedPatches::kClip) != 0;
        }
      }
    EXPECT_GT(apart, 0);
    ++tested;
  }
  EXPECT_GT(tested, 0);
}

TEST(AllowedContacts, WhereTheClipIsNearTheLimbMayBeAsNear) {
  // The hanging hand stays 3 mm off the thigh: nearer than the planning clearance.
  const auto figure = make_figure({.thigh_side = 0.147});
  SceneCollision scene = scene_of(world_of(figure, swing_clip({0, 1}, {-0.4, -kPi / 2})));
  const LimbState as_clip = [] {
    LimbState state;
    state.q.count = 7;
    state.q[1] = -kPi / 2;
    return state;
  }();
  scene.pose_limb(0, &as_clip);
  EXPECT_FALSE(scene.limb_in_contact(1, 0, 0.005));
  EXPECT_TRUE(scene.limb_in_contact(0.2, 0, 0.005)) << "at another time the clip is far from it";
  LimbState into = as_clip;
  into.q[1] -= 0.02;
  scene.pose_limb(0, &into);
  EXPECT_TRUE(scene.limb_in_contact(1, 0, 0.005)) << "near is not in";
  EXPECT_TRUE(scene.limb_in_contact(1, 0, kEpsilon));
}

TEST(AllowedContacts, TheClipsContactWithAnObstacleStaysAProblem) {
  const auto post = make_object("Post", box_shape({0.03f, 0.03f, 0.03f}));
  SceneCollision scene = scene_of(world_of(make_figure(), swing_clip({0, 1}, {0, 0}),
                                           {actor("post.glb", post, Vec3(0.62, 1.4, 0))}));
  EXPECT_TRUE(scene.limb_in_contact(0.5, 0, kEpsilon));
}

TEST(AllowedContacts, ABentElbowMayCreaseButTheHandMayNotReachThroughTheUpperArm) {
  SceneCollision scene =
      scene_of(world_of(make_figure({.thigh = false}), swing_clip({0, 1}, {0, 0})));
  LimbState state;
  state.q.count = 7;
  state.q[3] = 1.4;
  scene.pose_limb(0, &state);
  EXPECT_FALSE(scene.limb_in_contact(0.5, 0, kEpsilon)) << "80°";
  state.q[3] = kPi - 0.02;
  scene.pose_limb(0, &state);
  EXPECT_TRUE(scene.limb_in_contact(0.5, 0, kEpsilon)) << "folded onto itself";
  std::vector<ContactSample> contacts;
  scene.contacts_at(0.5, 0, false, contacts);
  ASSERT_FALSE(contacts.empty());
  for (const auto& contact : contacts) EXPECT_EQ(contact.limb, 0);
}

TEST(AllowedContacts, AShoulderMovesThroughItsRangeWithoutComplaint) {
  SceneCollision scene =
      scene_of(world_of(make_figure({.thigh = false}), swing_clip({0, 1}, {0, 0})));
  for (const double raise : {-1.2, -0.6, 0.0, 0.6, 1.2})
    for (const double forward : {-0.9, 0.0, 0.9}) {
      LimbState state;
      state.q.count = 7;
      state.q[0] = forward;
      state.q[1] = raise;
      scene.pose_limb(0, &state);
      EXPECT_FALSE(scene.limb_in_contact(0.5, 0, kEpsilon)) << raise << " " << forward;
    }
}

}  // namespace
}  // namespace elbowroom::test
