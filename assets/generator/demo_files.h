// SPDX-License-Identifier: MIT
// The demo's files as bytes.
#pragma once

#include <string>

#include "assets/generator/glb.h"

namespace elbowroom::demo {

GlbFile make_mannequin();
GlbFile make_umbrella();
GlbFile make_posts();

}  // namespace elbowroom::demo
