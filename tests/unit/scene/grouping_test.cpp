// SPDX-License-Identifier: MIT
#include "core/scene/grouping.h"

#include <gtest/gtest.h>

#include "tests/unit/scene/figures.h"

namespace elbowroom {
namespace {

using test::add_joint;
using test::add_mesh;
using test::add_skin;

const std::vector<glm::vec3> kTriangle{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}};

// A character of two joints below `parent`; returns its upper joint.
int add_character(Model& model, const std::string& name, int parent) {
  const int top = add_joint(model, name, parent, {0, 0, 0});
  const int hips = add_joint(model, "hips", top, {0, 1, 0});
  const int head = add_joint(model, "head", hips, {0, 1, 0});
  const int skin = add_skin(model, {hips, head});
  const int node = add_joint(model, "body", top, {0, 0, 0});
  add_mesh(model, node, skin, kTriangle, {0, 1, 0});
  return hips;
}

TEST(Grouping, TwoFiguresInOneSceneAreTwoCharacters) {
  Model model;
  const int scene = add_joint(model, "scene", -1, {0, 0, 0});
  add_character(model, "anna", scene);
  add_character(model, "bert", scene);
  link_skeleton(model.skeleton);
  group_characters_and_objects(model);
  ASSERT_EQ(model.characters.size(), 2u);
  EXPECT_EQ(model.characters[0].name, "anna");
  EXPECT_EQ(model.characters[1].name, "bert");
  EXPECT_EQ(model.characters[1].meshes, std::vector<int>{1});
  EXPECT_TRUE(model.objects.empty());
}

TEST(Grouping, ALoneFigureIsNamedByItsTopmostNode) {
  Model model;
  add_character(model, "anna", add_joint(model, "scene", -1, {0, 0, 0}));
  link_skeleton(model.skeleton);
  group_characters_and_objects(model);
  ASSERT_EQ(model.characters.size(), 1u);
  EXPECT_EQ(model.characters[0].name, "scene");
}

TEST(Grouping, SkinsWhoseJointsHangTogetherAreOneCharacter) {
  Model model;
  const int hips = add_character(model, "anna", -1);
  const int hair = add_joint(model, "hair", hips + 1, {0, 0.2, 0});  // below the head
  const int skin = add_skin(model, {hair});
  add_mesh(model, hair, skin, kTriangle, {0, 0, 0});
  link_skeleton(model.skeleton);
  group_characters_and_objects(model);
  ASSERT_EQ(model.characters.size(), 1u);
  EXPECT_EQ(model.characters[0].skins, (std::vector<int>{0, 1}));
  EXPECT_EQ(model.characters[0].joints, (std::vector<int>{hips, hips + 1, hair}));
  EXPECT_EQ(model.characters[0].triangles, 2);
}

TEST(Grouping, ASwordInTheHandBelongsToTheCharacter) {
  Model model;
  const int hips = add_character(model, "anna", -1);
  const int grip = add_joint(model, "grip", hips + 1, {1, 0, 0});
  const int sword = add_joint(model, "sword", grip, {0, 0, 0});
  add_mesh(model, sword, -1, kTriangle);
  const int table = add_joint(model, "table", -1, {3, 0, 0});
  const int cup = add_joint(model, "cup", table, {0, 1, 0});
  add_mesh(model, table, -1, kTriangle);
  add_mesh(model, cup, -1, kTriangle);
  link_skeleton(model.skeleton);
  group_characters_and_objects(model);
  ASSERT_EQ(model.characters.size(), 1u);
  EXPECT_EQ(model.characters[0].meshes, (std::vector<int>{0, 1}));
  ASSERT_EQ(model.objects.size(), 1u) << "the cup hangs below the table";
  EXPECT_EQ(model.objects[0].name, "table");
  EXPECT_EQ(model.objects[0].triangles, 2);
  EXPECT_FALSE(model.objects[0].animated);
}

TEST(Grouping, UnusedSkinsMakeACharacterOnlyWhereAllAreUnused) {
  Model clip_only;
  const int hips = add_joint(clip_only, "hips", -1, {0, 1, 0});
  const int head = add_joint(clip_only, "head", hips, {0, 0.75, 0});
  add_skin(clip_only, {hips, head});
  group_characters_and_objects(clip_only);
  ASSERT_EQ(clip_only.characters.size(), 1u);
  EXPECT_EQ(clip_only.characters[0].triangles, 0);
  EXPECT_NEAR(clip_only.characters[0].height, 0.75, 1e-12);

  Model model;
  add_character(model, "anna", -1);
  const int other = add_joint(model, "other", -1, {0, 0, 0});
  add_skin(model, {other});
  group_characters_and_objects(model);
  EXPECT_EQ(model.characters.size(), 1u);
}

TEST(Grouping, AnObjectThatAClipMovesIsAnimated) {
  Model model;
  const int root = add_joint(model, "root", -1, {0, 0, 0});
  const int ball = add_joint(model, "ball", root, {0, 0, 0});
  const int wall = add_joint(model, "wall", root, {0, 0, 0});
  add_mesh(model, ball, -1, kTriangle);
  add_mesh(model, wall, -1, kTriangle);
  link_skeleton(model.skeleton);
  Channel channel;
  channel.joint = ball;
  channel.path = Path::translation;
  channel.components = 3;
  channel.times = {0, 1};
  channel.values = {0, 0, 0, 0, 0, 0};
  Clip clip;
  clip.channels.push_back(channel);
  model.clips.push_back(clip);
  group_characters_and_objects(model);
  ASSERT_EQ(model.objects.size(), 2u);
  EXPECT_FALSE(model.objects[0].animated) << "all its keys are the same";
  model.clips[0].channels[0].values[4] = 1;
  group_characters_and_objects(model);
  EXPECT_TRUE(model.objects[0].animated);
  EXPECT_FALSE(model.objects[1].animated);
  model.clips[0].channels[0].joint = root;
  group_characters_and_objects(model);
  EXPECT_TRUE(model.objects[1].animated) << "moved by what it hangs on";
}

TEST(Grouping, AHeightIsNeverZero) {
  Model model;
  const int lone = add_joint(model, "lone", -1, {0, 0, 0});
  const int skin = add_skin(model, {lone});
  group_characters_and_objects(model);
  EXPECT_EQ(model.characters.at(0).height, 1.0);
  // A rug: flat along up.
  add_mesh(model, lone, skin, {{0, 0, 0}, {3, 0, 0}, {0, 0, 4}}, {0, 0, 0});
  group_characters_and_objects(model);
  EXPECT_NEAR(model.characters.at(0).height, 5.0, 1e-9);
}

TEST(FindClip, TakesANameBeforeANumber) {
  Model model;
  for (const char* name : {"1", "walk", "", "walk"}) {
    model.clips.emplace_back();
    model.clips.back().name = name;
  }
  EXPECT_EQ(model.find_clip("walk"), 1);
  EXPECT_EQ(model.find_clip("1"), 0);
  EXPECT_EQ(model.find_clip("3"), 3);
  EXPECT_EQ(model.find_clip("4"), -1);
  EXPECT_EQ(model.find_clip("-1"), -1);
  EXPECT_EQ(model.find_clip("2x"), -1);
  EXPECT_EQ(model.find_clip("99999999999999999999"), -1);
}

}  // namespace
}  // namespace elbowroom
