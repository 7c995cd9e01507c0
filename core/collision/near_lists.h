// SPDX-License-Identifier: MIT
// What a planner has learnt about one pair of rigid meshes: about some placements, which of their
// triangles are near each other. A planner asks about the same two parts thousands of times, mostly
// in places hardly apart from ones it has asked about before; limbs that rest beside a trunk are
// near it always, and no bounding volume says they are not.
//
// A list holds all pairs of triangles, but for allowed ones, that are nearer than a reach at its
// placement, with their distances, like the neighbour lists of molecular dynamics (Verlet 1967).
// From there to another placement a point x of mesh a moves, seen from b, by
//
//     |(R' − R)(x − c) + way of c|,   of a ball of radius r at most |way of its centre| + ‖R' − R‖
//     r
//
// so while all of a moves by less than the reach leaves, what is not listed need not be looked at,
// and of what is listed only pairs whose own distance is used up: mostly none. What is left is
// settled as in_contact() does it, so the answers are the same (mesh_pair.h); containment too.
//
// Space: that of in_contact(); lengths in a's units. A list is made where two placements without
// contact that no list knew have been near each other. Some dozens are kept, the oldest go first.
// Which are there decides no answer, only whether there is one. Memory: 28 bytes a listed pair, at
// most 256 of them a list. One thread at a time; meshes and filter must stay as they are.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/collision/mesh_pair.h"

namespace elbowroom {

class NearLists {
 public:
  NearLists() = default;
  // `room`: how much farther than what is asked about a list reaches at first.
  explicit NearLists(double room) : room_(room) {}

  // in_contact(), or nothing if no list is near enough to tell. About 0.2 µs.
  std::optional<bool> in_contact(const CollisionMesh& a, const CollisionMesh& b,
                                 const RigidTransform& a_from_b, double distance,
                                 const PatchFilter& filter, PairCache* cache);
  // True only if all pairs that are not allowed are farther apart than `distance`; a no costs
  // little and says little (surely_farther() in pair_clearance.h); nothing as above.
  std::optional<bool> surely_farther(const CollisionMesh& a, const CollisionMesh& b,
                                     const RigidTransform& a_from_b, double distance);

  // To be told of placements that no list knew and at which in_contact() at `distance` said no.
  void learn(const CollisionMesh& a, const CollisionMesh& b, const RigidTransform& a_from_b,
             double distance, const PatchFilter& filter);

 private:
  struct List {
    RigidTransform a_from_b, b_from_a;
    double reach = 0;  // what is not listed is farther
    // A component of a (of b) whose vertices are all in the box of what encloses in b (in a) would
    // have to move this far at least: the least over all components. Infinite where none encloses.
    double a_outside = 0, b_outside = 0;
    // By listed pair, distances ascending: a ball about a's triangle, relative to a's centre; a
    // distance that is not above that of the two; the triangles.
    std::vector<float> x, y, z, radius, distance;
    std::vector<std::uint32_t> a, b;
  };
  struct Ball {
    Vec3 centre{0.0};
    double radius = 0;
  };
  // What takes points of a from a placement to another, seen from b.
  struct Shift {
    Mat3 turn{0.0};
    Vec3 way{0.0};     // of a's centre
    double swing = 0;  // of `turn`: no vector becomes longer by it
    double most = 0;   // of any point of a
  };
  Shift shift(const RigidTransform& from, const RigidTransform& to) const;
  std::array<float, 12> summary(const RigidTransform& b_from_a) const;
  // What a list says of a placement, without a look at the triangles.
  enum class Said { nothing, apart, perhaps };
  // Of one list: `nothing` if it does not reach so far; marks the listed pairs that may be nearer
  // than `distance`.
  Said ask(std::size_t list, const RigidTransform& b_from_a, double distance);
  // Of the one that was asked last, which mostly is near enough, or of the nearest. Leaves it in
  // latest_ and how far a has moved from there in moved_.
  Said ask_any(const RigidTransform& b_from_a, double distance);
  std::size_t nearest(const RigidTransform& b_from_a);
  // Whether test(triangle of a, of b) says true of a pair that was marked.
  template <typename Test>
  bool any_marked(const Test& test) const;
  bool make_list(const CollisionMesh& a, const CollisionMesh& b, const RigidTransform& a_from_b,
                 double distance, const PatchFilter& filter, List& list);

  double room_ = 0;
  double slack_ = 0;  // more than what is rounded
  Ball ball_a_, ball_b_;
  bool known_ = false;  // the balls are
  std::vector<List> lists_;
  std::size_t next_ = 0, latest_ = 0;
  static constexpr std::size_t kMostLists = 128;
  // Of each list's placement, to find the nearest one: the place of a's centre and a's axes, as
  // long as a turn by them counts; a column for each.
  std::array<std::vector<float>, 12> summaries_;
  std::vector<float> apart_;  // scratch, by list
  static constexpr std::size_t kMissed = 8;
  std::array<RigidTransform, kMissed> missed_;  // b_from_a, a ring
  std::size_t missed_count_ = 0;
  // Of the last question.
  Shift moved_;
  std::size_t marked_ = 0;          // of the list's pairs, how many are looked at
  std::vector<std::int32_t> near_;  // which of these are marked
};

}  // namespace elbowroom
