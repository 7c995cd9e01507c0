// SPDX-License-Identifier: MIT
#include "core/collision/limb_planning_space.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "core/collision/frame_tracks.h"
#include "core/collision/planning_parts.h"
#include "core/collision/rigid_links.h"

namespace elbowroom {
namespace {

constexpr double kClipRate = 60;  // Hz, at which the clip's own near contacts are gathered
constexpr int kEndPoints = 4;     // extreme points of the end effector, and of each carried thing
constexpr int kWorld = -1;        // a part that no limb node moves

// Parts that move with the limb are placed by one of its nodes.
struct Chain {
  struct Node {
    int node = -1;
    int parent = -1;     // in the chain, -1 for the limb's root
    int dof_joint = -1;  // index in LimbModel::joints, -1: as in the clip
    bool scaled = false;
  };
  std::vector<Node> nodes;
  std::vector<int> number;  // by node of the skeleton, -1
};

struct Link {
  Mat3 linear{1.0};
  Vec3 place{0.0};
  RigidTransform frame;
};

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

struct LimbPlanningSpace::Data {
  const SceneCollision::Data& scene;
  World world;
  int limb_index;
  const LimbModel& limb;
  double t_init, t_goal;
  LimbState at_init, at_goal;
  bool residual_moves = false;
  Settings settings;

  Chain chain;
  std::unique_ptr<FrameTracks> tracks;
  std::vector<PlanningPart> pieces;
  std::vector<Part> parts;
  std::vector<std::size_t> track_of;  // by part: its node in the tracks

  // Between two steps of the world: who carries what.
  struct Segment {
    std::vector<int> chain_of;  // by part: the chain node that moves it, or kWorld
    std::vector<RigidTransform> chain_from_part;  // where chain_of is a node
    std::vector<int> moving;  // parts of the limb's side, the farthest from the root first
    // Pair numbers by moving part, in the order they are tried: with parts of the world, by their
    // number in `still`, or -1; and with other moving parts.
    std::vector<std::vector<int>> pair_with;
    std::vector<int> still;
    std::vector<int> inner_pairs;   // between two parts of the limb's side
    std::vector<int> sorted_pairs;  // all of them, ascending
  };
  std::vector<Segment> segments;
  std::vector<Pair> pairs;
  struct PairState {
    const std::vector<bool>* cross = nullptr;  // patches that may cross, null: none
    bool near_only = false;                    // some are allowed to be near but not to cross
    double distance = 0;
    PairCache cache, cross_cache;
    long hits = 0;
  };
  std::vector<PairState> pair_states;
  // The pairs that hit last, latest first: neighbours of a colliding configuration collide alike.
  // Only the time to an answer depends on them.
  std::array<int, 4> recent{-1, -1, -1, -1};
  struct OwnPatches {
    std::vector<bool> near, cross;
    bool near_only = false;
  };
  std::map<std::pair<int, int>, OwnPatches> own_patches;  // by bodies, as the pair has them

  // What a moving part can meet while the world goes from one row of the tracks to the next.
  std::vector<std::vector<std::uint32_t>> reachable;  // by row: places in Segment::still
  std::vector<std::uint8_t> reach_known;

  struct MetricPoint {
    int part = -1;  // -1: the chain node's own
    int chain_node = -1;
    Vec3 local{0.0};
  };
  std::vector<MetricPoint> metric;

  std::vector<Link> links;             // scratch, by chain node
  std::vector<RigidTransform> placed;  // scratch, by part
  std::vector<std::uint8_t> is_placed;

  Data(const SceneCollision& of, int index, double begin, double end, const LimbState& init,
       const LimbState& goal, const Settings& given)
      : scene(of.data()),
        world(of.world()),
        limb_index(index),
        limb(of.limbs()[static_cast<std::size_t>(index)]),
        t_init(begin),
        t_goal(end),
        at_init(init),
        at_goal(goal),
        settings(given) {}

  void build_chain();
  void build_segments();
  void build_pairs();
  void gather_clip_contacts();
  void build_metric();
  LimbState state_at(const Configuration& c) const;
  void place_chain(const FrameTracks::Cell& cell, const Configuration& c, bool clip_pose);
  RigidTransform world_part(const FrameTracks::Cell& cell, int part);
  const RigidTransform& place(const FrameTracks::Cell& cell, const Segment& segment, int part);
  void find_reachable(const FrameTracks::Cell& cell);
  // A pair is tested while its first part is on the limb's side, and its second as it was paired.
  bool in_segment(int pair, const Segment& segment) const {
    return segments.size() == 1 ||
           std::binary_search(segment.sorted_pairs.begin(), segment.sorted_pairs.end(), pair);
  }
  bool touches(int pair, const FrameTracks::Cell& cell, const Segment& segment);
};

// The limb's nodes that move parts or lead to ones that do.
void LimbPlanningSpace::Data::build_chain() {
  const Model& model = *world.actors[static_cast<std::size_t>(scene.actor)].model;
  const Skeleton& skeleton = model.skeleton;
  const std::size_t count = skeleton.joints.size();
  std::vector<bool> wanted(count, false);
  const auto want = [&](int node) {
    for (int at = node; at >= 0 && skeleton.is_within(at, limb.limb.root);
         at = skeleton.joints[static_cast<std::size_t>(at)].parent)
      wanted[static_cast<std::size_t>(at)] = true;
  };
  for (const JointModel& joint : limb.joints) want(joint.joint);
  for (const PlanningPart& part : pieces)
    if (part.actor == scene.actor && part.of_limb) want(part.node);
  for (const Actor& actor : world.actors)
    if (actor.attachment && actor.attachment->actor == scene.actor &&
        actor.attachment->joint >= 0 && static_cast<std::size_t>(actor.attachment->joint) < count)
      want(actor.attachment->joint);

  chain.number.assign(count, -1);
  for (const int n : skeleton.order) {
    if (!wanted[static_cast<std::size_t>(n)]) continue;
    Chain::Node node;
    node.node = n;
    if (n != limb.limb.root)
      node.parent = chain.number[static_cast<std::size_t>(
          skeleton.joints[static_cast<std::size_t>(n)].parent)];
    for (std::size_t j = 0; j < limb.joints.size(); ++j)
      if (limb.joints[j].joint == n) node.dof_joint = static_cast<int>(j);
    chain.number[static_cast<std::size_t>(n)] = static_cast<int>(chain.nodes.size());
    chain.nodes.push_back(node);
  }
  links.resize(chain.nodes.size());
}

LimbState LimbPlanningSpace::Data::state_at(const Configuration& c) const {
  LimbState state;
  state.q = c.q;
  state.residual = at_init.residual;
  if (residual_moves) {
    const double length = t_goal - t_init;
    const double u = length > 0 ? std::clamp((c.t - t_init) / length, 0.0, 1.0) : 0.0;
    for (std::size_t j = 0; j < 3; ++j)
      state.residual[j] = slerp_shortest(at_init.residual[j], at_goal.residual[j], u);
  }
  return state;
}

// Places the chain's nodes; with `clip_pose` as the clip has them.
void LimbPlanningSpace::Data::place_chain(const FrameTracks::Cell& cell, const Configuration& c,
                                          bool clip_pose) {
  const LimbState state = state_at(c);
  const Mat4 &p0 = tracks->parent(cell.row), &p1 = tracks->parent(cell.row + 1);
  // A rotation between two close ones, entry by entry, is short of a rotation by the square of
  // their angle; what is left of that the frames' own normalization takes out.
  const Mat4 parent = p0 + cell.u * (p1 - p0);
  for (std::size_t n = 0; n < chain.nodes.size(); ++n) {
    const Chain::Node& node = chain.nodes[n];
    Transform local = tracks->local_at(cell, n);
    if (node.dof_joint >= 0 && !clip_pose) {
      const JointModel& joint = limb.joints[static_cast<std::size_t>(node.dof_joint)];
      local.rotation =
          local_rotation(joint, &state.q.value[static_cast<std::size_t>(joint.first_dof)],
                         state.residual[static_cast<std::size_t>(node.dof_joint)]);
    }
    const Mat3 above =
        node.parent < 0 ? Mat3(parent) : links[static_cast<std::size_t>(node.parent)].linear;
    const Vec3 from =
        node.parent < 0 ? Vec3(parent[3]) : links[static_cast<std::size_t>(node.parent)].place;
    Mat3 own = glm::mat3_cast(local.rotation);
    for (int k = 0; k < 3; ++k) own[k] *= local.scale[k];
    Link& link = links[n];
    link.linear = above * own;
    link.place = from + above * local.translation;
    link.frame.translation = link.place;
    // Where nothing is sheared or mirrored the columns are a rotation but for their length.
    const Vec3 x = link.linear[0], y = link.linear[1], z = link.linear[2];
    const double xx = glm::dot(x, x), yy = glm::dot(y, y), zz = glm::dot(z, z);
    const double tiny = 1e-9 * (xx + yy + zz);
    if (xx > 0 && std::abs(xx - yy) <= tiny && std::abs(xx - zz) <= tiny &&
        std::abs(glm::dot(x, y)) <= tiny && std::abs(glm::dot(y, z)) <= tiny &&
        std::abs(glm::dot(x, z)) <= tiny && glm::dot(glm::cross(x, y), z) > 0) {
      link.frame.rotation = link.linear * (1.0 / std::sqrt(xx));
    } else {
      Mat4 m(link.linear);
      link.frame.rotation = glm::mat3_cast(rotation_of(m));
    }
  }
  std::fill(is_placed.begin(), is_placed.end(), std::uint8_t{0});
}

RigidTransform LimbPlanningSpace::Data::world_part(const FrameTracks::Cell& cell, int part) {
  const auto p = static_cast<std::size_t>(part);
  const RigidTransform frame = rigid(tracks->frame_at(cell, track_of[p]));
  const Vec3& shift = pieces[p].node_from_part.translation;
  return {frame.rotation, frame.translation + frame.rotation * shift};
}

const RigidTransform& LimbPlanningSpace::Data::place(const FrameTracks::Cell& cell,
                                                     const Segment& segment, int part) {
  const auto p = static_cast<std::size_t>(part);
  if (!is_placed[p]) {
    const int node = segment.chain_of[p];
    placed[p] = node == kWorld
                    ? world_part(cell, part)
                    : links[static_cast<std::size_t>(node)].frame * segment.chain_from_part[p];
    is_placed[p] = 1;
  }
  return placed[p];
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
    for (int p = 0; p < count; ++p)
      if (segment.chain_of[static_cast<std::size_t>(p)] == kWorld) segment.still.push_back(p);
    segments.push_back(std::move(segment));
  }
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
      state.distance = settings.clearance + (skin ? settings.margin : 0.0);
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
          if (swapped ? allowed.reasons_of(q, p) : allowed.reasons_of(p, q))
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
        find_contacts(*a.mesh, *b.mesh, a_from_b, cross ? scene.touching() : 1.001 * distance,
                      filter, contacts);
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

// Which parts of the world the limb's side can meet in a cell, whatever its DOFs.
void LimbPlanningSpace::Data::find_reachable(const FrameTracks::Cell& cell) {
  reach_known[cell.row] = 1;
  const Segment& segment = segments[static_cast<std::size_t>(cell.segment)];
  double reach = 0, largest = 0;
  Vec3 root[2];
  for (int end = 0; end < 2; ++end) {
    const std::uint32_t row = cell.row + static_cast<std::uint32_t>(end);
    const Mat4& parent = tracks->parent(row);
    root[end] = Vec3(parent * glm::dvec4(tracks->local(row, 0).translation, 1.0));
    // No node is farther from the root than the bones on the way are long.
    std::vector<double> stretch(chain.nodes.size()), from_root(chain.nodes.size(), 0.0);
    const auto longest = [](const Mat3& m) {
      return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
    };
    // Column lengths bound a rotation with scale; the Frobenius norm bounds anything.
    const auto bound = [&](const Mat3& m) {
      const double x = glm::dot(m[0], m[0]), y = glm::dot(m[1], m[1]), z = glm::dot(m[2], m[2]);
      const double tiny = 1e-9 * (x + y + z);
      const bool plain = std::abs(x - y) <= tiny && std::abs(x - z) <= tiny;
      return plain ? std::sqrt(x) * (1 + 1e-6) : longest(m);
    };
    for (std::size_t n = 0; n < chain.nodes.size(); ++n) {
      const Transform& local = tracks->local(row, n);
      const int up = chain.nodes[n].parent;
      const double above = up < 0 ? bound(Mat3(parent)) : stretch[static_cast<std::size_t>(up)];
      const double size =
          std::max({std::abs(local.scale.x), std::abs(local.scale.y), std::abs(local.scale.z)});
      stretch[n] = above * size;
      if (up >= 0)
        from_root[n] =
            from_root[static_cast<std::size_t>(up)] + above * glm::length(local.translation);
    }
    for (const int p : segment.moving) {
      const PlanningPart& piece = pieces[static_cast<std::size_t>(p)];
      const int node = segment.chain_of[static_cast<std::size_t>(p)];
      const Vec3 centre = segment.chain_from_part[static_cast<std::size_t>(p)] * piece.centre;
      reach = std::max(
          reach, from_root[static_cast<std::size_t>(node)] + glm::length(centre) + piece.radius);
    }
  }
  for (const PairState& state : pair_states) largest = std::max(largest, state.distance);
  const Vec3 middle = 0.5 * (root[0] + root[1]);
  const double drift = 0.5 * glm::distance(root[0], root[1]);
  auto& list = reachable[cell.row];
  list.clear();
  for (std::size_t s = 0; s < segment.still.size(); ++s) {
    const auto p = static_cast<std::size_t>(segment.still[s]);
    const Vec3 at = pieces[p].node_from_part * pieces[p].centre;
    Vec3 ends[2];
    for (int end = 0; end < 2; ++end) {
      const Frame& f = tracks->frame(cell.row + static_cast<std::uint32_t>(end), track_of[p]);
      ends[end] = f.place + f.rotation * at;
    }
    // Turning between two rows leaves the chord by at most its length.
    const double moves = glm::distance(ends[0], ends[1]);
    if (glm::distance(0.5 * (ends[0] + ends[1]), middle) <=
        reach + drift + pieces[p].radius + moves + largest)
      list.push_back(static_cast<std::uint32_t>(s));
  }
}

bool LimbPlanningSpace::Data::touches(int number, const FrameTracks::Cell& cell,
                                      const Segment& segment) {
  const auto k = static_cast<std::size_t>(number);
  const Pair& pair = pairs[k];
  PairState& state = pair_states[k];
  const RigidTransform& world_from_a = place(cell, segment, pair.a);
  const RigidTransform& world_from_b = place(cell, segment, pair.b);
  const PlanningPart &a = pieces[static_cast<std::size_t>(pair.a)],
                     &b = pieces[static_cast<std::size_t>(pair.b)];
  const Vec3 apart = world_from_a * a.centre - world_from_b * b.centre;
  const double sum = a.radius + b.radius + state.distance;
  if (glm::dot(apart, apart) > sum * sum) return false;
  const RigidTransform a_from_b = inverse(world_from_a) * world_from_b;
  bool hit = in_contact(*a.mesh, *b.mesh, a_from_b, state.distance, pair.filter, &state.cache);
  if (!hit && state.near_only) {
    PatchFilter cross = pair.filter;
    cross.allowed = state.cross;
    hit = in_contact(*a.mesh, *b.mesh, a_from_b, 0.0, cross, &state.cross_cache);
  }
  if (hit) {
    ++state.hits;
    auto at = std::find(recent.begin(), recent.end(), number);
    if (at == recent.end()) --at;
    std::rotate(recent.begin(), at, at + 1);
    recent.front() = number;
  }
  return hit;
}

LimbPlanningSpace::LimbPlanningSpace(const SceneCollision& scene, int limb, double t_init,
                                     double t_goal, const LimbState& at_init,
                                     const LimbState& at_goal, const Settings& settings)
    : data_(std::make_unique<Data>(scene, limb, t_init, t_goal, at_init, at_goal, settings)) {
  Data& d = *data_;
  for (double* length : {&d.settings.clearance, &d.settings.margin})
    if (!(*length > 0)) *length = 0;
  for (std::size_t j = 0; j < 3; ++j)
    d.residual_moves = d.residual_moves || d.at_init.residual[j] != d.at_goal.residual[j];

  std::vector<std::vector<int>> link(d.world.actors.size());
  for (std::size_t i = 0; i < d.world.actors.size(); ++i) {
    if (!d.world.actors[i].model) continue;
    std::vector<int> apart;
    if (static_cast<int>(i) == d.scene.actor) {
      for (const LimbModel& each : d.scene.limbs)
        for (const JointModel& joint : each.joints) apart.push_back(joint.joint);
    }
    link[i] =
        rigid_links(d.world, static_cast<int>(i), t_init, t_goal, apart, 1e-4 * d.scene.height);
  }
  d.pieces = planning_parts(d.scene, d.world, limb, t_init, link);
  d.build_chain();

  std::vector<FrameTracks::Node> nodes;
  std::map<std::pair<int, int>, std::size_t> node_number;
  for (const PlanningPart& piece : d.pieces) {
    const auto [at, fresh] = node_number.try_emplace({piece.actor, piece.node}, nodes.size());
    if (fresh) nodes.push_back({piece.actor, piece.node});
    d.track_of.push_back(at->second);
    d.parts.push_back({piece.mesh, piece.name, piece.of_limb});
  }
  FrameTracks::Locals locals;
  locals.actor = d.scene.actor;
  for (const Chain::Node& node : d.chain.nodes) locals.nodes.push_back(node.node);
  d.tracks =
      std::make_unique<FrameTracks>(d.world, std::move(nodes), std::move(locals), t_init, t_goal);
  d.placed.resize(d.pieces.size());
  d.is_placed.assign(d.pieces.size(), 0);
  d.reachable.resize(d.tracks->row_count());
  d.reach_known.assign(d.tracks->row_count(), 0);
  d.build_segments();
  for (const auto& segment : d.segments)
    for (const int p : segment.moving) d.parts[static_cast<std::size_t>(p)].limb = true;
  d.build_pairs();
  d.gather_clip_contacts();
  d.build_metric();
}

LimbPlanningSpace::~LimbPlanningSpace() = default;

bool LimbPlanningSpace::valid(const Configuration& c) {
  Data& d = *data_;
  if (!std::isfinite(c.t) || c.q.count < d.limb.dof_count()) return false;
  for (int i = 0; i < c.q.count; ++i)
    if (!std::isfinite(c.q[i])) return false;
  const auto cell = d.tracks->cell_at(c.t);
  d.tracks->fill(cell);
  if (!d.reach_known[cell.row]) d.find_reachable(cell);
  const auto& segment = d.segments[static_cast<std::size_t>(cell.segment)];
  d.place_chain(cell, c, false);
  for (const int pair : d.recent)
    if (pair >= 0 && d.in_segment(pair, segment) && d.touches(pair, cell, segment)) return false;
  const auto& reachable = d.reachable[cell.row];
  for (const auto& with : segment.pair_with)
    for (const std::uint32_t s : reachable)
      if (with[s] >= 0 && d.touches(with[s], cell, segment)) return false;
  for (const int pair : segment.inner_pairs)
    if (d.touches(pair, cell, segment)) return false;
  return true;
}

void LimbPlanningSpace::metric_points(const Configuration& c, std::vector<Vec3>& points) {
  Data& d = *data_;
  points.resize(d.metric.size());
  const auto cell = d.tracks->cell_at(c.t);
  d.tracks->fill(cell);
  const auto& segment = d.segments[static_cast<std::size_t>(cell.segment)];
  d.place_chain(cell, c, false);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Data::MetricPoint& point = d.metric[i];
    points[i] = point.part >= 0
                    ? d.place(cell, segment, point.part) * point.local
                    : d.links[static_cast<std::size_t>(point.chain_node)].frame * point.local;
  }
}

const std::vector<double>& LimbPlanningSpace::step_times() const { return data_->tracks->steps(); }

std::array<Quat, 3> LimbPlanningSpace::residual_at(double t) const {
  Configuration c;
  c.t = t;
  return data_->state_at(c).residual;
}

std::pair<std::string, std::string> LimbPlanningSpace::most_blocking() const {
  const Data& d = *data_;
  long most = 0;
  std::size_t worst = 0;
  for (std::size_t k = 0; k < d.pair_states.size(); ++k)
    if (d.pair_states[k].hits > most) most = d.pair_states[k].hits, worst = k;
  if (most == 0) return {};
  return {d.parts[static_cast<std::size_t>(d.pairs[worst].a)].name,
          d.parts[static_cast<std::size_t>(d.pairs[worst].b)].name};
}

const std::vector<LimbPlanningSpace::Part>& LimbPlanningSpace::parts() const {
  return data_->parts;
}
const std::vector<LimbPlanningSpace::Pair>& LimbPlanningSpace::pairs() const {
  return data_->pairs;
}

void LimbPlanningSpace::placements(const Configuration& c,
                                   std::vector<RigidTransform>& world_from_part) {
  Data& d = *data_;
  const auto cell = d.tracks->cell_at(c.t);
  d.tracks->fill(cell);
  const auto& segment = d.segments[static_cast<std::size_t>(cell.segment)];
  d.place_chain(cell, c, false);
  world_from_part.resize(d.pieces.size());
  for (std::size_t p = 0; p < d.pieces.size(); ++p)
    world_from_part[p] = d.place(cell, segment, static_cast<int>(p));
}

}  // namespace elbowroom
