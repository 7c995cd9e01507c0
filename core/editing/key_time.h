// SPDX-License-Identifier: MIT
// Times as files hold them: keys are float32, and a window that begins between two of them would
// begin elsewhere once it is written.
#pragma once

namespace elbowroom {

// Seconds, rounded to the nearest float32.
inline double as_float32(double t) { return static_cast<double>(static_cast<float>(t)); }

}  // namespace elbowroom
