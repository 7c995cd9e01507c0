// SPDX-License-Identifier: MIT
// in_contact() against exact arithmetic on random placements: generated shapes, and sample props
// and body parts where there are any. Placements are driven to just touching, and jittered about
// that: random ones alone would hardly ever be close.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "core/base/random.h"
#include "core/collision/mesh_pair.h"
#include "core/io/gltf_reader.h"
#include "tests/oracle/mesh_pair/judge.h"
#include "tests/support/samples.h"
#include "tests/support/shapes.h"

namespace elbowroom::test {
namespace {

constexpr int kPlacements = ELBOWROOM_PLACEMENTS;
constexpr double kNear = 0.005;  // of a figure 1.75 m tall; meshes are scaled to limb size

struct Subject {
  JudgedMesh judged;
  CollisionMesh ours;
};

void add(std::vector<Subject>& subjects, const std::string& name, const Shape& shape) {
  JudgedMesh judged(name, shape);
  if (judged.shape.triangles.empty()) return;
  auto ours = CollisionMesh::build(judged.shape.positions, judged.shape.triangles);
  ASSERT_TRUE(ours.ok()) << ours.error().message();
  subjects.push_back({std::move(judged), std::move(ours).value()});
}

// Scaled so that half its diagonal is `radius` metres, in float, as a file would have it.
Shape scaled(Shape shape, double radius) {
  glm::dvec3 low(1e30), high(-1e30);
  for (const auto& p : shape.positions) {
    low = glm::min(low, glm::dvec3(p));
    high = glm::max(high, glm::dvec3(p));
  }
  const double half = 0.5 * glm::length(high - low);
  if (!(half > 0)) return shape;
  for (auto& p : shape.positions) p = glm::vec3(glm::dvec3(p) * (radius / half));
  return shape;
}

void add_generated(std::vector<Subject>& subjects) {
  Random random(11);
  add(subjects, "limb 5k", limb_shape(0.05f, 0.3f, 80, 32, random));
  add(subjects, "limb 1k", limb_shape(0.06f, 0.25f, 28, 18, random));
  add(subjects, "torso 3k", limb_shape(0.18f, 0.3f, 40, 40, random));
  add(subjects, "ball", sphere_shape(0.1f, 19, 28));
  add(subjects, "box", box_shape({0.2f, 0.15f, 0.3f}));
  add(subjects, "open tube", tube_shape(0.1f, 0.25f, 12, 24, false));
  add(subjects, "sheet", sheet_shape(0.3f, 12));
}

void add_samples(std::vector<Subject>& subjects) {
  const auto samples = samples_dir();
  if (samples.empty()) return;
  ReadOptions options;
  options.images = false;
  for (const char* file : {"props/umbrella/umbrella.glb", "props/khronos/Duck.glb",
                           "props/quaternius/Chair_1.glb", "props/quaternius/WaterBottle_1.glb",
                           "props/quaternius/Light_Desk.glb", "props/quaternius/Helmet1.glb"}) {
    auto model = read_gltf(samples / file, options);
    if (!model.ok()) continue;
    Shape all;
    for (const Mesh& mesh : (*model)->meshes) {
      append(all, {mesh.positions, mesh.triangles});
    }
    add(subjects, file, scaled(all, 0.3));
  }
  for (const char* file : {"humanoids/kaykit/Knight.glb", "humanoids/khronos/CesiumMan.glb"}) {
    auto model = read_gltf(samples / file, options);
    if (!model.ok()) continue;
    // Body parts: the triangles whose first vertex follows one joint most, in the bind pose.
    std::map<int, Shape> parts;
    for (const Mesh& mesh : (*model)->meshes) {
      if (mesh.skin < 0) continue;
      const auto joint = [&](std::uint32_t v) {
        int best = -1;
        float weight = -1;
        for (auto i = mesh.influence_begin[v]; i < mesh.influence_begin[v + 1]; ++i) {
          if (mesh.influences[i].weight > weight) {
            weight = mesh.influences[i].weight;
            best = mesh.influences[i].joint;
          }
        }
        return best;
      };
      for (const auto& t : mesh.triangles) {
        Shape& part = parts[joint(t.x)];
        const auto n = static_cast<std::uint32_t>(part.positions.size());
        for (int k = 0; k < 3; ++k) part.positions.push_back(mesh.positions[t[k]]);
        part.triangles.push_back({n, n + 1, n + 2});
      }
    }
    int taken = 0;
    for (const auto& [joint, part] : parts) {
      if (part.triangles.size() < 150 || ++taken > 4) continue;
      add(subjects, std::string(file) + " joint " + std::to_string(joint), scaled(part, 0.25));
    }
  }
}

Mat3 random_rotation(Random& random) {
  return glm::mat3_cast(quat_from_rotation_vector(
      {random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)}));
}

Vec3 random_direction(Random& random) {
  for (;;) {
    const Vec3 v(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    const double length = glm::length(v);
    if (length > 0.1 && length < 1) return v / length;
  }
}

struct Tally {
  int placements = 0, near = 0, contact = 0, contained = 0;
  int wrong = 0, asymmetric = 0, fcl_differs = 0;
  void print(const char* name) const {
    std::printf(
        "%-10s %7d placements, %5.1f %% near, %5.1f %% in contact, %d contained; wrong %d, "
        "changed by swapping %d; FCL differs from exact on surfaces %d\n",
        name, placements, 100.0 * near / placements, 100.0 * contact / placements, contained, wrong,
        asymmetric, fcl_differs);
  }
};

void judge(const Subject& a, const Subject& b, const RigidTransform& t, bool near, Tally& tally) {
  const bool ours = in_contact(a.ours, b.ours, t, 0);
  const bool fcl = fcl_collides(a.judged, b.judged, t);
  const bool meet = exact_surfaces_meet(a.judged, b.judged, t);
  const bool contained = !meet && exact_contained(a.judged, b.judged, t);
  ++tally.placements;
  tally.near += near;
  tally.contact += ours;
  tally.contained += contained;
  tally.fcl_differs += fcl != meet;
  if (ours != (meet || contained)) {
    ++tally.wrong;
    ADD_FAILURE() << a.judged.name << " and " << b.judged.name << ": in_contact says " << ours
                  << ", surfaces meet " << meet << ", contained " << contained << ", FCL " << fcl;
  }
  // The other way round the doubles differ in their last bits: a hair of distance is allowed for.
  const bool swapped_changes =
      ours ? !in_contact(b.ours, a.ours, inverse(t), 1e-12)
           : in_contact(b.ours, a.ours, inverse(t), 0) && !in_contact(a.ours, b.ours, t, 1e-12);
  tally.asymmetric += swapped_changes;
}

// Where b, moved along `direction`, stops touching a: FCL's word, to about 1e-13 m.
double just_touching(const Subject& a, const Subject& b, const Mat3& rotation, const Vec3& base,
                     const Vec3& direction) {
  double in = 0, out = 1.05 * (a.judged.radius + b.judged.radius);
  for (int i = 0; i < 44; ++i) {
    const double middle = 0.5 * (in + out);
    (fcl_collides(a.judged, b.judged, {rotation, base + middle * direction}) ? in : out) = middle;
  }
  return in;
}

void run(const std::vector<Subject>& subjects, int count, std::uint64_t seed, Tally& tally) {
  Random random(seed);
  while (tally.placements < count && tally.wrong < 10) {
    const Subject& a = subjects[random.below(subjects.size())];
    const Subject& b = subjects[random.below(subjects.size())];
    const Mat3 rotation = random_rotation(random);
    const Vec3 direction = random_direction(random);
    const Vec3 base = a.judged.middle - rotation * b.judged.middle +
                      0.3 * a.judged.radius * random_direction(random);
    const double touching = just_touching(a, b, rotation, base, direction);
    for (int i = 0; i < 10; ++i) {
      // Six at distances from a hair to 5 mm to either side of touching, four anywhere.
      const bool near = i < 6;
      const double side = random.uniform() < 0.5 ? -1 : 1;
      const double along =
          near ? touching + side * kNear * std::pow(10.0, random.uniform(-11.0, 0.0))
               : random.uniform(0, 1.05 * (a.judged.radius + b.judged.radius));
      judge(a, b, {rotation, base + along * direction}, near, tally);
    }
  }
}

TEST(Placements, AgreeWithExactArithmetic) {
  std::vector<Subject> subjects;
  add_generated(subjects);
  const auto generated = subjects.size();
  add_samples(subjects);
  std::printf("%zu meshes, %zu of them generated\n", subjects.size(), generated);
  Tally tally;
  run(subjects, kPlacements * 7 / 10, 1, tally);
  tally.print("general");
  EXPECT_GE(tally.near, 0.3 * tally.placements);
  EXPECT_GE(tally.contact, 0.2 * tally.placements);
  EXPECT_LE(tally.contact, 0.8 * tally.placements);
  EXPECT_EQ(tally.asymmetric, 0);
}

TEST(Placements, NeedlesAgreeWithExactArithmetic) {
  std::vector<Subject> subjects;
  Random random(12);
  add(subjects, "needle", needle_shape(1e-4f, 0.2f, 3));
  add(subjects, "hair", needle_shape(1e-6f, 0.2f, 3));
  add(subjects, "limb", limb_shape(0.05f, 0.2f, 20, 14, random));
  add(subjects, "sheet", sheet_shape(0.2f, 10));
  Shape slivers;  // a fan of skinny triangles
  for (int i = 0; i < 200; ++i) {
    const auto n = static_cast<std::uint32_t>(slivers.positions.size());
    const double u = i * 1e-3, v = u + 1e-6;
    slivers.positions.push_back({0.0f, 0.0f, 0.1f});
    slivers.positions.push_back(glm::vec3(glm::dvec3(0.2 * std::cos(u), 0.2 * std::sin(u), 0)));
    slivers.positions.push_back(glm::vec3(glm::dvec3(0.2 * std::cos(v), 0.2 * std::sin(v), 0)));
    slivers.triangles.push_back({n, n + 1, n + 2});
  }
  add(subjects, "slivers", slivers);
  Tally tally;
  run(subjects, kPlacements / 10, 2, tally);
  tally.print("needles");
}

// Placements on a grid of which the meshes' vertices are part: faces coincide, edges lie in faces,
// vertices on vertices.
TEST(Placements, CoplanarOnesAgreeWithExactArithmetic) {
  std::vector<Subject> subjects;
  add(subjects, "cube", box_shape({0.25f, 0.25f, 0.25f}));
  add(subjects, "slab", box_shape({0.5f, 0.25f, 0.125f}));
  add(subjects, "sheet", sheet_shape(0.5f, 8));
  Shape steps = box_shape({0.25f, 0.25f, 0.25f});
  append(steps, box_shape({0.25f, 0.125f, 0.25f}), {0.5f, 0.0f, 0.0f});
  add(subjects, "steps", steps);
  Random random(13);
  Tally tally;
  const int turns[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  while (tally.placements < kPlacements / 10 && tally.wrong < 10) {
    const Subject& a = subjects[random.below(subjects.size())];
    const Subject& b = subjects[random.below(subjects.size())];
    const auto* turn = turns[random.below(4)];
    Mat3 rotation(0.0);
    const auto axis = static_cast<int>(random.below(3));
    rotation[axis][axis] = 1;
    rotation[(axis + 1) % 3][(axis + 1) % 3] = turn[0];
    rotation[(axis + 1) % 3][(axis + 2) % 3] = turn[1];
    rotation[(axis + 2) % 3][(axis + 1) % 3] = -turn[1];
    rotation[(axis + 2) % 3][(axis + 2) % 3] = turn[0];
    Vec3 at;
    for (int k = 0; k < 3; ++k) at[k] = 0.125 * (static_cast<double>(random.below(13)) - 6);
    judge(a, b, {rotation, at}, true, tally);
  }
  tally.print("coplanar");
}

TEST(Placements, ContainedOnesAgreeWithExactArithmetic) {
  std::vector<Subject> outer, inner;
  Random random(14);
  add(outer, "torso", limb_shape(0.25f, 0.3f, 30, 40, random));
  add(outer, "ball", sphere_shape(0.3f, 25, 40));
  Shape shell = sphere_shape(0.3f, 19, 32);
  append(shell, sphere_shape(0.1f, 9, 16), {0.35f, 0.1f, 0.05f});
  add(outer, "balls", shell);
  add(outer, "box", box_shape({0.25f, 0.3f, 0.2f}));
  add(inner, "finger", limb_shape(0.01f, 0.04f, 9, 10, random));
  add(inner, "cube", box_shape({0.03f, 0.03f, 0.03f}));
  add(inner, "sheet", sheet_shape(0.03f, 3));
  Tally tally;
  while (tally.placements < kPlacements / 10 && tally.wrong < 10) {
    const Subject& a = outer[random.below(outer.size())];
    const Subject& b = inner[random.below(inner.size())];
    const Mat3 rotation = random_rotation(random);
    const Vec3 at(random.uniform(-0.35, 0.35), random.uniform(-0.35, 0.35),
                  random.uniform(-0.35, 0.35));
    const bool flip = random.uniform() < 0.5;
    const RigidTransform t{rotation, at};
    if (flip) {
      judge(b, a, inverse(t), false, tally);
    } else {
      judge(a, b, t, false, tally);
    }
  }
  tally.print("contained");
  EXPECT_GE(tally.contained, 0.2 * tally.placements);
}

}  // namespace
}  // namespace elbowroom::test
