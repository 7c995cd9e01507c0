// SPDX-License-Identifier: MIT
// Limbs and joint models over all sample characters, one line a limb; and that neither names nor
// size nor placement change them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "core/anatomy/limb_clip.h"
#include "core/ik/limb_ik.h"
#include "tests/property/rigs/changed_rigs.h"
#include "tests/property/rigs/rig_table.h"
#include "tests/support/samples.h"

namespace elbowroom::test {
namespace {

constexpr double kSame = 1e-4;  // what size and placement may change, radians or relative

class Rigs : public testing::TestWithParam<RigRow> {
 protected:
  void SetUp() override {
    if (samples_dir().empty()) GTEST_SKIP() << samples_missing();
    model_ = read_row(GetParam());
    ASSERT_NE(model_, nullptr);
    findings_ = find_limbs(*model_, character());
  }
  const Character& character() const { return model_->characters.front(); }

  std::shared_ptr<const Model> model_;
  LimbFindings findings_;
};

const Limb* limb_of(const LimbFindings& findings, LimbKind kind) {
  for (const Limb& limb : findings.limbs) {
    if (limb.kind == kind) return &limb;
  }
  return nullptr;
}

const std::string& name_of(const Model& model, int joint) {
  return model.skeleton.joints[static_cast<std::size_t>(joint)].name;
}

TEST_P(Rigs, LimbsAreThoseWrittenByHandAndFitTheirClips) {
  std::printf("%s: %s\n", GetParam().file.c_str(), GetParam().kind.c_str());
  for (std::size_t i = 0; i < 4; ++i) {
    const auto kind = static_cast<LimbKind>(i);
    const LimbNames& expected = GetParam().limbs[i];
    const Limb* limb = limb_of(findings_, kind);
    if (expected.empty()) {
      EXPECT_EQ(limb, nullptr) << limb_id(kind);
      const std::string start = std::string(limb_id(kind)) + " not found: ";
      const auto reason =
          std::find_if(findings_.warnings.begin(), findings_.warnings.end(),
                       [&](const std::string& warning) { return warning.rfind(start, 0) == 0; });
      ASSERT_NE(reason, findings_.warnings.end()) << "absence needs a reason";
      std::printf("  %-9s none, as expected: %s\n", limb_id(kind),
                  reason->substr(start.size()).c_str());
      continue;
    }
    ASSERT_NE(limb, nullptr) << limb_id(kind);
    EXPECT_EQ((LimbNames{name_of(*model_, limb->root), name_of(*model_, limb->middle),
                         name_of(*model_, limb->end)}),
              expected);
    const auto fitted = fit_limb_model(*model_, character(), *limb, findings_);
    ASSERT_TRUE(fitted) << fitted.error().message();
    const LimbFit fit = fit_of(*model_, character(), *fitted);
    std::string route;
    for (const int joint : limb->joints)
      route += (route.empty() ? "" : " > ") + name_of(*model_, joint);
    std::printf("  %-9s %s\n            residual median/p99 °", limb_id(kind), route.c_str());
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_LE(fit.median[j], 5) << name_of(*model_, fitted->joints[j].joint);
      EXPECT_LE(fit.high[j], 15) << name_of(*model_, fitted->joints[j].joint);
      std::printf(" %.1f/%.1f", fit.median[j], fit.high[j]);
    }
    std::printf(", %zu frames; flexion axis (%.2f %.2f %.2f) by %s\n", fit.frames,
                fit.flexion_axis.x, fit.flexion_axis.y, fit.flexion_axis.z,
                fitted->flexion_axis_from.c_str());
    for (const std::string& note : fitted->notes) std::printf("            %s\n", note.c_str());
  }
}

void expect_the_same_model(const LimbModel& a, const LimbModel& b) {
  EXPECT_EQ(a.limb.joints, b.limb.joints);
  EXPECT_EQ(a.limb.beside, b.limb.beside);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(a.joints[k].kind, b.joints[k].kind);
    EXPECT_EQ(a.joints[k].joint, b.joints[k].joint);
    EXPECT_EQ(a.joints[k].parent_from_zero, b.joints[k].parent_from_zero);
    EXPECT_EQ(a.joints[k].joint_from_anatomy, b.joints[k].joint_from_anatomy);
    EXPECT_EQ(a.joints[k].side, b.joints[k].side);
  }
  ASSERT_EQ(a.dof_count(), b.dof_count());
  for (std::size_t d = 0; d < a.space.dofs.size(); ++d) {
    EXPECT_EQ(a.space.dofs[d].name, b.space.dofs[d].name);
    EXPECT_EQ(a.space.dofs[d].lower, b.space.dofs[d].lower);
    EXPECT_EQ(a.space.dofs[d].upper, b.space.dofs[d].upper);
    EXPECT_EQ(a.space.dofs[d].sample_lower, b.space.dofs[d].sample_lower);
    EXPECT_EQ(a.space.dofs[d].sample_upper, b.space.dofs[d].sample_upper);
  }
  ASSERT_EQ(a.grasp.ok(), b.grasp.ok());
  if (a.grasp.ok()) {
    EXPECT_EQ(a.grasp->origin, b.grasp->origin);
    EXPECT_EQ(a.grasp->x, b.grasp->x);
    EXPECT_EQ(a.grasp->y, b.grasp->y);
  }
}

TEST_P(Rigs, NamesDontMatterToWhereShapeTells) {
  if (!GetParam().by_shape) return;
  const Model nameless = without_names(*model_);
  const Character& figure = nameless.characters.front();
  const LimbFindings found = find_limbs(nameless, figure);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto kind = static_cast<LimbKind>(i);
    // Shape tells the body's own sides.
    auto named = kind;
    if (GetParam().sides_swapped) named = static_cast<LimbKind>(i ^ 1);
    SCOPED_TRACE(limb_id(kind));
    const Limb* a = limb_of(findings_, named);
    const Limb* b = limb_of(found, kind);
    ASSERT_EQ(a == nullptr, b == nullptr) << (b != nullptr ? b->why : found.warnings.front());
    if (a == nullptr) continue;
    EXPECT_EQ(name_of(*model_, a->root), name_of(*model_, b->root)) << b->why;
    EXPECT_EQ(name_of(*model_, a->middle), name_of(*model_, b->middle));
    EXPECT_EQ(name_of(*model_, a->end), name_of(*model_, b->end));
    if (GetParam().sides_swapped) continue;
    const auto x = fit_limb_model(*model_, character(), *a, findings_);
    const auto y = fit_limb_model(nameless, figure, *b, found);
    ASSERT_TRUE(x.ok() && y.ok());
    expect_the_same_model(*x, *y);
  }
}

// A posture that IK gives for a target made of the limb's own reach, in the body's axes.
Dofs solved(const Model& model, const LimbModel& limb, double share, bool& ok) {
  const Pose pose = rest_pose(model.skeleton);
  std::vector<Mat4> globals;
  compute_globals(model.skeleton, pose, Mat4(1.0), globals);
  const int parent = model.skeleton.joints[static_cast<std::size_t>(limb.limb.root)].parent;
  const Mat4 world_from_parent = parent < 0 ? Mat4(1.0) : globals[static_cast<std::size_t>(parent)];
  const LimbState state = limb_state(limb, pose);
  const auto ik = LimbIk::build(limb, model.skeleton, pose, world_from_parent, state.residual);
  ok = false;
  if (!ik) return {};
  // A point the same for every guise: where another posture has the end.
  Dofs aim = ik->current();
  for (int i = 0; i < aim.count; ++i) {
    const Dof& dof = limb.space.dofs[static_cast<std::size_t>(i)];
    aim[i] = dof.lower + (0.35 + 0.1 * ((i + 2) % 3)) * share * (dof.upper - dof.lower);
  }
  const auto points = ik->points(aim);
  IkTarget target{points.end, std::nullopt};
  const auto solution = ik->solve_at_swivel(target, ik->swivel_of(aim) + 0.3, ik->current(), 0);
  if (!solution) return {};
  ok = true;
  Dofs all = solution->q;
  return all;
}

TEST_P(Rigs, SizeAndPlacementDontMatter) {
  struct Guise {
    const char* name;
    Model model;
    bool mirrored = false;
  };
  std::vector<Guise> guises;
  guises.push_back({"x0.01", scaled(*model_, 0.01)});
  guises.push_back({"x100", scaled(*model_, 100)});
  Transform placement;
  placement.rotation = glm::angleAxis(0.6, Vec3(0, 1, 0));
  placement.translation = Vec3(3, -2, 5) * character().height;
  guises.push_back({"turned about up, shifted", placed(*model_, placement)});
  placement.rotation = glm::angleAxis(2.2, glm::normalize(Vec3(1, 2, -0.5)));
  guises.push_back({"turned over, shifted", placed(*model_, placement)});
  placement = {};
  placement.scale = Vec3(100);
  guises.push_back({"under a node x100", placed(*model_, placement)});
  placement.scale = Vec3(-1, 1, 1);
  guises.push_back({"mirrored", placed(*model_, placement), true});
  for (const Guise& guise : guises) {
    const Character& figure = guise.model.characters.front();
    const LimbFindings found = find_limbs(guise.model, figure);
    ASSERT_EQ(found.limbs.size(), findings_.limbs.size()) << guise.name;
    for (std::size_t i = 0; i < found.limbs.size(); ++i) {
      const Limb& a = findings_.limbs[i];
      const Limb& b = found.limbs[i];
      SCOPED_TRACE(std::string(guise.name) + " " + a.name);
      ASSERT_EQ(a.joints, b.joints);
      const auto x = fit_limb_model(*model_, character(), a, findings_);
      const auto y = fit_limb_model(guise.model, figure, b, found);
      ASSERT_TRUE(x.ok() && y.ok());
      ASSERT_EQ(x->dof_count(), y->dof_count());
      for (std::size_t d = 0; d < x->space.dofs.size(); ++d) {
        EXPECT_NEAR(x->space.dofs[d].lower, y->space.dofs[d].lower, kSame);
        EXPECT_NEAR(x->space.dofs[d].upper, y->space.dofs[d].upper, kSame);
      }
      double worst = 0;
      std::size_t n = 0;
      const auto moments = moments_of(*model_, *x);
      const std::size_t stride = 1 + moments.size() / 200;
      for (const auto& [clip, t] : moments) {
        if (n++ % stride != 0) continue;
        const Clip& other =
            guise.model.clips[static_cast<std::size_t>(clip - model_->clips.data())];
        const LimbState p = limb_state_at(*x, *model_, *clip, t);
        const LimbState q = limb_state_at(*y, guise.model, other, t);
        for (int k = 0; k < p.q.count; ++k) worst = std::max(worst, std::abs(p.q[k] - q.q[k]));
      }
      const LimbState rest = limb_state(*x, rest_pose(model_->skeleton));
      const LimbState rest_there = limb_state(*y, rest_pose(guise.model.skeleton));
      for (int k = 0; k < rest.q.count; ++k)
        worst = std::max(worst, std::abs(rest.q[k] - rest_there.q[k]));
      EXPECT_LT(worst, kSame) << "parameters";
      for (const double share : {0.6, 0.9, 1.1}) {
        bool here = false, there = false;
        const Dofs p = solved(*model_, *x, share, here);
        const Dofs q = solved(guise.model, *y, share, there);
        EXPECT_EQ(here, there);
        for (int k = 0; here && there && k < p.count; ++k)
          EXPECT_NEAR(p[k], q[k], kSame)
              << "IK, " << x->space.dofs[static_cast<std::size_t>(k)].name;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Rigs, testing::ValuesIn(rig_table()),
                         [](const auto& info) { return test_name(info.param); });

}  // namespace
}  // namespace elbowroom::test
