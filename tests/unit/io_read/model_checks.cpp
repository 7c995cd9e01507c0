// SPDX-License-Identifier: MIT
#include "tests/unit/io_read/model_checks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

namespace elbowroom::test {

int triangles_of(const Model& model) {
  int sum = 0;
  for (const Mesh& mesh : model.meshes) sum += static_cast<int>(mesh.triangles.size());
  return sum;
}

int joints_of(const Model& model) {
  std::set<int> joints;
  for (const Skin& skin : model.skins) joints.insert(skin.joints.begin(), skin.joints.end());
  return static_cast<int>(joints.size());
}

void expect_sound(const Model& model) {
  const int nodes = model.skeleton.size();
  ASSERT_EQ(model.skeleton.order.size(), model.skeleton.joints.size());
  for (const Mesh& mesh : model.meshes) {
    ASSERT_GE(mesh.node, 0);
    ASSERT_LT(mesh.node, nodes);
    for (const glm::uvec3& t : mesh.triangles) {
      ASSERT_LT(std::max({t.x, t.y, t.z}), mesh.positions.size());
    }
    if (mesh.skin < 0) continue;
    ASSERT_EQ(mesh.influence_begin.size(), mesh.positions.size() + 1);
    const Skin& skin = model.skins[static_cast<std::size_t>(mesh.skin)];
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      double sum = 0;
      for (std::uint32_t i = mesh.influence_begin[v]; i < mesh.influence_begin[v + 1]; ++i) {
        const Influence& influence = mesh.influences[i];
        ASSERT_EQ(skin.joints[static_cast<std::size_t>(influence.slot)], influence.joint);
        ASSERT_GE(influence.weight, 0);
        sum += influence.weight;
      }
      ASSERT_NEAR(sum, 1.0, 1e-5);
    }
  }
  for (const Clip& clip : model.clips) {
    for (const Channel& channel : clip.channels) {
      ASSERT_GE(channel.joint, 0);
      ASSERT_LT(channel.joint, nodes);
      ASSERT_FALSE(channel.times.empty());
      ASSERT_TRUE(std::is_sorted(channel.times.begin(), channel.times.end(), std::less_equal<>()));
      const std::size_t per_key = channel.interpolation == Interpolation::cubic_spline ? 3 : 1;
      ASSERT_EQ(channel.values.size(),
                per_key * channel.times.size() * static_cast<std::size_t>(channel.components));
    }
  }
  int triangles = 0;
  for (const Character& character : model.characters) {
    EXPECT_TRUE(std::isfinite(character.height) && character.height > 0) << character.name;
    EXPECT_FALSE(character.name.empty());
    EXPECT_TRUE(std::is_sorted(character.joints.begin(), character.joints.end()));
    triangles += character.triangles;
  }
  for (const Object& object : model.objects) triangles += object.triangles;
  EXPECT_EQ(triangles, triangles_of(model)) << "each mesh belongs to one character or object";
}

}  // namespace elbowroom::test
