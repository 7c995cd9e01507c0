// SPDX-License-Identifier: MIT
// Skeletons that nobody would make: finding limbs in them ends soon and with reasons.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <limits>

#include "core/anatomy/limb_model.h"

namespace elbowroom {
namespace {

struct Shape {
  const char* name;
  int (*parent)(int);
  bool finite;
};

TEST(HostileTrees, AreLookedThroughSoonAndWithReasons) {
  const Shape shapes[] = {
      {"one chain", [](int i) { return i - 1; }, true},
      {"one fan", [](int i) { return i == 0 ? -1 : 0; }, true},
      {"halved", [](int i) { return i == 0 ? -1 : (i - 1) / 2; }, true},
      {"a fan of chains", [](int i) { return i == 0    ? -1
                                             : i <= 60 ? 0
                                                       : i - 60; }, true},
      {"a chain of fans", [](int i) { return i < 70 ? i - 1 : i % 70; }, true},
      {"no tree", [](int) { return -1; }, true},
      {"no places", [](int i) { return i - 1; }, false}};
  for (const Shape& shape : shapes) {
    SCOPED_TRACE(shape.name);
    constexpr int kJoints = 4800;
    Model model;
    model.path = "hostile.glb";
    model.skeleton.joints.resize(kJoints);
    for (int i = 0; i < kJoints; ++i) {
      Joint& joint = model.skeleton.joints[static_cast<std::size_t>(i)];
      joint.parent = shape.parent(i);
      joint.rest.translation = Vec3(0.3 * (i % 3 - 1), 0.1 * (i % 5), 0.05 * (i % 7));
      if (!shape.finite) joint.rest.translation.x = std::numeric_limits<double>::quiet_NaN();
    }
    ASSERT_TRUE(link_skeleton(model.skeleton));
    std::vector<Mat4> globals;
    compute_globals(model.skeleton, rest_pose(model.skeleton), Mat4(1.0), globals);
    Skin skin;
    Character character;
    character.name = "hostile";
    character.height = 1;
    for (int i = 0; i < kJoints; ++i) {
      skin.joints.push_back(i);
      skin.inverse_bind.push_back(glm::inverse(globals[static_cast<std::size_t>(i)]));
      character.joints.push_back(i);
    }
    character.skins = {0};
    model.skins.push_back(skin);
    model.characters.push_back(character);
    const auto start = std::chrono::steady_clock::now();
    const LimbFindings findings = find_limbs(model, model.characters[0]);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    EXPECT_LT(seconds.count(), 5) << "on a busy machine; some tens of milliseconds on a free one";
    const auto not_found = std::count_if(
        findings.warnings.begin(), findings.warnings.end(),
        [](const auto& warning) { return warning.find(" not found: ") != std::string::npos; });
    EXPECT_EQ(findings.limbs.size() + static_cast<std::size_t>(not_found), 4u);
    for (const Limb& limb : findings.limbs) {
      const auto fitted = fit_limb_model(model, model.characters[0], limb, findings);
      EXPECT_TRUE(fitted.ok() || !fitted.error().what.empty());
    }
    std::printf("  %-16s %zu limbs, %.0f ms\n", shape.name, findings.limbs.size(),
                1e3 * seconds.count());
  }
}

}  // namespace
}  // namespace elbowroom
