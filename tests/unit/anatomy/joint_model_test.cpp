// SPDX-License-Identifier: MIT
// The joint models' formulas: exact inverses, what each residual may hold, signs, mirrored poses.
#include "core/anatomy/joint_model.h"

#include <gtest/gtest.h>

#include <array>

#include "core/base/random.h"

namespace elbowroom {
namespace {

constexpr int kRotations = 100000;
constexpr std::array kKinds = {JointModelKind::ball, JointModelKind::hinge, JointModelKind::swing,
                               JointModelKind::fixed};

// Uniform on the rotations (Shoemake 1992).
Quat random_rotation(Random& random) {
  const double u = random.uniform(), a = random.uniform(0, 2 * kPi), b = random.uniform(0, 2 * kPi);
  const double r = std::sqrt(1 - u), s = std::sqrt(u);
  return Quat(s * std::cos(b), r * std::sin(a), r * std::cos(a), s * std::sin(b));
}

JointModel random_model(JointModelKind kind, Random& random) {
  JointModel model;
  model.kind = kind;
  model.parent_from_zero = random_rotation(random);
  model.joint_from_anatomy = random_rotation(random);
  model.side = random.below(2) == 0 ? 1 : -1;
  return model;
}

bool is_finite(const Quat& q) { return std::isfinite(q.w + q.x + q.y + q.z); }

TEST(JointModel, ComposingWhatWasDecomposedGivesTheRotationBack) {
  Random random(1);
  double worst = 0;
  for (int i = 0; i < kRotations; ++i) {
    for (const JointModelKind kind : kKinds) {
      const JointModel model = random_model(kind, random);
      const Quat rotation = random_rotation(random);
      double q[3];
      Quat residual;
      decompose(model, rotation, q, residual);
      worst = std::max(worst, angle_between(rotation, local_rotation(model, q, residual)));
    }
  }
  EXPECT_LT(worst, 1e-12);
}

TEST(JointModel, DecomposingWhatWasComposedGivesTheNumbersBack) {
  Random random(2);
  double worst = 0;
  for (int i = 0; i < kRotations; ++i) {
    for (const JointModelKind kind : kKinds) {
      const JointModel model = random_model(kind, random);
      // Inside the ranges of each number, clear of the singular rims.
      std::array<double, 3> q{};
      if (kind == JointModelKind::hinge) {
        q = {random.uniform(-3.1, 3.1), random.uniform(-3.1, 3.1), 0};
      } else if (kind != JointModelKind::fixed) {
        const double size = random.uniform(0, 3.1), at = random.uniform(0, 2 * kPi);
        q = {size * std::cos(at), size * std::sin(at),
             kind == JointModelKind::ball ? random.uniform(-3.1, 3.1) : 0.0};
      }
      double found[3] = {0, 0, 0};
      Quat residual;
      decompose(model, local_rotation(model, q.data(), Quat(1, 0, 0, 0)), found, residual);
      for (int k = 0; k < model.dof_count(); ++k) {
        worst = std::max(worst, std::abs(found[k] - q[static_cast<std::size_t>(k)]));
      }
      worst = std::max(worst, glm::length(rotation_vector_from_quat(residual)));
    }
  }
  // Near the singular rim (3.1 rad) numbers lose a few digits.
  EXPECT_LT(worst, 1e-10);
}

TEST(JointModel, ResidualHoldsOnlyWhatTheModelCannotExpress) {
  Random random(3);
  for (int i = 0; i < kRotations; ++i) {
    const Quat rotation = random_rotation(random);
    double q[3];
    Quat residual;

    decompose(random_model(JointModelKind::ball, random), rotation, q, residual);
    EXPECT_LT(glm::length(rotation_vector_from_quat(residual)), 1e-12);
    EXPECT_LE(std::hypot(q[0], q[1]), kPi + 1e-12);
    EXPECT_LE(std::abs(q[2]), kPi + 1e-12);

    decompose(random_model(JointModelKind::swing, random), rotation, q, residual);
    EXPECT_LT(std::hypot(residual.y, residual.z), 1e-12) << "pure twist";

    const JointModel hinge = random_model(JointModelKind::hinge, random);
    decompose(hinge, rotation, q, residual);
    EXPECT_LT(std::abs(residual.x), 1e-12) << "no twist";
    // The tilt of the bone out of the plane of flexion, and no more.
    const Vec3 bone = glm::conjugate(hinge.parent_from_zero) *
                      (rotation * (hinge.joint_from_anatomy * Vec3(1, 0, 0)));
    EXPECT_NEAR(glm::length(rotation_vector_from_quat(residual)), std::asin(std::abs(bone.z)),
                1e-7);
  }
}

TEST(JointModel, NoOtherNumbersOfAHingeLeaveASmallerResidual) {
  Random random(4);
  for (int i = 0; i < 2000; ++i) {
    const JointModel model = random_model(JointModelKind::hinge, random);
    const Quat rotation = random_rotation(random);
    double q[3];
    Quat residual;
    decompose(model, rotation, q, residual);
    const double least = glm::length(rotation_vector_from_quat(residual));
    const Quat anatomical =
        glm::conjugate(model.parent_from_zero) * rotation * model.joint_from_anatomy;
    for (int k = 0; k < 20; ++k) {
      const double other[2] = {q[0] + random.uniform(-0.3, 0.3), q[1] + random.uniform(-0.3, 0.3)};
      const Quat rest = glm::normalize(glm::conjugate(joint_rotation(model, other)) * anatomical);
      EXPECT_GE(glm::length(rotation_vector_from_quat(rest)), least - 1e-9);
    }
  }
}

TEST(JointModel, MirroredRotationsHaveEqualNumbers) {
  // A mirror in the plane x = 0 takes a rotation's quaternion (w, x, y, z) to (w, x, -y, -z), and
  // the polar axes x and y of a frame to their images, its z to minus its image.
  const auto mirrored = [](const Quat& q) { return Quat(q.w, q.x, -q.y, -q.z); };
  const auto mirrored_frame = [](const Quat& frame) {
    const auto image = [](const Vec3& v) { return Vec3(-v.x, v.y, v.z); };
    const Vec3 x = image(frame * Vec3(1, 0, 0)), y = image(frame * Vec3(0, 1, 0));
    return glm::normalize(glm::quat_cast(Mat3(x, y, glm::cross(x, y))));
  };
  Random random(5);
  for (int i = 0; i < kRotations; ++i) {
    for (const JointModelKind kind : kKinds) {
      JointModel left = random_model(kind, random);
      left.side = 1;
      JointModel right = left;
      right.side = -1;
      right.parent_from_zero = mirrored_frame(left.parent_from_zero);
      right.joint_from_anatomy = mirrored_frame(left.joint_from_anatomy);
      const Quat rotation = random_rotation(random);
      double q_left[3] = {0, 0, 0}, q_right[3] = {0, 0, 0};
      Quat e_left, e_right;
      decompose(left, rotation, q_left, e_left);
      decompose(right, mirrored(rotation), q_right, e_right);
      // At a swing near pi, or a bone near a hinge's axis, rounding decides.
      if (kind != JointModelKind::hinge && std::hypot(q_left[0], q_left[1]) > 3.13) continue;
      if (glm::length(rotation_vector_from_quat(e_left)) > 1.56) continue;
      for (int k = 0; k < left.dof_count(); ++k) {
        EXPECT_NEAR(std::remainder(q_left[k] - q_right[k], 2 * kPi), 0, 1e-9);
      }
      EXPECT_NEAR(glm::length(rotation_vector_from_quat(e_left)),
                  glm::length(rotation_vector_from_quat(e_right)), 1e-9);
    }
  }
}

TEST(JointModel, SingularPosesAreFiniteAndExact) {
  for (const JointModelKind kind : kKinds) {
    JointModel model;
    model.kind = kind;
    // Half turns about every axis across the bone and along it, and bones along a hinge's axis.
    for (const Vec3& axis :
         {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(0, 0.6, 0.8), Vec3(0, -0.8, 0.6)}) {
      for (const double angle : {kPi, -kPi, kPi - 1e-9, kPi + 1e-9, kPi / 2, -kPi / 2, 0.0}) {
        const Quat rotation = glm::angleAxis(angle, axis);
        double q[3] = {0, 0, 0};
        Quat residual;
        decompose(model, rotation, q, residual);
        ASSERT_TRUE(std::isfinite(q[0] + q[1] + q[2]));
        ASSERT_TRUE(is_finite(residual));
        EXPECT_LT(angle_between(rotation, local_rotation(model, q, residual)), 1e-12);
      }
    }
    double q[3];
    Quat residual;
    decompose(model, Quat(0, 0, 1, 0), q, residual);
    EXPECT_TRUE(is_finite(residual));
  }
}

TEST(JointModel, SignsAreTheHeaders) {
  JointModel model;
  model.kind = JointModelKind::hinge;
  const double flexed[2] = {0.5, 0};
  // Flexion moves the bone's end towards +y, on both sides.
  for (const double side : {1.0, -1.0}) {
    model.side = side;
    EXPECT_NEAR((joint_rotation(model, flexed) * Vec3(1, 0, 0)).y, std::sin(0.5), 1e-15);
  }
  // Twist is about the bone, opposite on the right.
  const double twisted[2] = {0, 0.5};
  model.side = 1;
  EXPECT_NEAR((joint_rotation(model, twisted) * Vec3(0, 1, 0)).z, std::sin(0.5), 1e-15);
  model.side = -1;
  EXPECT_NEAR((joint_rotation(model, twisted) * Vec3(0, 1, 0)).z, -std::sin(0.5), 1e-15);
  // A swing's first number turns about y, its second about z.
  model.kind = JointModelKind::swing;
  model.side = 1;
  const double swung[2] = {0.5, 0};
  EXPECT_NEAR((joint_rotation(model, swung) * Vec3(1, 0, 0)).z, -std::sin(0.5), 1e-15);
}

}  // namespace
}  // namespace elbowroom
