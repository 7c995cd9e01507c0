// SPDX-License-Identifier: MIT
// What the command line's arguments mean.
#include "app/options.h"

#include <gtest/gtest.h>

namespace elbowroom {
namespace {

TEST(Attachment, JointAlone) {
  const auto attached = parse_attachment("some where/o@x.glb@mixamorig:RightHand");
  ASSERT_TRUE(attached.ok());
  EXPECT_EQ(attached->file, "some where/o@x.glb");
  EXPECT_EQ(attached->joint, "mixamorig:RightHand");
  EXPECT_EQ(attached->joint_from_object.translation, Vec3(0.0));
}

TEST(Attachment, PlaceAndRotation) {
  const auto attached = parse_attachment("o.glb@Hand,1,-2.5,3e-1,0,0,2,0");
  ASSERT_TRUE(attached.ok());
  EXPECT_EQ(attached->joint, "Hand");
  EXPECT_EQ(attached->joint_from_object.translation, Vec3(1, -2.5, 0.3));
  EXPECT_EQ(attached->joint_from_object.rotation, Quat(0, 0, 0, 1));  // w first: made unit
}

TEST(Attachment, JointNamesMayHoldCommas) {
  const auto attached = parse_attachment("o.glb@Hand, left,1,2,3");
  ASSERT_TRUE(attached.ok());
  EXPECT_EQ(attached->joint, "Hand, left");
  EXPECT_EQ(attached->joint_from_object.translation, Vec3(1, 2, 3));
}

TEST(Attachment, RefusesWhatIsNoAttachment) {
  for (const char* text : {"", "o.glb", "@Hand", "o.glb@", "o.glb@Hand,1", "o.glb@Hand,1,2",
                           "o.glb@Hand,1,2,3,4", "o.glb@Hand,1,2,3,0,0,0,0"})
    EXPECT_FALSE(parse_attachment(text).ok()) << text;
}

TEST(Window, BeginAndEndOrAuto) {
  EXPECT_FALSE(parse_window("auto")->has_value());
  const auto window = parse_window("1.25:2");
  ASSERT_TRUE(window.ok() && window->has_value());
  EXPECT_EQ((*window)->lower, 1.25);
  EXPECT_EQ((*window)->upper, 2);
  for (const char* text :
       {"", ":", "1", "1:", ":2", "2:1", "1:1", "a:b", "nan:1", "0:inf", "1:2:3"})
    EXPECT_FALSE(parse_window(text).ok()) << text;
}

TEST(Times, AListOfSeconds) {
  const auto times = parse_times("0,0.5,-1");
  ASSERT_TRUE(times.ok());
  EXPECT_EQ(*times, (std::vector<double>{0, 0.5, -1}));
  for (const char* text : {"", "1,,2", "x", "1;2", "nan"})
    EXPECT_FALSE(parse_times(text).ok()) << text;
}

TEST(SceneOptions, AProjectAndACharacterExcludeEachOther) {
  SceneOptions options;
  EXPECT_FALSE(check_scene_options(options).ok());
  options.character = "a.glb";
  EXPECT_TRUE(check_scene_options(options).ok());
  EXPECT_TRUE(document_from(options).ok());
  options.obstacles = {""};
  EXPECT_FALSE(check_scene_options(options).ok());
  options.obstacles.clear();
  options.attachments = {"o.glb"};
  EXPECT_FALSE(check_scene_options(options).ok());
  options.attachments.clear();
  options.project = "p.elbow";
  EXPECT_FALSE(check_scene_options(options).ok());
}

TEST(Numbers, AreFiniteAndTheErrorNamesTheOption) {
  EXPECT_EQ(*parse_number("-0.5", "--at"), -0.5);
  EXPECT_EQ(*parse_length("0", "--clearance"), 0);
  for (const char* text : {"", "nan", "inf", "1e999", "0x10", "1 ", "one"}) {
    ASSERT_FALSE(parse_number(text, "--at").ok()) << text;
    EXPECT_EQ(parse_number(text, "--at").error().where, "--at");
    EXPECT_FALSE(parse_length(text, "--clearance").ok()) << text;
  }
  EXPECT_FALSE(parse_length("-1e-9", "--clearance").ok());
}

TEST(Seed, IsAWholeNumberOf64Bits) {
  EXPECT_EQ(*parse_seed("0"), 0u);
  EXPECT_EQ(*parse_seed("18446744073709551615"), 18446744073709551615ull);
  for (const char* text :
       {"", "-1", "+1", "1.5", "1e3", "18446744073709551616", "99999999999999999999999", "x"}) {
    ASSERT_FALSE(parse_seed(text).ok()) << text;
    EXPECT_EQ(parse_seed(text).error().where, "--seed");
  }
}

TEST(Places, AreOnesThatAFloatCanHoldTheSquareOf) {
  EXPECT_TRUE(parse_target("1e17,0,-1e17").ok());
  EXPECT_TRUE(parse_attachment("o.glb@Hand,0,1e17,0").ok());
  for (const char* text : {"1e200,0,0", "0,-1e19,0", "0,0,1e39"}) {
    EXPECT_FALSE(parse_target(text).ok()) << text;
    EXPECT_FALSE(parse_attachment(std::string("o.glb@Hand,") + text).ok()) << text;
  }
}

}  // namespace
}  // namespace elbowroom
