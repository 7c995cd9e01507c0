// SPDX-License-Identifier: MIT
// No output takes the place of an input or of another output; outputs appear together or not at
// all.
#include "core/io/run_files.h"

#include <cmath>
#include <set>

#include "core/io/gltf_writer.h"
#include "tests/unit/io_write/folder.h"

namespace elbowroom {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTextured =
    R"({"asset":{"version":"2.0"},"buffers":[{"uri":"walk%20cycle.bin","byteLength":4}],)"
    R"("images":[{"uri":"tex\\skin.png"}],"extensions":{"X":{"uri":"notes.txt"}}})";

class Run : public test::InFolder {
 protected:
  // What is said of one input and one output.
  Status check(const fs::path& in, const fs::path& out) {
    RunFiles files;
    files.reads(in, "the input");
    files.writes(out, "-o");
    return files.check_distinct();
  }
};

TEST_F(Run, KnowsAFileByAnyOfItsNames) {
  const fs::path file = folder_ / "walk.glb";
  spill(file, "x");
  fs::create_directory(folder_ / "sub");
  fs::create_symlink(file, folder_ / "link.glb");
  fs::create_hard_link(file, folder_ / "twin.glb");
  fs::create_directory_symlink(folder_, folder_ / "sub" / "up");
  for (const fs::path& name :
       {file, folder_ / "." / "walk.glb", folder_ / "sub" / ".." / "walk.glb", folder_ / "link.glb",
        folder_ / "twin.glb", folder_ / "sub" / "up" / "walk.glb", fs::relative(file)}) {
    const Status distinct = check(file, name);
    ASSERT_FALSE(distinct.ok()) << name;
    EXPECT_EQ(distinct.error().where, name.string());
    EXPECT_NE(distinct.error().what.find("the input"), std::string::npos);
    EXPECT_NE(distinct.error().what.find("-o"), std::string::npos);
    EXPECT_FALSE(distinct.error().remedy.empty());
  }
  EXPECT_TRUE(check(file, folder_ / "walk2.glb").ok());
  EXPECT_TRUE(check(file, folder_ / "sub" / "walk.glb").ok());
}

TEST_F(Run, KnowsFilesThatAreNotThereYet) {
  fs::create_directory_symlink(folder_, folder_ / "again");
  fs::create_symlink(folder_ / "new.glb", folder_ / "dangling");
  for (const fs::path& name : {folder_ / "x" / ".." / "new.glb", folder_ / "again" / "new.glb",
                               folder_ / "dangling", folder_ / "new.glb"}) {
    RunFiles files;
    files.writes(folder_ / "new.glb", "-o");
    files.writes(name, "--report");
    const Status distinct = files.check_distinct();
    ASSERT_FALSE(distinct.ok()) << name;
    EXPECT_NE(distinct.error().what.find("--report"), std::string::npos);
  }
  RunFiles files;
  files.writes(folder_ / "new.glb", "-o");
  files.writes(folder_ / "New.glb", "--report");
  EXPECT_TRUE(files.check_distinct().ok());
}

TEST_F(Run, ReadsWhatAGltfNames) {
  spill(folder_ / "walk.gltf", kTextured);
  for (const char* named : {"walk cycle.bin", "tex/skin.png", "notes.txt"}) {
    EXPECT_TRUE(check(folder_ / "walk.gltf", folder_ / named).ok()) << named << " isn't there";
    spill(folder_ / named, "1234");
    EXPECT_FALSE(check(folder_ / "walk.gltf", folder_ / named).ok()) << named;
  }
  // Of a GLB just so, and of what is no glTF nothing.
  const std::string json = kTextured;
  std::string glb = "glTF" + std::string("\2\0\0\0", 4) + std::string(4, '\0');
  glb += std::string{static_cast<char>(json.size()), 0, 0, 0} + "JSON" + json;
  ASSERT_LT(json.size(), 256u);
  spill(folder_ / "walk.glb", glb);
  EXPECT_FALSE(check(folder_ / "walk.glb", folder_ / "notes.txt").ok());
  for (const std::string& bytes : {glb.substr(0, 40), std::string("glTF"), std::string(),
                                   json + "}", std::string(20, '\xff')}) {
    spill(folder_ / "odd", bytes);
    EXPECT_TRUE(check(folder_ / "odd", folder_ / "notes.txt").ok());
  }
}

TEST_F(Run, ASceneIsAllOfItsFiles) {
  SceneDescription scene;
  scene.character = folder_ / "ada.glb";
  scene.obstacles = {folder_ / "posts.glb"};
  scene.attachments = {{folder_ / "umbrella.glb", "Hand", {}}};
  for (const char* name : {"ada.glb", "posts.glb", "umbrella.glb"}) {
    RunFiles files;
    files.reads(scene);
    files.writes(folder_ / name, "-o");
    EXPECT_FALSE(files.check_distinct().ok()) << name;
  }
}

TEST_F(Run, AProjectMayBeSavedAgain) {
  spill(folder_ / "p.elbow", "{}");
  RunFiles files;
  files.reads(folder_ / "p.elbow", "the project");
  files.writes(folder_ / "p.elbow", "--save-project", RunFiles::Folders::must_be_there,
               folder_ / "." / "p.elbow");
  EXPECT_TRUE(files.check_distinct().ok());
  files.writes(folder_ / "p.elbow", "-o");
  EXPECT_FALSE(files.check_distinct().ok());
}

TEST_F(Run, PlacesAreCheckedBeforehand) {
  const auto check = [](const fs::path& file,
                        RunFiles::Folders folders = RunFiles::Folders::must_be_there) {
    RunFiles files;
    files.writes(file, "-o", folders);
    return files.check_places();
  };
  EXPECT_TRUE(check(folder_ / "a").ok());
  EXPECT_TRUE(check("a").ok());
  EXPECT_FALSE(check(folder_ / "no" / "a").ok());
  EXPECT_TRUE(check(folder_ / "no" / "no" / "a", RunFiles::Folders::are_made).ok());
  EXPECT_FALSE(fs::exists(folder_ / "no"));
  spill(folder_ / "file", "x");
  EXPECT_FALSE(check(folder_ / "file" / "a").ok());
  EXPECT_FALSE(check(folder_ / "file" / "a", RunFiles::Folders::are_made).ok());
  EXPECT_FALSE(check(folder_).ok());
  EXPECT_FALSE(check("/dev/null").ok());
  if (::geteuid() == 0) return;  // may write anywhere
  fs::create_directory(folder_ / "closed");
  fs::permissions(folder_ / "closed", fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_FALSE(check(folder_ / "closed" / "a").ok());
  fs::permissions(folder_ / "closed", fs::perms::owner_all);
}

TEST_F(Run, WhatIsNotCommittedLeavesNothing) {
  spill(folder_ / "old", "old");
  {
    RunFiles files;
    files.writes(folder_ / "a" / "b" / "c", "--per-file", RunFiles::Folders::are_made);
    ASSERT_TRUE(files.stage(folder_ / "a" / "b" / "c", "new").ok());
    ASSERT_TRUE(files.stage(folder_ / "old", "new").ok());
    EXPECT_FALSE(files.stage(folder_ / "old", "newer").ok());
    EXPECT_FALSE(files.stage(folder_ / "none" / "x", "new").ok());
    EXPECT_TRUE(files.is_staged(folder_ / "." / "old", "new"));
    EXPECT_FALSE(files.is_staged(folder_ / "old", "old"));
    EXPECT_EQ(slurp(files.staged_at(folder_ / "old")), "new");
    EXPECT_TRUE(files.staged_at(folder_ / "other").empty());
    EXPECT_EQ(slurp(folder_ / "old"), "old");
  }
  EXPECT_FALSE(fs::exists(folder_ / "a"));
  EXPECT_EQ(files_in(folder_), 1u);
  RunFiles files;
  ASSERT_TRUE(files.stage(folder_ / "a" / "b" / "c", "new", RunFiles::Folders::are_made).ok());
  ASSERT_TRUE(files.stage(folder_ / "old", "new").ok());
  ASSERT_TRUE(files.commit().ok());
  EXPECT_EQ(slurp(folder_ / "old"), "new");
  EXPECT_EQ(slurp(folder_ / "a" / "b" / "c"), "new");
  EXPECT_EQ(files_in(folder_), 2u);
}

TEST_F(Run, WhatCannotBeCommittedTakesTheRestBack) {
  spill(folder_ / "old", "old");
  RunFiles files;
  ASSERT_TRUE(files.stage(folder_ / "old", "new").ok());
  ASSERT_TRUE(files.stage(folder_ / "fresh", "new").ok());
  ASSERT_TRUE(files.stage(folder_ / "late", "new").ok());
  ASSERT_TRUE(files.stage(folder_ / "after", "new").ok());
  spill(folder_ / "late" / "in the way", "x");  // a folder has come there meanwhile
  EXPECT_FALSE(files.commit().ok());
  EXPECT_EQ(slurp(folder_ / "old"), "old");
  EXPECT_FALSE(fs::exists(folder_ / "fresh"));
  EXPECT_FALSE(fs::exists(folder_ / "after"));
  EXPECT_EQ(files_in(folder_), 2u);
}

TEST_F(Run, WhatIsReadIsNotStagedOver) {
  spill(folder_ / "in.bin", "input");
  RunFiles files;
  files.reads(folder_ / "in.bin", "the input");
  EXPECT_FALSE(files.is_free(folder_ / "in.bin"));
  EXPECT_TRUE(files.is_free(folder_ / "out.bin"));
  EXPECT_FALSE(files.stage(folder_ / "in.bin", "output").ok());
  EXPECT_TRUE(files.commit().ok());
  EXPECT_EQ(slurp(folder_ / "in.bin"), "input");
}

// A rotation of node 0 and what goes with it.
constexpr const char* kAnimated =
    R"({"asset":{"version":"2.0"},"nodes":[{"name":"a"}],"scenes":[{"nodes":[0]}],)"
    R"("buffers":[{"uri":"keys.bin","byteLength":40}],)"
    R"("bufferViews":[{"buffer":0,"byteLength":8},{"buffer":0,"byteOffset":8,"byteLength":32}],)"
    R"("accessors":[{"bufferView":0,"componentType":5126,"count":2,"type":"SCALAR","min":[0],"max":[1]},)"
    R"({"bufferView":1,"componentType":5126,"count":2,"type":"VEC4"}],)"
    R"("animations":[{"name":"turn","channels":[{"sampler":0,"target":{"node":0,"path":"rotation"}}],)"
    R"("samplers":[{"input":0,"output":1}]}]})";

CorrectedClip turn(float y) {
  CorrectedClip clip;
  clip.source_animation = 0;
  Channel channel;
  channel.joint = 0;
  channel.times = {0, 1};
  channel.values = {0, 0, 0, 1, 0, y, 0, std::sqrt(1 - y * y)};
  clip.changed = {channel};
  return clip;
}

TEST_F(Run, BuffersOfOutputsKeepOutOfEachOthersWay) {
  const float keys[10] = {0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  spill(folder_ / "in" / "walk.gltf", kAnimated);
  spill(folder_ / "in" / "keys.bin", std::string(reinterpret_cast<const char*>(keys), 40));
  const std::string source = slurp(folder_ / "in" / "keys.bin");
  // An older out.gltf named what another file of the scene needs.
  spill(folder_ / "out.gltf", R"({"asset":{"version":"2.0"},"buffers":[{"uri":"out.bin"}]})");
  spill(folder_ / "out.bin", "of the obstacle");
  spill(folder_ / "post.gltf", R"({"asset":{"version":"2.0"},"buffers":[{"uri":"out.bin"}]})");

  RunFiles files;
  files.reads(folder_ / "in" / "walk.gltf", "the character");
  files.reads(folder_ / "post.gltf", "an obstacle");
  files.writes(folder_ / "out.gltf", "-o");
  files.writes(folder_ / "out-2.gltf", "--alternatives");
  ASSERT_TRUE(files.check_distinct().ok());
  for (const auto& [name, y] : {std::pair("out.gltf", 0.1f), std::pair("out-2.gltf", 0.2f)}) {
    ExportReport report;
    const Status staged =
        stage_corrected(folder_ / "in" / "walk.gltf", folder_ / name, {turn(y)}, files, &report);
    ASSERT_TRUE(staged.ok()) << staged.error().message();
  }
  EXPECT_EQ(slurp(folder_ / "out.gltf").find("keys.bin"), std::string::npos);
  ASSERT_TRUE(files.commit().ok());
  EXPECT_EQ(slurp(folder_ / "out.bin"), "of the obstacle");
  EXPECT_EQ(slurp(folder_ / "in" / "keys.bin"), source);
  EXPECT_EQ(slurp(folder_ / "keys.bin"), source);  // one copy serves both
  // out.gltf, out-2.gltf, keys.bin and a buffer each, beside the four of before.
  std::set<fs::path> names;
  for (const auto& entry : fs::directory_iterator(folder_)) names.insert(entry.path().filename());
  EXPECT_EQ(names, (std::set<fs::path>{"in", "keys.bin", "out-2.bin", "out-2.gltf", "out.bin",
                                       "out.gltf", "out-2-2.bin", "post.gltf"}))
      << testing::PrintToString(names);
}

}  // namespace
}  // namespace elbowroom
