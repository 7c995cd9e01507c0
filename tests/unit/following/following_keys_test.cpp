// SPDX-License-Identifier: MIT
// What follows a limb is keyed so that a player shows it where it belongs: at every time, from what
// is laid over the clip.
#include "core/editing/following_keys.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "core/anatomy/following.h"
#include "core/base/random.h"
#include "core/editing/correct.h"
#include "core/editing/limb_keys.h"
#include "core/editing/limb_track.h"
#include "tests/unit/following/detached_rig.h"

namespace elbowroom::test {
namespace {

constexpr float kBegin = 0.41f, kEnd = 1.63f;

struct Corrected {
  DetachedRig rig;
  std::shared_ptr<Clip> source;
  LimbModel limb;
  Correction correction;
  Clip clip;
  double length = 0;  // of the leg
};

// A detour of the left leg.
Corrected detour(const RigOptions& options, FootKeys keys) {
  Corrected made;
  made.rig = make_detached_rig(options);
  made.source = walk_of(made.rig, keys);
  const Model& model = *made.rig.model;
  const LimbFindings findings = find_limbs(model, made.rig.character());
  for (const Limb& limb : findings.limbs)
    if (limb.kind == LimbKind::left_leg)
      made.limb = fit_limb_model(model, made.rig.character(), limb, findings).value();
  const LimbTrack track(model, *made.source, made.limb, kBegin, kEnd);
  const auto q = [&](double t) {
    Dofs dofs = track.at(t).q;
    const double u = (t - kBegin) / (static_cast<double>(kEnd) - kBegin);
    for (int d = 0; d < dofs.count; ++d)
      dofs[d] += (d % 2 ? 0.6 : -0.4) * std::pow(std::sin(kPi * u), 2);
    return dofs;
  };
  made.correction.limb = "left_leg";
  made.correction.begin = kBegin;
  made.correction.end = kEnd;
  made.correction.joints = make_limb_keys(model.skeleton, made.limb, q, track.at(kBegin),
                                          track.at(kEnd), {kBegin, kEnd}, 60);
  EXPECT_TRUE(add_following_keys(model, made.limb, *made.source, made.correction).ok());
  const auto laid = lay_over(model.skeleton, *made.source, {made.correction});
  EXPECT_TRUE(laid.ok()) << (laid.ok() ? "" : laid.error().message());
  if (laid.ok()) made.clip = *laid;
  const auto place = [&](const char* name) {
    return Vec3(global_of(model.skeleton, rest_pose(model.skeleton), made.rig.joint(name))[3]);
  };
  made.length = glm::distance(place("UpperLeg.L"), place("LowerLeg.L")) +
                glm::distance(place("LowerLeg.L"), place("Foot.L"));
  return made;
}

// How far a joint is from where it belongs, and how far it is turned from it.
std::pair<double, double> off(const Corrected& made, const FollowingJoint& own, double t) {
  const Skeleton& skeleton = made.rig.model->skeleton;
  Pose before = rest_pose(skeleton), after = before;
  sample_clip(*made.source, t, before);
  sample_clip(made.clip, t, after);
  const Mat4 moved = global_of(skeleton, after, own.serves) *
                     glm::inverse(global_of(skeleton, before, own.serves));
  const Mat4 wanted = moved * global_of(skeleton, before, own.joint);
  const Mat4 shown = global_of(skeleton, after, own.joint);
  return {glm::length(Vec3(wanted[3] - shown[3])),
          angle_between(rotation_of(wanted), rotation_of(shown))};
}

// How far it is turned from where the clip has it.
double detour_of(const Corrected& made, const FollowingJoint& own, double t) {
  Pose before = rest_pose(made.rig.model->skeleton), after = before;
  sample_clip(*made.source, t, before);
  sample_clip(made.clip, t, after);
  return angle_between(rotation_of(global_of(made.rig.model->skeleton, before, own.joint)),
                       rotation_of(global_of(made.rig.model->skeleton, after, own.joint)));
}

TEST(FollowingKeys, AFootStaysOnItsShinAtEveryTime) {
  Random random(2);
  for (const FootKeys keys : {FootKeys::linear, FootKeys::cubic, FootKeys::step, FootKeys::none}) {
    for (const RigOptions& options :
         {RigOptions{}, RigOptions{.scale = 100}, RigOptions{.scale = 0.01, .mirrored = true},
          RigOptions{.garment = true}, RigOptions{.uneven = true}}) {
      SCOPED_TRACE(testing::Message() << "keys " << static_cast<int>(keys) << " scale "
                                      << options.scale << (options.garment ? " garment" : ""));
      const Corrected made = detour(options, keys);
      ASSERT_EQ(made.limb.limb.following.size(), options.garment ? 4u : 1u);
      for (const FollowingJoint& own : made.limb.limb.following) {
        double worst = 0, turned = 0, at_keys = 0, moved = 0;
        for (int i = 0; i < 2000; ++i) {
          // A player's clock is float32.
          const auto t = static_cast<double>(static_cast<float>(random.uniform(-0.5, 2.5)));
          const auto [distance, angle] = off(made, own, t);
          worst = std::max(worst, distance);
          turned = std::max(turned, angle);
        }
        for (const JointKeys& joint : made.correction.joints) {
          if (joint.node != own.joint) continue;
          EXPECT_EQ(joint.translations.size(), joint.keys.times.size());
          EXPECT_LT(joint.keys.times.size(), 1200u);
          for (std::size_t i = 0; i < joint.keys.times.size(); ++i) {
            at_keys =
                std::max(at_keys, off(made, own, static_cast<double>(joint.keys.times[i])).first);
            moved = std::max(moved, detour_of(made, own, static_cast<double>(joint.keys.times[i])));
          }
        }
        EXPECT_LT(worst, 1.2 * kFollowingTolerance * made.length);
        EXPECT_LT(turned, 1e-3);
        EXPECT_LT(at_keys, 2e-6 * made.length);
        EXPECT_GT(moved, 0.2) << "it has been moved at all";
      }
    }
  }
}

TEST(FollowingKeys, NothingElseIsTouched) {
  const Corrected made = detour({}, FootKeys::linear);
  const int foot = made.rig.joint("Foot.L");
  for (const Channel& channel : made.source->channels) {
    const int found = made.clip.find_channel(channel.joint, channel.path);
    ASSERT_GE(found, 0);
    const Channel& now = made.clip.channels[static_cast<std::size_t>(found)];
    const bool own = std::any_of(made.correction.joints.begin(), made.correction.joints.end(),
                                 [&](const JointKeys& joint) {
                                   return joint.node == channel.joint &&
                                          (channel.path == Path::rotation || channel.joint == foot);
                                 });
    EXPECT_EQ(now.source_channel < 0, own);
    if (own) continue;
    EXPECT_EQ(now.times, channel.times);
    EXPECT_EQ(now.values, channel.values);
  }
  // At the window's ends and outside it the foot is the clip's.
  const Channel& before =
      made.source
          ->channels[static_cast<std::size_t>(made.source->find_channel(foot, Path::translation))];
  const Channel& after =
      made.clip.channels[static_cast<std::size_t>(made.clip.find_channel(foot, Path::translation))];
  for (const float t : {0.0f, 0.2f, 0.4f, kBegin, kEnd, 1.7f, 2.0f})
    EXPECT_LT(glm::distance(sample_vector(before, static_cast<double>(t)),
                            sample_vector(after, static_cast<double>(t))),
              1e-7)
        << t;
}

TEST(FollowingKeys, ALimbWithoutNeedsNone) {
  const DetachedRig rig = make_detached_rig({.plain = true});
  const LimbFindings findings = find_limbs(*rig.model, rig.character());
  for (const Limb& limb : findings.limbs) {
    const auto fitted = fit_limb_model(*rig.model, rig.character(), limb, findings);
    Correction correction, same;
    EXPECT_TRUE(
        add_following_keys(*rig.model, *fitted, *walk_of(rig, FootKeys::none), correction).ok());
    EXPECT_EQ(correction, same);
  }
}

// Laid over another clip than it was made for, a foot may be elsewhere at the window's ends.
TEST(FollowingKeys, OverAnotherClipTheyAreRefused) {
  const Corrected made = detour({}, FootKeys::linear);
  Clip other = *made.source;
  for (Channel& channel : other.channels)
    if (channel.joint == made.rig.joint("Foot.L") && channel.path == Path::translation)
      for (float& value : channel.values) value += 0.01f;
  const auto laid = lay_over(made.rig.model->skeleton, other, {made.correction});
  ASSERT_FALSE(laid.ok());
  EXPECT_NE(laid.error().where.find("Foot.L"), std::string::npos) << laid.error().message();
  Correction damaged = made.correction;
  damaged.joints.back().translations.pop_back();
  EXPECT_FALSE(lay_over(made.rig.model->skeleton, *made.source, {damaged}).ok());
}

}  // namespace
}  // namespace elbowroom::test
