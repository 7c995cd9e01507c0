// SPDX-License-Identifier: MIT
// The same character in another guise: what a model fitted to it says must not change.
#pragma once

#include "core/scene/model.h"

namespace elbowroom::test {

// Every joint under a name that means nothing; some have none, some share one.
Model without_names(const Model& model);

// Under one more node, which places the whole file: turns, shifts, scales and mirrors it.
Model placed(const Model& model, const Transform& placement);

// All lengths in the file multiplied: nodes, bind matrices, vertices and clips.
Model scaled(const Model& model, double factor);

}  // namespace elbowroom::test
