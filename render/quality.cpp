// SPDX-License-Identifier: MIT
#include "render/quality.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace elbowroom {
namespace {

constexpr int kLevels = static_cast<int>(kQualities.size());
constexpr double kRoom = 0.75;    // of the budget, for a finer level
constexpr double kWeight = 0.25;  // of a new measurement

const DrawQuality& quality_of(int level) { return kQualities[static_cast<std::size_t>(level)]; }

}  // namespace

Style with_quality(Style style, const DrawQuality& quality) {
  style.draft = style.draft || quality.draft;
  style.samples = std::min(style.samples, quality.samples);
  style.shadow_map_size = std::min(style.shadow_map_size, quality.shadow_map_size);
  return style;
}

PictureSize with_quality(const PictureSize& size, const DrawQuality& quality) {
  const auto scaled = [&](int pixels) {
    return std::max(1, static_cast<int>(std::lround(pixels * quality.scale)));
  };
  return {scaled(size.width), scaled(size.height)};
}

double pixel_scale_with_quality(double pixel_scale, const DrawQuality& quality) {
  return pixel_scale * quality.scale;
}

double QualityController::expected(int level) const {
  level = std::clamp(level, 0, kLevels - 1);
  int nearest = -1;
  for (int l = 0; l < kLevels; ++l) {
    const bool known = seconds_[static_cast<std::size_t>(l)] > 0;
    if (known && (nearest < 0 || std::abs(l - level) < std::abs(nearest - level))) nearest = l;
  }
  if (nearest < 0) return 0;
  return seconds_[static_cast<std::size_t>(nearest)] * quality_of(level).relative_cost /
         quality_of(nearest).relative_cost;
}

int QualityController::finest_within(double budget) const {
  for (int level = 0; level < kLevels; ++level) {
    if (expected(level) <= budget) return level;
  }
  return kLevels - 1;
}

int QualityController::choose(bool moving, double now) {
  if (moving) {
    last_moved_ = now;
    has_moved_ = true;
    const int within = finest_within(budget_.moving);
    if (moving_level_ < 0 || within > moving_level_) {
      moving_level_ = within;
    } else if (within < moving_level_) {
      moving_level_ = std::min(moving_level_, finest_within(kRoom * budget_.moving));
    }
    level_ = moving_level_;
    return level_;
  }
  // A clock that went back ends the wait.
  const double since = now - last_moved_;
  if (has_moved_ && since >= 0 && since < budget_.settle) {
    level_ = moving_level_;
  } else {
    has_moved_ = false;
    level_ = finest_within(budget_.still);
  }
  return level_;
}

void QualityController::measured(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0) return;
  seconds = std::max(seconds, 1e-6);
  auto& known = seconds_[static_cast<std::size_t>(level_)];
  if (known <= 0) {
    known = seconds;
    return;
  }
  // What made this level slower or faster did so to the others: a planner took a core, the figure
  // came nearer.
  const double changed = (1 - kWeight) + kWeight * seconds / known;
  for (double& other : seconds_) other *= changed;
}

std::optional<double> QualityController::redraw_at() const {
  if (level_ <= finest_within(budget_.still)) return std::nullopt;
  return last_moved_ + budget_.settle;
}

}  // namespace elbowroom
