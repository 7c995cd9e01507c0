// SPDX-License-Identifier: MIT
// Which contacts of the character in view with itself, and with what it carries, are natural.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "core/collision/scene_collision_data.h"

namespace elbowroom {
namespace {

using Data = SceneCollision::Data;

// The clip is looked at this often, and at its keys, for contacts it has itself.
constexpr double kClipRate = 120;  // Hz
// Long clips are looked at more coarsely, so that building stays a matter of seconds.
constexpr int kMostSamples = 2400;

// The nearest ancestors of `joint` that some triangle of the character follows.
std::vector<int> carriers_of(const Data& data, const Skeleton& skeleton, int joint) {
  std::set<int> followed;
  for (std::size_t b = 0; b < data.bodies.size(); ++b)
    if (data.roles[b].own)
      for (const BodyTriangle& t : data.bodies[b].triangles()) followed.insert(t.joint);
  int at = skeleton.joints[static_cast<std::size_t>(joint)].parent;
  while (at >= 0 && !followed.contains(at))
    at = skeleton.joints[static_cast<std::size_t>(at)].parent;
  return at >= 0 ? std::vector<int>{at} : std::vector<int>{};
}

// The joint two own bodies share, seen from the child's side; joint -1 if none by hierarchy.
SharedJoint shared_joint(const Data& data, const ActorState& bind, const LimbSide& child,
                         const LimbSide& parent, std::size_t parent_body) {
  SharedJoint shared;
  const bool to_trunk = child.segment == kUpperSegment && parent.limb != child.limb;
  const bool along_limb = parent.limb == child.limb && parent.segment == child.segment - 1;
  if (child.limb < 0 || !(to_trunk || along_limb)) return shared;
  const Limb& limb = data.limbs[static_cast<std::size_t>(child.limb)].limb;
  const int joints[3] = {limb.root, limb.middle, limb.end};
  const auto place = [&](int joint) {
    return Vec3(bind.world_from_joint[static_cast<std::size_t>(joint)][3]) - data.origin;
  };
  const int joint = joints[child.segment];
  const Skeleton& skeleton =
      data.world.actors[static_cast<std::size_t>(data.actor)].model->skeleton;
  shared.carriers = carriers_of(data, skeleton, joint);
  // Of a trunk cut into bodies only the one that carries the joint shares it by hierarchy.
  const auto& triangles = data.bodies[parent_body].triangles();
  const bool carries = std::any_of(triangles.begin(), triangles.end(), [&](const auto& t) {
    return std::find(shared.carriers.begin(), shared.carriers.end(), t.joint) !=
           shared.carriers.end();
  });
  shared.limb_length = glm::distance(place(limb.root), place(limb.middle)) +
                       glm::distance(place(limb.middle), place(limb.end));
  if (!carries) return shared;
  shared.joint = joint;
  shared.place = place(joint);
  if (child.segment < kEndSegment) shared.bone = place(joints[child.segment + 1]) - shared.place;
  return shared;
}

// Times at which the clip is looked at.
std::vector<double> clip_times(const Data& data) {
  std::vector<double> times;
  const double length = data.end - data.begin;
  const int samples =
      std::clamp(static_cast<int>(std::ceil(std::min(length * kClipRate, 1e9))), 1, kMostSamples);
  for (int i = 0; i <= samples; ++i) times.push_back(data.begin + length * i / samples);
  if (data.source_clip)
    for (const Channel& channel : data.source_clip->channels)
      for (const float key : channel.times)
        if (key > data.begin && key < data.end) times.push_back(key);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  // Keys of long clips are thinned like their samples.
  const std::size_t most = 2u * kMostSamples;
  if (times.size() > most) {
    std::vector<double> fewer;
    for (std::size_t i = 0; i < most; ++i) fewer.push_back(times[i * times.size() / most]);
    times = std::move(fewer);
  }
  return times;
}

// What the clip has in contact over time, gathered aside: what is allowed so far must not split the
// contacts of two parts, which are measured as one.
struct ClipTouch {
  std::map<std::pair<int, int>, double> depth;  // by parts: the deepest
  std::map<std::pair<int, int>, std::vector<AllowedPatches::DepthAt>> depths;
  std::set<std::pair<std::uint16_t, std::uint16_t>> patches;
  std::map<std::pair<int, int>, ClipTouching::Parts> touched;  // by parts
  bool looked = false;
  std::map<std::pair<int, int>, double> last;  // how deep they were at the last look
};

// One look at the clip as it is posed. Between two looks the clip may be deeper than at either, by
// half their difference at the slopes seen.
void look_at_clip(Data& data, TestPair& pair, ClipTouch& touch) {
  const auto touching = contact_groups(data, pair, data.touching(), Skip::lasting);
  const bool first = !touch.looked;
  touch.looked = true;
  const std::map<std::pair<int, int>, double> before = std::move(touch.last);
  touch.last.clear();
  if (touching.empty() && before.empty()) return;
  std::map<std::pair<int, int>, double>& parts = touch.last;
  for (const ContactGroup& group : touching) {
    ClipTouching::Parts& touched = touch.touched[{group.part_a, group.part_b}];
    touched.part_a = group.part_a;
    touched.part_b = group.part_b;
    touched.a.insert(group.triangles_a.begin(), group.triangles_a.end());
    touched.b.insert(group.triangles_b.begin(), group.triangles_b.end());
    double& now = parts[{group.part_a, group.part_b}];
    now = std::max(now, group.depth);
  }
  const auto deepen = [&](const std::pair<int, int>& key, double now, double then) {
    const double about = std::max(now, then) + 0.5 * std::abs(now - then);
    double& depth = touch.depth[key];
    depth = std::max(depth, about);
    touch.depths[key].push_back({data.posed_at, about});
  };
  for (const auto& [key, now] : parts) {
    const auto earlier = before.find(key);
    // Of what came before the first look nothing is known, nor asked.
    deepen(key, now, first ? now : earlier == before.end() ? 0.0 : earlier->second);
  }
  for (const auto& [key, then] : before)
    if (!parts.contains(key)) deepen(key, 0.0, then);
  if (touching.empty()) return;
  // Where two parts are in contact, what is near beside it is part of the same touching: an arm
  // that rests on a coat slides over it as it moves, and stays as shallow as the clip has it.
  const auto near = contact_groups(
      data, pair, std::max(data.settings.clearance, data.settings.touch_reach) * data.height,
      Skip::lasting, Depth::left_out);
  for (const ContactGroup& group : near)
    if (parts.contains({group.part_a, group.part_b}))
      touch.patches.insert(group.patch_pairs.begin(), group.patch_pairs.end());
}

void allow_from_clip(ClipTouch&& touch, const CollisionBody& a, const CollisionBody& b,
                     AllowedPatches& allowed) {
  for (const auto& [p, q] : touch.patches) allowed.allow(p, q, AllowedPatches::kClip);
  // An arm that rests on a hip rests on all of what it touches there.
  std::vector<ClipTouching::Parts> touched;
  for (auto& [parts, triangles] : touch.touched) touched.push_back(std::move(triangles));
  allowed.allow_touched(a, b, touched);
  allowed.clip_depth = std::move(touch.depth);
  allowed.clip_depths = std::move(touch.depths);
}

void list_entries(Data& data) {
  std::map<std::tuple<int, int, std::uint8_t>, AllowedContacts::Entry> entries;
  for (const auto& [key, allowed] : data.allowed_pairs) {
    const CollisionBody& a = data.bodies[static_cast<std::size_t>(key.first)];
    const CollisionBody& b = data.bodies[static_cast<std::size_t>(key.second)];
    for (int p = 0; p < allowed.patches_a; ++p)
      for (int q = 0; q < allowed.patches_b; ++q) {
        const std::uint8_t reasons = allowed.reasons_of(p, q);
        if (reasons == 0) continue;
        const int part_a = a.triangles()[a.triangles_of_patch(p).front()].part;
        const int part_b = b.triangles()[b.triangles_of_patch(q).front()].part;
        for (const auto& [bit, reason] :
             {std::pair(AllowedPatches::kShared, AllowedReason::shared_joint),
              std::pair(AllowedPatches::kBind, AllowedReason::bind_pose),
              std::pair(AllowedPatches::kClip, AllowedReason::clip)}) {
          if (!(reasons & bit)) continue;
          AllowedContacts::Entry& entry = entries[{part_a, part_b, bit}];
          entry.reason = reason;
          ++entry.patches;
          if (bit == AllowedPatches::kClip)
            if (const auto depth = allowed.clip_depth.find({part_a, part_b});
                depth != allowed.clip_depth.end())
              entry.depth = std::max(entry.depth, depth->second);
        }
      }
  }
  for (auto& [key, entry] : entries) {
    entry.part_a = data.parts[static_cast<std::size_t>(std::get<0>(key))];
    entry.part_b = data.parts[static_cast<std::size_t>(std::get<1>(key))];
    data.allowed.entries.push_back(entry);
  }
}

}  // namespace

bool find_allowed_contacts(Data& data, const std::stop_token& stop) {
  const ActorState bind = bind_state(data.world, data.actor, data.character);

  // In the bind pose: joints shared, and patches that touch.
  data.pose(data.begin);
  std::vector<TestPair*> own_pairs;
  for (TestPair& pair : data.pairs_now().pairs)
    if (data.roles[static_cast<std::size_t>(pair.a)].own &&
        data.roles[static_cast<std::size_t>(pair.b)].own)
      own_pairs.push_back(&pair);
  data.pose_actor(bind);
  std::vector<const CollisionBody*> own;
  std::vector<int> place(data.bodies.size(), -1);
  for (std::size_t b = 0; b < data.bodies.size(); ++b)
    if (data.roles[b].own) {
      place[b] = static_cast<int>(own.size());
      own.push_back(&data.placed(static_cast<int>(b)));
    }
  const JoinedSurface whole = join_bodies(own, data.weld_tolerance());
  const double radius = data.settings.joint_radius * data.height;
  for (TestPair* pair : own_pairs) {
    const auto a = static_cast<std::size_t>(pair->a), b = static_cast<std::size_t>(pair->b);
    const LimbSide &sa = data.roles[a].side, &sb = data.roles[b].side;
    // The child is the one farther from the trunk; of two limbs either will do.
    const bool a_is_child = sa.limb == sb.limb ? sa.segment > sb.segment : sa.limb >= 0;
    const SharedJoint shared =
        a_is_child ? shared_joint(data, bind, sa, sb, b) : shared_joint(data, bind, sb, sa, a);
    allow_shared_joint(whole, own, a_is_child ? place[a] : place[b],
                       a_is_child ? place[b] : place[a], shared, radius, !a_is_child,
                       *pair->allowed);
    for (const ContactGroup& group :
         contact_groups(data, *pair, data.touching(), Skip::lasting, Depth::left_out))
      for (const auto& [p, q] : group.patch_pairs)
        pair->allowed->allow(p, q, AllowedPatches::kBind);
  }

  // Over the clip.
  std::map<std::pair<int, int>, ClipTouch> touches;  // by bodies
  const std::vector<double> times = clip_times(data);
  for (std::size_t i = 1; i < times.size(); ++i)
    data.clip_memory = std::max(data.clip_memory, 2 * (times[i] - times[i - 1]));
  for (const double t : times) {
    if (stop.stop_requested()) return false;
    data.pose(t, true);
    for (TestPair& pair : data.pairs_now().pairs)
      if (pair.clip_may_allow) look_at_clip(data, pair, touches[{pair.a, pair.b}]);
  }
  for (auto& [bodies, touch] : touches)
    allow_from_clip(std::move(touch), data.placed(bodies.first), data.placed(bodies.second),
                    data.allowed_pairs.at(bodies));
  data.posed = false;
  list_entries(data);
  return true;
}

}  // namespace elbowroom
