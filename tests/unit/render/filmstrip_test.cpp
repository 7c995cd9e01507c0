// SPDX-License-Identifier: MIT
// Filmstrips and the shots they choose.
#include "render/filmstrip.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "render/text.h"
#include "tests/unit/render/gl_fixture.h"
#include "tests/unit/render/scenes.h"

namespace elbowroom::test {
namespace {

class FilmstripTest : public GlTest {
 protected:
  FilmstripTest() {
    model_ = bending_character(6, 4);
    world_.actors.push_back(actor_of(model_));
    world_.actors[0].clip = bending_clip(*model_, 1.2);
    request_.rows.push_back({});
    request_.rows[0].world = &world_;
    request_.times = {0, 0.5, 1};
    request_.frame_width = 120;
    request_.frame_height = 140;
    request_.fine = false;
    request_.style.shadow_map_size = 512;
  }

  static Actor box_at(const Vec3& at, const glm::vec3& half) {
    auto model = std::make_shared<Model>();
    Transform rest;
    rest.translation = at;
    add_object(*model, add_mesh(*model, box_mesh(half), add_node(*model, -1, rest)));
    return actor_of(model);
  }

  ShotRequest shot() const {
    ShotRequest request;
    request.worlds = {&world_};
    request.times = request_.times;
    return request;
  }

  Picture strip() {
    auto picture = render_filmstrip(renderer(), request_);
    EXPECT_TRUE(picture.ok()) << picture.error().message();
    return picture.ok() ? *picture : Picture();
  }

  std::shared_ptr<Model> model_;
  World world_;
  FilmstripRequest request_;
};

TEST_F(FilmstripTest, FramesStandSideBySideWithTheirTimes) {
  const Picture picture = strip();
  EXPECT_EQ(picture.width, 2 * 28 + 3 * 120 + 2 * 14);
  // Frames differ, as the figure moves, and none is blank.
  double last = 0;
  for (int frame = 0; frame < 3; ++frame) {
    double sum = 0;
    for (int y = 28; y < 168; ++y) {
      for (int x = 0; x < 120; ++x) sum += picture.pixel(28 + frame * 134 + x, y) >> 8 & 0xffu;
    }
    EXPECT_GT(sum / (120 * 140), 0x2a);
    EXPECT_NE(sum, last);
    last = sum;
  }
  // The page's colour is left at the margin; captions are lighter than it.
  EXPECT_EQ(picture.pixel(3, 3), 0x16181du);
  Rgb brightest = 0;
  for (int y = 172; y < 196; ++y) {
    for (int x = 28; x < 90; ++x) brightest = std::max(brightest, picture.pixel(x, y) & 0xffu);
  }
  if (Font::load(Weight::medium).found()) {
    EXPECT_GT(brightest, 0xa0u);
  }
}

TEST_F(FilmstripTest, SameRequestSameBytes) {
  const Picture first = strip();
  EXPECT_EQ(first.rgb, strip().rgb);
}

TEST_F(FilmstripTest, ColumnsWrapAndRowsPair) {
  request_.times = {0, 0.2, 0.4, 0.6, 0.8};
  request_.columns = 2;
  const Picture three_lines = strip();
  request_.rows.push_back(request_.rows[0]);
  request_.rows[0].label = "Before";
  request_.rows[1].label = "After";
  const Picture six_lines = strip();
  EXPECT_EQ(three_lines.width, six_lines.width);
  EXPECT_GT(six_lines.height, 2 * three_lines.height - 60);
  request_.frame_width = request_.frame_height = 0;
  request_.columns = 0;
  request_.title = "A title";
  request_.scale = 0.5;
  EXPECT_FALSE(strip().empty());
}

TEST_F(FilmstripTest, ContactsAreShownInTheFrameAndInItsCaption) {
  const auto warm = [](const Picture& p, int x0, int y0, int x1, int y1) {
    int count = 0;
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) count += warmth(p.pixel(x, y)) > 80;
    }
    return count;
  };
  EXPECT_EQ(warm(strip(), 0, 0, 444, 200), 0);
  request_.rows[0].contacts.resize(3);
  ContactMark mark;
  mark.place = Vec3(0, 1.0, 0.15);
  request_.rows[0].contacts[1].push_back(mark);
  const Picture picture = strip();
  EXPECT_GT(warm(picture, 162, 28, 282, 168), 20);
  EXPECT_EQ(warm(picture, 28, 28, 148, 168), 0);
  if (Font::load(Weight::medium).found()) {
    EXPECT_GT(warm(picture, 162, 170, 282, 200), 10);
  }
}

TEST_F(FilmstripTest, FarGeometryDoesNotMoveTheCamera) {
  const Shot alone = plan_shot(renderer(), shot(), 1);
  auto plane = box_at(Vec3(0, -0.05, 0), {100, 0.05f, 100});
  world_.actors.push_back(plane);
  world_.actors.push_back(box_at(Vec3(40, 5, -30), {3, 5, 3}));
  const Shot with = plan_shot(renderer(), shot(), 1);
  EXPECT_NEAR(with.cameras[0].distance, alone.cameras[0].distance, 1e-9);
  EXPECT_LT(glm::length(with.cameras[0].focus - alone.cameras[0].focus), 1e-9);
  // What is near is framed, as far as it is near.
  world_.actors.push_back(box_at(Vec3(0.35, 1, 0), {0.05f, 1, 0.05f}));
  const Shot near = plan_shot(renderer(), shot(), 1);
  EXPECT_GT(near.cameras[0].distance, alone.cameras[0].distance);
  EXPECT_LT(near.cameras[0].distance, 2.0 * alone.cameras[0].distance);
}

TEST_F(FilmstripTest, TheCameraStandsWhereTheContactIsSeen) {
  for (const double side : {1.0, -1.0}) {
    world_.actors.resize(1);
    // A wall on one side of the figure; the contact is on the other.
    world_.actors.push_back(box_at(Vec3(-side * 0.5, 1, 0), {0.02f, 1.5f, 3.0f}));
    ShotRequest request = shot();
    request.contacts = {{}, {Vec3(side * 0.12, 0.8, 0)}, {}};
    const Shot chosen = plan_shot(renderer(), request, 1);
    EXPECT_GT(side * std::sin(chosen.cameras[1].azimuth), 0.2);
    // From the front, not from behind.
    EXPECT_GT(std::cos(chosen.cameras[1].azimuth), -0.1);
  }
}

TEST_F(FilmstripTest, TheCameraWalksWithAFigureThatWalksFar) {
  auto clip = std::make_shared<Clip>(*world_.actors[0].clip);
  Channel channel;
  channel.joint = model_->characters[0].joints[0];
  channel.path = Path::translation;
  channel.components = 3;
  channel.times = {0, 1};
  channel.values = {0, 0, 0, 12, 0, 5};
  clip->channels.push_back(channel);
  world_.actors[0].clip = clip;
  const Shot shot_found = plan_shot(renderer(), shot(), 0.8);
  EXPECT_TRUE(shot_found.follows);
  EXPECT_NEAR(shot_found.cameras[2].focus.x - shot_found.cameras[0].focus.x, 12, 0.6);
  EXPECT_LT(shot_found.cameras[0].distance, 10);
  ShotRequest still = shot();
  still.move = CameraMove::fixed;
  EXPECT_GT(plan_shot(renderer(), still, 0.8).cameras[0].distance, 15);
}

TEST_F(FilmstripTest, WhatIsAskedForIsKept) {
  ShotRequest request = shot();
  request.azimuth = 1.1;
  request.elevation = 0.6;
  request.focus = Vec3(0, 1.2, 0);
  request.extent = 0.2;
  const Shot found = plan_shot(renderer(), request, 1.5);
  EXPECT_DOUBLE_EQ(found.cameras[0].azimuth, 1.1);
  EXPECT_DOUBLE_EQ(found.cameras[0].elevation, 0.6);
  EXPECT_LT(glm::length(project(found.cameras[0], 1.5, Vec3(0, 1.2, 0)) -
                        Vec3(0.5, 0.5, project(found.cameras[0], 1.5, Vec3(0, 1.2, 0)).z)),
            0.05);
  EXPECT_DOUBLE_EQ(found.aspect, 1.5);
}

TEST_F(FilmstripTest, RefusesWhatCannotBeDrawn) {
  const auto refused = [&](auto change) {
    FilmstripRequest request = request_;
    change(request);
    const auto result = render_filmstrip(renderer(), request);
    return !result.ok() && !result.error().what.empty() && !result.error().remedy.empty();
  };
  EXPECT_TRUE(refused([](auto& r) { r.times.clear(); }));
  EXPECT_TRUE(refused([](auto& r) { r.rows.clear(); }));
  EXPECT_TRUE(refused([](auto& r) { r.rows[0].world = nullptr; }));
  EXPECT_TRUE(refused([](auto& r) { r.times[1] = std::numeric_limits<double>::quiet_NaN(); }));
  EXPECT_TRUE(refused([](auto& r) { r.times.resize(5000, 0.1); }));
  EXPECT_TRUE(refused([](auto& r) { r.frame_width = -4; }));
  EXPECT_TRUE(refused([](auto& r) { r.scale = 0; }));
  // An empty world is a picture all the same.
  World empty;
  request_.rows[0].world = &empty;
  request_.times = {0};
  EXPECT_FALSE(strip().empty());
}

TEST_F(FilmstripTest, NeedsNoRendererOfTheCaller) {
  request_.times = {0.5};
  std::vector<std::string> warnings;
  const auto picture = render_filmstrip(request_, &warnings);
  ASSERT_TRUE(picture.ok()) << picture.error().message();
  EXPECT_EQ(picture->rgb, strip().rgb);
}

}  // namespace
}  // namespace elbowroom::test
