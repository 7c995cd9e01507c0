// SPDX-License-Identifier: MIT
// A picture of what a driver shows, drawn by Dear ImGui's own OpenGL 3 code, without a display.
#pragma once

#include "core/base/result.h"
#include "render/picture.h"
#include "tests/gui/driver/ui_driver.h"

namespace elbowroom {

// Steps one frame and draws it. Error: no offscreen GL context.
Result<Picture> snapshot(UiDriver& driver);

}  // namespace elbowroom
