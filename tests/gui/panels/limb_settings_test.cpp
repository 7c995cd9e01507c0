// SPDX-License-Identifier: MIT
// What the character's limbs are and how far they swing, set in the window: the limb panel's map
// and the dialog of joints. Each is one step of undo, the session follows, the project keeps it.
#include <gtest/gtest.h>

#include "core/io/project_file.h"
#include "tests/gui/panels/demo_stretch.h"
#include "tests/gui/panels/editor_driver.h"

namespace elbowroom {
namespace {

using namespace command;

class LimbSettings : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new ScratchFolder;
    driver_ = new EditorDriver;
    ASSERT_TRUE(
        driver_->open(demo_stretch(folder_->path(), kStretchBegin, kStretchEnd, Props::none)));
    ASSERT_TRUE(driver_->settle());
  }
  static void TearDownTestSuite() {
    delete driver_;
    delete folder_;
  }
  void SetUp() override {
    ASSERT_TRUE(driver_ && driver_->state().open());
    for (int i = 0; i < 500 && !state().undo_name.empty(); ++i) driver_->handle(Undo{});
    driver_->view().tab = InspectorTab::limb;
    driver_->view().dialog = Dialog::none;
    driver_->view().swing_joint = 0;
    driver_->ui.move_to(ImVec2{-1000, -1000});
    ASSERT_TRUE(follows());
    driver_->handle(SelectLimb{driver_->limb("left_arm")});
    driver_->ui.frame(3);
  }
  // The session has the document's limbs and limits; contacts may still be looked for.
  static bool follows() {
    return driver_->wait_until([] {
      const Session& session = *driver_->state().session;
      return !driver_->state().opening.active &&
             session.document.limbs == driver_->document().limbs &&
             session.document.swing_limits == driver_->document().swing_limits;
    });
  }
  EditorDriver& driver() { return *driver_; }
  UiDriver& ui() { return driver_->ui; }
  const EditorState& state() const { return driver_->state(); }
  // The wheel until it is in sight.
  void bring_into_sight(const std::string& name) {
    for (int i = 0; i < 30; ++i) {
      const ProbedWidget* widget = ui().ui().probe().find(name);
      if (widget && widget->visible && widget->max.y < inspector_bottom()) return;
      ui().move_to(ImVec2{1400, 300});
      ui().wheel(-2);
      ui().frame(2);
    }
    ADD_FAILURE() << name << " does not come into sight\n" << ui().dump();
  }
  float inspector_bottom() {
    const ProbedWidget* panel = ui().ui().probe().find("Inspector");
    return panel ? panel->max.y : 0;
  }
  const SwingPolygon& polygon() const {
    static const SwingPolygon none;
    const auto set = driver_->document().swing_limits.find("left_arm");
    return set == driver_->document().swing_limits.end() ? none : set->second[0];
  }
  const DofSpace& space() const {
    return state().session->limbs[static_cast<std::size_t>(driver_->limb("left_arm"))].space;
  }

  static inline ScratchFolder* folder_ = nullptr;
  static inline EditorDriver* driver_ = nullptr;
};

TEST_F(LimbSettings, TheMapShowsTheLimitAndWhatTheClipDoes) {
  ASSERT_EQ(state().swings.size(), 2u);
  const SwingView& shoulder = state().swings[0];
  EXPECT_EQ(shoulder.joint, "Shoulder");
  EXPECT_EQ(shoulder.first, "up");
  EXPECT_EQ(shoulder.second, "forward");
  EXPECT_GT(shoulder.clip.size(), 100u);
  // The marks are where DESIGN.md's words have them.
  const LimbModel& arm = *state().limb_model();
  ASSERT_EQ(shoulder.landmarks.size(), 4u);
  const std::pair<const char*, double> raised[] = {
      {"hanging", 0}, {"to the side", 90}, {"ahead", 90}, {"overhead", 180}};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(shoulder.landmarks[i].name, raised[i].first);
    Dofs q;
    q.count = arm.dof_count();
    q[0] = shoulder.landmarks[i].place[0];
    q[1] = shoulder.landmarks[i].place[1];
    EXPECT_NEAR(elevation(arm, q).raise * 180 / kPi, raised[i].second, 1e-6);
  }
  // The clip's value is one of its own samples' neighbours.
  double nearest = 10;
  for (const auto& place : shoulder.clip)
    nearest = std::min(
        nearest, std::hypot(place[0] - shoulder.clip_value[0], place[1] - shoulder.clip_value[1]));
  EXPECT_LT(nearest, 0.1);
  bring_into_sight("Swing map");
  EXPECT_EQ(ui().value("Swing map"), "own limit");
  EXPECT_EQ(ui().value("Swing joint"), "Shoulder");
}

TEST_F(LimbSettings, TheLimitIsAtTheJointWhileThePointerIsOnTheMap) {
  bring_into_sight("Swing map");
  const auto trails = [&] { return driver().panels.frame(state(), driver().view(), 1).trails; };
  ui().move_to(ImVec2{800, 300});
  ui().frame(2);
  const std::size_t without = trails().size();
  ui().move_to("Swing map");
  ui().frame(2);
  ASSERT_GT(trails().size(), without + 14);  // spokes, then the rim
  const std::vector<Vec3> own = trails()[without + 12].points;
  // It follows what is drawn, before the session does.
  driver().handle(SetSwingLimit{
      LimbJointRole::root, {{0.3, 0}, {0, 0.3}, {-0.3, 0}, {0, -0.3}}, Phase::changing});
  ui().frame(2);
  ASSERT_GT(trails().size(), without + 14);
  EXPECT_NE(trails()[without + 12].points, own);
  driver().handle(SetSwingLimit{LimbJointRole::root, {}, Phase::cancelled});
  ui().move_to(ImVec2{800, 300});
  ui().frame(2);
  EXPECT_EQ(trails().size(), without);
}

TEST_F(LimbSettings, APolygonIsDrawnDraggedAndTakenBack) {
  bring_into_sight("Draw as polygon");
  ui().click("Draw as polygon");
  ASSERT_TRUE(follows());
  EXPECT_GE(polygon().size(), 6u);
  ASSERT_EQ(space().polygons.size(), 1u) << "the session has it";
  EXPECT_EQ(state().undo_name, "Swing limit of the shoulder");

  // One drag, one step; the session follows when it ends.
  bring_into_sight("Swing map");
  const Document before = driver().document();
  ui().drag("Swing map.corner.0", {-12, 20}, 8);
  ASSERT_TRUE(follows());
  EXPECT_NE(driver().document(), before);
  const SwingPolygon dragged = polygon();
  EXPECT_EQ(make_swing_polygon(0, 1, dragged)->corners, space().polygons[0].corners);
  driver().handle(Undo{});
  ASSERT_TRUE(follows());
  EXPECT_EQ(driver().document(), before);
  EXPECT_NE(make_swing_polygon(0, 1, dragged)->corners, space().polygons[0].corners);
  driver().handle(Redo{});
  ASSERT_TRUE(follows());
  EXPECT_EQ(make_swing_polygon(0, 1, dragged)->corners, space().polygons[0].corners);

  // Saved and opened.
  const auto file = *folder_ / "swing.elbow";
  ASSERT_TRUE(write_project(file, driver().document()).ok());
  const auto read = read_project(file);
  ASSERT_TRUE(read.ok()) << read.error().message();
  EXPECT_EQ(read->swing_limits, driver().document().swing_limits);
  const auto session = open_project_session(*read);
  ASSERT_TRUE(session.ok());
  const auto arm = limbs_named(*session, "left_arm");
  ASSERT_TRUE(arm.ok());
  EXPECT_EQ(session->limbs[static_cast<std::size_t>(arm->front())].space.polygons[0].corners,
            space().polygons[0].corners);

  bring_into_sight("Back to own limit");
  ui().click("Back to own limit");
  ASSERT_TRUE(follows());
  EXPECT_TRUE(polygon().empty());
  EXPECT_TRUE(driver().document().swing_limits.empty());
  EXPECT_TRUE(space().polygons.empty());
}

TEST_F(LimbSettings, CornersAreAddedAndTakenAwayEachInOneStep) {
  driver().handle(SetSwingLimit{LimbJointRole::root, {{1.4, 0}, {0, 1.4}, {-1.4, 0}, {0, -1.4}}});
  ASSERT_TRUE(follows());
  bring_into_sight("Swing map");
  ui().click("Swing map.edge.0");
  EXPECT_EQ(polygon().size(), 5u);
  ASSERT_TRUE(follows());
  ui().wait(1);
  ui().click("Swing map.corner.1", 1);
  EXPECT_EQ(polygon().size(), 4u);
  driver().handle(Undo{});
  EXPECT_EQ(polygon().size(), 5u);
  driver().handle(Undo{});
  EXPECT_EQ(polygon().size(), 4u);
}

TEST_F(LimbSettings, WhatIsNoSwingLimitIsRefused) {
  const Document before = driver().document();
  for (const SwingPolygon& polygon :
       {SwingPolygon{{1, 0}, {-1, 0}}, SwingPolygon{{1, 1}, {2, 1}, {2, 2}},
        SwingPolygon{{std::nan(""), 0}, {0, 1}, {-1, -1}},
        SwingPolygon{{1e300, 0}, {0, 1}, {-1, -1}}}) {
    const int told = state().notices.empty() ? 0 : state().notices.back().id;
    driver().handle(SetSwingLimit{LimbJointRole::root, polygon});
    EXPECT_EQ(driver().document(), before);
    ASSERT_FALSE(state().notices.empty());
    EXPECT_GT(state().notices.back().id, told) << "it is said";
    EXPECT_EQ(state().notices.back().kind, Notice::Kind::error);
  }
  // A joint without a swing has none.
  driver().handle(SetSwingLimit{LimbJointRole::middle, {{1, 0}, {-1, 1}, {-1, -1}}});
  EXPECT_EQ(driver().document(), before);
}

TEST_F(LimbSettings, ThePanelSaysWhyTheLimbWasTaken) {
  bring_into_sight("Choose joints…");
  const std::string why = state().limb_model()->limb.why;
  ASSERT_FALSE(why.empty());
  EXPECT_NE(ui().dump().find(why.substr(0, 20)), std::string::npos) << ui().dump();
  EXPECT_NE(ui().dump().find("LeftUpperArm"), std::string::npos);
}

TEST_F(LimbSettings, JointsAreChosenFromAListAndTheSceneFollows) {
  bring_into_sight("Choose joints…");
  ui().click("Choose joints…");
  ui().frame(3);
  EXPECT_FALSE(ui().widget("Use these joints")->enabled) << "they are its joints already";
  // The shoulder goes to the collar bone, by a search.
  ui().click("Joints of the limbs/Shoulder");
  ui().click("Search joints");
  ui().type("leftshoulder");
  ui().frame(2);
  ui().click("Joints of the limbs/LeftShoulder");
  ui().frame(2);
  EXPECT_TRUE(ui().widget("Use these joints")->enabled);
  const Document before = driver().document();
  ui().click("Use these joints");
  ASSERT_TRUE(driver().settle());
  EXPECT_EQ(driver().view().dialog, Dialog::none);
  ASSERT_TRUE(driver().document().limbs.contains("left_arm"));
  EXPECT_EQ(driver().document().limbs.at("left_arm").from, "LeftShoulder");
  const auto& joints = state().session->scene.model().skeleton.joints;
  const auto root = [&] {
    const int arm = driver().limb("left_arm");
    return joints[static_cast<std::size_t>(
                      state().session->limbs[static_cast<std::size_t>(arm)].limb.root)]
        .name;
  };
  EXPECT_EQ(root(), "LeftShoulder");
  EXPECT_TRUE(state().strip && state().strip->complete());
  EXPECT_EQ(state().limb, driver().limb("left_arm")) << "it stays chosen";
  driver().handle(Undo{});
  ASSERT_TRUE(driver().settle());
  EXPECT_EQ(driver().document(), before);
  EXPECT_EQ(root(), "LeftUpperArm");
}

TEST_F(LimbSettings, WhatIsNoChainIsSaidAndNotTaken) {
  driver().view().joints_of = "left_arm";
  driver().view().dialog = Dialog::limb_joints;
  ui().frame(3);
  ui().click("Joints of the limbs/Wrist");
  ui().click("Search joints");
  ui().type("righthand");
  ui().frame(2);
  ui().click("Joints of the limbs/RightHand");
  ui().frame(2);
  EXPECT_FALSE(ui().widget("Use these joints")->enabled);
  EXPECT_NE(ui().dump().find("is not below"), std::string::npos) << ui().dump();
  ui().click("Cancel");
  EXPECT_TRUE(driver().document().limbs.empty());
  // The same from elsewhere.
  const auto told = state().notices.empty() ? 0 : state().notices.back().id;
  driver().handle(SetLimbJoints{"left_arm", LimbJoints{"LeftUpperArm", "", "RightHand"}});
  EXPECT_TRUE(driver().document().limbs.empty());
  ASSERT_FALSE(state().notices.empty());
  EXPECT_GT(state().notices.back().id, told);
  EXPECT_EQ(state().notices.back().kind, Notice::Kind::error);
}

TEST_F(LimbSettings, ALimbCanBeNoneAndComesBack) {
  driver().view().joints_of = "left_leg";
  driver().view().dialog = Dialog::limb_joints;
  ui().frame(3);
  const auto count = state().session->limbs.size();
  ui().click("Not a limb");
  ASSERT_TRUE(follows());
  EXPECT_EQ(driver().limb("left_leg"), -1);
  EXPECT_EQ(state().session->limbs.size(), count - 1);
  ASSERT_TRUE(driver().wait_until([&] { return state().strip != nullptr; }));
  EXPECT_EQ(state().strip->limbs.size(), count - 1);
  EXPECT_FALSE(ui().has("Outliner/Left leg"));
  const auto file = *folder_ / "none.elbow";
  ASSERT_TRUE(write_project(file, driver().document()).ok());
  const auto read = read_project(file);
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read->limbs, driver().document().limbs);
  // It is in the dialog's list and can be found again.
  driver().view().dialog = Dialog::limb_joints;
  ui().frame(3);
  ui().click("Joints of the limbs/Left leg");
  ui().frame(2);
  ui().click("As found");
  ASSERT_TRUE(follows());
  EXPECT_GE(driver().limb("left_leg"), 0);
  EXPECT_TRUE(driver().document().limbs.empty());
}

TEST_F(LimbSettings, AChainGetsANameAndJoints) {
  driver().view().dialog = Dialog::limb_joints;
  ui().frame(3);
  ui().click("New chain");
  ui().frame(2);
  EXPECT_FALSE(ui().widget("Use these joints")->enabled);
  ui().click("Name of the chain");
  ui().type("spine");
  ui().click("Joints of the limbs/Root");
  ui().click("Search joints");
  ui().type("spine");
  ui().frame(2);
  ui().click("Joints of the limbs/Spine");
  ui().frame(2);
  ui().click("Search joints");
  ui().type("head");
  ui().frame(2);
  ui().click("Joints of the limbs/Head");
  ui().frame(2);
  ASSERT_TRUE(ui().widget("Use these joints")->enabled) << ui().dump();
  ui().click("Use these joints");
  ASSERT_TRUE(follows());
  ASSERT_TRUE(driver().document().limbs.contains("spine"));
  EXPECT_GE(driver().limb("spine"), 0);
  driver().handle(Undo{});
  ASSERT_TRUE(follows());
  EXPECT_EQ(driver().limb("spine"), -1);
}

}  // namespace
}  // namespace elbowroom
