// SPDX-License-Identifier: MIT
// Pictures of known scenes: what is in them, that it does not depend on units, place or mirroring,
// and that hostile input leaves the rest of the picture as it is.
#include "render/scene_renderer.h"

#include <epoxy/gl.h>

#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "tests/unit/render/gl_fixture.h"
#include "tests/unit/render/scenes.h"

namespace elbowroom::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class SceneRendererTest : public GlTest {};

Picture drawn_by(SceneRenderer& renderer, const World& world, double t, const Camera& camera,
                 const Style& style) {
  const auto drawn = renderer.draw(world, t, camera, style, {120, 90});
  EXPECT_TRUE(drawn.ok());
  return renderer.read();
}

World world_of(std::shared_ptr<const Model> model, const Mat4& place = Mat4(1.0)) {
  World world;
  world.actors.push_back(actor_of(std::move(model), place));
  return world;
}

std::shared_ptr<Model> object_of(Mesh mesh, const Vec3& at = Vec3(0.0)) {
  auto model = std::make_shared<Model>();
  Transform rest;
  rest.translation = at;
  add_object(*model, add_mesh(*model, std::move(mesh), add_node(*model, -1, rest)));
  return model;
}

Camera three_quarter(const World& world, double t, double aspect = 4.0 / 3.0) {
  return framed(with_preset({}, ViewPreset::three_quarter), bounds_over(world, {t}), aspect, 0.2);
}

// A figure that is not its own mirror image: a bent cylinder and a box beside it.
World lopsided() {
  auto model = bending_character(5, 4);
  World world = world_of(model);
  world.actors[0].clip = bending_clip(*model, 1.4);
  world.actors.push_back(actor_of(object_of(box_mesh({0.15f, 0.3f, 0.1f}), Vec3(0.6, 0.3, 0.3))));
  return world;
}

TEST_F(SceneRendererTest, EmptyWorldsGiveTheBackdropAndNoError) {
  const Picture nothing = draw(Frame{}, Camera{});
  World world;
  const Picture empty = draw(world, 0, Camera{});
  EXPECT_EQ(difference(nothing, empty), 0.0);
  world.actors.emplace_back();  // an actor without a model
  EXPECT_EQ(difference(nothing, draw(world, 0, Camera{})), 0.0);
  world.actors[0].model = std::make_shared<Model>();
  EXPECT_EQ(difference(nothing, draw(world, 0, Camera{})), 0.0);
  // Lighter in the middle than at the edge, dark throughout.
  const auto level = [&](int x, int y) { return nothing.pixel(x, y) & 0xffu; };
  EXPECT_GT(level(80, 50), level(1, 1));
  EXPECT_LT(level(80, 50), 0x80u);
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(SceneRendererTest, SphereIsWhereItsProjectionIs) {
  const World world = world_of(object_of(sphere_mesh(1.0f, 64, 128), Vec3(3, 2, -1)));
  Camera camera;
  camera.focus = Vec3(3, 2, -1);
  camera.distance = 4;
  camera.azimuth = 0.7;
  camera.elevation = 0.3;
  for (const bool orthographic : {false, true}) {
    camera.orthographic = orthographic;
    const int side = 200;
    std::vector<ActorState> states;
    world_state_at(world, 0, states);
    Frame frame;
    frame.world = &world;
    frame.states = &states;
    const auto picks = renderer().pick_all(frame, camera, {side, side});
    const double tangent = std::tan(0.5 * camera.field_of_view);
    const double radius = orthographic ? 1.0 / (4.0 * tangent) : 1.0 / (std::sqrt(15.0) * tangent);
    int wrong = 0;
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const double r = std::hypot(x + 0.5 - 0.5 * side, y + 0.5 - 0.5 * side) / (0.5 * side);
        if (std::abs(r - radius) < 2.0 / side) continue;  // within a pixel of the rim
        const Pick& pick = picks[static_cast<std::size_t>(y * side + x)];
        if (pick.hit() != (r < radius)) ++wrong;
        if (pick.hit()) {
          EXPECT_NEAR(glm::length(pick.place - camera.focus), 1.0, 3e-3);
        }
      }
    }
    EXPECT_EQ(wrong, 0);
    // The picture agrees: the middle is lit surface, the corner backdrop.
    const Picture picture = draw(world, 0, camera, {}, side, side);
    EXPECT_GT(picture.pixel(100, 100) >> 16, 0x60u);
    EXPECT_LT(picture.pixel(2, 2) >> 16, 0x40u);
    const Pick middle = renderer().pick(100, 100);
    EXPECT_EQ(middle.actor, 0);
    EXPECT_FALSE(renderer().pick(2, 2).hit());
  }
}

TEST_F(SceneRendererTest, PicturesDoNotDependOnUnitsNorOnTheDistanceFromTheOrigin) {
  World world = lopsided();
  const Camera camera = three_quarter(world, 1);
  const Picture original = draw(world, 1, camera);
  // Centimetres for metres: two decades, so the grid's lines fall alike.
  Mat4 scale = glm::scale(Mat4(1.0), Vec3(100.0));
  World large = world;
  for (auto& actor : large.actors) actor.world_from_file = scale;
  Camera far = camera;
  far.focus *= 100.0;
  far.distance *= 100.0;
  EXPECT_LT(difference(original, draw(large, 1, far)), 0.3);
  // A million metres away, by a whole number of grid lines.
  World away = world;
  const Vec3 shift(1e6, 0, -2e6);
  for (auto& actor : away.actors) actor.world_from_file[3] += glm::dvec4(shift, 0);
  Camera there = camera;
  there.focus += shift;
  EXPECT_LT(difference(original, draw(away, 1, there)), 0.3);
}

TEST_F(SceneRendererTest, MirroredPlacementGivesTheMirroredPicture) {
  World world = lopsided();
  Style style;
  Camera camera = three_quarter(world, 1);
  const Picture original = draw(world, 1, camera, style);
  ASSERT_GT(difference(original, flipped(original)), 3.0);
  World mirrored = world;
  for (auto& actor : mirrored.actors) actor.world_from_file = glm::scale(Mat4(1.0), Vec3(-1, 1, 1));
  camera.focus.x = -camera.focus.x;
  camera.azimuth = -camera.azimuth;
  style.key_azimuth = -style.key_azimuth;
  // The dither and the shadow's pattern stay as they are, so a little remains.
  EXPECT_LT(difference(original, flipped(draw(mirrored, 1, camera, style))), 1.0);
}

TEST_F(SceneRendererTest, SingleSidedMaterialsAreSeenFromOutsideOnly) {
  for (const double mirror : {1.0, -1.0}) {
    // The eye is inside the box: with culling one looks through its walls.
    auto model = object_of(box_mesh(glm::vec3(1.0f)));
    Material material;
    model->materials.push_back(material);
    model->meshes[0].material = 0;
    World world = world_of(model, glm::scale(Mat4(1.0), Vec3(mirror, 1, 1)));
    Camera camera;
    camera.focus = Vec3(0.0);
    camera.distance = 0.5;
    Style style;
    style.ground = false;
    const Picture through = draw(world, 0, camera, style);
    const Picture backdrop = draw(Frame{}, camera, style);
    EXPECT_LT(difference(through, backdrop), 0.2);
    camera.distance = 6;
    EXPECT_GT(difference(draw(world, 0, camera, style), draw(Frame{}, camera, style)), 3.0);
    camera.distance = 0.5;
    model->materials[0].double_sided = true;
    EXPECT_GT(difference(draw(world, 0, camera, style), backdrop), 5.0);
  }
}

TEST_F(SceneRendererTest, TrianglesInContactAndContactPlacesGlow) {
  const World world = world_of(object_of(sphere_mesh(1.0f), Vec3(0, 1, 0)));
  std::vector<ActorState> states;
  world_state_at(world, 0, states);
  Frame frame;
  frame.world = &world;
  frame.states = &states;
  Camera camera;
  camera.focus = Vec3(0, 1, 0);
  camera.distance = 5;
  const Picture plain = draw(frame, camera);
  const Pick pick = renderer().pick(80, 60);
  ASSERT_TRUE(pick.hit());
  const auto& mesh = world.actors[0].model->meshes[0];
  TriangleGlow glow{0, 0, std::vector<std::uint8_t>(mesh.triangles.size(), 0)};
  // Every triangle about the one in the middle; those on the left stay.
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto p = mesh.positions[mesh.triangles[t][0]];
    if (p.x > -0.3f) glow.levels[t] = 255;
  }
  frame.glows.push_back(glow);
  const Picture glowing = draw(frame, camera);
  EXPECT_LT(warmth(plain.pixel(80, 60)), 30);
  EXPECT_GT(warmth(glowing.pixel(80, 60)), 60);
  EXPECT_LT(std::abs(warmth(glowing.pixel(52, 60)) - warmth(plain.pixel(52, 60))), 6);

  frame.glows.clear();
  ContactMark mark;
  mark.place = pick.place;
  mark.radius = 0.2;
  mark.ring = false;
  frame.contacts.push_back(mark);
  const Picture contact = draw(frame, camera);
  EXPECT_GT(warmth(contact.pixel(80, 60)), 60);
  EXPECT_LT(std::abs(warmth(contact.pixel(52, 60)) - warmth(plain.pixel(52, 60))), 6);
  frame.contacts[0].ring = true;
  EXPECT_GT(difference(contact, draw(frame, camera)), 0.01);
  // What is out of range or not a number is ignored.
  frame.contacts = {ContactMark{Vec3(kNan)}};
  frame.glows = {TriangleGlow{7, 0, {255}}, TriangleGlow{0, 9, {255}}, TriangleGlow{-1, -1, {}}};
  EXPECT_LT(difference(plain, draw(frame, camera)), 0.01);
}

TEST_F(SceneRendererTest, GhostsAreTranslucentAndHiddenByWhatStandsBefore) {
  const auto ball = object_of(sphere_mesh(0.5f), Vec3(0, 0.5, 0));
  const World scene = world_of(ball);
  World elsewhere = world_of(ball, glm::translate(Mat4(1.0), Vec3(1.2, 0, 0)));
  std::vector<ActorState> states, ghost_states;
  world_state_at(scene, 0, states);
  world_state_at(elsewhere, 0, ghost_states);
  Frame frame;
  frame.world = &scene;
  frame.states = &states;
  Camera camera;
  camera.focus = Vec3(0.6, 0.5, 0);
  camera.distance = 7;
  const Picture plain = draw(frame, camera);
  frame.ghosts.push_back({&elsewhere.actors[0], &ghost_states[0]});
  const Picture with = draw(frame, camera);
  // The ghost's middle is violet, yet darker than a solid of that colour; the solid is as it was.
  const Vec3 there = project(camera, 4.0 / 3.0, Vec3(1.2, 0.5, 0));
  const Vec3 here = project(camera, 4.0 / 3.0, Vec3(0, 0.5, 0));
  const auto at = [](const Picture& p, const Vec3& v) {
    return p.pixel(static_cast<int>(v.x * p.width), static_cast<int>(v.y * p.height));
  };
  EXPECT_GT(at(with, there) & 0xffu, (at(plain, there) & 0xffu) + 30);
  EXPECT_LT(at(with, there) & 0xffu, 0xfau - 40);
  EXPECT_EQ(at(with, here), at(plain, here));
  // Behind the solid nothing of it is seen.
  elsewhere.actors[0].world_from_file = glm::translate(Mat4(1.0), Vec3(-0.5, 0, -5));
  world_state_at(elsewhere, 0, ghost_states);
  Camera in_line = camera;
  in_line.focus = Vec3(0, 0.5, 0);
  in_line.azimuth = std::atan2(0.5, 5.0);
  Frame only = frame;
  only.ghosts.clear();
  EXPECT_LT(difference(draw(only, in_line), draw(frame, in_line)), 0.05);
  // The part of a figure only: a mask of nothing draws nothing.
  frame.ghosts[0].parts.assign(ball->skeleton.joints.size(), 0.0f);
  EXPECT_LT(difference(draw(only, camera), draw(frame, camera)), 0.01);
}

TEST_F(SceneRendererTest, TrailsAndMarkersAreDrawnFaintlyThroughBodies) {
  const World world = world_of(object_of(sphere_mesh(0.5f), Vec3(0, 0.5, 0)));
  std::vector<ActorState> states;
  world_state_at(world, 0, states);
  Frame frame;
  frame.world = &world;
  frame.states = &states;
  Camera camera;
  camera.focus = Vec3(0, 0.5, 0);
  camera.distance = 6;
  const Picture plain = draw(frame, camera);
  Trail trail;
  trail.points = {Vec3(-1.2, 0.5, -1), Vec3(1.2, 0.5, -1)};  // behind the sphere
  trail.colours = {0x3ecf9a};
  trail.width = 4;
  frame.trails.push_back(trail);
  const Picture with = draw(frame, camera);
  const auto green = [](Rgb c) { return static_cast<int>(c >> 8 & 0xffu); };
  EXPECT_GT(green(with.pixel(47, 60)), green(plain.pixel(47, 60)) + 60);
  const int through = std::abs(static_cast<int>(with.pixel(80, 60) >> 16 & 0xffu) -
                               static_cast<int>(plain.pixel(80, 60) >> 16 & 0xffu));
  EXPECT_GT(through, 5);
  EXPECT_LT(through, 80);
  frame.trails[0].points = {Vec3(kNan), Vec3(1), Vec3(kNan)};
  frame.markers = {Marker{Vec3(kNan)}};
  EXPECT_LT(difference(plain, draw(frame, camera)), 0.01);
  // A line past the eye does not turn round.
  frame.trails[0].points = {Vec3(0, 0.2, -20), Vec3(0, 0.2, 40)};
  const Picture past = draw(frame, camera);
  EXPECT_LT(difference(plain, past), 12.0);
}

TEST_F(SceneRendererTest, MeshesThatAreNotFiniteAreLeftOutAndTheRestStays) {
  World world = lopsided();
  const Camera camera = three_quarter(world, 1);
  const Picture sound = draw(world, 1, camera);
  // A pose that is not a number: the actor is left out, the other stays.
  World broken = world;
  Mat4 place(1.0);
  place[3][1] = kNan;
  broken.actors.push_back(actor_of(object_of(box_mesh(glm::vec3(0.3f))), place));
  EXPECT_LT(difference(sound, draw(broken, 1, camera)), 0.01);
  // Vertices that are not numbers, indices out of range: those triangles alone are left out.
  Mesh box = box_mesh(glm::vec3(0.3f));
  for (auto& p : box.positions) p.x = std::numeric_limits<float>::infinity();
  box.triangles.emplace_back(0, 1, 4000000000u);
  World odd = world;
  odd.actors.push_back(actor_of(object_of(box)));
  EXPECT_LT(difference(sound, draw(odd, 1, camera)), 0.01);
  // Cameras and styles that are not numbers still give a picture.
  Camera strange;
  strange.focus = Vec3(kNan);
  strange.distance = kNan;
  strange.azimuth = std::numeric_limits<double>::infinity();
  strange.field_of_view = -3;
  EXPECT_FALSE(draw(world, 1, strange).empty());
  EXPECT_FALSE(draw(world, kNan, camera).empty());
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(SceneRendererTest, SizesOutOfRangeAreClampedOrRefused) {
  const World world = lopsided();
  const Camera camera = three_quarter(world, 1);
  const Picture dot = draw(world, 1, camera, {}, -5, 0);
  EXPECT_EQ(dot.width, 1);
  EXPECT_EQ(dot.height, 1);
  const auto refused = renderer().draw(world, 1, camera, {}, {2000000000, 2000000000});
  ASSERT_FALSE(refused.ok());
  EXPECT_FALSE(refused.error().remedy.empty());
  EXPECT_TRUE(renderer().read().empty());
  EXPECT_FALSE(renderer().pick(0, 0).hit());
  EXPECT_FALSE(draw(world, 1, camera).empty());
}

TEST_F(SceneRendererTest, PresentsTheVeryBytesThatItReads) {
  const World world = lopsided();
  const Picture picture = draw(world, 1, three_quarter(world, 1), {}, 64, 48);
  unsigned texture = 0, framebuffer = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &texture);
  glTextureStorage2D(texture, 1, GL_RGBA8, 64, 48);
  glCreateFramebuffers(1, &framebuffer);
  glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, texture, 0);
  renderer().present(framebuffer, 0, 0);
  std::vector<std::uint8_t> shown(4 * 64 * 48);
  glGetTextureImage(texture, 0, GL_RGBA, GL_UNSIGNED_BYTE, static_cast<GLsizei>(shown.size()),
                    shown.data());
  glDeleteFramebuffers(1, &framebuffer);
  glDeleteTextures(1, &texture);
  int wrong = 0;
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      const auto* p = &shown[static_cast<std::size_t>(4 * ((47 - y) * 64 + x))];
      const Rgb colour = (Rgb{p[0]} << 16) | (Rgb{p[1]} << 8) | Rgb{p[2]};
      if (colour != picture.pixel(x, y)) ++wrong;
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_NE(renderer().texture(), 0u);
  // Drawing again gives the same bytes.
  EXPECT_EQ(difference(picture, draw(world, 1, three_quarter(world, 1), {}, 64, 48)), 0.0);
}

TEST_F(SceneRendererTest, TrailsHaveTheColourOfEachPoint) {
  Frame frame;
  Trail trail;
  for (int i = 0; i <= 8; ++i) {
    trail.points.emplace_back(-0.8 + 0.2 * i, 0.6, 0);
    trail.colours.push_back(i < 4 ? 0x3ecf9au : 0xff7a45u);  // clear, then colliding
  }
  trail.width = 6;
  frame.trails = {trail};
  Camera camera;
  camera.focus = Vec3(0, 0.6, 0);
  Style style;
  style.ground = false;
  for (const bool draft : {false, true}) {
    style.draft = draft;
    style.samples = draft ? 1 : 4;
    const Picture picture = draw(frame, camera, style);
    const auto at = [&](double x) {
      const Vec3 p = project(camera, 160.0 / 120.0, Vec3(x, 0.6, 0));
      return picture.pixel(static_cast<int>(p.x * 160), static_cast<int>(p.y * 120));
    };
    EXPECT_EQ(at(-0.5), 0x3ecf9au);
    EXPECT_EQ(at(0.5), 0xff7a45u);
  }
}

// Frames drawn over a kept scene are the frames themselves.
TEST_F(SceneRendererTest, KeptScenesGiveTheSamePictures) {
  const World world = lopsided();
  std::vector<ActorState> states, later;
  world_state_at(world, 0.5, states);
  world_state_at(world, 0.9, later);
  const Camera camera = three_quarter(world, 0.5);
  Frame frame;
  frame.world = &world;
  frame.states = &states;
  const Frame plain = frame;
  Frame ghost = plain;
  ghost.ghosts.push_back({&world.actors[0], &later[0]});
  Frame marked = plain;
  marked.markers.push_back({Vec3(0.1, 0.8, 0.2)});
  Frame glowing = plain;
  glowing.contacts.push_back({Vec3(0.0, 0.8, 0.2), 0.3, false});
  Frame emphasized = plain;
  emphasized.looks.resize(1);
  emphasized.looks[0].emphasis.assign(
      static_cast<std::size_t>(world.actors[0].model->skeleton.size()), 1.0f);
  emphasized.looks[0].emphasis_strength = 1;
  Frame recoloured = emphasized;
  recoloured.looks[0].emphasis_colour = 0xff0000;
  Frame moved = plain;
  moved.states = &later;
  Frame hidden = plain;
  hidden.looks.resize(1);
  hidden.looks[0].visible = false;
  Frame hot = plain;
  hot.glows.push_back({0, 0, std::vector<std::uint8_t>(50, 255)});
  const Frame frames[] = {plain,      ghost, marked, glowing, emphasized,
                          recoloured, moved, hidden, hot,     ghost};
  for (const int samples : {1, 4}) {
    Style style;
    style.samples = samples;
    std::vector<Picture> want;
    for (const Frame& each : frames) want.push_back(draw(each, camera, style));
    for (std::size_t k = 1; k + 1 < want.size(); ++k) {
      EXPECT_GT(difference(want[0], want[k]), 0.0) << k;
    }
    for (std::size_t a = 0; a < want.size(); ++a) {
      for (std::size_t b = 0; b < want.size(); ++b) {
        if ((a + 2 * b) % 3 == 0) continue;  // two pairs of three will do
        for (const std::size_t k : {a, b}) {
          Frame kept = frames[k];
          kept.keep_scene = true;
          EXPECT_EQ(difference(draw(kept, camera, style), want[k]), 0.0) << a << " " << b;
        }
      }
    }
    // Another size in between, and another camera.
    Frame kept = plain;
    kept.keep_scene = true;
    (void)draw(kept, camera, style, 80, 60);
    EXPECT_EQ(difference(draw(kept, camera, style), want[0]), 0.0);
    (void)draw(kept, orbited(camera, 1, 0), style);
    EXPECT_EQ(difference(draw(kept, camera, style), want[0]), 0.0);
  }
}

// What is kept from one picture to the next never shows: a renderer that has drawn other pictures
// before draws the same as a fresh one.
TEST_F(SceneRendererTest, KeptFiguresAndShadowsAreThoseOfTheFrame) {
  const World world = lopsided();
  World other = lopsided();
  other.actors[0].clip = bending_clip(*other.actors[0].model, -0.9);
  World without = world;
  without.actors.pop_back();
  const Camera home = three_quarter(world, 0.5);
  const Style style;
  Style draft;
  draft.draft = true;
  Style low = style;
  low.key_elevation = 20;
  Style small = style;
  small.shadow_map_size = 300;
  small.samples = 1;
  const std::vector<std::function<Picture(SceneRenderer&)>> pictures = {
      [&](SceneRenderer& r) { return drawn_by(r, world, 0.5, home, style); },
      [&](SceneRenderer& r) { return drawn_by(r, world, 0.5, orbited(home, 0.4, 0.1), style); },
      [&](SceneRenderer& r) { return drawn_by(r, world, 0.5, panned(home, 0.1, 0.1), style); },
      [&](SceneRenderer& r) { return drawn_by(r, world, 0.9, home, style); },
      [&](SceneRenderer& r) { return drawn_by(r, other, 0.9, home, style); },
      [&](SceneRenderer& r) { return drawn_by(r, without, 0.9, home, style); },
      [&](SceneRenderer& r) { return drawn_by(r, world, 0.5, home, low); },
      [&](SceneRenderer& r) { return drawn_by(r, world, 0.5, home, small); },
      [&](SceneRenderer& r) { return drawn_by(r, world, 0.5, home, draft); },
      [&](SceneRenderer& r) { return drawn_by(r, world, 0.9, home, draft); },
  };
  std::vector<Picture> fresh;
  for (const auto& picture : pictures) {
    auto made = SceneRenderer::create();
    ASSERT_TRUE(made.ok());
    fresh.push_back(picture(*made));
  }
  EXPECT_GT(difference(fresh[0], fresh[3]), 0.0);
  EXPECT_GT(difference(fresh[3], fresh[5]), 0.0);
  // Pairs, one after the other, and an id picture of something else in between.
  for (std::size_t a = 0; a < pictures.size(); ++a) {
    for (std::size_t b = 0; b < pictures.size(); ++b) {
      if ((a + 2 * b) % 3 == 1) continue;  // two of three will do
      (void)pictures[a](renderer());
      if ((a + b) % 2 == 0) {
        std::vector<ActorState> states;
        world_state_at(other, 0.2, states);
        Frame frame;
        frame.world = &other;
        frame.states = &states;
        (void)renderer().pick_all(frame, home, {16, 16});
      }
      EXPECT_EQ(difference(pictures[b](renderer()), fresh[b]), 0.0) << a << " then " << b;
    }
  }
}

TEST_F(SceneRendererTest, DraftsLookLikeThePicture) {
  const World world = lopsided();
  const Camera camera = three_quarter(world, 0.5);
  Style draft;
  draft.draft = true;
  const Picture empty = draw(World{}, 0, camera, draft);
  const Picture full = draw(world, 0.5, camera), fast = draw(world, 0.5, camera, draft);
  EXPECT_GT(difference(full, fast), 0.0);
  EXPECT_LT(difference(full, fast), 0.25 * difference(fast, empty));
}

}  // namespace
}  // namespace elbowroom::test
