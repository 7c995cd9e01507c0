// SPDX-License-Identifier: MIT
// The mannequin as a body: its surface, proportions and skin.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "assets/demo.h"
#include "assets/generator/demo_files.h"
#include "tests/unit/assets/demo_world.h"

namespace elbowroom::test {
namespace {

using demo::kDemoClip;
using demo::kIdleClip;
using demo::kWalkClip;

double area(const Vec3& a, const Vec3& b, const Vec3& c) {
  return 0.5 * glm::length(glm::cross(b - a, c - a));
}

// Closed, 2-manifold, one winding: every directed edge once, and its reverse once.
void expect_closed(const Body& body, double least_area) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const glm::uvec3& t : body.triangles) {
    ASSERT_TRUE(t.x != t.y && t.y != t.z && t.z != t.x);
    EXPECT_GT(area(body.positions[t.x], body.positions[t.y], body.positions[t.z]), least_area);
    for (int k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  }
  for (const auto& [edge, count] : edges) {
    ASSERT_EQ(count, 1) << edge.first << " " << edge.second;
    ASSERT_TRUE(edges.count({edge.second, edge.first})) << edge.first << " " << edge.second;
  }
}

double volume(const Body& body) {
  double sum = 0;
  for (const glm::uvec3& t : body.triangles)
    sum +=
        glm::dot(body.positions[t.x], glm::cross(body.positions[t.y], body.positions[t.z])) / 6.0;
  return sum;
}

TEST(Mannequin, IsOneCharacterOfEightToTwentyThousandTriangles) {
  const Model& model = mannequin();
  EXPECT_TRUE(model.warnings.empty());
  ASSERT_EQ(model.characters.size(), 1u);
  EXPECT_TRUE(model.objects.empty());
  EXPECT_EQ(model.characters[0].name, "Mannequin");
  EXPECT_GE(model.characters[0].triangles, 8000);
  EXPECT_LE(model.characters[0].triangles, 20000);
  EXPECT_NEAR(model.characters[0].height, 1.75, 0.01);
}

TEST(Mannequin, IsOneClosedSurfaceWithoutHandles) {
  const Body body = welded(mannequin());
  expect_closed(body, 1e-7);
  // Sphere topology: V - E + F = 2 with E = 3F/2; and in one piece, as every vertex is reached.
  const auto v = static_cast<long>(body.positions.size());
  const auto f = static_cast<long>(body.triangles.size());
  EXPECT_EQ(2 * v - f, 4);
  std::vector<std::uint32_t> root(body.positions.size());
  for (std::uint32_t i = 0; i < root.size(); ++i) root[i] = i;
  const auto find = [&](std::uint32_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  for (const glm::uvec3& t : body.triangles) {
    root[find(t.x)] = find(t.y);
    root[find(t.y)] = find(t.z);
  }
  std::set<std::uint32_t> pieces;
  for (std::uint32_t i = 0; i < root.size(); ++i) pieces.insert(find(i));
  EXPECT_EQ(pieces.size(), 1u);
  // Outward winding; a man of 1.75 m has some 0.07 m³.
  EXPECT_GT(volume(body), 0.045);
  EXPECT_LT(volume(body), 0.085);
}

TEST(Mannequin, HasSmoothOutwardNormals) {
  for (const Mesh& mesh : mannequin().meshes) {
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    for (const glm::uvec3& t : mesh.triangles) {
      const glm::vec3 n = glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                                     mesh.positions[t.z] - mesh.positions[t.x]);
      for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(glm::length(mesh.normals[t[k]]), 1.0f, 1e-5f);
        EXPECT_GT(glm::dot(mesh.normals[t[k]], glm::normalize(n)), 0.1f);
      }
    }
  }
}

TEST(Mannequin, HasTheProportionsOfDrillisAndContini) {
  const Model& model = mannequin();
  const auto g = globals_at(model, "", 0);
  const auto at = [&](const std::string& name) { return joint_position(model, g, name); };
  const double h = 1.75;
  for (const std::string side : {"Left", "Right"}) {
    EXPECT_NEAR(glm::distance(at(side + "UpperArm"), at(side + "LowerArm")), 0.186 * h, 0.005);
    EXPECT_NEAR(glm::distance(at(side + "LowerArm"), at(side + "Hand")), 0.146 * h, 0.005);
    EXPECT_NEAR(glm::distance(at(side + "UpperLeg"), at(side + "LowerLeg")), 0.245 * h, 0.010);
    EXPECT_NEAR(glm::distance(at(side + "LowerLeg"), at(side + "Foot")), 0.246 * h, 0.010);
    EXPECT_NEAR(at(side + "UpperArm").y, 0.818 * h, 0.02);
    EXPECT_NEAR(at(side + "UpperLeg").y, 0.530 * h, 0.01);
    EXPECT_NEAR(at(side + "Foot").y, 0.039 * h, 0.005);
  }
  const Body body = welded(model);
  double top = -1e9, bottom = 1e9, hand = 0, heel = 1e9, toe = -1e9;
  const Vec3 wrist = at("LeftHand");
  for (const Vec3& p : body.positions) {
    top = std::max(top, p.y);
    bottom = std::min(bottom, p.y);
    if (p.x > wrist.x) hand = std::max(hand, glm::distance(p, wrist));
    if (p.y < 0.06) heel = std::min(heel, p.z), toe = std::max(toe, p.z);
  }
  EXPECT_NEAR(top, h, 0.01);
  EXPECT_NEAR(bottom, 0.0, 0.002);
  EXPECT_NEAR(hand, 0.108 * h, 0.012);
  EXPECT_NEAR(toe - heel, 0.152 * h, 0.020);
}

TEST(Mannequin, HasFiveFingersAHandOfThreeJointsEach) {
  const Model& model = mannequin();
  for (const std::string side : {"Left", "Right"})
    for (const std::string finger : {"Thumb", "Index", "Middle", "Ring", "Little"})
      for (int i = 1; i <= 3; ++i) {
        const int joint = model.skeleton.find(side + finger + std::to_string(i));
        ASSERT_GE(joint, 0);
        const std::string parent = i == 1 ? side + "Hand" : side + finger + std::to_string(i - 1);
        EXPECT_EQ(model.skeleton.joints[static_cast<std::size_t>(joint)].parent,
                  model.skeleton.find(parent));
      }
}

TEST(Mannequin, WeightsSumToOneAndStayInTheirPart) {
  const Model& model = mannequin();
  const Body body = welded(model);
  const auto name = [&](const Influence& f) {
    return model.skeleton.joints[static_cast<std::size_t>(f.joint)].name;
  };
  const auto has = [](const std::string& s, const std::string& part) {
    return s.find(part) != std::string::npos;
  };
  const std::vector<std::string> fingers{"Thumb", "Index", "Middle", "Ring", "Little"};
  for (std::size_t i = 0; i < body.positions.size(); ++i) {
    const auto& influences = body.influences[i];
    ASSERT_GE(influences.size(), 1u);
    ASSERT_LE(influences.size(), 4u);
    double sum = 0;
    double left = 0, right = 0, trunk_and_legs = 0, arm = 0;
    for (const Influence& f : influences) {
      EXPECT_GT(f.weight, 0.0f);
      sum += static_cast<double>(f.weight);
      const std::string n = name(f);
      const auto w = static_cast<double>(f.weight);
      // Only the middle of the trunk and the fork may feel both sides.
      if (has(n, "Left")) left += w;
      if (has(n, "Right")) right += w;
      if (has(n, "Leg") || has(n, "Foot") || has(n, "Toes") || n == "Hips" || n == "Spine" ||
          n == "Chest")
        trunk_and_legs += w;
      if (has(n, "LowerArm") || has(n, "Hand")) arm += w;
      for (const std::string& finger : fingers) arm += has(n, finger) ? w : 0.0;
    }
    EXPECT_NEAR(sum, 1.0, 1e-6);
    if (std::abs(body.positions[i].x) > 0.06) {
      EXPECT_LT(std::min(left, right), 0.20) << i;
    }
    EXPECT_LT(std::min(trunk_and_legs, arm), 0.01) << i;
    // A finger's outer bones move nothing of another finger.
    std::set<std::string> outer;
    for (const Influence& f : influences)
      for (const std::string& finger : fingers)
        if (has(name(f), finger) && (has(name(f), "2") || has(name(f), "3"))) outer.insert(finger);
    EXPECT_LE(outer.size(), 1u) << i;
  }
}

// No spikes, no cracks, no crumpled skin in any frame of any clip.
TEST(Mannequin, SkinStaysWholeInEveryFrame) {
  const Model& model = mannequin();
  const Body body = welded(model);
  double most = 0, least = 1e9, flattest = 1e9;
  for (const Clip& clip : model.clips)
    for (const double t : key_times(model, clip.name)) {
      const std::vector<Vec3> p = deformed(model, body, globals_at(model, clip.name, t));
      for (const glm::uvec3& tri : body.triangles) {
        for (int k = 0; k < 3; ++k) {
          const std::uint32_t a = tri[k], b = tri[(k + 1) % 3];
          const double ratio =
              glm::distance(p[a], p[b]) / glm::distance(body.positions[a], body.positions[b]);
          most = std::max(most, ratio);
          least = std::min(least, ratio);
        }
        flattest = std::min(flattest, area(p[tri.x], p[tri.y], p[tri.z]) /
                                          area(body.positions[tri.x], body.positions[tri.y],
                                               body.positions[tri.z]));
      }
    }
  RecordProperty("most_stretch", std::to_string(most));
  RecordProperty("least_stretch", std::to_string(least));
  RecordProperty("least_area", std::to_string(flattest));
  EXPECT_LT(most, 3.0);
  EXPECT_GT(least, 0.05);
  EXPECT_GT(flattest, 0.02);
}

TEST(Mannequin, ComesOutTheSameTwice) {
  // Once when it was built, by another process; once now.
  std::ifstream in(std::filesystem::path(ELBOWROOM_DEMO_DIR) / demo::kMannequinFile,
                   std::ios::binary);
  const std::string built{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  EXPECT_GT(built.size(), 100000u);
  EXPECT_TRUE(built == demo::to_glb(demo::make_mannequin()));
}

TEST(Props, AreClosedSurfaces) {
  // The umbrella is put together of closed shells that reach into each other; each welds into a
  // closed surface of its own.
  expect_closed(welded(umbrella()), 1e-9);
  expect_closed(welded(posts()), 1e-9);
  EXPECT_GT(volume(welded(umbrella())), 0);
  EXPECT_GT(volume(welded(posts())), 0);
  EXPECT_EQ(umbrella().objects.size(), 1u);
  EXPECT_EQ(posts().objects.size(), 2u);
}

}  // namespace
}  // namespace elbowroom::test
