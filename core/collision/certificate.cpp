// SPDX-License-Identifier: MIT
#include "core/collision/certificate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "core/collision/motion_bound.h"
#include "core/collision/scene_collision_data.h"
#include "core/collision/world_steps.h"

namespace elbowroom {
namespace {

using Data = SceneCollision::Data;

// What shapes that keep their scale to 1e-4 a node make of a distance (motion_bound.h).
constexpr double kMore = 1.01;

// The frame in which the two sides of a pair move least against each other: of two parts of the
// limb that of the joint above the outer one's, of a limb and the trunk that above the limb.
NodeReference reference_of(const Data& data, const TestPair& pair, int limb) {
  const auto with_body = [&](int body, int its_limb) {
    const auto b = static_cast<std::size_t>(body);
    return its_limb >= 0 || data.roles[b].own || data.bodies[b].actor() == data.actor;
  };
  if (!with_body(pair.a, pair.limb_a) || !with_body(pair.b, pair.limb_b)) return {};
  const Skeleton& skeleton =
      data.world.actors[static_cast<std::size_t>(data.actor)].model->skeleton;
  const auto above = [&](int joint) -> NodeReference {
    const int parent = skeleton.joints[static_cast<std::size_t>(joint)].parent;
    return parent < 0 ? NodeReference{} : NodeReference{data.actor, parent};
  };
  const int outer = data.in_limb(pair.limb_a, limb) ? pair.limb_a : pair.limb_b;
  const Limb& chain = data.limbs[static_cast<std::size_t>(outer)].limb;
  if (pair.limb_a != pair.limb_b) return above(chain.root);
  const auto segment = [&](int body) {
    const auto b = static_cast<std::size_t>(body);
    return data.roles[b].own ? data.roles[b].side.segment : kEndSegment;
  };
  const int deepest = std::max(segment(pair.a), segment(pair.b));
  return above(deepest == kUpperSegment   ? chain.root
               : deepest == kLowerSegment ? chain.middle
                                          : chain.end);
}

struct Proof {
  SceneCollision& scene;
  Data& data;
  int limb;
  const CertificateSettings& settings;
  const std::stop_token& stop;
  MotionBound bound;
  Certificate certificate;
  long poses_left = 0;
  std::set<std::pair<int, int>> depth_sampled;  // part numbers

  // Of the interval that is looked at.
  using Frame = std::pair<int, int>;                                  // a reference
  std::map<std::pair<Frame, int>, std::vector<PointTravel>> by_node;  // and an actor
  struct BodyReach {
    double most = 0;
    bool known = false;
    std::vector<float> by_triangle;
  };
  std::map<std::pair<Frame, int>, BodyReach> reach;  // and a body

  // What the clip allows a pair while it has some of its parts in contact: by bodies, and by which
  // parts these are (ClipTouching::parts()).
  struct ClipAllowed {
    std::vector<bool> pieces;
    std::shared_ptr<const PatchRegions> regions;
  };
  std::map<std::pair<int, int>, std::map<std::vector<bool>, ClipAllowed>> clip_allowed{};

  const std::vector<PointTravel>& travel_of(const NodeReference& from, int actor) {
    const auto [at, fresh] = by_node.try_emplace({{from.actor, from.node}, actor});
    if (fresh) bound.travel(actor, from, at->second);
    return at->second;
  }
  const ActorState& state_of(const CollisionBody& body) const {
    return data.states[static_cast<std::size_t>(body.actor())];
  }
  BodyReach& reach_of(const NodeReference& from, int body) {
    const auto [at, fresh] = reach.try_emplace({{from.actor, from.node}, body});
    const CollisionBody& b = data.bodies[static_cast<std::size_t>(body)];
    if (fresh) at->second.most = b.most_travel(state_of(b), bound, travel_of(from, b.actor()));
    return at->second;
  }
  const float* by_triangle(const NodeReference& from, int body) {
    BodyReach& r = reach_of(from, body);
    const CollisionBody& b = data.bodies[static_cast<std::size_t>(body)];
    if (!r.known) b.triangle_travel(state_of(b), bound, travel_of(from, b.actor()), r.by_triangle);
    r.known = true;
    return r.by_triangle.data();
  }

  double apart() const {
    const int root = data.limbs[static_cast<std::size_t>(limb)].limb.root;
    const Vec3 place(data.states[static_cast<std::size_t>(data.actor)]
                         .world_from_joint[static_cast<std::size_t>(root)][3]);
    const double slack = 32 * 0x1p-24 * (glm::length(place) + 2 * data.height);
    return kMore * (data.touching() + slack);
  }

  // What may touch since the clip touches there at all times of [begin, end].
  PatchFilter clip_filter(const TestPair& pair, double begin, double end) {
    const ClipTouching& touching = pair.allowed->touching;
    std::vector<bool> touch;
    for (const ClipTouching::Pieces& parts : touching.parts())
      touch.push_back(
          pair.allowed->clip_touches(parts.part_a, parts.part_b, begin, end, data.clip_memory));
    const auto [at, fresh] = clip_allowed[{pair.a, pair.b}].try_emplace(touch);
    ClipAllowed& allowed = at->second;
    if (fresh) allowed.pieces = touching.allowed_where(touch);
    PatchFilter filter = touching.filter(allowed.pieces);
    if (fresh)
      allowed.regions = patch_regions(data.bodies[static_cast<std::size_t>(pair.a)].mesh(),
                                      data.bodies[static_cast<std::size_t>(pair.b)].mesh(), filter);
    filter.regions = allowed.regions.get();
    return filter;
  }

  // The pair cannot touch within [begin, end], the interval that is looked at, but where the clip
  // itself does then.
  bool pair_free(TestPair& pair, double begin, double end) {
    ++certificate.pair_checks;
    const NodeReference from = reference_of(data, pair, limb);
    TriangleReach reach;
    reach.most = reach_of(from, pair.a).most + reach_of(from, pair.b).most;
    reach.apart = apart();
    const double most = reach.most + reach.apart;
    if (!std::isfinite(most)) return false;
    const CollisionBody &a = data.placed(pair.a), &b = data.placed(pair.b);
    if (!a.box().within(b.box(), most)) return true;
    reach.of_a = by_triangle(from, pair.a);
    reach.of_b = by_triangle(from, pair.b);
    const auto reached = [&](const PatchFilter& filter) {
      return reach_each_other(a.mesh(), b.mesh(), data.a_from_b(pair), reach, filter, &pair.cache);
    };
    if (!reached(pair.allowed ? pair.allowed->filter(a, b, AllowedPatches::Reasons::lasting)
                              : PatchFilter{}))
      return true;
    if (!pair.allowed || pair.allowed->clip_depth.empty() || pair.allowed->touching.empty())
      return false;
    // What the clip touches at these very times may touch, and how deep is known at samples only.
    if (reached(clip_filter(pair, begin, end))) return false;
    for (const auto& [parts, depth] : pair.allowed->clip_depth) depth_sampled.insert(parts);
    return true;
  }

  bool fail(const TestPair* pair, double t, const std::string& why) {
    certificate.time = t;
    certificate.reason = why;
    if (!pair) return false;
    certificate.beside_clip_contacts = pair->allowed && !pair->allowed->clip_depth.empty();
    const CollisionBody &a = data.bodies[static_cast<std::size_t>(pair->a)],
                        &b = data.bodies[static_cast<std::size_t>(pair->b)];
    const auto part = [&](const CollisionBody& body, std::uint32_t triangle) {
      const std::size_t t = pair->cache.set ? triangle : 0;
      return data.parts[static_cast<std::size_t>(body.triangles()[t].part)];
    };
    const bool a_first = data.in_limb(pair->limb_a, limb);
    certificate.part_a = part(a, pair->cache.triangle_a);
    certificate.part_b = part(b, pair->cache.triangle_b);
    if (!a_first) std::swap(certificate.part_a, certificate.part_b);
    return false;
  }

  // No proof: whether the pairs touch at times close to each other.
  bool looked_at(double begin, double end, const std::vector<std::size_t>& open) {
    certificate.looked_at += end - begin;
    const double steps = std::max(1.0, std::ceil((end - begin) / settings.look_step));
    for (double i = 0; i <= steps; ++i) {
      const double t = i == steps ? end : begin + (end - begin) * i / steps;
      if (stop.stop_requested()) return fail(nullptr, t, "stopped");
      data.pose(t);
      ++certificate.poses;
      for (const std::size_t k : open) {
        TestPair& pair = data.pairs_now().pairs[k];
        if (data.pair_in_contact(pair, data.touching()))
          return fail(&pair, t, "the two are in contact");
      }
    }
    return true;
  }

  bool free(double begin, double end, const std::vector<std::size_t>& asked) {
    if (stop.stop_requested()) return fail(nullptr, begin, "stopped");
    const double middle = begin + 0.5 * (end - begin);
    data.pose(middle);
    bound.set(data.world, begin, end, middle, data.states);
    by_node.clear();
    reach.clear();
    ++certificate.poses;
    std::vector<TestPair>& pairs = data.pairs_now().pairs;
    std::vector<std::size_t> open;
    for (const std::size_t k : asked)
      if (!pair_free(pairs[k], begin, end)) open.push_back(k);
    if (open.empty()) {
      certificate.shortest = std::min(certificate.shortest, end - begin);
      return true;
    }
    if (settings.look_below > 0 && (end - begin <= settings.look_below || poses_left <= 0))
      return looked_at(begin, end, open);
    if (!(end - begin > settings.smallest))
      return fail(
          &pairs[open.front()], middle,
          "the two are too near to each other to be told apart within the shortest interval");
    if (--poses_left < 0)
      return fail(&pairs[open.front()], middle,
                  "the two are so near to each other that proving more would take too long");
    return free(begin, middle, open) && free(middle, end, open);
  }

  bool stretch_free(double begin, double end) {
    // What is inside of what, too.
    if (scene.limb_in_contact(begin, limb, data.touching())) {
      std::vector<ContactSample> contacts;
      scene.contacts_at(begin, limb, false, contacts);
      fail(nullptr, begin, "the two are in contact");
      if (contacts.empty()) return false;
      certificate.part_a = contacts.front().part_a;
      certificate.part_b = contacts.front().part_b;
      return false;
    }
    data.pose(begin);
    const auto& pairs = data.pairs_now().pairs;
    std::vector<std::size_t> asked;
    for (std::size_t k = 0; k < pairs.size(); ++k)
      if (data.concerns(pairs[k], limb)) asked.push_back(k);
    const double pieces = std::max(1.0, std::ceil((end - begin) / settings.longest));
    double from = begin;
    for (double i = 1; i <= pieces; ++i) {
      const double to = i == pieces ? end : begin + (end - begin) * i / pieces;
      if (!free(from, to, asked)) return false;
      from = to;
    }
    return true;
  }
};

}  // namespace

Certificate certify_limb(SceneCollision& scene, int limb, double begin, double end,
                         const CertificateSettings& settings, const std::stop_token& stop) {
  Data& data = scene.data();
  const auto refused = [&](const std::string& why) {
    Certificate certificate;
    certificate.reason = why;
    certificate.time = begin;
    return certificate;
  };
  if (limb < 0 || !data.knows(limb)) return refused("there is no such limb");
  if (!(std::isfinite(begin) && std::isfinite(end) && begin <= end))
    return refused("the interval is empty or not finite");
  if (!(settings.longest > 0 && settings.smallest > 0 && (end - begin) / settings.longest < 1e7))
    return refused("the shortest or the longest interval is no positive number");
  if (settings.look_below > 0 &&
      !(settings.look_step > 0 && (end - begin) / settings.look_step < 1e9))
    return refused("the step of a closer look is no positive number");
  if (std::any_of(data.posed_limbs.begin(), data.posed_limbs.end(),
                  [](const auto& posed) { return posed.has_value(); }))
    return refused("a limb is posed by hand");

  Proof proof{scene, data, limb, settings, stop, MotionBound(data.world), {}, 0, {}, {}, {}};
  proof.certificate.shortest = end - begin;
  proof.poses_left = static_cast<long>(
      std::min(1e9, static_cast<double>(settings.most_poses) * std::max(0.1, end - begin)));
  std::vector<double> borders = {begin};
  for (const double step : world_steps(data.world, begin, end))
    if (step > begin) borders.push_back(step);
  Certificate& certificate = proof.certificate;
  certificate.holds = true;
  for (std::size_t i = 0; i < borders.size() && certificate.holds; ++i) {
    const double last = i + 1 < borders.size() ? just_before(borders[i + 1]) : end;
    certificate.holds = proof.stretch_free(borders[i], std::max(borders[i], last));
  }
  for (const auto& [a, b] : proof.depth_sampled)
    certificate.depth_sampled.push_back(data.parts[static_cast<std::size_t>(a)] + " with " +
                                        data.parts[static_cast<std::size_t>(b)]);
  return std::move(proof.certificate);
}

}  // namespace elbowroom
