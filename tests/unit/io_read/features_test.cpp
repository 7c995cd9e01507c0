// SPDX-License-Identifier: MIT
// What the reader makes of each feature of the format, on files made here.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/io/gltf_reader.h"
#include "tests/unit/io_read/gltf_maker.h"
#include "tests/unit/io_read/model_checks.h"

namespace elbowroom {
namespace {

using test::GltfMaker;
using test::Json;
using test::TemporaryFolder;

std::shared_ptr<const Model> read(const GltfMaker& maker) {
  const TemporaryFolder folder;
  GltfMaker copy = maker;
  const auto model = read_gltf(test::write_file(folder.path() / "made.glb", copy.glb()));
  EXPECT_TRUE(model.ok()) << (model.ok() ? "" : model.error().message());
  if (!model.ok()) return nullptr;
  test::expect_sound(**model);
  return *model;
}

bool warns_of(const Model& model, const std::string& words) {
  return std::any_of(model.warnings.begin(), model.warnings.end(), [&](const std::string& warning) {
    return warning.find(words) != std::string::npos;
  });
}

// A mesh of one primitive at one node.
GltfMaker one_mesh(GltfMaker maker, const Json& primitive) {
  maker.mesh(primitive);
  maker.node({{"mesh", 0}});
  maker.json["scenes"] = {{{"nodes", {0}}}};
  return maker;
}

TEST(ReadFeatures, Everything) {
  const auto model = read(test::everything());
  ASSERT_TRUE(model);
  EXPECT_TRUE(model->warnings.empty()) << model->warnings.front();
  ASSERT_EQ(model->characters.size(), 1u);
  const Character& character = model->characters[0];
  EXPECT_EQ(character.name, "hips");
  EXPECT_EQ(character.joints, (std::vector<int>{0, 1}));
  EXPECT_EQ(character.triangles, 2 + 2) << "the body and the hat on the head";
  ASSERT_EQ(model->objects.size(), 1u);
  EXPECT_EQ(model->objects[0].name, "wall");
  EXPECT_FALSE(model->objects[0].animated);

  const Mesh& body = model->meshes[0];
  ASSERT_EQ(body.influence_begin, (std::vector<std::uint32_t>{0, 2, 3, 4, 5}));
  EXPECT_NEAR(body.influences[0].weight, 32768.0 / 65535, 1e-7);
  EXPECT_EQ(body.influences[2].joint, 0);
  ASSERT_EQ(body.morphs.size(), 1u);
  EXPECT_EQ(body.morphs[0].offsets[2], glm::vec3(0));
  EXPECT_EQ(body.morphs[0].offsets[3], glm::vec3(0, 1, 0)) << "the sparse element";
  EXPECT_EQ(body.morph_weights, std::vector<double>{0.5});
  EXPECT_EQ(model->materials[0].base_color, glm::vec4(1, 0.5f, 0.25f, 1));
  ASSERT_TRUE(model->skeleton.joints[3].rest_matrix);
  EXPECT_EQ(model->skeleton.joints[3].rest.translation, Vec3(0, 1, 0));

  ASSERT_EQ(model->clips.size(), 1u);
  const Clip& clip = model->clips[0];
  EXPECT_EQ(clip.name, "nod");
  ASSERT_EQ(clip.channels.size(), 4u) << "the channel without a node is not kept";
  EXPECT_EQ(clip.channels[3].source_channel, 3);
  EXPECT_EQ(clip.begin, 0);
  EXPECT_EQ(clip.end, 1);
  EXPECT_NEAR(angle_between(sample_rotation(clip.channels[0], 0.5),
                            Quat(std::sqrt(0.5), 0, 0, std::sqrt(0.5))),
              0, 1e-4);
  EXPECT_EQ(clip.channels[1].interpolation, Interpolation::step);
  EXPECT_EQ(clip.channels[2].interpolation, Interpolation::cubic_spline);
  EXPECT_EQ(sample_vector(clip.channels[2], 0.5), Vec3(2, 2, 2));
  EXPECT_EQ(clip.channels[3].components, 1);
}

TEST(ReadFeatures, StripsFansAndPlainVertices) {
  const std::vector<float> five{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0};
  const std::vector<std::pair<int, std::vector<glm::uvec3>>> cases{
      {4, {{0, 1, 2}}},
      {5, {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}},
      {6, {{1, 2, 0}, {2, 3, 0}, {3, 4, 0}}}};
  for (const auto& [mode, expected] : cases) {
    GltfMaker maker;
    const int positions = maker.points(five);
    const auto model =
        read(one_mesh(maker, {{"attributes", {{"POSITION", positions}}}, {"mode", mode}}));
    ASSERT_TRUE(model);
    EXPECT_EQ(model->meshes.at(0).triangles, expected) << "mode " << mode;
    EXPECT_EQ(warns_of(*model, "fewer than three"), mode == 4);
  }
  for (const int mode : {0, 1, 2, 3}) {
    GltfMaker maker;
    const int positions = maker.points(five);
    const auto model =
        read(one_mesh(maker, {{"attributes", {{"POSITION", positions}}}, {"mode", mode}}));
    ASSERT_TRUE(model);
    EXPECT_TRUE(model->meshes.empty());
    EXPECT_TRUE(warns_of(*model, "points and lines"));
  }
}

TEST(ReadFeatures, IndicesOfEveryWidth) {
  for (const int type : {5121, 5123, 5125}) {
    GltfMaker maker;
    const int positions = maker.points({0, 0, 0, 1, 0, 0, 0, 1, 0});
    const int indices = type == 5121 ? maker.accessor<std::uint8_t>({2, 0, 1}, type, "SCALAR", 1)
                        : type == 5123
                            ? maker.accessor<std::uint16_t>({2, 0, 1}, type, "SCALAR", 1)
                            : maker.accessor<std::uint32_t>({2, 0, 1}, type, "SCALAR", 1);
    const auto model =
        read(one_mesh(maker, {{"attributes", {{"POSITION", positions}}}, {"indices", indices}}));
    ASSERT_TRUE(model);
    EXPECT_EQ(model->meshes.at(0).triangles.at(0), glm::uvec3(2, 0, 1));
  }
}

TEST(ReadFeatures, InterleavedAndUnalignedData) {
  GltfMaker maker;
  // Twelve bytes of position, eight of something else.
  const std::vector<float> rows{0, 0, 0, 7, 7, 1, 0, 0, 7, 7, 0, 1, 0, 7, 7};
  const int view = maker.view(GltfMaker::bytes_of(rows), 20);
  const int strided = maker.accessor(
      {{"bufferView", view}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
  auto model = read(one_mesh(maker, {{"attributes", {{"POSITION", strided}}}}));
  ASSERT_TRUE(model);
  EXPECT_EQ(model->meshes.at(0).positions[2], glm::vec3(0, 1, 0));

  GltfMaker odd;
  const std::vector<float> points{0, 0, 0, 1, 0, 0, 0, 1, 0};
  const int shifted = odd.view("x" + GltfMaker::bytes_of(points));
  const int unaligned = odd.accessor({{"bufferView", shifted},
                                      {"byteOffset", 1},
                                      {"componentType", 5126},
                                      {"count", 3},
                                      {"type", "VEC3"}});
  model = read(one_mesh(odd, {{"attributes", {{"POSITION", unaligned}}}}));
  ASSERT_TRUE(model);
  EXPECT_EQ(model->meshes.at(0).positions[2], glm::vec3(0, 1, 0));
}

TEST(ReadFeatures, QuantizedPositionsOnlyWithTheExtension) {
  GltfMaker maker;
  const int positions =
      maker.accessor<std::int16_t>({0, 0, 0, 0, 100, 0, 0, 0, 0, -32767, 0, 0}, 5122, "VEC3", 4);
  // Three 16-bit numbers and a pad.
  maker.json["bufferViews"][0]["byteStride"] = 8;
  maker = one_mesh(maker, {{"attributes", {{"POSITION", positions}}}});
  maker.json["extensionsUsed"] = {"KHR_mesh_quantization"};
  maker.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  auto model = read(maker);
  ASSERT_TRUE(model);
  EXPECT_EQ(model->meshes.at(0).positions[1], glm::vec3(100, 0, 0));
  maker.json["accessors"][0]["normalized"] = true;
  model = read(maker);
  ASSERT_TRUE(model);
  EXPECT_EQ(model->meshes.at(0).positions[2].y, -1.0f);

  maker.json.erase("extensionsUsed");
  maker.json.erase("extensionsRequired");
  const TemporaryFolder folder;
  const auto refused = read_gltf(test::write_file(folder.path() / "q.glb", maker.glb()));
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().what.find("KHR_mesh_quantization"), std::string::npos);
}

// A triangle on a skin of six joints; the caller sets joints and weights.
struct Skinned {
  GltfMaker maker;
  Json attributes;

  Skinned() {
    attributes["POSITION"] = maker.points({0, 0, 0, 1, 0, 0, 0, 1, 0});
    for (int i = 0; i < 6; ++i) maker.node({{"name", "joint " + std::to_string(i)}});
    maker.json["skins"] = {{{"joints", {5, 4, 3, 2, 1, 0}}}};
  }
  void set(int number, const std::vector<std::uint8_t>& joints, const std::vector<float>& weights) {
    attributes["JOINTS_" + std::to_string(number)] =
        maker.accessor<std::uint8_t>(joints, 5121, "VEC4", 4);
    attributes["WEIGHTS_" + std::to_string(number)] = maker.floats(weights, "VEC4", 4);
  }
  GltfMaker made() {
    GltfMaker m = maker;
    m.mesh({{"attributes", attributes}});
    m.node({{"mesh", 0}, {"skin", 0}});
    return m;
  }
};

TEST(ReadFeatures, SeveralWeightSetsAreNormalizedTogether) {
  Skinned figure;
  figure.set(0, {0, 1, 2, 3, 0, 0, 0, 0, 1, 0, 0, 0}, {1, 1, 1, 1, 2, 0, 0, 0, 0.5f, 0, 0, 0});
  figure.set(1, {4, 5, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0}, {1, 2, 1, 0, 0, 0, 0, 0, 0.5f, 0, 0, 0});
  const auto model = read(figure.made());
  ASSERT_TRUE(model);
  const Mesh& mesh = model->meshes.at(0);
  // Joint 0 stands in both sets with 1 each, joint 5 with 2, of 8 in all.
  ASSERT_EQ(mesh.influence_begin, (std::vector<std::uint32_t>{0, 6, 7, 8}));
  EXPECT_FLOAT_EQ(mesh.influences[0].weight, 0.25f);
  EXPECT_EQ(mesh.influences[0].joint, 5) << "slot 0 is node 5";
  EXPECT_EQ(mesh.influences[0].slot, 0);
  EXPECT_FLOAT_EQ(mesh.influences[1].weight, 0.125f);
  EXPECT_FLOAT_EQ(mesh.influences[5].weight, 0.25f);
  EXPECT_FLOAT_EQ(mesh.influences[6].weight, 1);
  EXPECT_FLOAT_EQ(mesh.influences[7].weight, 1);
}

TEST(ReadFeatures, ZeroNegativeAndStrayWeights) {
  Skinned figure;
  // The first vertex has none, the second a negative one, the third a stray joint of weight 0.
  figure.set(0, {3, 1, 0, 0, 1, 2, 0, 0, 2, 200, 0, 0}, {0, 0, 0, 0, -1, 0.5f, 0, 0, 1, 0, 0, 0});
  const auto model = read(figure.made());
  ASSERT_TRUE(model);
  const Mesh& mesh = model->meshes.at(0);
  ASSERT_EQ(mesh.influences.size(), 3u);
  EXPECT_EQ(mesh.influences[0].slot, 3) << "the first joint named";
  EXPECT_EQ(mesh.influences[1].slot, 2);
  EXPECT_EQ(mesh.influences[2].slot, 2);
  EXPECT_TRUE(warns_of(*model, "without weights"));
  EXPECT_TRUE(warns_of(*model, "negative"));
}

TEST(ReadFeatures, ASkinWithoutWeightsMovesWithItsNode) {
  Skinned figure;
  const auto model = read(figure.made());
  ASSERT_TRUE(model);
  EXPECT_EQ(model->meshes.at(0).skin, -1);
  EXPECT_TRUE(warns_of(*model, "no joints or weights"));
}

TEST(ReadFeatures, TheDefaultSceneIsShown) {
  GltfMaker maker;
  const int positions = maker.points({0, 0, 0, 1, 0, 0, 0, 1, 0});
  maker.mesh({{"attributes", {{"POSITION", positions}}}});
  for (const char* name : {"a", "b", "c"}) maker.node({{"name", name}, {"mesh", 0}});
  const auto shown = [](const Model& model) {
    std::string names;
    for (const Object& object : model.objects) names += object.name;
    return names;
  };
  auto model = read(maker);
  ASSERT_TRUE(model);
  EXPECT_EQ(shown(*model), "abc");
  EXPECT_TRUE(warns_of(*model, "no scene"));
  maker.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1, 2}}}};
  model = read(maker);
  ASSERT_TRUE(model);
  EXPECT_EQ(shown(*model), "a");
  EXPECT_TRUE(warns_of(*model, "2 scenes"));
  maker.json["scene"] = 1;
  model = read(maker);
  ASSERT_TRUE(model);
  EXPECT_EQ(shown(*model), "bc");
  EXPECT_EQ(model->skeleton.size(), 3) << "all nodes are kept under their numbers";
}

TEST(ReadFeatures, ChannelsThatCannotPlayAreLeftOut) {
  GltfMaker maker = test::everything();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const int times = maker.scalars({0, 1}), backwards = maker.scalars({0, 1, 1, 0.5f, 2});
  const int bad = maker.points({0, 0, 0, nan, 0, 0});
  const int good = maker.points({0, 0, 0, 1, 0, 0});
  const int five = maker.points({0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 4, 0, 0});
  maker.json["animations"] = Json::array();
  maker.json["animations"].push_back(
      {{"samplers",
        {{{"input", times}, {"output", bad}},
         {{"input", times}, {"output", good}},
         {{"input", times}, {"output", good}, {"interpolation", "WOBBLE"}},
         {{"input", backwards}, {"output", five}}}},
       {"channels",
        {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}},
         {{"sampler", 1}, {"target", {{"node", 0}, {"path", "pointer"}}}},
         {{"sampler", 1}, {"target", {{"node", 3}, {"path", "translation"}}}},
         {{"sampler", 2}, {"target", {{"node", 1}, {"path", "translation"}}}},
         {{"sampler", 1}, {"target", {{"node", 4}, {"path", "weights"}}}},
         {{"sampler", 3}, {"target", {{"node", 4}, {"path", "translation"}}}},
         {{"sampler", 1}, {"target", {{"node", 4}, {"path", "translation"}}}}}}});
  const auto model = read(maker);
  ASSERT_TRUE(model);
  for (const char* words : {"not finite", "\"pointer\"", "matrix can't be animated", "\"WOBBLE\"",
                            "no morph targets", "2 keys", "twice"}) {
    EXPECT_TRUE(warns_of(*model, words)) << words;
  }
  ASSERT_EQ(model->clips.at(0).channels.size(), 1u);
  const Channel& kept = model->clips[0].channels[0];
  EXPECT_EQ(kept.source_channel, 5);
  EXPECT_EQ(kept.times, (std::vector<float>{0, 1, 2}));
  EXPECT_EQ(sample_vector(kept, 2), Vec3(4, 0, 0));
}

TEST(ReadFeatures, AGltfWithItsBytesBesideOrWithin) {
  GltfMaker maker = test::everything();
  const std::string bytes = maker.binary;
  const TemporaryFolder folder;
  test::write_file(folder.path() / "data" / "my bytes.bin", bytes + "trailing");
  maker.json["buffers"] = {{{"byteLength", bytes.size()}, {"uri", "data/my%20bytes.bin"}}};
  const auto beside = read_gltf(test::write_file(folder.path() / "a.gltf", maker.json.dump()));
  ASSERT_TRUE(beside.ok()) << beside.error().message();

  static const char* const kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string base64;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    }
    for (int k = 3; k >= 0; --k) base64 += kDigits[bits >> (6 * k) & 63];
  }
  maker.json["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64;
  // Told apart by content: the name doesn't matter.
  const auto within = read_gltf(test::write_file(folder.path() / "b.glb", maker.json.dump()));
  ASSERT_TRUE(within.ok()) << within.error().message();
  EXPECT_EQ((*beside)->meshes[0].positions, (*within)->meshes[0].positions);
  EXPECT_EQ((*beside)->clips[0].channels[0].values, (*within)->clips[0].channels[0].values);
}

TEST(ReadFeatures, TextureTransformAndSetOfTheBaseColour) {
  GltfMaker maker;
  const int positions = maker.points({0, 0, 0, 1, 0, 0, 0, 1, 0});
  const int first = maker.floats({9, 9, 9, 9, 9, 9}, "VEC2", 2);
  const int second = maker.floats({0, 0, 1, 0, 0, 1}, "VEC2", 2);
  maker = one_mesh(
      maker,
      {{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", first}, {"TEXCOORD_1", second}}},
       {"material", 0}});
  maker.json["images"] = {{{"uri", "missing.png"}}};
  maker.json["textures"] = {{{"source", 0}}};
  maker.json["materials"] = {
      {{"pbrMetallicRoughness",
        {{"baseColorTexture",
          {{"index", 0},
           {"texCoord", 1},
           {"extensions",
            {{"KHR_texture_transform", {{"offset", {0.5, 0}}, {"scale", {2, 1}}}}}}}}}}}};
  const auto model = read(maker);
  ASSERT_TRUE(model);
  EXPECT_EQ(model->meshes.at(0).texcoords,
            (std::vector<glm::vec2>{{0.5f, 0}, {2.5f, 0}, {0.5f, 1}}));
  EXPECT_EQ(model->materials.at(0).base_color_image, 0);
  EXPECT_TRUE(warns_of(*model, "missing.png")) << "an image that can't be read costs only itself";
}

}  // namespace
}  // namespace elbowroom
