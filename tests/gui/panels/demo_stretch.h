// SPDX-License-Identifier: MIT
// A stretch of the demo: its files with every clip cut to the keys within a time range (or to its
// first few, if it has none there). What takes seconds on the whole clip takes a fraction on it.
#pragma once

#include <filesystem>

#include "core/editing/document.h"

namespace elbowroom {

enum class Props { none, all };

// Writes the character's file into the folder. The demo's clip is chosen.
Document demo_stretch(const std::filesystem::path& folder, double from, double to, Props props);

// Between the posts, before the umbrella meets one of them and behind it.
inline constexpr double kStretchBegin = 1.2, kStretchEnd = 2.5;

}  // namespace elbowroom
