// SPDX-License-Identifier: MIT
#include "core/collision/frame_tracks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/animation/affine.h"
#include "core/collision/world_steps.h"

namespace elbowroom {
namespace {

constexpr double kRate = 240;          // Hz
constexpr double kMostRows = 1 << 18;  // a quarter of an hour; longer windows get a lower rate

// Sign-aligned normalized linear interpolation; between neighbouring samples it is slerp to within
// the cube of the angle.
Quat nlerp(const Quat& a, const Quat& b, double u) {
  const double v = glm::dot(a, b) < 0 ? -u : u;
  return glm::normalize(Quat((1 - u) * a.w + v * b.w, (1 - u) * a.x + v * b.x,
                             (1 - u) * a.y + v * b.y, (1 - u) * a.z + v * b.z));
}

}  // namespace

NodeFrame between(const NodeFrame& a, const NodeFrame& b, double u) {
  if (u == 0) return a;
  return {nlerp(a.rotation, b.rotation, u), a.place + u * (b.place - a.place)};
}

RigidTransform rigid(const NodeFrame& frame) {
  return {glm::mat3_cast(frame.rotation), frame.place};
}

FrameTracks::FrameTracks(World world, std::vector<Node> nodes, Locals locals, double begin,
                         double end)
    : world_(std::move(world)), nodes_(std::move(nodes)), local_nodes_(std::move(locals)) {
  if (!(end > begin)) end = just_after(begin);
  steps_ = world_steps(world_, begin, end);
  const double rate = std::min(kRate, kMostRows / (end - begin));
  std::vector<double> borders = {begin};
  for (const double step : steps_)
    if (step > begin) borders.push_back(step);
  for (std::size_t i = 0; i < borders.size(); ++i) {
    Segment segment;
    segment.begin = borders[i];
    segment.end = i + 1 < borders.size() ? just_before(borders[i + 1]) : end;
    segment.end = std::max(segment.end, segment.begin);
    const double intervals = std::clamp(std::ceil((segment.end - segment.begin) * rate), 1.0, 1e7);
    segment.first = rows_;
    segment.last = rows_ + static_cast<std::uint32_t>(intervals);
    rows_ = segment.last + 1;
    segments_.push_back(segment);
  }
  filled_.assign(rows_, 0);
  frames_.resize(rows_ * nodes_.size());
  locals_.resize(rows_ * local_nodes_.nodes.size());
  parents_.resize(rows_, Mat4(1.0));
}

double FrameTracks::segment_middle(int segment) const {
  const Segment& s = segments_[static_cast<std::size_t>(segment)];
  return 0.5 * (s.begin + s.end);
}

bool FrameTracks::joined(std::uint32_t row) const {
  return std::none_of(segments_.begin(), segments_.end(),
                      [&](const Segment& s) { return s.last == row; });
}

double FrameTracks::time_of(std::uint32_t row) const {
  const auto after =
      std::upper_bound(segments_.begin(), segments_.end(), row,
                       [](std::uint32_t r, const Segment& s) { return r < s.first; });
  const Segment& s = *(after - 1);
  if (row == s.last) return s.end;
  return s.begin + (s.end - s.begin) * static_cast<double>(row - s.first) /
                       static_cast<double>(s.last - s.first);
}

FrameTracks::Cell FrameTracks::cell_at(double t) const {
  Cell cell;
  if (segments_.size() > 1) {
    const auto after = std::upper_bound(segments_.begin(), segments_.end(), t,
                                        [](double x, const Segment& s) { return x < s.begin; });
    if (after != segments_.begin()) cell.segment = static_cast<int>(after - segments_.begin()) - 1;
  }
  const Segment& s = segments_[static_cast<std::size_t>(cell.segment)];
  const double intervals = static_cast<double>(s.last - s.first);
  const double length = s.end - s.begin;
  const double at = length > 0 ? (t - s.begin) / length * intervals : 0.0;
  const double clamped = at > 0 ? std::min(at, intervals) : 0.0;
  const double whole = std::min(std::floor(clamped), intervals - 1);
  cell.row = s.first + static_cast<std::uint32_t>(whole);
  cell.u = clamped - whole;
  return cell;
}

void FrameTracks::fill_row(std::uint32_t row) {
  world_state_at(world_, time_of(row), states_);
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const ActorState& state = states_[static_cast<std::size_t>(nodes_[n].actor)];
    const Mat4& m = state.world_from_joint[static_cast<std::size_t>(nodes_[n].node)];
    frames_[row * nodes_.size() + n] = {rotation_of(m), Vec3(m[3])};
  }
  if (!local_nodes_.nodes.empty()) {
    const Actor& actor = world_.actors[static_cast<std::size_t>(local_nodes_.actor)];
    const Skeleton& skeleton = actor.model->skeleton;
    const ActorState& state = states_[static_cast<std::size_t>(local_nodes_.actor)];
    for (std::size_t n = 0; n < local_nodes_.nodes.size(); ++n) {
      const auto node = static_cast<std::size_t>(local_nodes_.nodes[n]);
      Transform& local = locals_[row * local_nodes_.nodes.size() + n];
      local = state.pose.local[node];
      const int below = n < local_nodes_.below.size() ? local_nodes_.below[n] : Locals::kOwnParent;
      if (below == Locals::kOwnParent) continue;
      const Mat4 inverse = glm::inverse(state.world_from_joint[static_cast<std::size_t>(below)]);
      local = decompose(multiply_affine(inverse, state.world_from_joint[node]));
    }
    const int root = local_nodes_.nodes.front();
    const int parent = skeleton.joints[static_cast<std::size_t>(root)].parent;
    // A root's parent is the file's own placement: what its matrix leaves of its local transform.
    parents_[row] =
        parent >= 0 ? state.world_from_joint[static_cast<std::size_t>(parent)]
                    : state.world_from_joint[static_cast<std::size_t>(root)] *
                          glm::inverse(state.pose.local[static_cast<std::size_t>(root)].matrix());
  }
  filled_[row] = 1;
}

NodeFrame FrameTracks::frame_at(const Cell& cell, std::size_t node) const {
  return between(frame(cell.row, node), frame(cell.row + 1, node), cell.u);
}

Transform FrameTracks::local_at(const Cell& cell, std::size_t node, bool rotation) const {
  const Transform &a = local(cell.row, node), &b = local(cell.row + 1, node);
  return {a.translation + cell.u * (b.translation - a.translation),
          rotation ? nlerp(a.rotation, b.rotation, cell.u) : Quat(1, 0, 0, 0),
          a.scale + cell.u * (b.scale - a.scale)};
}

}  // namespace elbowroom
