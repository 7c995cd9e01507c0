// SPDX-License-Identifier: MIT
// Makes problems: a post where a clip's own arm or leg passes, so that the clip collides in one
// stretch with free time before and after it, and nothing but that limb does.
//
// Found by looking at the skin's vertices, with the core's own reading and skinning; whether a
// motion is free of the post is never judged by this.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/anatomy/limb.h"
#include "core/scene/model.h"

namespace elbowroom::test {

struct PostProblem {
  int clip = 0;
  double x = 0, z = 0, radius = 0, y_low = 0, y_high = 0;
  double hit_begin = 0, hit_end = 0;  // seconds, by vertices at 60 Hz
  double depth = 0;                   // how far vertices are inside at most, scene units
};

// `clip` < 0: the first clip that allows one. `variant` picks among the possible ones. None if
// there is no place for such a post.
std::optional<PostProblem> post_in_the_way(const Model& model, const Character& character,
                                           const Limb& limb, int clip, unsigned variant = 0);

// Writes the post as a GLB.
bool write_post(const PostProblem& problem, const std::filesystem::path& file);

}  // namespace elbowroom::test
