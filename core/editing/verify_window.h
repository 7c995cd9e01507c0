// SPDX-License-Identifier: MIT
// From a planned motion to keys that are looked at: what a player will show, on the deformed skin,
// at many times, and between them by proof (certificate.h).
#pragma once

#include <cstdint>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/editing/correct.h"
#include "core/editing/window_motion.h"

namespace elbowroom {

// A motion as keys, and the clip with them.
struct KeyedMotion {
  Correction correction;
  std::shared_ptr<const Clip> clip;
};
// Keys at the clip's rate or denser and at each of the problem's postures. Error: that of lay_over.
Result<KeyedMotion> key_motion(const WindowProblem& problem, const WindowMotion& motion);

// What was seen to touch first, and when.
struct SeenContact {
  std::string text{};  // "A with B at t", or "cancelled"; empty: nothing
  double time = 0;
  bool none() const { return text.empty(); }
};

// Looks at the keys: the scene plays them meanwhile and problem.clip afterwards. Where nothing
// touches, report's clearances, certified and what belongs to it are set. Times are added to
// report's. `seed` chooses the random times.
//
// What the clip itself touches may be touched, triangle by triangle (clip_touching.h); the room to
// slide that planning has does not count here. A glance at 60 Hz comes first, then the proof. What
// is proven, with no depth left to samples, is not looked at again, but for its clearance at 120
// Hz. Anything else is looked at at all of verification_times(); and the pairs that stand in the
// way of a proof every 0.1 ms where they do (CertificateSettings::look_below). Surfaces all but
// touching where a proof ended count as contact, but for what is near beside contacts of the clip.
SeenContact verify_keys(WindowProblem& problem, const KeyedMotion& keyed, std::uint64_t seed,
                        const std::stop_token& stop, const ProgressSink& progress,
                        WindowReport& report);

// Whether anything touches as keys are looked at 60 times a second. The scene plays them meanwhile.
bool touches_at_a_glance(WindowProblem& problem, const KeyedMotion& keyed,
                         const std::stop_token& stop);

// What touches as keys are looked at 60 times a second, or, where that shows nothing, 240.
struct GlancedContact {
  double time = 0;
  std::string part_a, part_b;  // as in ContactSample
};
std::vector<GlancedContact> contacts_at_a_glance(WindowProblem& problem, const KeyedMotion& keyed,
                                                 const std::stop_token& stop);

// The times at which a motion over [begin, end] is looked at: 240 Hz, the keys given, 1,000 random
// ones, both sides of steps; ascending, unique.
std::vector<double> verification_times(double begin, double end, const std::vector<float>& keys,
                                       const std::vector<double>& steps, std::uint64_t seed);

// Peak speed and acceleration of the curve, and how far it goes from the clip.
void measure_motion(const WindowProblem& problem, const WindowMotion& motion, WindowReport& report);

}  // namespace elbowroom
