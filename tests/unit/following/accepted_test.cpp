// SPDX-License-Identifier: MIT
// A correction of a leg whose foot hangs elsewhere, through a project file and back: it holds with
// the foot's keys, and does not without them. Once it is muted or gone, so are they.
#include "core/editing/accepted.h"

#include <gtest/gtest.h>

#include "core/editing/motion.h"
#include "core/io/project_file.h"
#include "tests/support/folder.h"
#include "tests/support/post_in_the_way.h"
#include "tests/support/samples.h"

namespace elbowroom::test {
namespace {

constexpr const char* kRunning = "Running";

TEST(FollowingInProjects, AcceptedCorrectionsCarryTheFoot) {
  const auto file = samples_dir() / "humanoids/quaternius/RobotExpressive.glb";
  if (samples_dir().empty() || !std::filesystem::exists(file)) GTEST_SKIP() << samples_missing();
  const Folder folder;
  Document document;
  document.scene.character = file;
  document.scene.clip = kRunning;
  document.scene.obstacles = {folder / "post.glb"};
  Task task;
  task.name = "around the post";
  task.limb = "left_leg";
  document.tasks = {task};
  {
    Document alone = document;
    alone.scene.obstacles.clear();
    const auto session = open_session(alone);
    ASSERT_TRUE(session.ok()) << session.error().message();
    const Model& model = session->scene.model();
    const Limb& leg = session->findings.limbs[2];
    ASSERT_EQ(leg.kind, LimbKind::left_leg);
    ASSERT_EQ(leg.following.size(), 1u);
    const auto post = post_in_the_way(model, session->character(), leg, model.find_clip(kRunning));
    ASSERT_TRUE(post.has_value());
    ASSERT_TRUE(write_post(*post, folder / "post.glb"));
  }
  const auto session = open_session(document);
  ASSERT_TRUE(session.ok()) << session.error().message();
  auto scene = contacts_of(*session);
  ASSERT_TRUE(scene.ok()) << scene.error().message();
  const auto limbs = limbs_named(*session, task.limb);
  ASSERT_TRUE(limbs.ok());
  const auto outcome = correct(*scene, *limbs, task);
  ASSERT_TRUE(outcome.ok()) << outcome.error().message();
  ASSERT_TRUE(outcome->all_corrected());
  ASSERT_EQ(outcome->corrections.size(), 1u);
  const int foot = scene->limbs()[static_cast<std::size_t>(limbs->front())].limb.following[0].joint;
  const Correction& made = outcome->corrections.front();
  ASSERT_EQ(made.joints.back().node, foot);
  ASSERT_FALSE(made.joints.back().translations.empty());

  document.corrections = outcome->corrections;
  document.corrections.front().task = task.name;
  ASSERT_TRUE(write_project(folder / "p.elbow", document).ok());
  const auto again = read_project(folder / "p.elbow");
  ASSERT_TRUE(again.ok()) << again.error().message();
  EXPECT_EQ(again->corrections, document.corrections);
  scene->set_clip(session->clip());
  const Accepted held = keep_accepted(*scene, *session, again->corrections, again->tasks);
  ASSERT_EQ(held.kept.size(), 1u) << held.dropped.front().why;
  EXPECT_EQ(held.clip->channels.size(), outcome->clip->channels.size());

  // As older versions have written it: it opens and is shown, but leaves the foot behind.
  std::vector<Correction> without = again->corrections;
  std::erase_if(without.front().joints, [&](const JointKeys& keys) { return keys.node == foot; });
  const Skeleton& skeleton = session->scene.model().skeleton;
  EXPECT_FALSE(motion_of(skeleton, session->clip(), without).problems.front().has_value());
  scene->set_clip(session->clip());
  const Accepted left = keep_accepted(*scene, *session, without, again->tasks);
  ASSERT_EQ(left.dropped.size(), 1u);
  EXPECT_EQ(left.dropped.front().why, "it has no keys of Foot.L, which follows left_leg");

  without = again->corrections;
  without.front().muted = true;
  EXPECT_EQ(motion_of(skeleton, session->clip(), without).clip, session->clip());
}

}  // namespace
}  // namespace elbowroom::test
