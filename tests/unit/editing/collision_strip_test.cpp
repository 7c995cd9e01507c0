// SPDX-License-Identifier: MIT
// The strip tells what a scan of the whole clip tells, however it was cut into stretches.
#include "core/editing/collision_strip.h"

#include <gtest/gtest.h>

#include "assets/demo.h"
#include "core/editing/session.h"

namespace elbowroom {
namespace {

Document demo_scene() {
  const std::filesystem::path folder = ELBOWROOM_DEMO_DIR;
  Document document;
  document.scene.character = folder / demo::kMannequinFile;
  document.scene.clip = demo::kDemoClip;
  document.scene.obstacles = {folder / demo::kPostsFile};
  AttachedFile umbrella{folder / demo::kUmbrellaFile, demo::kAttachJoint, {}};
  umbrella.joint_from_object.translation = {demo::kGripX, demo::kGripY, demo::kGripZ};
  document.scene.attachments = {umbrella};
  return document;
}

class Strip : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    auto session = open_session(demo_scene());
    ASSERT_TRUE(session.ok());
    session_ = new Session(std::move(*session));
    auto scene = contacts_of(*session_);
    ASSERT_TRUE(scene.ok());
    scene_ = new SceneCollision(std::move(*scene));
    strip_ = new CollisionStrip(
        make_collision_strip(*scene_, session_->clip()->begin, session_->clip()->end));
  }
  static void TearDownTestSuite() {
    delete strip_;
    delete scene_;
    delete session_;
  }
  static inline Session* session_ = nullptr;
  static inline SceneCollision* scene_ = nullptr;
  static inline CollisionStrip* strip_ = nullptr;
};

void expect_same(const std::vector<ContactInterval>& a, const std::vector<ContactInterval>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].deepest.part_a, b[i].deepest.part_a);
    EXPECT_EQ(a[i].deepest.part_b, b[i].deepest.part_b);
    EXPECT_NEAR(a[i].begin, b[i].begin, 5e-4);
    EXPECT_NEAR(a[i].end, b[i].end, 5e-4);
  }
}

TEST_F(Strip, HasTheContactsOfOneScan) {
  ASSERT_TRUE(strip_->complete());
  ASSERT_EQ(strip_->limbs.size(), session_->limbs.size());
  std::vector<std::vector<ContactInterval>> expected(strip_->limbs.size());
  for (const auto& contact :
       scene_->scan(session_->clip()->begin, session_->clip()->end, 120, -1, false))
    if (contact.deepest.limb >= 0)
      expected[static_cast<std::size_t>(contact.deepest.limb)].push_back(contact);
  bool any = false;
  for (std::size_t limb = 0; limb < expected.size(); ++limb) {
    any = any || !expected[limb].empty();
    expect_same(strip_->limbs[limb].contacts, expected[limb]);
  }
  EXPECT_TRUE(any) << "the demo has to collide, or this test says nothing";
}

TEST_F(Strip, SamplesAgreeWithTheIntervalsAndHaveWindowsAroundThem) {
  for (const LimbStrip& limb : strip_->limbs) {
    EXPECT_GE(limb.samples.size(),
              static_cast<std::size_t>((strip_->end - strip_->begin) * kStripRate));
    for (std::size_t i = 1; i < limb.samples.size(); ++i)
      EXPECT_LT(limb.samples[i - 1].t, limb.samples[i].t);
    for (const StripSample& sample : limb.samples) {
      const bool inside = std::any_of(
          limb.contacts.begin(), limb.contacts.end(),
          [&](const auto& c) { return c.begin - 1e-3 <= sample.t && sample.t <= c.end + 1e-3; });
      EXPECT_EQ(sample.contact, inside) << sample.t;
      if (sample.contact) {
        EXPECT_EQ(sample.clearance, 0);
      }
    }
    // What a mark in the timeline says a contact comes to is what the curve beside it shows there.
    for (const ContactInterval& contact : limb.contacts)
      EXPECT_TRUE(std::any_of(limb.samples.begin(), limb.samples.end(), [&](const auto& sample) {
        return std::abs(sample.t - contact.time_of_deepest) < 1e-6 &&
               sample.depth >= contact.deepest.depth;
      })) << contact.time_of_deepest;
    for (const ContactInterval& contact : limb.contacts)
      EXPECT_TRUE(std::any_of(limb.windows.begin(), limb.windows.end(), [&](const auto& w) {
        return w.begin <= contact.begin && contact.end <= w.end;
      }));
  }
}

TEST_F(Strip, LookingAgainAtAStretchChangesNothingOfAnUnchangedClip) {
  const CollisionStrip again = renew_collision_strip(*scene_, *strip_, 1.3, 2.1);
  ASSERT_TRUE(again.complete());
  for (std::size_t limb = 0; limb < strip_->limbs.size(); ++limb) {
    expect_same(again.limbs[limb].contacts, strip_->limbs[limb].contacts);
    EXPECT_EQ(again.limbs[limb].samples.size(), strip_->limbs[limb].samples.size());
    EXPECT_EQ(again.limbs[limb].windows.size(), strip_->limbs[limb].windows.size());
  }
}

TEST_F(Strip, StopsAtOnceAndSaysHowFarItCame) {
  std::stop_source stop;
  int told = 0;
  const CollisionStrip part = make_collision_strip(
      *scene_, strip_->begin, strip_->end, stop.get_token(), [&](const CollisionStrip& grown) {
        EXPECT_FALSE(grown.complete());
        if (++told == 2) stop.request_stop();
      });
  EXPECT_EQ(told, 2);
  EXPECT_FALSE(part.complete());
  EXPECT_GT(part.computed_to, strip_->begin);
}

TEST(StripSampleAt, FindsTheNearestOrNone) {
  LimbStrip strip;
  EXPECT_EQ(strip_sample_at(strip, 1), nullptr);
  for (int i = 0; i < 10; ++i) {
    StripSample sample;
    sample.t = i / kStripRate;
    strip.samples.push_back(sample);
  }
  EXPECT_EQ(strip_sample_at(strip, 3.4 / kStripRate), &strip.samples[3]);
  EXPECT_EQ(strip_sample_at(strip, 3.6 / kStripRate), &strip.samples[4]);
  EXPECT_EQ(strip_sample_at(strip, -1 / kStripRate), &strip.samples[0]);
  EXPECT_EQ(strip_sample_at(strip, 60 / kStripRate), nullptr);
}

}  // namespace
}  // namespace elbowroom
