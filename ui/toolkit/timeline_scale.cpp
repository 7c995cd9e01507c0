// SPDX-License-Identifier: MIT
#include "ui/toolkit/timeline_scale.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace elbowroom {
namespace {

// The least of 1, 2, 5 × 10^n that is at least `least`, and into how many parts it is cut.
struct Step {
  double size = 1;
  int parts = 5;
  int exponent = 0;
};

Step nice_step(double least, bool whole) {
  if (whole) least = std::max(least, 1.0);
  const int exponent = static_cast<int>(std::floor(std::log10(least)));
  const double power = std::pow(10.0, exponent);
  for (const int factor : {1, 2, 5}) {
    if (factor * power >= least * (1 - 1e-9)) {
      return {factor * power, factor == 2 ? 4 : 5, exponent};
    }
  }
  return {10 * power, 5, exponent + 1};
}

}  // namespace

double usable_rate(double frame_rate) {
  return std::isfinite(frame_rate) && frame_rate > 0 ? std::clamp(frame_rate, 1e-3, 1e5) : 30.0;
}

TimeRange usable_clip(double begin, double end, double frame_rate) {
  TimeRange clip;
  clip.from = std::isfinite(begin) ? std::clamp(begin, -1e9, 1e9) : 0;
  clip.to = std::isfinite(end) ? std::clamp(end, -1e9, 1e9) : clip.from;
  if (clip.from > clip.to) std::swap(clip.from, clip.to);
  clip.to = std::max(clip.to, clip.from + 1 / usable_rate(frame_rate));
  return clip;
}

TimeRange usable_view(double from, double to, const TimeRange& clip, double frame_rate) {
  if (!std::isfinite(from) || !std::isfinite(to) || !(from < to)) {
    const double air = 0.004 * clip.length();
    return {clip.from - air, clip.to + air};
  }
  const double longest = 1.5 * clip.length();
  const double shortest = std::min(2 / usable_rate(frame_rate), longest);
  const double length = std::clamp(to - from, shortest, longest);
  const double middle = std::clamp(0.5 * (from + to), clip.from, clip.to);
  return {middle - 0.5 * length, middle + 0.5 * length};
}

TimeRange zoomed(const TimeRange& view, double time, double factor) {
  const double f = std::isfinite(factor) && factor > 0 ? factor : 1;
  return {time - (time - view.from) / f, time + (view.to - time) / f};
}

std::vector<Tick> ticks_of(const TimeScale& scale, double begin, double frame_rate, bool frames,
                           float label_pixels) {
  std::vector<Tick> ticks;
  const double second = frames ? 1 / usable_rate(frame_rate) : 1.0;  // one unit, in seconds
  const double origin = frames ? begin : 0.0;
  const double unit_pixels = second / scale.seconds_a_pixel();
  if (!(unit_pixels > 0) || !(scale.width > 1)) return ticks;
  const Step step = nice_step(static_cast<double>(std::max(label_pixels, 8.0f)) / unit_pixels,
                              frames);
  int parts = step.parts;
  if (frames && step.size < 5) parts = static_cast<int>(step.size);
  if (step.size / parts * unit_pixels < 6) parts = 1;
  const double minor = step.size / parts;
  const auto first = static_cast<long long>(std::ceil((scale.range.from - origin) / second / minor));
  const auto last = static_cast<long long>(std::floor((scale.range.to - origin) / second / minor));
  for (long long i = first; i <= last && ticks.size() < 4096; ++i) {
    const double value = static_cast<double>(i) * minor;
    Tick tick{origin + value * second, i % parts == 0, {}};
    if (tick.major) {
      char text[64];
      // Zero needs no decimals.
      if (value == 0) std::snprintf(text, sizeof text, "0");
      else std::snprintf(text, sizeof text, "%.*f", std::clamp(-step.exponent, 0, 6),
                    value);
      tick.label = text;
      if (i == 0 && !frames) tick.label += " s";
      if (i == 0 && frames) tick.label += " f";
    }
    ticks.push_back(std::move(tick));
  }
  return ticks;
}

}  // namespace elbowroom
