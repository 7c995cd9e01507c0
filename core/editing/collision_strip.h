// SPDX-License-Identifier: MIT
// What a timeline shows of collisions: for each limb its contacts over a clip, how deep they are,
// how much room there is otherwise, and the windows one would replan.
//
// Computed stretch by stretch, so that it can be shown while it grows and given up at once. World
// space, scene units, seconds of the clip's clock.
#pragma once

#include <functional>
#include <stop_token>
#include <vector>

#include "core/editing/correct.h"

namespace elbowroom {

struct StripSample {
  double t = 0;
  double depth = 0;      // of the deepest contact that is not allowed; 0: none, or a mere touch
  double clearance = 0;  // of limb and what it carries from all that is not the character, at most
                         // kStripReach × height; 0 in contact
  bool contact = false;
  Vec3 place{0.0};  // of the deepest contact
};

struct LimbStrip {
  std::vector<ContactInterval> contacts;  // not allowed ones, by begin
  std::vector<StripSample> samples;       // by time
  std::vector<ProposedWindow> windows;    // once the strip is complete; by begin, disjoint
};

struct CollisionStrip {
  double begin = 0, end = 0;
  double computed_to = 0;              // what lies before it is final
  std::vector<LimbStrip> limbs;        // by limb index
  std::vector<ContactInterval> other;  // of no limb
  bool complete() const { return computed_to >= end; }
};

inline constexpr double kStripReach = 0.1;  // × height: what is farther is not measured
inline constexpr double kStripRate = 60;  // Hz, of the samples; and one where a contact is deepest

using StripSink = std::function<void(const CollisionStrip&)>;

// The strip of the clip that the scene plays, over [begin, end]. `grown` (may be empty) is told
// after each stretch of about a quarter of a second. On a stop request what there is comes back,
// incomplete. Requires begin ≤ end.
CollisionStrip make_collision_strip(SceneCollision& scene, double begin, double end,
                                    std::stop_token stop = {}, const StripSink& grown = {});

// The strip after the clip has changed within [from, to] only: that stretch is looked at again, the
// rest is taken over.
CollisionStrip renew_collision_strip(SceneCollision& scene, const CollisionStrip& before,
                                     double from, double to, std::stop_token stop = {},
                                     const StripSink& grown = {});

// The sample nearest to t; null if there is none within two sample distances.
const StripSample* strip_sample_at(const LimbStrip& limb, double t);

}  // namespace elbowroom
