// SPDX-License-Identifier: MIT
#include "core/collision/limb_motion.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace elbowroom {
namespace {

constexpr double kUnevenScale = 1e-4;
constexpr double kMore = 1.01;  // what such scales, and rounding, can make of a bound

// Rotation vector, in the outer frame, of what takes a to b.
Vec3 turn_between(const Quat& a, const Quat& b) {
  return rotation_vector_from_quat(b * glm::conjugate(a));
}

double fastest(double angle) { return 4 * std::tan(0.25 * angle); }
// How far the rate of turning within a row gets from its mean.
double unevenness(double angle) {
  return std::max(angle - 2 * std::sin(0.5 * angle), fastest(angle) - angle);
}

double even_scale(const Vec3& s) {
  const double low = std::min({s.x, s.y, s.z}), high = std::max({s.x, s.y, s.z});
  return low > 0 && high - low <= kUnevenScale * low ? high : 0.0;
}

// Uniform scale of a rotation with scale, or 0.
double even_scale(const Mat3& m) {
  const Vec3 size(glm::length(m[0]), glm::length(m[1]), glm::length(m[2]));
  const double scale = even_scale(size), tiny = kUnevenScale * scale * scale;
  const bool square = std::abs(glm::dot(m[0], m[1])) <= tiny &&
                      std::abs(glm::dot(m[1], m[2])) <= tiny &&
                      std::abs(glm::dot(m[0], m[2])) <= tiny && glm::determinant(m) > 0;
  return square ? scale : 0.0;
}

}  // namespace

LimbMotion::LimbMotion(LimbPlanningSpace::Data& data) : data_(data) {
  FrameTracks& tracks = *data.tracks;
  const std::uint32_t rows = tracks.row_count();
  for (std::uint32_t row = 0; row + 1 < rows; ++row) {
    FrameTracks::Cell cell;
    cell.row = row;
    tracks.fill(cell);
  }
  const std::size_t nodes = data.track_count, chain = data.chain.nodes.size();
  tracked_.assign(rows * nodes, {});
  local_.resize(chain);
  above_.assign(chain, 0.0);
  way_.resize(chain);
  turns_.resize(chain);
  for (std::size_t n = 0; n < chain; ++n) {
    const int up = data.chain.nodes[n].parent;
    if (up >= 0) way_[n] = way_[static_cast<std::size_t>(up)];
    way_[n].push_back(static_cast<int>(n));
  }
  turns_on_way_.resize(chain);
  for (std::size_t n = 0; n < chain; ++n)
    for (const int k : way_[n]) turns_on_way_[n].push_back(&turns_[static_cast<std::size_t>(k)]);
  const auto start = [&](Sums& sums) {
    sums.lift.assign(rows, 0.0);
    sums.turn.assign(rows, 0.0);
  };
  start(base_);
  for (Sums& sums : local_) start(sums);

  // Scales, which have to keep.
  for (std::uint32_t row = 0; row < rows && supported_; ++row) {
    const double first = even_scale(Mat3(tracks.parent(0)));
    const double base = even_scale(Mat3(tracks.parent(row)));
    supported_ = first > 0 && std::abs(base - first) <= kUnevenScale * first;
    for (std::size_t n = 0; n < chain && supported_; ++n) {
      const double own = even_scale(tracks.local(row, n).scale);
      const double kept = even_scale(tracks.local(0, n).scale);
      supported_ = own > 0 && std::abs(own - kept) <= kUnevenScale * kept;
      const int up = data.chain.nodes[n].parent;
      above_[n] = up < 0 ? base
                         : above_[static_cast<std::size_t>(up)] *
                               even_scale(tracks.local(row, static_cast<std::size_t>(up)).scale);
    }
  }
  if (!supported_) return;

  double largest_turn = 0;
  for (std::uint32_t row = 0; row + 1 < rows; ++row) {
    const bool joined = tracks.joined(row);
    const auto add = [&](Sums& sums, double lift, double turn) {
      sums.lift[row + 1] = sums.lift[row] + (joined ? lift : 0.0);
      sums.turn[row + 1] = sums.turn[row] + (joined ? turn : 0.0);
    };
    const NodeFrame g0{rotation_of(tracks.parent(row)), Vec3(tracks.parent(row)[3])};
    const NodeFrame g1{rotation_of(tracks.parent(row + 1)), Vec3(tracks.parent(row + 1)[3])};
    const Vec3 base_turn = turn_between(g0.rotation, g1.rotation);
    const double base_angle = glm::length(base_turn), base_uneven = unevenness(base_angle);
    if (joined) largest_turn = std::max(largest_turn, base_angle);
    add(base_, glm::distance(g0.place, g1.place), fastest(base_angle));
    for (std::size_t n = 0; n < nodes; ++n) {
      const NodeFrame &f0 = tracks.frame(row, n), &f1 = tracks.frame(row + 1, n);
      const Vec3 turn = turn_between(f0.rotation, f1.rotation);
      const double angle = glm::length(turn);
      const TrackSums& before = tracked_[row * nodes + n];
      TrackSums& sums = tracked_[(row + 1) * nodes + n];
      sums = before;
      if (!joined) continue;
      sums.world_lift += glm::distance(f0.place, f1.place);
      sums.world_turn += fastest(angle);
      // In the base: what is left of the node's own motion when the base's is taken away; what is
      // neglected in that is the change of the base's rate and of the arm it turns on.
      const Vec3 d0 = f0.place - g0.place, d1 = f1.place - g1.place;
      const Vec3 left = (d1 - d0) - glm::cross(base_turn, 0.5 * (d0 + d1));
      sums.base_lift += glm::length(left) + 0.5 * base_angle * glm::distance(d0, d1) +
                        base_uneven * std::max(glm::length(d0), glm::length(d1));
      sums.base_turn += glm::length(turn - base_turn) + unevenness(angle) + base_uneven;
    }
    for (std::size_t n = 0; n < chain; ++n) {
      const Transform &a = tracks.local(row, n), &b = tracks.local(row + 1, n);
      const bool by_clip = data.chain.nodes[n].dof_joint < 0;
      add(local_[n], glm::distance(a.translation, b.translation),
          (by_clip ? fastest(angle_between(a.rotation, b.rotation)) : 0.0) +
              glm::distance(a.scale, b.scale) / even_scale(a.scale));
    }
  }

  // How far the limb and what it carries reach from the base.
  double reach = 0;
  std::vector<double> from_base(chain, 0.0);
  for (std::size_t n = 0; n < chain; ++n) {
    double bone = 0;
    for (std::uint32_t row = 0; row < rows; ++row)
      bone = std::max(bone, glm::length(tracks.local(row, n).translation));
    const int up = data.chain.nodes[n].parent;
    from_base[n] = (up < 0 ? 0.0 : from_base[static_cast<std::size_t>(up)]) + above_[n] * bone;
  }
  const std::size_t parts = data.pieces.size();
  node_radius_.assign(parts, 0.0);
  twist_radius_.assign(parts, -1.0);
  known_.assign(parts, 0);
  travel_.resize(parts);
  placed_.resize(parts);
  for (std::size_t p = 0; p < parts; ++p) {
    const PlanningPart& piece = data.pieces[p];
    node_radius_[p] = glm::length(piece.node_from_part * piece.centre) + piece.radius;
    for (const auto& segment : data.segments) {
      const int node = segment.chain_of[p];
      if (node == kWorld) continue;
      const RigidTransform& placed = segment.chain_from_part[p];
      reach = std::max(reach, from_base[static_cast<std::size_t>(node)] +
                                  glm::length(placed * piece.centre) + piece.radius);
    }
    // About the twist's axis a long thin part reaches much less far than from the joint.
    if (data.segments.size() != 1 || data.segments[0].chain_of[p] == kWorld) continue;
    const auto node = static_cast<std::size_t>(data.segments[0].chain_of[p]);
    const int joint = data.chain.nodes[node].dof_joint;
    if (joint < 0) continue;
    const auto j = static_cast<std::size_t>(joint);
    const Quat to_joint = data.limb.joints[j].joint_from_anatomy;
    double radius = 0;
    for (const Quat& residual : {data.at_init.residual[j], data.at_goal.residual[j]}) {
      const Vec3 axis = glm::mat3_cast(to_joint * glm::conjugate(residual)) * Vec3(1, 0, 0);
      for (const glm::vec3& v : piece.mesh->positions())
        radius = std::max(
            radius, glm::length(glm::cross(data.segments[0].chain_from_part[p] * Vec3(v), axis)));
    }
    // Between the two residuals the axis leaves neither by more than their angle.
    const double far =
        glm::length(data.segments[0].chain_from_part[p] * piece.centre) + piece.radius;
    const double leaves = angle_between(data.at_init.residual[j], data.at_goal.residual[j]);
    twist_radius_[p] = std::min(far, radius + far * leaves);
  }
  flex_ = 0.5 * largest_turn * largest_turn * reach;
}

double LimbMotion::between(const std::vector<double>& sums) const {
  const auto at = [&](const FrameTracks::Cell& cell) {
    return sums[cell.row] + cell.u * (sums[cell.row + 1] - sums[cell.row]);
  };
  const double middle = at(middle_);
  return std::max(at(end_) - middle, middle - at(begin_));
}

void LimbMotion::set(const Dofs& q, const Dofs& rate, double begin, double middle, double end,
                     const FrameTracks::Cell& at_begin, const FrameTracks::Cell& at_middle,
                     const FrameTracks::Cell& at_end,
                     const LimbPlanningSpace::Data::Segment& segment,
                     const std::array<Quat, 3>& residual) {
  begin_ = at_begin;
  middle_ = at_middle;
  end_ = at_end;
  segment_ = &segment;
  std::fill(known_.begin(), known_.end(), std::uint8_t{0});
  const double half = std::max(end - middle, middle - begin);
  const double window = data_.t_goal - data_.t_init;
  for (std::size_t n = 0; n < turns_.size(); ++n) {
    TurningJoint& turn = turns_[n];
    turn.origin = data_.links[n].place;
    turn.lift = above_[n] * between(local_[n].lift);
    turn.loose = between(local_[n].turn);
    const int joint = data_.chain.nodes[n].dof_joint;
    if (joint < 0) continue;
    const auto j = static_cast<std::size_t>(joint);
    const JointModel& model = data_.limb.joints[j];
    const auto first = static_cast<std::size_t>(model.first_dof);
    set_turn(turn, model, &q.value[first], &rate.value[first], half,
             data_.links[n].frame.rotation *
                 glm::mat3_cast(model.joint_from_anatomy * glm::conjugate(residual[j])));
    if (data_.residual_moves && window > 0)
      turn.loose +=
          half / window * angle_between(data_.at_init.residual[j], data_.at_goal.residual[j]);
  }
  base_lift_ = between(base_.lift);
  base_turn_ = between(base_.turn);
  const Mat4 &p0 = data_.tracks->parent(at_middle.row),
             &p1 = data_.tracks->parent(at_middle.row + 1);
  base_place_ = Vec3(p0[3]) + at_middle.u * (Vec3(p1[3]) - Vec3(p0[3]));
}

const LimbMotion::Travel& LimbMotion::moving_travel(int part) {
  const auto p = static_cast<std::size_t>(part);
  Travel& own = travel_[p];
  if (known_[p]) return own;
  known_[p] = 1;
  const PlanningPart& piece = data_.pieces[p];
  const auto node = static_cast<std::size_t>(segment_->chain_of[p]);
  const RigidTransform frame = data_.links[node].frame * segment_->chain_from_part[p];
  TurningPart& placed = placed_[p];
  placed.centre = frame * piece.centre;
  placed.radius = piece.radius;
  for (int k = 0; k < 3; ++k) placed.half[k] = frame.rotation[k] * piece.half[k];
  placed.twist_radius = twist_radius_[p];
  own.in_base = travel_beyond(part, 0);
  own.in_world = own.in_base + base_lift_ +
                 base_turn_ * (glm::distance(placed.centre, base_place_) + piece.radius);
  own.in_base = kMore * own.in_base + flex_;
  own.in_world = kMore * own.in_world + flex_;
  return own;
}

double LimbMotion::travel_beyond(int part, std::size_t shared) {
  const auto p = static_cast<std::size_t>(part);
  const auto& turns = turns_on_way_[static_cast<std::size_t>(segment_->chain_of[p])];
  return turning_travel(std::span(turns).subspan(shared), placed_[p]);
}

const LimbMotion::Travel& LimbMotion::still_travel(int part) {
  const auto p = static_cast<std::size_t>(part);
  Travel& own = travel_[p];
  if (known_[p]) return own;
  known_[p] = 1;
  const std::size_t nodes = data_.track_count, track = data_.track_of[p];
  const auto at = [&](const FrameTracks::Cell& cell) {
    const TrackSums &x = tracked_[cell.row * nodes + track],
                    &y = tracked_[(cell.row + 1) * nodes + track];
    return glm::dvec4(x.world_lift + cell.u * (y.world_lift - x.world_lift),
                      x.world_turn + cell.u * (y.world_turn - x.world_turn),
                      x.base_lift + cell.u * (y.base_lift - x.base_lift),
                      x.base_turn + cell.u * (y.base_turn - x.base_turn));
  };
  const glm::dvec4 middle = at(middle_);
  const glm::dvec4 farther = glm::max(at(end_) - middle, middle - at(begin_));
  const double radius = node_radius_[p];
  own.in_world = kMore * (farther[0] + radius * farther[1]);
  own.in_base = kMore * (farther[2] + radius * farther[3]);
  return own;
}

double LimbMotion::travel(int a, int b) {
  const auto pa = static_cast<std::size_t>(a), pb = static_cast<std::size_t>(b);
  const Travel& one = moving_travel(a);
  const int node_b = segment_->chain_of[pb];
  if (node_b == kWorld) {
    const Travel& still = still_travel(b);
    return std::min(one.in_world + still.in_world, one.in_base + still.in_base);
  }
  moving_travel(b);
  const auto& way_a = way_[static_cast<std::size_t>(segment_->chain_of[pa])];
  const auto& way_b = way_[static_cast<std::size_t>(node_b)];
  std::size_t shared = 0;
  while (shared < way_a.size() && shared < way_b.size() && way_a[shared] == way_b[shared]) ++shared;
  return kMore * (travel_beyond(a, shared) + travel_beyond(b, shared)) + flex_;
}

}  // namespace elbowroom
