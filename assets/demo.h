// SPDX-License-Identifier: MIT
// The demo scene, the situation of [SKF07] figure 1: a mannequin walks between two posts with an
// umbrella in its right hand, which runs into one of them. The files are made at build time by
// assets/generator and stand in the build folder's assets/.
#pragma once

#include "core/base/math.h"

namespace elbowroom::demo {

inline constexpr const char* kMannequinFile = "mannequin.glb";
inline constexpr const char* kUmbrellaFile = "umbrella.glb";
inline constexpr const char* kPostsFile = "posts.glb";

// Clips of the mannequin.
inline constexpr const char* kIdleClip = "Idle";                // a loop, on the spot
inline constexpr const char* kWalkClip = "Walk";                // a loop of one stride, on the spot
inline constexpr const char* kDemoClip = "Walk between posts";  // walks 5 m along +z

// Where the umbrella (origin at its grip, shaft along +y) is held. The hand joint's axes are the
// body's own (x left, y up, z ahead) when the forearm points ahead and the thumb up, so the grip is
// a shift only: in front of the palm. Metres.
inline constexpr const char* kAttachJoint = "RightHand";
inline constexpr double kGripX = 0.027, kGripY = 0.0, kGripZ = 0.072;
// As the command line takes it.
inline constexpr const char* kAttachArgument = "umbrella.glb@RightHand,0.027,0,0.072";

}  // namespace elbowroom::demo
