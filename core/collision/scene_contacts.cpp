// SPDX-License-Identifier: MIT
// The world brought to a time, and one pair of bodies asked for its contacts.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "core/animation/affine.h"
#include "core/collision/contact_depth.h"
#include "core/collision/mesh_data.h"
#include "core/collision/scene_collision_data.h"

namespace elbowroom {
namespace {

using Data = SceneCollision::Data;

// Where the origin of queries may stand: corners of a grid, so that it is a function of the pose
// alone and rests while the character moves about. Wide enough to be crossed seldom, narrow enough
// that float keeps a fiftieth of ε: 8 heights · 2^-24 ≈ 5e-7 heights.
constexpr double kOriginGrid = 8;  // × height

double snapped(double x, double grid) {
  const double cell = std::round(x / grid) * grid;
  return std::isfinite(cell) ? cell : 0.0;
}

std::uint8_t strongest(std::uint8_t reasons) {
  for (const std::uint8_t r :
       {AllowedPatches::kShared, AllowedPatches::kBind, AllowedPatches::kClip})
    if (reasons & r) return r;
  return 0;
}

// A surface that is closed by itself, not by the caps of a cut.
bool closed_by_itself(const CollisionMesh& mesh, std::uint32_t triangle) {
  const Topology& topology = mesh.data().topology;
  return topology.components[topology.component[triangle]].border_edges == 0;
}

template <typename T>
void sort_unique(std::vector<T>& v) {
  std::sort(v.begin(), v.end());
  v.erase(std::unique(v.begin(), v.end()), v.end());
}

AllowedReason reason_named(std::uint8_t bit) {
  return bit == AllowedPatches::kShared ? AllowedReason::shared_joint
         : bit == AllowedPatches::kBind ? AllowedReason::bind_pose
                                        : AllowedReason::clip;
}

bool any_not_allowed(const std::vector<ContactGroup>& groups) {
  return std::any_of(groups.begin(), groups.end(), [](const auto& g) { return g.reason == 0; });
}

bool same_parts(const ContactGroup& a, const ContactGroup& b) {
  return a.part_a == b.part_a && a.part_b == b.part_b;
}

PatchFilter filter_of(const TestPair& pair, const CollisionBody& a, const CollisionBody& b,
                      Skip skip) {
  using Reasons = AllowedPatches::Reasons;
  if (!pair.allowed || skip == Skip::none) return {};
  return pair.allowed->filter(a, b,
                              skip == Skip::all       ? Reasons::all
                              : skip == Skip::touched ? Reasons::touched
                                                      : Reasons::lasting);
}

// All that may be passed over.
Skip all_allowed(const Data& data) { return data.beside_clip_contacts ? Skip::all : Skip::touched; }

// Why two triangles may touch, one bit; 0: they may not.
std::uint8_t reason_of(const Data& data, const TestPair& pair, std::uint8_t reasons,
                       const TriangleContact& contact) {
  const std::uint8_t reason = strongest(reasons);
  if (reason != AllowedPatches::kClip || data.beside_clip_contacts) return reason;
  const ClipTouching& touching = pair.allowed->touching;
  return !touching.empty() && touching.allows(contact.triangle_a, contact.triangle_b) ? reason : 0;
}

double depth_of(Data& data, const TestPair& pair, const ContactGroup& group) {
  const CollisionBody &a = data.placed(pair.a), &b = data.placed(pair.b);
  return group.contained ? penetration_depth(a.mesh(), b.mesh(), data.a_from_b(pair))
                         : contact_depth(a, group.patches_a, b, group.patches_b);
}

// Whether groups of the same parts have all its pairs of patches.
bool patches_within(const ContactGroup& group, const std::vector<ContactGroup>& all) {
  std::vector<std::pair<std::uint16_t, std::uint16_t>> patches;
  for (const ContactGroup& g : all)
    if (same_parts(group, g))
      patches.insert(patches.end(), g.patch_pairs.begin(), g.patch_pairs.end());
  sort_unique(patches);
  return std::includes(patches.begin(), patches.end(), group.patch_pairs.begin(),
                       group.patch_pairs.end());
}

// Whether groups of the same parts have all its triangles.
bool triangles_within(const ContactGroup& group, const std::vector<ContactGroup>& all) {
  std::set<std::uint32_t> of_a, of_b;
  for (const ContactGroup& g : all) {
    if (!same_parts(group, g)) continue;
    of_a.insert(g.triangles_a.begin(), g.triangles_a.end());
    of_b.insert(g.triangles_b.begin(), g.triangles_b.end());
  }
  const auto known = [](const std::set<std::uint32_t>& set) {
    return [&set](std::uint32_t t) { return set.contains(t); };
  };
  return std::all_of(group.triangles_a.begin(), group.triangles_a.end(), known(of_a)) &&
         std::all_of(group.triangles_b.begin(), group.triangles_b.end(), known(of_b));
}

// Contacts that the clip has at this very time are allowed by definition, whether or not the scan
// that gathered patches looked at this time: those of `groups` are marked as the clip's where it
// has the same patches (or triangles, beside_clip_contacts) in contact, as deep. What is no contact
// but nearer than `distance` is so where the clip has the two parts as near. Depths are costly and
// measured last, where all else speaks for the contact. May leave the source clip posed.
void excuse_by_source(Data& data, const TestPair& pair, double distance,
                      std::vector<ContactGroup>& groups) {
  std::vector<ContactGroup> touching_now;
  if (distance > data.touching())
    touching_now = contact_groups(data, pair, data.touching(), Skip::none, Depth::left_out);
  const double t = data.posed_at;
  data.pose(t, true);
  // What is near in the clip serves too, as in the scan, where the parts are in contact at all.
  const auto touching = contact_groups(data, pair, data.touching(), Skip::none, Depth::left_out);
  const auto near =
      contact_groups(data, pair, std::max(distance, data.settings.clearance * data.height),
                     Skip::none, Depth::left_out);
  std::map<std::pair<int, int>, double> depth_in_clip;  // by parts
  std::vector<ContactGroup*> candidates;
  for (ContactGroup& group : groups) {
    if (group.reason != 0) continue;
    const auto same = [&](const ContactGroup& other) { return same_parts(group, other); };
    if (distance > data.touching() &&
        std::none_of(touching_now.begin(), touching_now.end(), same)) {
      if (std::any_of(near.begin(), near.end(), same)) group.reason = AllowedPatches::kClip;
      continue;
    }
    if (std::none_of(touching.begin(), touching.end(), same)) continue;
    if (!(data.beside_clip_contacts ? patches_within(group, near)
                                    : triangles_within(group, touching)))
      continue;
    double& depth = depth_in_clip.try_emplace({group.part_a, group.part_b}, 0.0).first->second;
    for (const ContactGroup& g : touching)
      if (same(g)) depth = std::max(depth, depth_of(data, pair, g));
    candidates.push_back(&group);
  }
  if (candidates.empty()) return;
  data.pose(t);
  for (ContactGroup* group : candidates) {
    if (group->depth < 0) group->depth = depth_of(data, pair, *group);
    if (group->depth <= depth_in_clip[{group->part_a, group->part_b}] + data.touching())
      group->reason = AllowedPatches::kClip;
  }
}

// Marks as allowed what is so by the clip; the world stays at its time.
void excuse_by_clip(Data& data, const TestPair& pair, double distance,
                    std::vector<ContactGroup>& groups) {
  if (!pair.clip_may_allow || !any_not_allowed(groups)) return;
  if (data.posed_at < data.begin || data.posed_at > data.end) return;
  if (data.playing_source()) {
    for (ContactGroup& group : groups)
      if (group.reason == 0) group.reason = AllowedPatches::kClip;
    return;
  }
  const double t = data.posed_at;
  excuse_by_source(data, pair, distance, groups);
  data.pose(t);
}

}  // namespace

bool Data::playing_source() const {
  const auto& played = world.actors[static_cast<std::size_t>(actor)].clip;
  if (played != source_clip && !posed_source) return false;
  if (posed_source) return true;
  return std::none_of(posed_limbs.begin(), posed_limbs.end(),
                      [](const auto& limb) { return limb.has_value(); });
}

void Data::pose(double t, bool source) {
  const bool plain = std::none_of(posed_limbs.begin(), posed_limbs.end(),
                                  [](const auto& limb) { return limb.has_value(); });
  if (posed && posed_at == t && posed_source == source && !std::isnan(t)) return;
  auto& self = world.actors[static_cast<std::size_t>(actor)];
  if (source) {
    std::shared_ptr<const Clip> played = source_clip;
    std::swap(self.clip, played);
    world_state_at(world, t, states);
    std::swap(self.clip, played);
  } else {
    world_state_at(world, t, states);
  }
  if (!source && !plain) {
    ActorState& state = states[static_cast<std::size_t>(actor)];
    for (std::size_t l = 0; l < limbs.size(); ++l)
      if (posed_limbs[l])
        apply_limb_state(limbs[l], *posed_limbs[l], self.model->skeleton, state.pose);
    Mat4 world_from_file = self.world_from_file;
    const auto& attachment = self.attachment;
    if (attachment && attachment->begin <= t && t <= attachment->end && attachment->actor >= 0 &&
        attachment->actor < actor && attachment->joint >= 0) {
      const auto& carrier = states[static_cast<std::size_t>(attachment->actor)].world_from_joint;
      if (static_cast<std::size_t>(attachment->joint) < carrier.size())
        world_from_file = attached_placement(*attachment, carrier);
    }
    compute_globals(self.model->skeleton, state.pose, world_from_file, state.world_from_joint);
    for (std::size_t i = static_cast<std::size_t>(actor) + 1; i < world.actors.size(); ++i)
      if (world.actors[i].attachment) actor_state_at(world, static_cast<int>(i), t, states);
  }
  posed = true;
  posed_at = t;
  posed_source = source;
  ++stamp;

  const auto& joints = world.actors[static_cast<std::size_t>(actor)]
                           .model->characters[static_cast<std::size_t>(character)]
                           .joints;
  const auto& globals = states[static_cast<std::size_t>(actor)].world_from_joint;
  const Vec3 at =
      joints.empty() ? Vec3(0.0) : Vec3(globals[static_cast<std::size_t>(joints.front())][3]);
  for (int k = 0; k < 3; ++k) origin[k] = snapped(at[k], kOriginGrid * height);
}

void Data::pose_actor(const ActorState& state) {
  states.resize(world.actors.size());
  states[static_cast<std::size_t>(actor)] = state;
  posed = false;
  ++stamp;
  const auto& joints = world.actors[static_cast<std::size_t>(actor)]
                           .model->characters[static_cast<std::size_t>(character)]
                           .joints;
  const Vec3 at = joints.empty()
                      ? Vec3(0.0)
                      : Vec3(state.world_from_joint[static_cast<std::size_t>(joints.front())][3]);
  for (int k = 0; k < 3; ++k) origin[k] = snapped(at[k], kOriginGrid * height);
}

const CollisionBody& Data::placed(int body) {
  const auto b = static_cast<std::size_t>(body);
  if (body_stamp[b] != stamp) {
    bodies[b].place(states[static_cast<std::size_t>(bodies[b].actor())], origin);
    body_stamp[b] = stamp;
  }
  return bodies[b];
}

RigidTransform Data::a_from_b(const TestPair& pair) {
  const CollisionBody &a = placed(pair.a), &b = placed(pair.b);
  if (a.deforms() && b.deforms()) return {};
  if (a.deforms()) return b.query_from_body();
  return inverse(a.query_from_body()) * b.query_from_body();
}

std::vector<ContactGroup> contact_groups(Data& data, const TestPair& pair, double distance,
                                         Skip skip, Depth depth) {
  std::vector<ContactGroup> groups;
  const CollisionBody &a = data.placed(pair.a), &b = data.placed(pair.b);
  if (!a.box().within(b.box(), distance)) return groups;
  const RigidTransform a_from_b = data.a_from_b(pair);
  std::vector<TriangleContact> contacts;
  find_contacts(a.mesh(), b.mesh(), a_from_b, distance, filter_of(pair, a, b, skip), contacts);
  const bool same_body = data.roles[static_cast<std::size_t>(pair.a)].own &&
                         data.roles[static_cast<std::size_t>(pair.b)].own;
  std::map<std::tuple<int, int, std::uint8_t>, std::size_t> number;
  for (const TriangleContact& contact : contacts) {
    const std::uint16_t p = a.patch_of()[contact.triangle_a], q = b.patch_of()[contact.triangle_b];
    // Pieces of one skin are joined: what is inside has crossed on its way. Only surfaces that were
    // closed in the file can lie inside each other.
    if (contact.contained && same_body &&
        !(closed_by_itself(a.mesh(), contact.triangle_a) &&
          closed_by_itself(b.mesh(), contact.triangle_b)))
      continue;
    const int part_a = a.triangles()[contact.triangle_a].part;
    const int part_b = b.triangles()[contact.triangle_b].part;
    const std::uint8_t reason =
        pair.allowed ? reason_of(data, pair, pair.allowed->reasons_of(p, q), contact) : 0;
    const auto [at, fresh] = number.try_emplace({part_a, part_b, reason}, groups.size());
    if (fresh) {
      groups.emplace_back();
      groups.back().part_a = part_a;
      groups.back().part_b = part_b;
      groups.back().reason = reason;
      groups.back().place = a.query_from_body() * contact.place;
      groups.back().contained = contact.contained;
    }
    ContactGroup& group = groups[at->second];
    group.patches_a.push_back(p);
    group.patches_b.push_back(q);
    group.patch_pairs.emplace_back(p, q);
    group.triangles_a.push_back(contact.triangle_a);
    group.triangles_b.push_back(contact.triangle_b);
  }
  for (ContactGroup& group : groups) {
    sort_unique(group.patches_a);
    sort_unique(group.patches_b);
    sort_unique(group.patch_pairs);
    if (depth == Depth::left_out || group.reason == AllowedPatches::kShared ||
        group.reason == AllowedPatches::kBind)
      continue;
    if (depth == Depth::of_the_clips && group.reason != AllowedPatches::kClip) {
      group.depth = -1;
      continue;
    }
    group.depth = depth_of(data, pair, group);
    if (group.reason != AllowedPatches::kClip) continue;
    // No deeper than the clip has these two parts about this time.
    const double limit =
        pair.allowed->depth_about(group.part_a, group.part_b, data.posed_at, data.clip_memory);
    if (limit < 0 || group.depth > limit + data.touching()) group.reason = 0;
  }
  return groups;
}

namespace {

// Whether what the clip allows the pair, all that it has in contact, may be deeper than the clip
// has it: false is certain, and quick; true leaves it to contact_groups().
bool may_be_too_deep(Data& data, TestPair& pair) {
  const CollisionBody &a = data.placed(pair.a), &b = data.placed(pair.b);
  find_patch_contacts(a.mesh(), b.mesh(), data.a_from_b(pair), data.touching(),
                      pair.allowed->filter(a, b, AllowedPatches::Reasons::lasting), pair.touched);
  struct Patches {
    std::vector<std::uint16_t> a, b;
  };
  std::map<std::pair<int, int>, Patches> by_parts;
  for (const TriangleContact& contact : pair.touched) {
    if (contact.contained) return true;
    Patches& patches =
        by_parts[{a.triangles()[contact.triangle_a].part, b.triangles()[contact.triangle_b].part}];
    patches.a.push_back(a.patch_of()[contact.triangle_a]);
    patches.b.push_back(b.patch_of()[contact.triangle_b]);
  }
  for (auto& [parts, patches] : by_parts) {
    const double limit =
        pair.allowed->depth_about(parts.first, parts.second, data.posed_at, data.clip_memory);
    if (limit < 0) return true;
    sort_unique(patches.a);
    sort_unique(patches.b);
    if (deeper_than(limit + data.touching(), a, patches.a, b, patches.b)) return true;
  }
  return false;
}

}  // namespace

bool Data::pair_in_contact(TestPair& pair, double distance) {
  const CollisionBody &a = placed(pair.a), &b = placed(pair.b);
  if (!a.box().within(b.box(), distance)) return false;
  const RigidTransform relative = a_from_b(pair);
  if (!pair.allowed)
    return elbowroom::in_contact(a.mesh(), b.mesh(), relative, distance, {}, &pair.cache);

  const auto wrong_at = [&](double at_distance, Skip skip) {
    auto groups = contact_groups(*this, pair, at_distance, skip, Depth::of_the_clips);
    excuse_by_clip(*this, pair, at_distance, groups);
    return any_not_allowed(groups);
  };
  // Pieces of one body: parity is looked at with the groups, where it is known which are closed.
  const bool hit = elbowroom::in_contact(a.mesh(), b.mesh(), relative, distance,
                                         filter_of(pair, a, b, all_allowed(*this)), &pair.cache);
  if (hit && wrong_at(distance, all_allowed(*this))) return true;
  // The clip's patches: in contact, and then deeper than the clip?
  if (pair.allowed->clip_depth.empty()) return false;
  return (hit || may_be_too_deep(*this, pair)) && wrong_at(touching(), Skip::lasting);
}

void Data::pair_contacts(TestPair& pair, int only_limb, bool list_allowed,
                         std::vector<ContactSample>& out) {
  auto groups = contact_groups(*this, pair, touching(), list_allowed ? Skip::none : Skip::lasting);
  const Vec3 query_origin = origin;
  excuse_by_clip(*this, pair, touching(), groups);
  const int limb_a = pair.limb_a, limb_b = pair.limb_b;
  bool b_first = limb_a < 0 || (limb_b >= 0 && limb_b < limb_a);
  if (only_limb >= 0) b_first = !in_limb(limb_a, only_limb);
  if (limb_a < 0 && limb_b < 0) b_first = roles[static_cast<std::size_t>(pair.b)].own;

  // One sample for each pair of parts and verdict.
  std::map<std::tuple<int, int, std::uint8_t>, std::size_t> number;
  for (const ContactGroup& group : groups) {
    if (group.reason != 0 && !list_allowed) continue;
    const auto [at, fresh] =
        number.try_emplace({group.part_a, group.part_b, group.reason}, out.size());
    if (fresh) {
      ContactSample sample;
      sample.limb = only_limb >= 0 ? only_limb : b_first ? limb_b : limb_a;
      sample.part_a = parts[static_cast<std::size_t>(b_first ? group.part_b : group.part_a)];
      sample.part_b = parts[static_cast<std::size_t>(b_first ? group.part_a : group.part_b)];
      sample.place = group.place + query_origin;
      sample.depth = group.depth;
      sample.allowed = group.reason != 0;
      if (sample.allowed) sample.reason = reason_named(group.reason);
      out.push_back(std::move(sample));
    } else if (group.depth > out[at->second].depth) {
      out[at->second].depth = group.depth;
      out[at->second].place = group.place + query_origin;
    }
  }
}

double Data::pair_clearance(TestPair& pair, double at_most) {
  const CollisionBody &a = placed(pair.a), &b = placed(pair.b);
  if (!a.box().within(b.box(), at_most)) return at_most;
  if (pair_in_contact(pair, touching())) return 0;
  // Asking may have posed the source clip and come back.
  const CollisionBody &a_now = placed(pair.a), &b_now = placed(pair.b);
  return surface_distance(a_now.mesh(), b_now.mesh(), a_from_b(pair), at_most,
                          filter_of(pair, a_now, b_now, all_allowed(*this)));
}

}  // namespace elbowroom
