// SPDX-License-Identifier: MIT
// Presets name regions of posture that are where their names say.
#include "core/editing/sampling_presets.h"

#include <gtest/gtest.h>

#include "assets/demo.h"
#include "core/io/gltf_reader.h"

namespace elbowroom {
namespace {

std::vector<LimbModel> mannequin_limbs() {
  std::vector<LimbModel> limbs;
  const auto model = read_gltf(std::filesystem::path(ELBOWROOM_DEMO_DIR) / demo::kMannequinFile);
  if (!model) return limbs;
  const Character& character = (*model)->characters.front();
  const LimbFindings findings = find_limbs(**model, character);
  for (const Limb& limb : findings.limbs) {
    auto fitted = fit_limb_model(**model, character, limb, findings);
    if (fitted) limbs.push_back(std::move(*fitted));
  }
  return limbs;
}

TEST(Presets, LieInsideTheLimitsAndNameOnlyTheLimbsDofs) {
  const auto limbs = mannequin_limbs();
  ASSERT_EQ(limbs.size(), 4u);
  for (const LimbModel& limb : limbs)
    for (const SamplingPreset preset : kSamplingPresets) {
      const auto intervals = preset_intervals(limb, preset);
      EXPECT_EQ(intervals.empty(), preset == SamplingPreset::paper);
      for (const auto& [name, interval] : intervals) {
        bool known = false;
        for (const Dof& dof : limb.space.dofs)
          if (dof.name == name) {
            known = true;
            EXPECT_LE(dof.lower, interval.lower);
            EXPECT_LE(interval.upper, dof.upper);
          }
        EXPECT_TRUE(known) << name;
        EXPECT_LT(interval.lower, interval.upper);
      }
      EXPECT_EQ(preset_of(limb, intervals), preset);
    }
}

// Of all postures that a low arm is drawn from the upper arm is below level, of all of a high arm
// at or above it.
TEST(Presets, LowIsLowAndHighIsHigh) {
  for (const LimbModel& limb : mannequin_limbs()) {
    if (!limb.limb.is_arm()) continue;
    for (const SamplingPreset preset : {SamplingPreset::low, SamplingPreset::high}) {
      const auto intervals = preset_intervals(limb, preset);
      ASSERT_EQ(intervals.size(), 1u);
      const auto& interval = intervals.begin()->second;
      for (int i = 0; i <= 10; ++i) {
        Dofs q;
        q.count = limb.dof_count();
        q[0] = interval.lower + (interval.upper - interval.lower) * i / 10;
        const double raise = elevation(limb, q).raise * 180 / kPi;
        if (preset == SamplingPreset::low)
          EXPECT_LT(raise, 60) << q[0];
        else
          EXPECT_GT(raise, 85) << q[0];
      }
    }
  }
}

TEST(Presets, TheAnimatorsOwnIntervalsAreNoPreset) {
  const auto limbs = mannequin_limbs();
  ASSERT_FALSE(limbs.empty());
  auto sampling = preset_intervals(limbs.front(), SamplingPreset::high);
  sampling.begin()->second.lower += 0.01;
  EXPECT_FALSE(preset_of(limbs.front(), sampling).has_value());
  EXPECT_EQ(preset_of(limbs.front(), {}), SamplingPreset::paper);
}

}  // namespace
}  // namespace elbowroom
