// SPDX-License-Identifier: MIT
// How a LimbPlanningSpace is put together: the limb's chain, who carries what when, which pairs of
// pieces are tested and what they may do to each other, and the points of the metric.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

#include "core/collision/limb_planning_data.h"

namespace elbowroom {
namespace {

constexpr double kClipRate = 60;  // Hz, at which the clip's own near contacts are gathered
constexpr int kEndPoints = 4;     // extreme points of the end effector, and of each carried thing

// `count` points far from each other and from `from`: farthest-point sampling, first of equals.
std::vector<Vec3> extreme_points(const std::vector<Vec3>& points, const Vec3& from, int count) {
  std::vector<Vec3> chosen;
  std::vector<double> distance;
  distance.reserve(points.size());
  for (const Vec3& p : points) distance.push_back(glm::distance(p, from));
  while (static_cast<int>(chosen.size()) < count) {
    if (points.empty()) {
      chosen.push_back(from);
      continue;
    }
    const auto at = static_cast<std::size_t>(std::max_element(distance.begin(), distance.end()) -
                                             distance.begin());
    chosen.push_back(points[at]);
    for (std::size_t i = 0; i < points.size(); ++i)
      distance[i] = std::min(distance[i], glm::distance(points[i], points[at]));
  }
  return chosen;
}

}  // namespace

// The limb's nodes that move parts or lead to ones that do; after its own those that follow it.
void LimbPlanningSpace::Data::build_chain() {
  const Model& model = *world.actors[static_cast<std::size_t>(scene.actor)].model;
  const Skeleton& skeleton = model.skeleton;
  const std::size_t count = skeleton.joints.size();
  std::vector<bool> wanted(count, false);
  const auto follows = [&](int node) {
    return std::any_of(limb.limb.following.begin(), limb.limb.following.end(),
                       [&](const auto& own) { return skeleton.is_within(node, own.joint); });
  };
  const auto want = [&](int node) {
    for (int at = node; at >= 0 && (skeleton.is_within(at, limb.limb.root) || follows(at));
         at = skeleton.joints[static_cast<std::size_t>(at)].parent)
      wanted[static_cast<std::size_t>(at)] = true;
  };
  for (const JointModel& joint : limb.joints) want(joint.joint);
  for (const FollowingJoint& own : limb.limb.following) {
    want(own.joint);
    want(own.serves);
  }
  for (const PlanningPart& part : pieces)
    if (part.actor == scene.actor && part.of_limb) want(part.node);
  for (const Actor& actor : world.actors)
    if (actor.attachment && actor.attachment->actor == scene.actor &&
        actor.attachment->joint >= 0 && static_cast<std::size_t>(actor.attachment->joint) < count)
      want(actor.attachment->joint);

  chain.number.assign(count, -1);
  const auto number = [&](int node) { return chain.number[static_cast<std::size_t>(node)]; };
  const auto add = [&](int n) {
    Chain::Node node;
    node.node = n;
    if (n != limb.limb.root)
      node.parent = number(skeleton.joints[static_cast<std::size_t>(n)].parent);
    for (const FollowingJoint& own : limb.limb.following) {
      if (own.joint != n) continue;
      node.parent = number(own.serves);
      node.follows = true;
    }
    for (std::size_t j = 0; j < limb.joints.size(); ++j)
      if (limb.joints[j].joint == n) node.dof_joint = static_cast<int>(j);
    chain.number[static_cast<std::size_t>(n)] = static_cast<int>(chain.nodes.size());
    chain.nodes.push_back(node);
  };
  for (const bool own : {true, false})
    for (const int n : skeleton.order)
      if (wanted[static_cast<std::size_t>(n)] && skeleton.is_within(n, limb.limb.root) == own)
        add(n);
  links.resize(chain.nodes.size());
}

void LimbPlanningSpace::Data::build_segments() {
  const int count = static_cast<int>(pieces.size());
  const auto chain_number = [&](int node) {
    // The nearest node of the chain at or above.
    const Skeleton& skeleton = world.actors[static_cast<std::size_t>(scene.actor)].model->skeleton;
    while (node >= 0 && chain.number[static_cast<std::size_t>(node)] < 0)
      node = skeleton.joints[static_cast<std::size_t>(node)].parent;
    return node < 0 ? kWorld : chain.number[static_cast<std::size_t>(node)];
  };
  std::vector<ActorState> states;
  for (int s = 0; s < tracks->segment_count(); ++s) {
    Segment segment;
    const double t = tracks->segment_middle(s);
    world_state_at(world, t, states);
    // Follow attachments up to the character in view.
    std::vector<int> carrier(world.actors.size(), kWorld);
    for (std::size_t i = 0; i < world.actors.size(); ++i) {
      const auto& attachment = world.actors[i].attachment;
      if (!attachment || !(attachment->begin <= t && t <= attachment->end) ||
          attachment->actor < 0 || attachment->actor >= static_cast<int>(i) ||
          static_cast<int>(i) == scene.actor)
        continue;
      if (attachment->actor != scene.actor) {
        carrier[i] = carrier[static_cast<std::size_t>(attachment->actor)];
      } else if (attachment->joint >= 0 &&
                 static_cast<std::size_t>(attachment->joint) < scene.side_of_node.size() &&
                 scene.in_limb(scene.side_of_node[static_cast<std::size_t>(attachment->joint)].limb,
                               limb_index)) {
        carrier[i] = chain_number(attachment->joint);
      }
    }
    segment.chain_of.assign(pieces.size(), kWorld);
    segment.chain_from_part.resize(pieces.size());
    for (int p = 0; p < count; ++p) {
      const PlanningPart& piece = pieces[static_cast<std::size_t>(p)];
      int& node = segment.chain_of[static_cast<std::size_t>(p)];
      RigidTransform& relative = segment.chain_from_part[static_cast<std::size_t>(p)];
      if (piece.of_limb)
        node = chain_number(piece.node);
      else if (piece.actor != scene.actor)
        node = carrier[static_cast<std::size_t>(piece.actor)];
      if (node == kWorld) continue;
      // What hangs on a chain node keeps its place to it.
      const int carrying = chain.nodes[static_cast<std::size_t>(node)].node;
      const auto frame = [&](int actor, int at) {
        return rigid_frame(
            states[static_cast<std::size_t>(actor)].world_from_joint[static_cast<std::size_t>(at)]);
      };
      relative = inverse(frame(scene.actor, carrying)) * frame(piece.actor, piece.node) *
                 piece.node_from_part;
      segment.moving.push_back(p);
    }
    // What is farthest along the limb moves most: it is asked first.
    std::stable_sort(segment.moving.begin(), segment.moving.end(), [&](int x, int y) {
      const auto rank = [&](int p) {
        return (pieces[static_cast<std::size_t>(p)].of_limb ? 0 : 1 << 20) +
               segment.chain_of[static_cast<std::size_t>(p)];
      };
      return rank(x) > rank(y);
    });
    for (const int p : segment.moving)
      segment.centre.push_back(segment.chain_from_part[static_cast<std::size_t>(p)] *
                               pieces[static_cast<std::size_t>(p)].centre);
    for (int p = 0; p < count; ++p)
      if (segment.chain_of[static_cast<std::size_t>(p)] == kWorld) segment.still.push_back(p);
    segments.push_back(std::move(segment));
  }
}

bool LimbPlanningSpace::Data::are_named(int a, int b, const std::string& one,
                                        const std::string& other) const {
  const auto has = [&](int piece, const std::string& name) {
    const auto& made_of = pieces[static_cast<std::size_t>(piece)].parts;
    return std::any_of(made_of.begin(), made_of.end(), [&](int part) {
      return scene.parts[static_cast<std::size_t>(part)] == name;
    });
  };
  return (has(a, one) && has(b, other)) || (has(a, other) && has(b, one));
}

double LimbPlanningSpace::Data::margin_of(int a, int b) const {
  double margin = 0;
  for (const PairMargin& pair : settings.pair_margins)
    if (pair.margin > margin && are_named(a, b, pair.part_a, pair.part_b)) margin = pair.margin;
  return margin;
}

void LimbPlanningSpace::Data::build_pairs() {
  std::map<std::pair<int, int>, int> number;
  const auto pair_of = [&](int a, int b) {
    // -1: nothing between the two is a contact.
    if (about_one_joint(pieces[static_cast<std::size_t>(a)], pieces[static_cast<std::size_t>(b)]))
      return -1;
    const auto [at, fresh] = number.try_emplace({a, b}, static_cast<int>(pairs.size()));
    if (fresh) {
      pairs.push_back({a, b, {}});
      PairState state;
      const bool skin = pieces[static_cast<std::size_t>(a)].deforms ||
                        pieces[static_cast<std::size_t>(b)].deforms;
      const auto own = [&](int part) {
        const int body = pieces[static_cast<std::size_t>(part)].body;
        return scene.roles[static_cast<std::size_t>(body)].own;
      };
      const bool within_body = settings.body_clearance >= 0 && own(a) && own(b);
      state.distance = (within_body ? settings.body_clearance : settings.clearance) +
                       (skin ? settings.margin : 0.0) + margin_of(a, b);
      pair_states.push_back(state);
    }
    return at->second;
  };
  for (Segment& segment : segments) {
    const auto side_segment = [&](int p) {
      const PlanningPart& piece = pieces[static_cast<std::size_t>(p)];
      if (piece.of_limb) return piece.segment;
      const int node =
          chain.nodes[static_cast<std::size_t>(segment.chain_of[static_cast<std::size_t>(p)])].node;
      return scene.side_of_node[static_cast<std::size_t>(node)].segment;
    };
    const auto& list = segment.moving;
    segment.pair_with.resize(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
      for (const int still : segment.still) segment.pair_with[i].push_back(pair_of(list[i], still));
      for (std::size_t j = i + 1; j < list.size(); ++j) {
        // One segment of the limb is one link to the planner, with what it holds.
        if (side_segment(list[i]) == side_segment(list[j])) continue;
        if (const int pair = pair_of(list[i], list[j]); pair >= 0)
          segment.inner_pairs.push_back(pair);
      }
    }
    segment.sorted_pairs = segment.inner_pairs;
    for (const auto& with : segment.pair_with)
      for (const int pair : with)
        if (pair >= 0) segment.sorted_pairs.push_back(pair);
    std::sort(segment.sorted_pairs.begin(), segment.sorted_pairs.end());
  }
  // Patches that may touch, for two bodies of the character or a carried thing and its holder.
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    Pair& pair = pairs[k];
    const PlanningPart& a = pieces[static_cast<std::size_t>(pair.a)];
    const PlanningPart& b = pieces[static_cast<std::size_t>(pair.b)];
    const auto key = std::minmax(a.body, b.body);
    const auto known = scene.allowed_pairs.find(key);
    if (known == scene.allowed_pairs.end() || a.body == b.body) continue;
    const bool swapped = a.body > b.body;
    const AllowedPatches& allowed = known->second;
    const int rows = swapped ? allowed.patches_b : allowed.patches_a;
    const int columns = swapped ? allowed.patches_a : allowed.patches_b;
    const auto [at, fresh] = own_patches.try_emplace({a.body, b.body});
    OwnPatches& own = at->second;
    if (fresh) {
      own.cross.assign(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns), false);
      for (int p = 0; p < rows; ++p)
        for (int q = 0; q < columns; ++q)
          // What the clip touches is gathered below, within the window.
          if ((swapped ? allowed.reasons_of(q, p) : allowed.reasons_of(p, q)) &
              (AllowedPatches::kShared | AllowedPatches::kBind))
            own.cross[static_cast<std::size_t>(p) * static_cast<std::size_t>(columns) +
                      static_cast<std::size_t>(q)] = true;
      own.near = own.cross;
    }
    pair.filter = {a.patch_of.data(), b.patch_of.data(), columns, &own.near};
    pair_states[k].cross = &own.cross;
  }
}

// The character's own parts as rigid pieces differ from its skin: what they do to each other while
// the limb follows the clip is natural, near as near, across as across.
void LimbPlanningSpace::Data::gather_clip_contacts() {
  const double length = t_goal - t_init;
  const int samples = std::clamp(static_cast<int>(std::ceil(length * kClipRate)), 1, 3600);
  std::vector<TriangleContact> contacts;
  for (int i = 0; i <= samples; ++i) {
    Configuration c;
    c.t = t_init + length * i / samples;
    const auto cell = tracks->cell_at(c.t);
    tracks->fill(cell);
    const Segment& segment = segments[static_cast<std::size_t>(cell.segment)];
    // At the window's ends the limb stands as the planner will be told.
    const bool clip_pose = i != 0 && i != samples;
    c.q = i == 0 ? at_init.q : at_goal.q;
    place_chain(cell, c, clip_pose);
    std::vector<int> list = segment.inner_pairs;
    for (const auto& with : segment.pair_with) list.insert(list.end(), with.begin(), with.end());
    for (const int k : list) {
      if (k < 0) continue;
      const auto at = static_cast<std::size_t>(k);
      if (!pair_states[at].cross) continue;
      const Pair& pair = pairs[at];
      const RigidTransform &world_from_a = place(cell, segment, pair.a),
                           &world_from_b = place(cell, segment, pair.b);
      const PlanningPart &a = pieces[static_cast<std::size_t>(pair.a)],
                         &b = pieces[static_cast<std::size_t>(pair.b)];
      const double distance = pair_states[at].distance;
      if (glm::distance(world_from_a * a.centre, world_from_b * b.centre) >
          a.radius + b.radius + distance)
        continue;
      const RigidTransform a_from_b = inverse(world_from_a) * world_from_b;
      OwnPatches& own = own_patches[{a.body, b.body}];
      // A hair more than is asked later, so that the ends themselves are never in doubt.
      for (const bool cross : {true, false}) {
        PatchFilter filter = pair.filter;
        filter.allowed = cross ? &own.cross : &own.near;
        double reach = cross ? scene.touching() : 1.001 * distance;
        // Where the two are in contact, what is near beside it is part of the same touching.
        if (cross && in_contact(*a.mesh, *b.mesh, a_from_b, reach))
          reach = std::max(reach, scene.settings.touch_reach * scene.height);
        find_contacts(*a.mesh, *b.mesh, a_from_b, reach, filter, contacts);
        for (const TriangleContact& contact : contacts) {
          const std::size_t bit = static_cast<std::size_t>(a.patch_of[contact.triangle_a]) *
                                      static_cast<std::size_t>(pair.filter.patches_b) +
                                  b.patch_of[contact.triangle_b];
          own.near[bit] = true;
          if (cross) own.cross[bit] = true;
        }
      }
    }
  }
  for (auto& [key, own] : own_patches) own.near_only = own.near != own.cross;
  for (std::size_t k = 0; k < pairs.size(); ++k)
    if (pair_states[k].cross)
      pair_states[k].near_only = own_patches[{pieces[static_cast<std::size_t>(pairs[k].a)].body,
                                              pieces[static_cast<std::size_t>(pairs[k].b)].body}]
                                     .near_only;
}

// What may touch is known and stays as it is.
void LimbPlanningSpace::Data::find_regions() {
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    PairState& state = pair_states[k];
    if (!state.cross) continue;
    PatchFilter& filter = pairs[k].filter;
    const CollisionMesh &a = *pieces[static_cast<std::size_t>(pairs[k].a)].mesh,
                        &b = *pieces[static_cast<std::size_t>(pairs[k].b)].mesh;
    state.near_regions = patch_regions(a, b, filter);
    PatchFilter cross = filter;
    cross.allowed = state.cross;
    state.cross_regions = state.near_only ? patch_regions(a, b, cross) : state.near_regions;
    filter.regions = state.near_regions.get();
  }
}

void LimbPlanningSpace::Data::build_metric() {
  const auto add = [&](int part, int node, const Vec3& local) {
    metric.push_back({part, node, local});
  };
  const auto number = [&](int node) { return chain.number[static_cast<std::size_t>(node)]; };
  const int end = number(limb.limb.end);
  add(-1, number(limb.limb.middle), Vec3(0.0));
  add(-1, end, Vec3(0.0));
  // The end effector's points, in its rigid frame at the window's beginning.
  const auto cell = tracks->cell_at(t_init);
  tracks->fill(cell);
  Configuration c;
  c.q = at_init.q;
  c.t = t_init;
  place_chain(cell, c, false);
  const Segment& first = segments[static_cast<std::size_t>(cell.segment)];
  const RigidTransform end_from_world = inverse(links[static_cast<std::size_t>(end)].frame);
  std::vector<Vec3> points;
  for (int p = 0; p < static_cast<int>(pieces.size()); ++p) {
    const PlanningPart& piece = pieces[static_cast<std::size_t>(p)];
    if (!piece.of_limb || piece.segment != kEndSegment ||
        scene.roles[static_cast<std::size_t>(piece.body)].side.limb != limb_index)
      continue;
    const RigidTransform end_from_part = end_from_world * place(cell, first, p);
    for (const glm::vec3& v : piece.mesh->positions()) points.push_back(end_from_part * Vec3(v));
  }
  if (points.empty()) {
    // No hand to see: a cross as wide as one.
    const double reach = 0.05 * scene.height;
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 p(0.0);
      for (const double side : {-reach, reach}) {
        p[axis] = side;
        points.push_back(p);
      }
    }
  }
  for (const Vec3& p : extreme_points(points, Vec3(0.0), kEndPoints)) add(-1, end, p);
  // Whatever the limb carries at some time of the window.
  std::set<int> carried;
  for (const Segment& segment : segments)
    for (const int p : segment.moving)
      if (!pieces[static_cast<std::size_t>(p)].of_limb) carried.insert(p);
  std::map<int, std::vector<int>> by_actor;
  for (const int p : carried) by_actor[pieces[static_cast<std::size_t>(p)].actor].push_back(p);
  for (const auto& [actor, list] : by_actor) {
    // One point set a carried thing, on its largest piece.
    const int part = *std::max_element(list.begin(), list.end(), [&](int x, int y) {
      return pieces[static_cast<std::size_t>(x)].radius <
             pieces[static_cast<std::size_t>(y)].radius;
    });
    const PlanningPart& piece = pieces[static_cast<std::size_t>(part)];
    points.assign(piece.mesh->positions().begin(), piece.mesh->positions().end());
    for (const Vec3& p : extreme_points(points, piece.centre, kEndPoints)) add(part, -1, p);
  }
}

}  // namespace elbowroom
