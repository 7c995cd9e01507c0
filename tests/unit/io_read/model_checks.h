// SPDX-License-Identifier: MIT
// What every Model the reader returns promises, whatever the file was.
#pragma once

#include "core/scene/model.h"

namespace elbowroom::test {

void expect_sound(const Model& model);
int triangles_of(const Model& model);
int joints_of(const Model& model);

}  // namespace elbowroom::test
