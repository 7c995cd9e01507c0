// SPDX-License-Identifier: MIT
// Time to pixels and back, and where a ruler's ticks stand. Plain arithmetic.
#pragma once

#include <string>
#include <vector>

namespace elbowroom {

// What the timeline may show of a clip.
struct TimeRange {
  double from = 0, to = 1;
  double length() const { return to - from; }
};

// The clip's range put right: finite, at least one frame long.
TimeRange usable_clip(double begin, double end, double frame_rate);
double usable_rate(double frame_rate);
// The part seen put right: from == to or no numbers give the whole clip with a little air;
// otherwise between two frames and one and a half clips long, and never out of sight of the clip.
TimeRange usable_view(double from, double to, const TimeRange& clip, double frame_rate);
// Zoomed by `factor` (> 1: closer) about `time`.
TimeRange zoomed(const TimeRange& view, double time, double factor);

struct TimeScale {
  TimeRange range;
  float left = 0, width = 1;  // pixels

  float x_of(double time) const {
    const double t = (time - range.from) / range.length();
    // Far outside stays outside, and inside the range of a float.
    const double x = static_cast<double>(left) + t * static_cast<double>(width);
    return static_cast<float>(x < -1e6 ? -1e6 : x > 1e6 ? 1e6 : x);
  }
  double time_of(float x) const {
    return range.from + range.length() * static_cast<double>((x - left) / width);
  }
  double seconds_a_pixel() const { return range.length() / static_cast<double>(width); }
};

struct Tick {
  double time = 0;
  bool major = false;
  std::string label;  // of major ones
};
// Ticks within the scale's range: major ones at least `label_pixels` apart, at 1, 2 or 5 times a
// power of ten seconds (or frames); between them minor ones where they are 6 pixels apart or more.
std::vector<Tick> ticks_of(const TimeScale& scale, double begin, double frame_rate, bool frames,
                           float label_pixels);

}  // namespace elbowroom
