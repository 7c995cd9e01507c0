// SPDX-License-Identifier: MIT
// How well a picture can be drawn in the time there is: a ladder of qualities, and who chooses from
// it while something moves. At rest a picture has full quality.
//
// Plain values and measured times, no GL. Times in seconds by any clock that runs on.
#pragma once

#include <array>
#include <optional>

#include "render/frame.h"
#include "render/scene_renderer.h"
#include "render/style.h"

namespace elbowroom {

struct DrawQuality {
  const char* name;
  bool draft;            // Style::draft
  int samples;           // at most
  int shadow_map_size;   // at most
  double scale;          // of the picture's sides: shown stretched
  double relative_cost;  // of full quality, about; measured times take its place
};

// From full quality downwards, each cheaper than the one before it.
inline constexpr std::array<DrawQuality, 5> kQualities = {{
    {"full", false, 64, 8192, 1.0, 1.0},
    {"smooth draft", true, 4, 1024, 1.0, 0.25},
    {"draft", true, 1, 512, 1.0, 0.14},
    {"coarse draft", true, 1, 512, 0.7, 0.11},
    {"rough draft", true, 1, 512, 0.5, 0.075},
}};
inline constexpr int kFullQuality = 0;

// A style, a size and widths in pixels as a quality has them; full quality leaves them as they are.
Style with_quality(Style style, const DrawQuality& quality);
PictureSize with_quality(const PictureSize& size, const DrawQuality& quality);
double pixel_scale_with_quality(double pixel_scale, const DrawQuality& quality);

struct QualityBudget {
  double moving = 0.024;  // a picture while something moves: leaves room in 33 ms for the panels
  double still = 1.0;     // the one picture after that; less while the machine is needed elsewhere
  double settle = 0.2;    // after the last movement
};

class QualityController {
 public:
  explicit QualityController(const QualityBudget& budget = {}) : budget_(budget) {}

  // May change at any time (planning begins). Values that are not positive are taken as 0.
  void set_budget(const QualityBudget& budget) { budget_ = budget; }

  // Before each picture: the level to draw it at, index in kQualities. `moving`: what it shows is
  // being dragged, orbited or played. Coarser at once when a level turns out too slow, finer only
  // with room to spare, so that it does not flicker.
  int choose(bool moving, double now);
  // After it: how long it took from draw() to its end on the screen. Not finite or negative: not
  // counted.
  void measured(double seconds);

  // When a picture is due although nothing changes, as the last one was not as good as it may be at
  // rest (a time that has passed: at once); none if it was.
  std::optional<double> redraw_at() const;

  int level() const { return level_; }
  // What a picture of a level takes, as far as is known: measured, or from the nearest measured
  // one.
  double expected(int level) const;

 private:
  int finest_within(double budget) const;

  QualityBudget budget_;
  int level_ = kFullQuality;  // of the last picture
  int moving_level_ = -1;     // of the last one that moved; −1: none yet
  double last_moved_ = 0;
  bool has_moved_ = false;
  std::array<double, kQualities.size()> seconds_{};  // by level; 0: not known
};

}  // namespace elbowroom
