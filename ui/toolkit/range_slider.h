// SPDX-License-Identifier: MIT
// The sampling interval of one degree of freedom (paper, section 4.1): name on the left, "85° –
// 140°" on the right; below a track with the joint's limits behind, the interval as a bright bar
// with two handles, the current value as a tick and the clip's value as a thinner one.
//
// Values are in radians (or metres); `shown_per_value` turns them into what is shown.
#pragma once

#include <optional>
#include <string_view>

#include "ui/toolkit/ui.h"

namespace elbowroom {

struct RangeModel {
  double limit_low = 0, limit_high = 0;      // what the joint can do
  double track_low = 0, track_high = 0;      // the track's ends; equal: the limits with some air
  double low = 0, high = 0;                  // the interval
  double default_low = 0, default_high = 0;  // double-click goes back here
  std::optional<double> current = {};        // a tick
  std::optional<double> clip = {};           // a thinner tick
};

struct RangeOptions {
  std::string_view unit = "°";
  double shown_per_value = 57.29577951308232;  // degrees in a radian
  int decimals = 0;
  double key_step = 0;          // shown units an arrow key; 0: one of the last decimal
  std::string_view right = {};  // instead of the numbers: "90 – 100 % first, then all"
  std::string_view hint = {};
  bool enabled = true;
};

// The interval put right: what is not a number becomes the limit, an interval the wrong way round
// is turned, and it lies within the limits.
void put_right(RangeModel& model);

// Changes model.low and model.high: a handle is dragged, or the bar between them (both move; the
// length stays), Shift for fine steps, Escape puts it back. Double-click on the track: the default.
// Double-click on the numbers, or Enter with the keyboard's focus: type "85 140" or "85 – 140".
// With the focus (a click gives it): Left and Right move the handle last used, Up
// and Down choose the other one, Home goes to the default; Shift a tenth, Ctrl ten steps.
// Recorded as "NAME", and its parts as "NAME.low", "NAME.high", "NAME.bar", "NAME.value".
Edit range_slider(Ui& ui, std::string_view name, RangeModel& model,
                  const RangeOptions& options = {});

}  // namespace elbowroom
