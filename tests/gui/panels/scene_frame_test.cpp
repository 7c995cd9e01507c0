// SPDX-License-Identifier: MIT
// What the picture holds for each state of the editor.
#include "ui/scene_frame.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/editing/session.h"
#include "tests/gui/panels/editor_driver.h"

namespace elbowroom {
namespace {

class SceneFrameTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    auto session = open_session(demo_scene());
    ASSERT_TRUE(session.ok());
    session_ = new Session(std::move(*session));
  }
  static void TearDownTestSuite() { delete session_; }

  SceneFrameTest() {
    document = session_->document;
    state.document = &document;
    state.session = session_;
    state.source = state.clip = session_->clip();
    state.begin = state.source->begin;
    state.end = state.source->end;
    state.time = 1.5;
    for (std::size_t i = 0; i < session_->limbs.size(); ++i)
      if (session_->limbs[i].limb.kind == LimbKind::right_arm) arm = static_cast<int>(i);
  }
  const LimbModel& model() const { return session_->limbs[static_cast<std::size_t>(arm)]; }
  void choose() {
    state.limb = arm;
    document.draft.limb = model().limb.name;
  }
  // The clip as another object, with the arm's correction over it.
  void give_candidate(double begin, double end) {
    state.candidate.emplace();
    state.candidate->report.limb = arm;
    state.candidate->correction.limb = model().limb.name;
    state.candidate->correction.begin = static_cast<float>(begin);
    state.candidate->correction.end = static_cast<float>(end);
    state.candidate->clip = std::make_shared<const Clip>(*state.source);
  }
  std::shared_ptr<CollisionStrip> strip_with_contact(double t, Vec3 place) const {
    auto strip = std::make_shared<CollisionStrip>();
    strip->begin = state.begin;
    strip->end = strip->computed_to = state.end;
    strip->limbs.resize(session_->limbs.size());
    auto& samples = strip->limbs[static_cast<std::size_t>(arm)].samples;
    for (double at = state.begin; at <= state.end; at += 1 / kStripRate) {
      StripSample sample;
      sample.t = at;
      sample.contact = std::abs(at - t) < 0.1;
      sample.place = place;
      samples.push_back(sample);
    }
    return strip;
  }

  static inline Session* session_ = nullptr;
  Document document;
  EditorState state;
  ViewState view;
  SceneFrame scene;
  int arm = -1;
};

TEST_F(SceneFrameTest, WithoutASceneItIsEmpty) {
  EditorState nothing;
  const Document none;
  nothing.document = &none;
  const Frame& frame = scene.make(nothing, view, 1);
  EXPECT_TRUE(frame.ghosts.empty() && frame.trails.empty() && frame.markers.empty() &&
              frame.contacts.empty());
  EXPECT_TRUE(scene.states().empty());
  EXPECT_FALSE(scene.figure_place().has_value());
  EXPECT_TRUE(scene.points_of_figure(nothing, true).empty());
  EXPECT_TRUE(scene.points_of_selection(nothing).empty());
  // And again after a scene was shown.
  (++state.picture_version, scene.make(state, view, 1));
  EXPECT_FALSE(scene.states().empty());
  scene.make(nothing, view, 1);
  EXPECT_TRUE(scene.states().empty());
}

TEST_F(SceneFrameTest, ShowsTheMotionAtTheTime) {
  const Frame& frame = (++state.picture_version, scene.make(state, view, 2));
  ASSERT_NE(frame.world, nullptr);
  EXPECT_EQ(frame.pixel_scale, 2);
  EXPECT_EQ(frame.states->size(), session_->scene.world.actors.size());
  EXPECT_GT(frame.size, 0);
  EXPECT_TRUE(frame.ghosts.empty());
  EXPECT_TRUE(frame.markers.empty());
  std::vector<ActorState> expected;
  world_state_at(session_->scene.world, 1.5, expected);
  EXPECT_EQ(frame.states->front().world_from_joint, expected.front().world_from_joint);
  const auto there = scene.figure_place();
  ASSERT_TRUE(there.has_value());
  state.time = 2.5;
  (++state.picture_version, scene.make(state, view, 1));
  EXPECT_GT(glm::length(*scene.figure_place() - *there), 0.5) << "the figure walks";
}

TEST_F(SceneFrameTest, BeforeShowsTheSourceAndNoGhost) {
  choose();
  // A corrected clip that stands elsewhere at this time.
  auto other = std::make_shared<Clip>(*state.source);
  for (Channel& channel : other->channels)
    if (channel.path == Path::translation)
      for (float& value : channel.values) value += 1;
  state.clip = other;
  document.corrections.resize(1);
  document.corrections[0].limb = model().limb.name;
  document.corrections[0].begin = 1;
  document.corrections[0].end = 2;
  const auto root = [&] {
    return Vec3(
        scene.states().front().world_from_joint[static_cast<std::size_t>(model().limb.root)][3]);
  };
  view.compare = Compare::after;
  EXPECT_TRUE((++state.picture_version, scene.make(state, view, 1)).ghosts.empty());
  const Vec3 after = root();
  view.compare = Compare::before;
  EXPECT_TRUE((++state.picture_version, scene.make(state, view, 1)).ghosts.empty());
  const Vec3 before = root();
  EXPECT_GT(glm::length(after - before), 0.5);
  view.compare = Compare::both;
  const Frame& both = (++state.picture_version, scene.make(state, view, 1));
  EXPECT_EQ(glm::length(root() - after), 0);
  ASSERT_FALSE(both.ghosts.empty()) << "the source's arm";
  const auto& ghost = both.ghosts.front();
  EXPECT_LT(
      glm::length(
          Vec3(ghost.state->world_from_joint[static_cast<std::size_t>(model().limb.root)][3]) -
          before),
      1e-9);
  EXPECT_EQ(ghost.parts.size(), static_cast<std::size_t>(session_->scene.model().skeleton.size()));
  EXPECT_EQ(both.ghosts.size(), 2u) << "the umbrella goes along with the arm";
  // Outside the window, or muted, both are the same.
  state.time = 3;
  EXPECT_TRUE((++state.picture_version, scene.make(state, view, 1)).ghosts.empty());
  state.time = 1.5;
  document.corrections[0].muted = true;
  EXPECT_TRUE((++state.picture_version, scene.make(state, view, 1)).ghosts.empty());
}

TEST_F(SceneFrameTest, ACandidateIsAGhostInsideItsWindow) {
  choose();
  give_candidate(1, 2);
  for (const Compare compare : {Compare::after, Compare::both}) {
    view.compare = compare;
    const Frame& frame = (++state.picture_version, scene.make(state, view, 1));
    ASSERT_FALSE(frame.ghosts.empty());
    EXPECT_EQ(frame.ghosts.front().actor->clip, state.candidate->clip);
  }
  state.time = 2.5;
  EXPECT_TRUE((++state.picture_version, scene.make(state, view, 1)).ghosts.empty());
  state.time = 1.5;
  state.candidate->report.limb = 99;  // of no limb that there is
  EXPECT_TRUE((++state.picture_version, scene.make(state, view, 1)).ghosts.empty());
}

TEST_F(SceneFrameTest, TheTargetHasAMarkAndAPosture) {
  choose();
  HandTarget target;
  target.time = state.time;
  target.position = {0.3, 1.2, 2};
  document.draft.target = target;
  state.target.status = TargetView::Status::solved;
  state.target.state = limb_state(model(), rest_pose(session_->scene.model().skeleton));
  const auto ring = [](const Frame& frame) {
    const Marker* found = nullptr;
    for (const Marker& marker : frame.markers)
      if (marker.shape == MarkerShape::ring) found = &marker;
    return found;
  };
  const Frame& frame = (++state.picture_version, scene.make(state, view, 1));
  ASSERT_NE(ring(frame), nullptr);
  EXPECT_EQ(ring(frame)->place, target.position);
  ASSERT_FALSE(frame.ghosts.empty());
  const Rgb good = frame.ghosts.front().colour;
  state.target.status = TargetView::Status::in_collision;
  EXPECT_NE((++state.picture_version, scene.make(state, view, 1)).ghosts.front().colour, good);
  EXPECT_TRUE((++state.picture_version, scene.make(state, view, 1)).keep_scene);
  // At another time only the mark stays.
  state.time += 0.5;
  EXPECT_TRUE((++state.picture_version, scene.make(state, view, 1)).ghosts.empty());
  EXPECT_NE(ring((++state.picture_version, scene.make(state, view, 1))), nullptr);
  state.target.state.reset();
  state.time = target.time;
  EXPECT_TRUE((++state.picture_version, scene.make(state, view, 1)).ghosts.empty());
}

TEST_F(SceneFrameTest, ContactsOfTheMotionThatIsShown) {
  state.source_strip = strip_with_contact(1.5, {1, 2, 3});
  state.strip = strip_with_contact(2.5, {4, 5, 6});
  state.strip_is_current = true;
  view.compare = Compare::after;
  EXPECT_TRUE((++state.picture_version, scene.make(state, view, 1)).contacts.empty());
  view.compare = Compare::before;
  const Frame& before = (++state.picture_version, scene.make(state, view, 1));
  ASSERT_EQ(before.contacts.size(), 1u);
  EXPECT_EQ(before.contacts.front().place, Vec3(1, 2, 3));
  state.time = 2.5;
  EXPECT_TRUE((++state.picture_version, scene.make(state, view, 1)).contacts.empty());
  view.compare = Compare::both;
  ASSERT_EQ((++state.picture_version, scene.make(state, view, 1)).contacts.size(), 1u);
  // What is known of the motion before the last change says nothing of this one.
  state.strip_is_current = false;
  EXPECT_TRUE((++state.picture_version, scene.make(state, view, 1)).contacts.empty());
}

TEST_F(SceneFrameTest, TrailsOverTheWindow) {
  choose();
  EXPECT_TRUE((++state.picture_version, scene.make(state, view, 1)).trails.empty())
      << "no window, no trail";
  document.draft.window = Interval{1, 2};
  const Frame& frame = (++state.picture_version, scene.make(state, view, 1));
  ASSERT_EQ(frame.trails.size(), 1u);
  EXPECT_GT(frame.trails[0].points.size(), 50u);
  EXPECT_EQ(frame.trails[0].points.size(), frame.trails[0].colours.size());
  const auto end = static_cast<std::size_t>(model().limb.end);
  std::vector<ActorState> states;
  world_state_at(session_->scene.world, 1, states);
  EXPECT_LT(
      glm::length(frame.trails[0].points.front() - Vec3(states.front().world_from_joint[end][3])),
      1e-9);
  const Rgb free = frame.trails[0].colours[frame.trails[0].colours.size() / 2];
  // Where it collides the trail says so, also when the strip comes later.
  state.strip = strip_with_contact(1.5, {0, 0, 0});
  const Frame& again = (++state.picture_version, scene.make(state, view, 1));
  EXPECT_NE(again.trails[0].colours[again.trails[0].colours.size() / 2], free);
  EXPECT_EQ(again.trails[0].colours.front(), free);
  give_candidate(1.2, 1.8);
  EXPECT_EQ((++state.picture_version, scene.make(state, view, 1)).trails.size(), 2u);
  view.show_trails = false;
  EXPECT_TRUE((++state.picture_version, scene.make(state, view, 1)).trails.empty());
}

TEST_F(SceneFrameTest, TheSelectedLimbHasItsTone) {
  choose();
  const Frame& frame = (++state.picture_version, scene.make(state, view, 1));
  ASSERT_FALSE(frame.looks.empty());
  const auto& emphasis = frame.looks.front().emphasis;
  const Skeleton& skeleton = session_->scene.model().skeleton;
  ASSERT_EQ(emphasis.size(), static_cast<std::size_t>(skeleton.size()));
  for (int node = 0; node < skeleton.size(); ++node)
    EXPECT_EQ(emphasis[static_cast<std::size_t>(node)] > 0,
              skeleton.is_within(node, model().limb.root))
        << node;
  EXPECT_EQ(frame.markers.size(), 3u);
  view.show_limb = false;
  EXPECT_TRUE((++state.picture_version, scene.make(state, view, 1)).markers.empty());
}

TEST_F(SceneFrameTest, FramingIsFiniteAndAroundTheFigure) {
  (++state.picture_version, scene.make(state, view, 1));
  const auto now = scene.points_of_figure(state, false);
  ASSERT_GT(now.size(), 10u);
  const Vec3 place = *scene.figure_place();
  for (const Vec3& point : now) EXPECT_LT(glm::length(point - place), 4) << "no posts";
  choose();
  (++state.picture_version, scene.make(state, view, 1));
  EXPECT_FALSE(scene.points_of_selection(state).empty());
}

}  // namespace
}  // namespace elbowroom
