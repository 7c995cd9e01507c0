// SPDX-License-Identifier: MIT
// Where nodes of a world stand over a window, filled as it is asked for, so that a planner samples
// no clip in its inner loop.
//
// Rigid frames of the tracked nodes at 240 Hz, with times at which the world steps kept apart;
// between, places are interpolated linearly and rotations by normalized linear interpolation. The
// error against the clip is that of a chord: at most a·h²/8 for acceleration a and h = 1/240 s (0.2
// mm at 100 m/s²), and a quarter of h times the change of velocity at a clip's key that falls
// between two samples (0.5 mm for 0.5 m/s). One thread at a time; no allocation once filled.
#pragma once

#include <cstdint>
#include <vector>

#include "core/collision/collision_mesh.h"
#include "core/scene/world.h"

namespace elbowroom {

struct NodeFrame {
  Quat rotation{1, 0, 0, 0};
  Vec3 place{0.0};
};

class FrameTracks {
 public:
  struct Node {
    int actor = -1, node = -1;
  };
  // Local transforms that are wanted beside the frames (a limb's own nodes), of one actor. By node:
  // below which other node it is wanted, where that is not its own parent (Limb::following); empty:
  // all below their own.
  struct Locals {
    static constexpr int kOwnParent = -1;
    int actor = -1;
    std::vector<int> nodes, below;
  };
  FrameTracks(World world, std::vector<Node> nodes, Locals locals, double begin, double end);

  // A place between two samples: `row` and `row + 1`, share `u` of the way. t is clamped to the
  // window. At a step the side after it counts.
  struct Cell {
    std::uint32_t row = 0;
    double u = 0;
    int segment = 0;  // between which steps
  };
  Cell cell_at(double t) const;
  std::uint32_t row_count() const { return rows_; }
  // `row` and `row + 1` have no step of the world between them.
  bool joined(std::uint32_t row) const;
  int segment_count() const { return static_cast<int>(segments_.size()); }
  double segment_middle(int segment) const;

  // Makes both rows of the cell ready.
  void fill(const Cell& cell) {
    if (!filled_[cell.row]) fill_row(cell.row);
    if (!filled_[cell.row + 1]) fill_row(cell.row + 1);
  }
  // Of a filled row.
  const NodeFrame& frame(std::uint32_t row, std::size_t node) const {
    return frames_[row * nodes_.size() + node];
  }
  const Transform& local(std::uint32_t row, std::size_t node) const {
    return locals_[row * local_nodes_.nodes.size() + node];
  }
  // World matrix of the parent of the first local node: linear part and place.
  const Mat4& parent(std::uint32_t row) const { return parents_[row]; }

  NodeFrame frame_at(const Cell& cell, std::size_t node) const;
  // Without its rotation where somebody else sets that.
  Transform local_at(const Cell& cell, std::size_t node, bool rotation = true) const;

  const std::vector<double>& steps() const { return steps_; }

 private:
  void fill_row(std::uint32_t row);
  double time_of(std::uint32_t row) const;

  struct Segment {
    double begin, end;          // end is just before the next step
    std::uint32_t first, last;  // rows
  };
  World world_;
  std::vector<Node> nodes_;
  Locals local_nodes_;
  std::vector<double> steps_;
  std::vector<Segment> segments_;
  std::uint32_t rows_ = 0;
  std::vector<std::uint8_t> filled_;
  std::vector<NodeFrame> frames_;
  std::vector<Transform> locals_;
  std::vector<Mat4> parents_;
  std::vector<ActorState> states_;
};

NodeFrame between(const NodeFrame& a, const NodeFrame& b, double u);
RigidTransform rigid(const NodeFrame& frame);

}  // namespace elbowroom
