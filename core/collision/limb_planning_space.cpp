// SPDX-License-Identifier: MIT
#include "core/collision/limb_planning_space.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/collision/limb_planning_data.h"
#include "core/collision/mesh_data.h"
#include "core/collision/pair_clearance.h"
#include "core/collision/rigid_links.h"

namespace elbowroom {
namespace {

constexpr double kStraight = 3e-9;  // of the scale's square, as rounding leaves it

// The uniform scale's square of a rotation with scale, or 0 if it is none to within `most` of that.
double even_square(const Mat3& m, double most) {
  const double xx = glm::dot(m[0], m[0]), yy = glm::dot(m[1], m[1]), zz = glm::dot(m[2], m[2]);
  const double size2 = (xx + yy + zz) / 3, tiny = most * size2;
  const bool even =
      size2 > 0 && std::abs(xx - yy) <= tiny && std::abs(xx - zz) <= tiny &&
      std::abs(glm::dot(m[0], m[1])) <= tiny && std::abs(glm::dot(m[1], m[2])) <= tiny &&
      std::abs(glm::dot(m[0], m[2])) <= tiny && glm::dot(glm::cross(m[0], m[1]), m[2]) > 0;
  return even ? size2 : 0.0;
}

// Between two rotations with the same scale that are close. Entry by entry what lies between is
// short of a rotation by the square of their angle; one step of Newton's iteration for the polar
// factor [Higham 1986] takes that out. What is sheared, mirrored or unevenly scaled stays as it is.
Mat3 base_between(const Mat3& a, const Mat3& b, double u) {
  const Mat3 m = a + u * (b - a);
  const double size2 = even_square(m, 1e-2);
  if (!(size2 > 0) || !(even_square(a, kStraight) > 0) || !(even_square(b, kStraight) > 0))
    return m;
  const double k = 0.5 * size2 / glm::dot(glm::cross(m[0], m[1]), m[2]);
  return {0.5 * m[0] + k * glm::cross(m[1], m[2]), 0.5 * m[1] + k * glm::cross(m[2], m[0]),
          0.5 * m[2] + k * glm::cross(m[0], m[1])};
}

}  // namespace

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
  if (!clip_pose && chain_placed && chain_at.t == c.t && chain_at.q.count == c.q.count &&
      std::equal(c.q.value.begin(), c.q.value.begin() + c.q.count, chain_at.q.value.begin()))
    return;
  chain_placed = !clip_pose;
  chain_at = c;
  ++placement;
  const LimbState state = state_at(c);
  const Mat4 &p0 = tracks->parent(cell.row), &p1 = tracks->parent(cell.row + 1);
  const Mat3 base = base_between(Mat3(p0), Mat3(p1), cell.u);
  const Vec3 base_place = Vec3(p0[3]) + cell.u * (Vec3(p1[3]) - Vec3(p0[3]));
  for (std::size_t n = 0; n < chain.nodes.size(); ++n) {
    const Chain::Node& node = chain.nodes[n];
    const bool planned = node.dof_joint >= 0 && !clip_pose;
    Transform local = tracks->local_at(cell, n, !planned);
    if (planned) {
      const JointModel& joint = limb.joints[static_cast<std::size_t>(node.dof_joint)];
      local.rotation =
          local_rotation(joint, &state.q.value[static_cast<std::size_t>(joint.first_dof)],
                         state.residual[static_cast<std::size_t>(node.dof_joint)]);
    }
    const Mat3 above = node.parent < 0 ? base : links[static_cast<std::size_t>(node.parent)].linear;
    const Vec3 from =
        node.parent < 0 ? base_place : links[static_cast<std::size_t>(node.parent)].place;
    Mat3 own = glm::mat3_cast(local.rotation);
    for (int k = 0; k < 3; ++k) own[k] *= local.scale[k];
    Link& link = links[n];
    link.linear = above * own;
    link.place = from + above * local.translation;
    link.frame.translation = link.place;
    // Where nothing is sheared or mirrored the columns are a rotation but for their length.
    const double size2 = even_square(link.linear, kStraight);
    if (size2 > 0) {
      link.frame.rotation = link.linear * (1.0 / std::sqrt(size2));
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
    placed_centre[p] = placed[p] * pieces[p].centre;
    is_placed[p] = 1;
  }
  return placed[p];
}

double LimbPlanningSpace::Data::bounds_gap(int number, const FrameTracks::Cell& cell,
                                           const Segment& segment) {
  const Pair& pair = pairs[static_cast<std::size_t>(number)];
  const RigidTransform& world_from_a = place(cell, segment, pair.a);
  const RigidTransform& world_from_b = place(cell, segment, pair.b);
  const PlanningPart &a = pieces[static_cast<std::size_t>(pair.a)],
                     &b = pieces[static_cast<std::size_t>(pair.b)];
  const Vec3 apart = placed_centre[static_cast<std::size_t>(pair.a)] -
                     placed_centre[static_cast<std::size_t>(pair.b)];
  // Long thin parts fill little of their spheres: each one's box against the other's sphere.
  const auto beyond_box = [&](const Mat3& turned, const Vec3& half) {
    double out2 = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double out = std::abs(glm::dot(turned[axis], apart)) - half[axis];
      if (out > 0) out2 += out * out;
    }
    return std::sqrt(out2);
  };
  return std::max({glm::length(apart) - a.radius - b.radius,
                   beyond_box(world_from_a.rotation, a.half) - b.radius,
                   beyond_box(world_from_b.rotation, b.half) - a.radius});
}

bool LimbPlanningSpace::Data::bounds_near(int number, const FrameTracks::Cell& cell,
                                          const Segment& segment, double more) {
  const auto k = static_cast<std::size_t>(number);
  return !(bounds_gap(number, cell, segment) > pair_states[k].distance + more) &&
         boxes_near(number, cell, segment, more);
}

bool LimbPlanningSpace::Data::boxes_near(int number, const FrameTracks::Cell& cell,
                                         const Segment& segment, double more) {
  const auto k = static_cast<std::size_t>(number);
  const auto a = static_cast<std::size_t>(pairs[k].a), b = static_cast<std::size_t>(pairs[k].b);
  const double distance = pair_states[k].distance + more;
  const auto may_meet = [&](std::size_t part, std::size_t other) {
    const RigidTransform& at = place(cell, segment, static_cast<int>(part));
    return pieces[part].mesh->data().sphere_may_meet(
        (placed_centre[other] - at.translation) * at.rotation, pieces[other].radius + distance);
  };
  return may_meet(a, b) && may_meet(b, a);
}

bool LimbPlanningSpace::Data::near(int number, const FrameTracks::Cell& cell,
                                   const Segment& segment, double more) {
  if (!bounds_near(number, cell, segment, more)) return false;
  const auto k = static_cast<std::size_t>(number);
  const Pair& pair = pairs[k];
  PairState& state = pair_states[k];
  const CollisionMesh &a = *pieces[static_cast<std::size_t>(pair.a)].mesh,
                      &b = *pieces[static_cast<std::size_t>(pair.b)].mesh;
  const RigidTransform a_from_b =
      inverse(place(cell, segment, pair.a)) * place(cell, segment, pair.b);
  if (in_contact(a, b, a_from_b, state.distance + more, pair.filter, &state.cache)) return true;
  if (!state.near_only) return false;
  PatchFilter cross = pair.filter;
  cross.allowed = state.cross;
  cross.regions = state.cross_regions.get();
  return in_contact(a, b, a_from_b, more, cross, &state.cross_cache);
}

bool LimbPlanningSpace::Data::surely_clear(int number, const FrameTracks::Cell& cell,
                                           const Segment& segment, double more) {
  if (!bounds_near(number, cell, segment, more)) return true;
  const auto k = static_cast<std::size_t>(number);
  const Pair& pair = pairs[k];
  const PairState& state = pair_states[k];
  const CollisionMesh &a = *pieces[static_cast<std::size_t>(pair.a)].mesh,
                      &b = *pieces[static_cast<std::size_t>(pair.b)].mesh;
  const RigidTransform a_from_b =
      inverse(place(cell, segment, pair.a)) * place(cell, segment, pair.b);
  if (!surely_farther(a, b, a_from_b, state.distance + more, pair.filter)) return false;
  if (!state.near_only) return true;
  PatchFilter cross = pair.filter;
  cross.allowed = state.cross;
  cross.regions = state.cross_regions.get();
  return surely_farther(a, b, a_from_b, more, cross);
}

bool LimbPlanningSpace::Data::touches(int number, const FrameTracks::Cell& cell,
                                      const Segment& segment) {
  PairState& state = pair_states[static_cast<std::size_t>(number)];
  if (state.clear_at == placement) return false;
  const bool hit = near(number, cell, segment, 0.0);
  if (hit) {
    ++state.hits;
    auto at = std::find(recent.begin(), recent.end(), number);
    if (at == recent.end()) --at;
    std::rotate(recent.begin(), at, at + 1);
    recent.front() = number;
  } else {
    state.clear_at = placement;
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
      for (const LimbModel& each : d.scene.limbs) {
        for (const JointModel& joint : each.joints) apart.push_back(joint.joint);
        for (const FollowingJoint& own : each.limb.following) apart.push_back(own.joint);
      }
    }
    link[i] =
        rigid_links(d.world, static_cast<int>(i), t_init, t_goal, apart, 1e-4 * d.scene.height);
  }
  d.pieces = planning_parts(d.scene, d.world, limb, t_init, t_goal, link);
  d.build_chain();

  std::vector<FrameTracks::Node> nodes;
  std::map<std::pair<int, int>, std::size_t> node_number;
  for (const PlanningPart& piece : d.pieces) {
    const auto [at, fresh] = node_number.try_emplace({piece.actor, piece.node}, nodes.size());
    if (fresh) nodes.push_back({piece.actor, piece.node});
    d.track_of.push_back(at->second);
    d.track_count = nodes.size();
    d.parts.push_back({piece.mesh, piece.name, piece.of_limb});
  }
  FrameTracks::Locals locals;
  locals.actor = d.scene.actor;
  for (const Chain::Node& node : d.chain.nodes) {
    locals.nodes.push_back(node.node);
    locals.below.push_back(node.follows ? d.chain.nodes[static_cast<std::size_t>(node.parent)].node
                                        : FrameTracks::Locals::kOwnParent);
  }
  d.tracks =
      std::make_unique<FrameTracks>(d.world, std::move(nodes), std::move(locals), t_init, t_goal);
  d.placed.resize(d.pieces.size());
  d.placed_centre.resize(d.pieces.size());
  d.moving_centre.resize(d.pieces.size());
  d.is_placed.assign(d.pieces.size(), 0);
  d.reachable.resize(d.tracks->row_count());
  d.reach_known.assign(d.tracks->row_count(), 0);
  d.build_segments();
  for (const auto& segment : d.segments)
    for (const int p : segment.moving) d.parts[static_cast<std::size_t>(p)].limb = true;
  d.build_pairs();
  d.gather_clip_contacts();
  d.find_regions();
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
  return d.clear_of_still(cell, segment) && d.clear_of_itself(cell, segment);
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

std::optional<double> LimbPlanningSpace::margin_to_refuse(const Configuration& c,
                                                          const std::string& part_a,
                                                          const std::string& part_b,
                                                          double at_most) {
  constexpr int kSteps = 16;
  Data& d = *data_;
  if (!std::isfinite(c.t) || c.q.count < d.limb.dof_count() || !(at_most > 0)) return std::nullopt;
  const auto cell = d.tracks->cell_at(c.t);
  d.tracks->fill(cell);
  const auto& segment = d.segments[static_cast<std::size_t>(cell.segment)];
  d.place_chain(cell, c, false);
  int least = kSteps + 1;
  for (std::size_t k = 0; k < d.pairs.size(); ++k) {
    const int pair = static_cast<int>(k);
    if (!d.are_named(d.pairs[k].a, d.pairs[k].b, part_a, part_b) || !d.in_segment(pair, segment))
      continue;
    // Of the steps from `low`, which is too small, to `high`.
    int low = -1, high = least;
    while (high - low > 1) {
      const int middle = low + (high - low) / 2;
      (d.near(pair, cell, segment, at_most * middle / kSteps) ? high : low) = middle;
    }
    least = high;
  }
  if (least > kSteps) return std::nullopt;
  return at_most * least / kSteps;
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
