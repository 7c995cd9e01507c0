// SPDX-License-Identifier: MIT
// What a LimbPlanningSpace holds. Private to the collision folder.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/collision/frame_tracks.h"
#include "core/collision/limb_planning_space.h"
#include "core/collision/patch_regions.h"
#include "core/collision/planning_parts.h"

namespace elbowroom {

class LimbMotion;

// In place of a node of the chain: what no limb node moves.
inline constexpr int kWorld = -1;

// Parts that move with the limb are placed by one of its nodes.
struct Chain {
  struct Node {
    int node = -1;
    int parent = -1;       // in the chain, -1 for the limb's root
    bool follows = false;  // from elsewhere in the tree: its parent here is the joint it serves
    int dof_joint = -1;    // index in LimbModel::joints, -1: as in the clip
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
  std::size_t track_count = 0;        // nodes in the tracks

  // Between two steps of the world: who carries what.
  struct Segment {
    std::vector<int> chain_of;  // by part: the chain node that moves it, or kWorld
    std::vector<RigidTransform> chain_from_part;  // where chain_of is a node
    std::vector<int> moving;   // parts of the limb's side, the farthest from the root first
    std::vector<Vec3> centre;  // of their spheres, in their chain nodes' frames
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
    std::shared_ptr<const PatchRegions> near_regions, cross_regions;
    bool near_only = false;  // some are allowed to be near but not to cross
    double distance = 0;
    PairCache cache, cross_cache;
    long hits = 0;
    std::uint64_t clear_at = 0;  // the placement at which it was found not to touch last
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

  // What a moving part can meet while the world goes from one row of the tracks to the next, and
  // spheres about it, which a moving part's meet several at once: in float, relative to `origin`,
  // from one row to the next in a straight line, and wide enough for what that leaves out. Their
  // number is a multiple of kSpheres; those beyond `still` are out of everything's way.
  static constexpr std::size_t kSpheres = 8;
  struct Reach {
    std::vector<std::uint32_t> still;  // places in Segment::still, ascending
    std::uint32_t list = 0;            // equal for rows of one segment with equal `still`
    Vec3 origin{0.0};
    std::vector<float> x, y, z, dx, dy, dz, radius;
    float largest = 0;  // coordinate
  };
  std::vector<Reach> reachable;  // by row
  std::vector<std::uint8_t> reach_known;
  std::map<std::vector<std::uint32_t>, std::uint32_t> reach_lists;

  struct MetricPoint {
    int part = -1;  // -1: the chain node's own
    int chain_node = -1;
    Vec3 local{0.0};
  };
  std::vector<MetricPoint> metric;

  std::shared_ptr<LimbMotion> motion;  // made when first asked for
  // Edges proven last, a ring: a path is asked about again when it is found, and when smoothed.
  std::vector<std::pair<Configuration, Configuration>> proven;
  std::size_t next_proven = 0;
  // Scratch of certified_free: intervals that are not yet free, and the pairs they ask about.
  struct Interval {
    double begin, end;
    std::size_t first, last;  // in open_pairs
  };
  std::vector<Interval> open_intervals;
  std::vector<int> open_pairs;
  std::vector<std::uint32_t> reached, reached_more;           // places in Segment::still, ascending
  std::vector<float> world_travel, base_travel, more_travel;  // by place in a cell's Reach

  Configuration chain_at;  // what the links were placed for, if they were
  bool chain_placed = false;
  std::uint64_t placement = 0;         // how often the chain was placed
  std::vector<Link> links;             // scratch, by chain node
  std::vector<RigidTransform> placed;  // scratch, by part
  std::vector<Vec3> placed_centre;     // scratch, by part: of its sphere, where it is placed
  std::vector<std::uint8_t> is_placed;
  std::vector<Vec3> moving_centre;                  // scratch, by part: of its sphere, world
  std::vector<float> sphere_x, sphere_y, sphere_z;  // scratch, of a cell's Reach
  std::vector<std::int32_t> sphere_near;            // by place in a cell's Reach

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

  // One of two pieces has a part of the one name, the other of the other.
  bool are_named(int a, int b, const std::string& one, const std::string& other) const;
  double margin_of(int a, int b) const;  // Settings::pair_margins
  void build_chain();
  void build_segments();
  void build_pairs();
  void gather_clip_contacts();
  void find_regions();
  void build_metric();
  LimbState state_at(const Configuration& c) const;
  void place_chain(const FrameTracks::Cell& cell, const Configuration& c, bool clip_pose);
  RigidTransform world_part(const FrameTracks::Cell& cell, int part);
  const RigidTransform& place(const FrameTracks::Cell& cell, const Segment& segment, int part);
  void find_reachable(const FrameTracks::Cell& cell);
  // Places the spheres of a cell's Reach and of the moving parts; the chain must be placed.
  void place_spheres(const FrameTracks::Cell& cell, const Segment& segment);
  // Sets sphere_near for one moving part that may come nearer by `more` (by place; none: 0). What
  // rounding may do to a coordinate is returned.
  float find_near(const FrameTracks::Cell& cell, int part, const float* more);
  // Parts that the limb's side can meet in any of the rows, into `reached`.
  void find_reached(const FrameTracks::Cell& first, std::uint32_t last_row);
  // Pairs that may meet within the interval that `motion` is set to, into open_pairs.
  void open_near_pairs(const FrameTracks::Cell& cell, const Segment& segment);
  // No moving part is nearer than it may be to anything that does not move with the limb, and to
  // another one (after the first of the two); the chain must be placed.
  bool clear_of_still(const FrameTracks::Cell& cell, const Segment& segment);
  bool clear_of_itself(const FrameTracks::Cell& cell, const Segment& segment);
  // A pair is tested while its first part is on the limb's side, and its second as it was paired.
  bool in_segment(int pair, const Segment& segment) const {
    return segments.size() == 1 ||
           std::binary_search(segment.sorted_pairs.begin(), segment.sorted_pairs.end(), pair);
  }
  // The pair's surfaces are no nearer than that, by their spheres, and each one's box and the
  // other's sphere.
  double bounds_gap(int pair, const FrameTracks::Cell& cell, const Segment& segment);
  // Each one's sphere may meet what fills the other's box: large bulky things (an umbrella) fill
  // little of it.
  bool boxes_near(int pair, const FrameTracks::Cell& cell, const Segment& segment, double more);
  // The pair is nearer than it may be plus `more` (0: what valid() says no to); its bounding
  // volumes are.
  bool bounds_near(int pair, const FrameTracks::Cell& cell, const Segment& segment, double more);
  bool near(int pair, const FrameTracks::Cell& cell, const Segment& segment, double more);
  // Only true if the pair's surfaces are not near; at a fraction of the cost, and no says little.
  bool surely_clear(int pair, const FrameTracks::Cell& cell, const Segment& segment, double more);
  bool touches(int pair, const FrameTracks::Cell& cell, const Segment& segment);
  std::optional<bool> piece_free(const Configuration& from, const Configuration& to, double begin,
                                 double end, std::int64_t& looks, std::int64_t most_looks);
};

}  // namespace elbowroom
