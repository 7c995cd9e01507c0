// SPDX-License-Identifier: MIT
// Problems without end: things of several kinds put where a clip's own limb passes, jittered by a
// seed, so that the clip itself collides in one stretch with free time before and after it.
//
// Placed by the skin's vertices, with the core's reading and skinning; whether a motion is free is
// never judged by this.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/anatomy/limb.h"
#include "core/scene/model.h"
#include "tests/support/simple_glb.h"

namespace elbowroom::test {

enum class Thing { post, plate, wire, frame, ball };
inline constexpr Thing kThings[] = {Thing::post, Thing::plate, Thing::wire, Thing::frame,
                                    Thing::ball};
const char* name_of(Thing thing);

struct TruthProblem {
  Thing thing = Thing::post;
  SimpleMesh mesh;          // the world, scene units
  glm::vec3 move_to{0.0f};  // where a ball goes over [0, seconds]
  float seconds = 0;
  double hit_begin = 0, hit_end = 0;  // by vertices, seconds
};

// One limb of one clip, its vertices over time at hand.
class TruthStage {
 public:
  // None where the limb hardly moves or the clip is short.
  static std::optional<TruthStage> make(std::shared_ptr<const Model> model,
                                        const Character& character, const Limb& limb, int clip);

  // None where no place is found in a number of tries.
  std::optional<TruthProblem> problem(Thing thing, std::uint64_t seed) const;

  const Limb& limb() const { return limb_; }
  int clip() const { return clip_; }

 private:
  struct Moment {
    double t = 0;
    std::vector<Vec3> limb, rest;
    Vec3 end{0.0}, centre{0.0};
  };
  std::shared_ptr<const Model> model_;
  Limb limb_;
  int clip_ = 0;
  double height_ = 1, floor_ = 0;
  std::vector<Moment> moments_;
};

bool write_thing(const TruthProblem& problem, const std::filesystem::path& file);

}  // namespace elbowroom::test
