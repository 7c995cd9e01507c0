// SPDX-License-Identifier: MIT
// A proof that a limb touches nothing it may not at any time of an interval, on the deformed skin,
// while the scene plays the clips it plays: the adaptive bisection of Schwarzer, Saha and Latombe
// 2005 over time, with bounds from the keys themselves (motion_bound.h). What is proven is the
// motion a player shows between float32 keys, not a curve they were taken from.
//
// An interval is free if, as the scene stands at its middle, every two triangles that may not touch
// are farther apart than both can travel within it, plus ε, plus a slack for a player that computes
// in float32. Pairs of bodies for which that fails are asked again for its two halves. Two parts of
// the character are compared in a frame they share, so that the walk of both does not count. No
// interval goes across a step of the world (STEP keys, attachments that begin or end): each stretch
// between two steps is closed at both sides.
//
// The slack is 32 roundings of float32 at the limb's distance from the world's origin plus two
// heights: about 2e-6 of that; half of ε for a figure near the origin.
//
// What it says and what it does not:
//  * Allowed contacts are allowed: pairs of patches that may touch (about a shared joint, in the
//    bind pose, those that the clip itself has in contact, about that time) are not looked at; that
//    no others touch, nor these at other times, is proven. Those that may for the clip's sake may
//    only be as deep as the clip has them; between samples that depth is NOT proven. Parts of the
//    limb that come near such patches are listed in `depth_sampled`; the depth is known at the
//    times of the verification, 240 Hz and all keys.
//  * A contact that is excused only because the clip has it at that very moment, outside the
//    patches gathered from it, is not certified.
//  * Inside and outside cannot change where surfaces never touch; that nothing is inside something
//    is looked at once between two steps.
//
// Deterministic; no clock. One thread at a time. Cost: some hundred poses a second of motion, most
// of them for the few bodies that are near something.
#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "core/collision/scene_collision.h"

namespace elbowroom {

struct CertificateSettings {
  double longest = 1.0 / 30;  // seconds; what is begun with
  double smallest = 1.0e-7;   // seconds; what is not free by then is not certified
  long most_poses = 4000;     // for each second of the interval; then it is given up
  // For a closer look where there is no proof: intervals shorter than that (0: none), and what is
  // left when it would be given up, are not refused, but the pairs that are open in them are looked
  // at that often.
  double look_below = 0;    // seconds
  double look_step = 1e-4;  // seconds
};

struct Certificate {
  bool holds = false;
  double looked_at = 0;  // seconds of intervals that were looked at instead: if > 0, it is no proof
  // If not: where it ended.
  std::string part_a, part_b;         // the pair, the limb's side first
  double time = 0;                    // seconds
  std::string reason;                 // one sentence
  bool beside_clip_contacts = false;  // the pair is one that the clip has in contact somewhere
  // Pairs that may touch for the clip's sake and come that near: their depth is sampled only.
  std::vector<std::string> depth_sampled;
  long poses = 0, pair_checks = 0;
  double shortest = 0;  // seconds, of the intervals that were free
};

// Of the limb and what it carries, against everything; [begin, end] within what is played or not.
// The scene keeps its clip; no limb of it may be posed (SceneCollision::pose_limb). A stop request
// is answered after one pose: then nothing is certified.
Certificate certify_limb(SceneCollision& scene, int limb, double begin, double end,
                         const CertificateSettings& settings = {},
                         const std::stop_token& stop = {});

}  // namespace elbowroom
