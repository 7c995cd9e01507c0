// SPDX-License-Identifier: MIT
// Names are for people: a character whose joints are called something else, or nothing, gets the
// same bytes of motion.
#include <cstdint>
#include <cstring>

#include "tests/cli/program.h"
#include "tests/support/cli_scene.h"

namespace elbowroom::test {
namespace {

struct Glb {
  nlohmann::ordered_json json;
  std::string binary;
};

std::uint32_t word(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

Glb read_glb(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  Glb glb;
  if (bytes.size() < 20) return glb;
  const std::size_t json = word(bytes, 12);
  glb.json = nlohmann::ordered_json::parse(bytes.substr(20, json), nullptr, false);
  if (bytes.size() >= 28 + json) glb.binary = bytes.substr(28 + json, word(bytes, 20 + json));
  return glb;
}

void write_glb(const std::filesystem::path& file, const Glb& glb) {
  std::string json = glb.json.dump();
  while (json.size() % 4 != 0) json += ' ';
  std::string bytes = "glTF";
  const auto put = [&](std::size_t value) {
    const auto v = static_cast<std::uint32_t>(value);
    bytes.append(reinterpret_cast<const char*>(&v), 4);
  };
  put(2);
  put(12 + 8 + json.size() + 8 + glb.binary.size());
  put(json.size());
  bytes += "JSON" + json;
  put(glb.binary.size());
  bytes += std::string("BIN\0", 4) + glb.binary;
  std::ofstream(file, std::ios::binary) << bytes;
}

// Node names of another tool's habit would do as well; these say nothing at all.
Glb renamed(Glb glb) {
  int i = 0;
  for (auto& node : glb.json["nodes"]) {
    node.erase("name");
    if (++i % 3 != 0) node["name"] = "x" + std::to_string(i * 7919 % 1009);
  }
  glb.json.erase("extensions");
  return glb;
}

TEST(RenamedRig, GetsTheSameBytesOfMotion) {
  std::vector<std::filesystem::path> files = {kDemo / "mannequin.glb"};
  if (!samples_dir().empty())
    for (const char* name : {"khronos/CesiumMan.glb", "kaykit/Knight.glb"})
      files.push_back(samples_dir() / "humanoids" / name);
  int compared = 0;
  for (const auto& file : files) {
    SCOPED_TRACE(file.filename().string());
    const auto model = read_gltf(file);
    ASSERT_TRUE(model.ok());
    const Character& figure = (*model)->characters.front();
    const Folder folder;
    write_glb(folder / "named.glb", read_glb(file));
    write_glb(folder / "nameless.glb", renamed(read_glb(file)));
    for (const Limb& limb : find_limbs(**model, figure).limbs) {
      const auto post = post_in_the_way(**model, figure, limb, -1);
      if (!post) continue;
      SCOPED_TRACE(limb.name);
      ASSERT_TRUE(write_post(*post, folder / "post.glb"));
      std::array<std::string, 2> motion;
      std::array<int, 2> exit_codes{};
      for (std::size_t i = 0; i < 2; ++i) {
        const auto out = folder / ("out" + std::to_string(i) + ".glb");
        std::filesystem::remove(out);
        exit_codes[i] =
            run_program(kProgram,
                        {"correct", "--character", folder / (i == 0 ? "named.glb" : "nameless.glb"),
                         "--clip", std::to_string(post->clip), "--limb", limb.name, "--obstacles",
                         folder / "post.glb", "-o", out})
                .exit_code;
        if (std::filesystem::exists(out)) motion[i] = read_glb(out).binary;
      }
      EXPECT_EQ(exit_codes[0], exit_codes[1]);
      EXPECT_TRUE(motion[0] == motion[1]);
      compared += exit_codes[0] == 0 && !motion[0].empty();
    }
  }
  EXPECT_GT(compared, 0);
  std::printf("%d corrections compared\n", compared);
}

}  // namespace
}  // namespace elbowroom::test
