// SPDX-License-Identifier: MIT
// Puts a corrected stretch into a rotation or translation channel: the source outside the window,
// new keys inside (DESIGN.md, "Keys").
//
// What holds for the result:
// * Source keys outside [window_begin, window_end] keep their bits, times and values.
// * The segments that bracket the window show the source's rotation to within 1e-6 rad. At the
//   window's ends stand keys with the source's own value there.
// * Before its first and after its last key the source clamps; so does the result, wherever the
//   window lies.
// * Quaternions are unit and change sign only where the source does or must: a path that winds once
//   round ends on the other sign than the source's next key has. Then the change of sign stands
//   between window_end and the float32 just before it, where no float32 time can fall.
// * Times strictly increase.
//
// A glTF sampler has one interpolation for all its keys, so the source's decides:
// * LINEAR stays LINEAR; the keys are joined by slerp and their derivatives are not used, so they
//   should be dense.
// * CUBICSPLINE stays CUBICSPLINE. A segment that the window cuts is split: Hermite tangents are
//   derivatives by time, so the part kept is described by the curve's value and derivative at the
//   cut. As the cubic is normalized only after interpolation, its value there is not unit in
//   general; further unit keys are put into the kept part until the normalized curves agree, and
//   only the two tangents at its ends are rewritten. Keys without derivatives are joined by chords.
// * STEP becomes LINEAR: each value is held by a second key at the float32 time just before the
//   next key's, so every float32 time outside the window shows what it did.
// * No source channel: the joint's rest rotation holds outside; CUBICSPLINE if derivatives are
//   given, else LINEAR.
//
// For translations the same holds, and more simply: LINEAR and CUBICSPLINE segments that the window
// cuts are cut exactly (to the rounding of the key at the cut, which is float32), planned keys are
// joined by straight lines, and without a source channel the rest translation holds outside.
//
// A spliced channel can be spliced again. Pure functions, safe on any thread.
#pragma once

#include <vector>

#include "core/animation/clip.h"
#include "core/base/result.h"

namespace elbowroom {

// A planned rotation, local to the joint's parent.
struct RotationKeys {
  std::vector<float> times;       // seconds, strictly increasing, inside the window
  std::vector<Quat> values;       // one a time; unit (normalized here), sign free
  std::vector<Quat> derivatives;  // components of dq/dt per second, one a time, or none at all
  bool operator==(const RotationKeys&) const = default;
};

// How far the planned rotation may be from the source at a window's end, radians; the source's
// value is what is written there.
inline constexpr double kBorderTolerance = 1e-4;

// A planned translation, local to the joint's parent.
struct TranslationKeys {
  std::vector<float> times;  // seconds, strictly increasing, inside the window
  std::vector<Vec3> values;  // one a time
  bool operator==(const TranslationKeys&) const = default;
};

// The interpolation the result will have.
Interpolation spliced_interpolation(const Channel* source, bool with_derivatives);

// The source (null: the joint has no rotation channel and `rest` holds) with `keys` in
// [window_begin, window_end]. The result's source_channel is -1.
// Errors: a window that is empty or not finite; keys that are none, outside the window, not
// increasing, not finite, zero, or at a window's end further than kBorderTolerance from the source;
// a source that is no well-formed rotation channel, or whose spline passes through zero at a
// window's end.
Result<Channel> splice_rotation(const Channel* source, const Quat& rest, int joint,
                                float window_begin, float window_end, const RotationKeys& keys);

// The same of a translation. At a window's end a key may be off the source by kBorderTolerance of
// the longest translation among the keys and the source there.
Result<Channel> splice_translation(const Channel* source, const Vec3& rest, int joint,
                                   float window_begin, float window_end,
                                   const TranslationKeys& keys);

// A copy of the clip in which each of `spliced` replaces the channel of its joint and path, or is
// added. Untouched channels keep their source_channel, which is how an exporter knows them; begin
// and end are widened to the new keys.
Clip apply_splices(const Clip& clip, const std::vector<Channel>& spliced);

}  // namespace elbowroom
