// SPDX-License-Identifier: MIT
// Files that mean harm or make no sense: each is refused by an error that names the place, quickly,
// and without opening anything outside its folder.
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <chrono>
#include <functional>
#include <limits>

#include "core/io/gltf_reader.h"
#include "tests/unit/io_read/gltf_maker.h"
#include "tests/unit/io_read/model_checks.h"

namespace elbowroom {
namespace {

namespace fs = std::filesystem;
using test::GltfMaker;
using test::Json;
using test::TemporaryFolder;

// Reads what `change` makes of a file that has something of everything, and expects a refusal whose
// message holds all of `words`.
void expect_refused(const std::function<void(GltfMaker&)>& change,
                    const std::vector<std::string>& words) {
  GltfMaker maker = test::everything();
  change(maker);
  const TemporaryFolder folder;
  const auto begin = std::chrono::steady_clock::now();
  const auto model = read_gltf(test::write_file(folder.path() / "bad.glb", maker.glb()));
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  EXPECT_LT(took.count(), 5.0);
  ASSERT_FALSE(model.ok());
  const std::string message = model.error().message();
  EXPECT_NE(message.find("bad.glb"), std::string::npos) << message;
  EXPECT_FALSE(model.error().remedy.empty());
  for (const std::string& word : words) {
    EXPECT_NE(message.find(word), std::string::npos) << message << "\nlacks: " << word;
  }
}

TEST(HostileReferences, IndicesOutOfRange) {
  expect_refused([](GltfMaker& m) { m.json["nodes"][2]["mesh"] = 2; }, {"node 2 \"body\"", "mesh"});
  expect_refused([](GltfMaker& m) { m.json["nodes"][2]["mesh"] = -1; }, {"node 2 \"body\""});
  expect_refused([](GltfMaker& m) { m.json["nodes"][2]["mesh"] = 1e300; }, {"node 2 \"body\""});
  expect_refused([](GltfMaker& m) { m.json["nodes"][2]["mesh"] = 0.5; }, {"no integer"});
  expect_refused([](GltfMaker& m) { m.json["nodes"][2]["skin"] = 1; }, {"node 2 \"body\"", "skin"});
  expect_refused([](GltfMaker& m) { m.json["nodes"][0]["children"] = {99}; }, {"node 0 \"hips\""});
  expect_refused([](GltfMaker& m) { m.json["nodes"][0]["children"] = "all"; }, {"no array"});
  expect_refused([](GltfMaker& m) { m.json["skins"][0]["joints"] = {0, 77}; }, {"skin 0"});
  expect_refused([](GltfMaker& m) { m.json["skins"][0]["joints"] = Json::array(); }, {"no joints"});
  expect_refused([](GltfMaker& m) { m.json["skins"][0]["inverseBindMatrices"] = 999; }, {"skin 0"});
  expect_refused([](GltfMaker& m) { m.json["scene"] = 3; }, {"scene"});
  expect_refused([](GltfMaker& m) { m.json["scenes"][0]["nodes"] = {50}; }, {"scene 0"});
  expect_refused([](GltfMaker& m) { m.json["animations"][0]["channels"][0]["sampler"] = 9; },
                 {"animation 0 \"nod\""});
  expect_refused([](GltfMaker& m) { m.json["animations"][0]["channels"][0]["target"]["node"] = 9; },
                 {"animation 0 \"nod\""});
  expect_refused([](GltfMaker& m) { m.json["animations"][0]["samplers"][0]["input"] = 900; },
                 {"animation 0 \"nod\""});
  expect_refused([](GltfMaker& m) { m.json["meshes"][0]["primitives"][0]["indices"] = 900; },
                 {"mesh 0"});
  expect_refused(
      [](GltfMaker& m) { m.json["meshes"][0]["primitives"][0]["attributes"]["_X"] = 900; },
      {"mesh 0"});
  expect_refused([](GltfMaker& m) { m.json["meshes"][0]["primitives"][0]["mode"] = 7; },
                 {"mesh 0"});
  expect_refused([](GltfMaker& m) { m.json["accessors"][0]["bufferView"] = 900; }, {"accessor 0"});
  expect_refused([](GltfMaker& m) { m.json["bufferViews"][0]["buffer"] = 1; }, {"bufferView 0"});
}

TEST(HostileReferences, RangesOutsideTheirBuffers) {
  expect_refused([](GltfMaker& m) { m.json["accessors"][0]["count"] = 5; },
                 {"accessor 0", "past the end"});
  expect_refused([](GltfMaker& m) { m.json["accessors"][0]["count"] = 4294967295u; },
                 {"accessor 0"});
  expect_refused([](GltfMaker& m) { m.json["accessors"][0]["count"] = 1e18; }, {"accessor 0"});
  expect_refused([](GltfMaker& m) { m.json["accessors"][0]["byteOffset"] = 4; }, {"accessor 0"});
  expect_refused([](GltfMaker& m) { m.json["accessors"][0]["byteOffset"] = -4; }, {"accessor 0"});
  expect_refused([](GltfMaker& m) { m.json["bufferViews"][0]["byteLength"] = 1 << 30; },
                 {"bufferView 0"});
  expect_refused([](GltfMaker& m) { m.json["bufferViews"][0]["byteOffset"] = 1 << 30; },
                 {"bufferView 0"});
  expect_refused([](GltfMaker& m) { m.json["bufferViews"][0]["byteStride"] = 4; }, {"overlap"});
  expect_refused([](GltfMaker& m) { m.json["bufferViews"][0]["byteStride"] = 13; },
                 {"multiple of 4"});
  expect_refused(
      [](GltfMaker& m) {
        m.json["buffers"] = {{{"byteLength", m.binary.size() + 64}}};
      },
      {"buffer 0", "cut short"});
  expect_refused(
      [](GltfMaker& m) {
        m.json["accessors"][0].erase("bufferView");
        m.json["accessors"][0]["count"] = 1 << 30;
      },
      {"accessor 0", "without any data"});
}

TEST(HostileReferences, SparseOutsideItsAccessor) {
  const auto sparse_of = [](GltfMaker& m) -> Json& {
    for (Json& accessor : m.json["accessors"]) {
      if (accessor.contains("sparse")) return accessor["sparse"];
    }
    return m.json;
  };
  expect_refused([&](GltfMaker& m) { sparse_of(m)["count"] = 5; }, {"accessor", "count"});
  expect_refused([&](GltfMaker& m) { sparse_of(m)["indices"]["bufferView"] = 500; }, {"accessor"});
  expect_refused([&](GltfMaker& m) { sparse_of(m)["indices"]["componentType"] = 5126; },
                 {"unsigned integers"});
  expect_refused([&](GltfMaker& m) { sparse_of(m)["values"]["byteOffset"] = 1000; },
                 {"past the end"});
  expect_refused([&](GltfMaker& m) { sparse_of(m).erase("values"); }, {"sparse"});
  expect_refused(
      [&](GltfMaker& m) {
        const std::size_t view = sparse_of(m)["indices"]["bufferView"];
        m.binary[m.json["bufferViews"][view]["byteOffset"].get<std::size_t>()] = 4;
      },
      {"sparse", "element 4 of 4"});
}

TEST(HostileStructure, LoopsAndSeveralParents) {
  expect_refused([](GltfMaker& m) { m.json["nodes"][3]["children"] = {0}; }, {"loop"});
  expect_refused([](GltfMaker& m) { m.json["nodes"][3]["children"] = {3}; }, {"node 3 \"hat\""});
  expect_refused([](GltfMaker& m) { m.json["nodes"][4]["children"] = {1}; },
                 {"node 1 \"head\"", "two parents"});
}

TEST(HostileStructure, WrongTypesEverywhere) {
  const std::vector<Json> wrong{
      nullptr,         true, 7, -1, 1e300, "text", Json::array(), Json::object(), {1, "x", nullptr},
      {{{"nodes", 3}}}};
  const Json good = test::everything().json;
  const TemporaryFolder folder;
  // Every value in the document replaced by every kind of nonsense: a sound model or an error.
  std::vector<Json::json_pointer> places;
  const Json flat = good.flatten();
  for (const auto& [pointer, value] : flat.items()) {
    Json::json_pointer place(pointer);
    for (; !place.empty(); place = place.parent_pointer()) {
      if (std::find(places.begin(), places.end(), place) == places.end()) places.push_back(place);
    }
  }
  ASSERT_GT(places.size(), 200u);
  int refused = 0;
  for (const auto& place : places) {
    for (const Json& value : wrong) {
      GltfMaker maker = test::everything();
      maker.json[place] = value;
      const auto model = read_gltf(test::write_file(folder.path() / "w.glb", maker.glb()));
      SCOPED_TRACE(place.to_string() + " = " + value.dump());
      if (model.ok()) {
        test::expect_sound(**model);
      } else {
        ++refused;
        EXPECT_NE(model.error().where.find("w.glb"), std::string::npos);
      }
    }
  }
  EXPECT_GT(refused, 500);
}

TEST(HostileNumbers, NotFiniteOrBeyondUse) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  const auto poke = [](GltfMaker& m, const char* attribute, std::size_t byte, float value) {
    const std::size_t accessor = m.json["meshes"][0]["primitives"][0]["attributes"][attribute];
    const std::size_t view = m.json["accessors"][accessor]["bufferView"];
    const std::size_t at = m.json["bufferViews"][view]["byteOffset"];
    std::memcpy(m.binary.data() + at + byte, &value, sizeof(value));
  };
  for (const float bad : {nan, infinity, -infinity, 1e30f}) {
    expect_refused([&](GltfMaker& m) { poke(m, "POSITION", 16, bad); },
                   {"node 2 \"body\"", "vertex 1", "not finite"});
    expect_refused(
        [&](GltfMaker& m) {
          m.json["skins"][0]["inverseBindMatrices"] =
              m.floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,   0, 1,  //
                        1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, bad, 0, 1},
                       "MAT4", 16);
        },
        {"skin 0", "node 1 \"head\""});
  }
  expect_refused(
      [](GltfMaker& m) {
        m.json["nodes"][1]["translation"] = {0, 1e300, 0};
      },
      {"node 1 \"head\"", "translation"});
  expect_refused(
      [](GltfMaker& m) {
        m.json["nodes"][1]["translation"] = {0, "1", 0};
      },
      {"node 1 \"head\""});
  expect_refused([](GltfMaker& m) { m.json["nodes"][1]["scale"] = {1, 1}; }, {"node 1 \"head\""});
  expect_refused(
      [](GltfMaker& m) {
        for (auto& node : m.json["nodes"]) {
          if (!node.contains("matrix")) node["scale"] = {1e14, 1e14, 1e14};
        }
      },
      {"not finite", "scale"});
  expect_refused([](GltfMaker& m) { m.json["nodes"][3]["matrix"][15] = 2; },
                 {"node 3 \"hat\"", "affine"});
}

TEST(HostileNumbers, ARotationOfLengthZeroCostsOnlyItself) {
  GltfMaker maker = test::everything();
  maker.json["nodes"][1]["rotation"] = {0, 0, 0, 0};
  const TemporaryFolder folder;
  const auto model = read_gltf(test::write_file(folder.path() / "z.glb", maker.glb()));
  ASSERT_TRUE(model.ok());
  EXPECT_EQ((*model)->skeleton.joints[1].rest.rotation, Quat(1, 0, 0, 0));
  ASSERT_EQ((*model)->warnings.size(), 1u);
  EXPECT_NE((*model)->warnings[0].find("node 1 \"head\""), std::string::npos);
}

TEST(HostileMeshes, WhatDoesNotFitTogether) {
  const auto attribute = [](GltfMaker& m, const char* name) -> Json& {
    return m.json["meshes"][0]["primitives"][0]["attributes"][name];
  };
  expect_refused(
      [&](GltfMaker& m) {
        m.json["meshes"][0]["primitives"][0]["indices"] = m.indices({0, 1, 4});
      },
      {"vertex 4 of 4"});
  expect_refused(
      [&](GltfMaker& m) {
        m.json["meshes"][0]["primitives"][0]["indices"] = m.scalars({0, 1, 2});
      },
      {"unsigned integers"});
  expect_refused(
      [&](GltfMaker& m) {
        attribute(m, "POSITION") = m.floats({0, 0, 0, 0}, "VEC2", 2);
      },
      {"positions", "type"});
  expect_refused(
      [&](GltfMaker& m) {
        attribute(m, "WEIGHTS_0") = m.floats({1, 0, 0, 0}, "VEC4", 4);
      },
      {"1 vertices of 4"});
  expect_refused(
      [&](GltfMaker& m) {
        attribute(m, "JOINTS_0") = m.accessor<std::uint8_t>(
            {9, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 5121, "VEC4", 4);
      },
      {"vertex 0 follows joint 9"});
  expect_refused(
      [&](GltfMaker& m) {
        m.json["meshes"][0]["primitives"][0]["targets"][0]["POSITION"] = m.points({0, 0, 0});
      },
      {"morph target", "1 vertices of 4"});
  expect_refused(
      [&](GltfMaker& m) {
        m.json["animations"][0]["samplers"][0]["output"] = m.floats({0, 0, 0, 1}, "VEC4", 4);
      },
      {"animation 0 \"nod\"", "node 1 \"head\"", "3 key times but values for 1"});
  expect_refused(
      [&](GltfMaker& m) {
        m.json["skins"][0]["inverseBindMatrices"] = m.floats(std::vector<float>(16, 0), "MAT4", 16);
      },
      {"skin 0", "1 inverse bind matrices for 2 joints"});
}

TEST(HostileExtensions, AreRefusedByName) {
  for (const char* name : {"KHR_draco_mesh_compression", "EXT_meshopt_compression",
                           "EXT_mesh_gpu_instancing", "ACME_secret_sauce"}) {
    expect_refused([&](GltfMaker& m) { m.json["extensionsRequired"] = {name}; }, {name});
  }
  // Merely used, with no plain data to fall back to: refused where the data is missed.
  expect_refused(
      [](GltfMaker& m) {
        m.json["buffers"] = {{{"byteLength", m.binary.size()}}, {{"byteLength", 48}}};
        m.json["bufferViews"][0] = {{"buffer", 1},
                                    {"byteLength", 48},
                                    {"extensions", {{"EXT_meshopt_compression", {{"buffer", 0}}}}}};
        m.json["extensionsUsed"] = {"EXT_meshopt_compression"};
      },
      {"positions", "EXT_meshopt_compression"});
}

TEST(HostileContainers, CutAndTwisted) {
  const std::string good = test::everything().glb();
  const TemporaryFolder folder;
  for (std::size_t length = 0; length < good.size(); length += length < 40 ? 1 : 97) {
    const auto model =
        read_gltf(test::write_file(folder.path() / "cut.glb", good.substr(0, length)));
    EXPECT_FALSE(model.ok()) << "cut to " << length;
  }
  std::string version = good;
  version[4] = 1;
  EXPECT_NE(
      read_gltf(test::write_file(folder.path() / "v.glb", version)).error().what.find("version 1"),
      std::string::npos);
  std::string deep = R"({"asset":{"version":"2.0"},"extras":)";
  for (int i = 0; i < 100000; ++i) deep += "[";
  const auto nested = read_gltf(test::write_file(folder.path() / "deep.gltf", deep));
  ASSERT_FALSE(nested.ok());
  EXPECT_NE(nested.error().what.find("nested"), std::string::npos);
}

TEST(HostilePaths, NothingOutsideTheFolderIsOpened) {
  const TemporaryFolder outer;
  const fs::path folder = outer.path() / "model";
  const std::string secret(4096, 's');
  test::write_file(outer.path() / "secret.bin", secret);
  test::write_file(folder / "good.bin", secret);
  test::write_file(outer.path() / "model2" / "secret.bin", secret);
  fs::create_symlink(outer.path() / "secret.bin", folder / "link.bin");
  fs::create_directory_symlink(outer.path(), folder / "up");
  fs::create_symlink("good.bin", folder / "inner.bin");
  ASSERT_EQ(mkfifo((folder / "pipe.bin").c_str(), 0600), 0);
  const fs::path real = fs::canonical(folder);

  const auto read_with = [&](const std::string& uri, bool as_image) {
    Json json = {{"asset", {{"version", "2.0"}}}};
    if (as_image) {
      json["images"] = {{{"uri", uri}}};
      json["textures"] = {{{"source", 0}}};
      json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    } else {
      json["buffers"] = {{{"byteLength", 16}, {"uri", uri}}};
    }
    ReadOptions options;
    options.on_open = [&](const fs::path& opened) {
      EXPECT_EQ(fs::canonical(opened).string().rfind(real.string() + "/", 0), 0u)
          << uri << " opened " << opened;
    };
    return read_gltf(test::write_file(folder / "m.gltf", json.dump()), options);
  };

  const std::string absolute = (outer.path() / "secret.bin").string();
  for (const std::string& uri : {std::string("../secret.bin"),
                                 std::string("%2e%2e/secret.bin"),
                                 std::string("..%2fsecret.bin"),
                                 std::string("%2E%2E%2Fsecret.bin"),
                                 std::string("..\\secret.bin"),
                                 std::string("a/../../secret.bin"),
                                 std::string("./../secret.bin"),
                                 std::string("up/secret.bin"),
                                 std::string("link.bin"),
                                 std::string("up/model2/secret.bin"),
                                 std::string("../model2/secret.bin"),
                                 absolute,
                                 "file://" + absolute,
                                 "file:" + absolute,
                                 std::string("http://127.0.0.1/secret.bin"),
                                 std::string("C:\\secret.bin"),
                                 std::string("~/secret.bin"),
                                 std::string("$HOME/secret.bin"),
                                 std::string("pipe.bin"),
                                 std::string("."),
                                 std::string(""),
                                 std::string("good.bin%00.png"),
                                 std::string("/dev/zero"),
                                 std::string("//server/share"),
                                 std::string("m.gltf/x")}) {
    const auto buffer = read_with(uri, false);
    EXPECT_FALSE(buffer.ok()) << uri;
    if (!buffer.ok()) {
      EXPECT_NE(buffer.error().where.find("buffer 0"), std::string::npos) << uri;
    }
    const auto image = read_with(uri, true);
    ASSERT_TRUE(image.ok()) << uri << ": a bad image never refuses a file";
    EXPECT_TRUE((*image)->images.at(0).rgba.empty());
    if (!uri.empty()) {
      EXPECT_NE((*image)->warnings.at(0).find("image 0"), std::string::npos) << uri;
    }
  }
  for (const char* uri : {"good.bin", "./good.bin", "inner.bin", "x/../good.bin", "%67ood.bin"}) {
    EXPECT_TRUE(read_with(uri, false).ok()) << uri;
  }
}

TEST(HostilePaths, TheFileItself) {
  const TemporaryFolder folder;
  for (const fs::path& path : {folder.path() / "none.glb", folder.path(), fs::path(),
                               folder.path() / "none" / "none.glb", fs::path("/dev/zero")}) {
    const auto model = read_gltf(path);
    ASSERT_FALSE(model.ok()) << path;
    EXPECT_FALSE(model.error().what.empty());
  }
}

TEST(HostileSizes, ABudgetOfBytes) {
  GltfMaker maker = test::everything();
  const TemporaryFolder folder;
  const fs::path file = test::write_file(folder.path() / "big.glb", maker.glb());
  ReadOptions options;
  options.max_bytes = 100;
  const auto model = read_gltf(file, options);
  ASSERT_FALSE(model.ok());
  EXPECT_NE(model.error().what.find("100 bytes"), std::string::npos);

  // One file named a thousand times counts a thousand times.
  test::write_file(folder.path() / "data.bin", std::string(1 << 20, 'x'));
  Json json = {{"asset", {{"version", "2.0"}}}};
  for (int i = 0; i < 1000; ++i) {
    json["buffers"].push_back({{"byteLength", 1 << 20}, {"uri", "data.bin"}});
  }
  options.max_bytes = 8 << 20;
  EXPECT_FALSE(read_gltf(test::write_file(folder.path() / "many.gltf", json.dump()), options).ok());
}

TEST(HostileSizes, SmallFilesThatUnfold) {
  // A thousand nodes show a mesh of a thousand primitives, all of one accessor.
  expect_refused(
      [](GltfMaker& m) {
        Json& primitives = m.json["meshes"][1]["primitives"];
        for (int i = 0; i < 1000; ++i) primitives.push_back(primitives[0]);
        for (int i = 0; i < 1000; ++i) {
          m.json["nodes"].push_back({{"mesh", 1}});
          m.json["scenes"][0]["nodes"].push_back(5 + i);
        }
      },
      {"mesh 1"});
  // Many skins over many nodes.
  expect_refused(
      [](GltfMaker& m) {
        for (int i = 0; i < 8000; ++i) {
          m.json["nodes"].push_back(Json::object());
          m.json["skins"].push_back({{"joints", {0}}});
        }
      },
      {"skins"});
  // Channels that share one long accessor.
  expect_refused(
      [](GltfMaker& m) {
        const int times = m.scalars(std::vector<float>(20000, 0));
        const int values = m.points(std::vector<float>(60000, 0));
        m.json["animations"][0]["samplers"] = {{{"input", times}, {"output", values}}};
        m.json["animations"][0]["channels"] = Json::array();
        for (int i = 0; i < 5000; ++i) {
          m.json["animations"][0]["channels"].push_back(
              {{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}});
        }
      },
      {"animation 0"});
}

TEST(HostileSizes, DeepChainsAreNoTrouble) {
  GltfMaker maker = test::everything();
  constexpr int kDepth = 20000;
  for (int i = 0; i < kDepth; ++i) {
    Json node = Json::object();
    if (i + 1 < kDepth) node["children"] = {6 + i};
    maker.json["nodes"].push_back(node);
  }
  maker.json["scenes"][0]["nodes"].push_back(5);
  const TemporaryFolder folder;
  const auto begin = std::chrono::steady_clock::now();
  const auto model = read_gltf(test::write_file(folder.path() / "deep.glb", maker.glb()));
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  ASSERT_TRUE(model.ok()) << model.error().message();
  EXPECT_EQ((*model)->skeleton.size(), 5 + kDepth);
  EXPECT_LT(took.count(), 5.0);
}

TEST(HostileImages, ThatClaimTooMuch) {
  // A PNG header that promises 16000 by 16000 pixels in a hundred bytes.
  std::string png("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x3e\x80\0\0\x3e\x80\x08\x06\0\0\0", 29);
  png.resize(100, '\0');
  GltfMaker maker = test::everything();
  maker.json["images"] = {{{"bufferView", maker.view(png)}, {"mimeType", "image/png"}}};
  maker.json["textures"] = {{{"source", 0}}};
  maker.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  const TemporaryFolder folder;
  const auto model = read_gltf(test::write_file(folder.path() / "png.glb", maker.glb()));
  ASSERT_TRUE(model.ok());
  EXPECT_TRUE((*model)->images.at(0).rgba.empty());
  EXPECT_NE((*model)->warnings.at(0).find("16000 by 16000"), std::string::npos);
}

}  // namespace
}  // namespace elbowroom
