// SPDX-License-Identifier: MIT
// Byte-honest export on files made for the purpose: odd texts, odd buffers, changes of container.
#include "core/io/gltf_writer.h"

#include <cstring>
#include <nlohmann/json.hpp>

#include "core/base/random.h"
#include "core/io/gltf_append.h"
#include "core/io/gltf_container.h"
#include "tests/judge/judge.h"
#include "tests/unit/io_write/folder.h"

namespace elbowroom {
namespace {

namespace fs = std::filesystem;
using gltf_export::Container;

// Two joints; "walk" turns the first and moves the second; a channel without a node; samplers
// shared. %B is the list of buffers.
constexpr const char* kText = R"({
  "asset" : { "version":"2.0", "generator":"by hand" },
  "extras" : { "one": 1.0, "small": 1e-5, "long": 12345678901234567890123, "empty": {}, "none": [ ] },
  "nodes":[{"name":"a","children":[1]},{"name":"b"},{"name":"fixed","matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}],
  "scenes":[{"nodes":[0,2]}],
  "buffers":%B,
  "bufferViews":[{"buffer":0,"byteLength":12},{"buffer":0,"byteOffset":12,"byteLength":48},{"buffer":0,"byteOffset":60,"byteLength":36}],
  "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"SCALAR","min":[0],"max":[2.0]},
               {"bufferView":1,"componentType":5126,"count":3,"type":"VEC4"},
               {"bufferView":2,"componentType":5126,"count":3,"type":"VEC3"}],
  "animations":[{"name":"walk","extras":{"keep":1.50},
    "channels":[{"sampler":0,"target":{"node":0,"path":"rotation"},"extras":"turn"},
                {"sampler":1,"target":{"node":1,"path":"translation"}},
                {"sampler":0,"target":{"path":"rotation"}},
                {"sampler":2,"target":{"node":1,"path":"rotation"}}],
    "samplers":[{"input":0,"output":1},{"input":0,"output":2,"interpolation":"STEP","extras":[7.0]},{"input":0,"output":1,"interpolation":"LINEAR"}]}]
})";

std::string key_bytes() {
  const float values[24] = {0, 1, 2, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 2, 3, 4, 5, 6, 7, 8};
  return std::string(reinterpret_cast<const char*>(values), sizeof values);
}

std::string with_buffers(const std::string& buffers, std::string text = kText) {
  return text.replace(text.find("%B"), 2, buffers);
}

std::string glb(const std::string& json, const std::optional<std::string>& bin) {
  Container container;
  container.binary = true;
  container.json = json;
  container.bin = bin;
  return *gltf_export::write_container(container, "");
}

Channel turn_of(int joint) {
  Channel channel;
  channel.joint = joint;
  channel.times = {0.25f, 0.5f, 1.1f};
  channel.values = {0, 0, 0, 1, 0, 0, 0.6f, 0.8f, 0, 0, 0, 1};
  return channel;
}

CorrectedClip correction(std::vector<Channel> changed) {
  CorrectedClip clip;
  clip.source_animation = 0;
  clip.changed = std::move(changed);
  return clip;
}

class GltfWriter : public test::InFolder {
 protected:
  // Exports a turn of node 1 and judges it; returns the output as the judge reads it.
  judge::File export_turn(const fs::path& in, const fs::path& out, ExportReport* report = nullptr,
                          bool same_container = true) {
    const auto status = export_corrected(in, out, correction({turn_of(1)}), report);
    EXPECT_TRUE(status.ok()) << status.error().message();
    const judge::File before = judge::load(in), after = judge::load(out);
    const judge::ByteReport bytes = judge::compare_bytes(before, after);
    EXPECT_TRUE(bytes.buffers_are_prefixes);
    if (same_container) {
      EXPECT_TRUE(bytes.json_differences.empty()) << bytes.json_differences.front();
    }
    EXPECT_TRUE(
        judge::joints_outside_limb_bit_identical(before, after, "walk", "walk (corrected)", {"b"})
            .empty());
    const judge::KeyAnimation& animation = after.animation("walk (corrected)");
    EXPECT_EQ(animation.channels.size(), 3u);  // and one without a node
    for (const judge::KeyChannel& channel : animation.channels) {
      if (channel.node != 1 || channel.path != "rotation") continue;
      EXPECT_EQ(channel.times, turn_of(1).times);
      EXPECT_EQ(std::vector<float>(channel.values.begin(), channel.values.end()),
                turn_of(1).values);
    }
    EXPECT_TRUE(judge::key_faults(after, "walk (corrected)").empty());
    return after;
  }
};

TEST_F(GltfWriter, AppendsToAGlb) {
  const std::string json = with_buffers(R"([{"byteLength":96}])");
  spill(folder_ / "in.glb", glb(json, key_bytes()));
  ExportReport report;
  const judge::File out = export_turn(folder_ / "in.glb", folder_ / "out.glb", &report);
  ASSERT_EQ(report.animations.size(), 1u);
  EXPECT_EQ(report.animations[0].name, "walk (corrected)");
  EXPECT_EQ(report.animations[0].index, 1);
  EXPECT_TRUE(report.side_files.empty());
  // The text before the first appended entry is the source's to the byte, odd numbers included.
  EXPECT_EQ(out.json.compare(0, json.find("\"buffers\""), json, 0, json.find("\"buffers\"")), 0);
  const auto document = nlohmann::json::parse(out.json);
  const auto& animation = document["animations"][1];
  EXPECT_EQ(animation["extras"]["keep"], 1.5);
  EXPECT_EQ(animation["channels"].size(), 4u);
  EXPECT_EQ(animation["channels"][0]["extras"], "turn");
  EXPECT_EQ(animation["samplers"].size(), 3u);  // the new one took the place of the one replaced
  EXPECT_EQ(animation["samplers"][0], document["animations"][0]["samplers"][0]);
  EXPECT_EQ(animation["samplers"][1]["extras"][0], 7.0);
  const auto& input = document["accessors"][animation["samplers"][2]["input"].get<std::size_t>()];
  EXPECT_EQ(input["min"][0], 0.25);
  EXPECT_EQ(input["max"][0], static_cast<double>(1.1f));
  EXPECT_EQ(files_in(folder_), 2u);
}

TEST_F(GltfWriter, IsDeterministicAndCorrectsACorrection) {
  spill(folder_ / "in.glb", glb(with_buffers(R"([{"byteLength":96}])"), key_bytes()));
  ASSERT_TRUE(
      export_corrected(folder_ / "in.glb", folder_ / "a.glb", correction({turn_of(1)})).ok());
  ASSERT_TRUE(
      export_corrected(folder_ / "in.glb", folder_ / "b.glb", correction({turn_of(1)})).ok());
  EXPECT_EQ(slurp(folder_ / "a.glb"), slurp(folder_ / "b.glb"));
  ExportReport report;
  ASSERT_TRUE(
      export_corrected(folder_ / "a.glb", folder_ / "a.glb", correction({turn_of(0)}), &report)
          .ok());
  EXPECT_EQ(report.animations.at(0).name, "walk (corrected 2)");
  const judge::File once = judge::load(folder_ / "b.glb"), twice = judge::load(folder_ / "a.glb");
  EXPECT_TRUE(judge::compare_bytes(once, twice).buffers_are_prefixes);
  EXPECT_TRUE(judge::compare_bytes(once, twice).json_differences.empty());
}

TEST_F(GltfWriter, KeepsSharedSamplersAndAddsChannels) {
  spill(folder_ / "in.glb", glb(with_buffers(R"([{"byteLength":96}])"), key_bytes()));
  // Node 0's sampler is shared with the channel that has no node; node 0's scale is new.
  Channel scale = turn_of(0);
  scale.path = Path::scale;
  scale.components = 3;
  scale.interpolation = Interpolation::cubic_spline;
  scale.values.assign(27, 1.0f);
  ASSERT_TRUE(
      export_corrected(folder_ / "in.glb", folder_ / "out.glb", correction({turn_of(0), scale}))
          .ok());
  const auto document = nlohmann::json::parse(judge::load(folder_ / "out.glb").json);
  const auto& animation = document["animations"][1];
  EXPECT_EQ(animation["samplers"].size(), 5u);
  EXPECT_EQ(animation["samplers"][0], document["animations"][0]["samplers"][0]);
  EXPECT_EQ(animation["channels"][0]["sampler"], 3);
  EXPECT_EQ(animation["channels"][2]["sampler"], 0);
  EXPECT_EQ(animation["channels"][4]["target"]["path"], "scale");
  // Equal times are written once.
  EXPECT_EQ(animation["samplers"][3]["input"], animation["samplers"][4]["input"]);
}

TEST_F(GltfWriter, CopesWithEveryKindOfBuffer) {
  const std::string data = gltf_export::encode_data_uri("application/octet-stream", key_bytes());
  const auto document = [&](const char* file) {
    return nlohmann::json::parse(judge::load(folder_ / file).json);
  };
  // BIN padding that the buffer does not count, and text of odd length.
  spill(folder_ / "padded.glb",
        glb(with_buffers(R"([{"byteLength":97}] )"), key_bytes() + std::string("x\0\0\0", 4)));
  export_turn(folder_ / "padded.glb", folder_ / "padded-out.glb");

  // A data URI stays; the new buffer is one too.
  spill(folder_ / "data.gltf", with_buffers(R"([{"uri":")" + data + R"(","byteLength":96}])"));
  export_turn(folder_ / "data.gltf", folder_ / "data-out.gltf");
  EXPECT_EQ(document("data-out.gltf")["buffers"].size(), 2u);
  EXPECT_EQ(document("data-out.gltf")["buffers"][0]["byteLength"], 96);
  spill(folder_ / "data.glb",
        glb(with_buffers(R"([{"uri":")" + data + R"(","byteLength":96}])"), std::nullopt));
  export_turn(folder_ / "data.glb", folder_ / "data-out.glb");

  // A GLB whose first buffer is a file: another file beside it.
  spill(folder_ / "keys.bin", key_bytes());
  spill(folder_ / "external.glb",
        glb(with_buffers(R"([{"uri":"keys.bin","byteLength":96}])"), std::nullopt));
  export_turn(folder_ / "external.glb", folder_ / "external-out.glb");
  EXPECT_TRUE(fs::exists(folder_ / "external-out.bin"));
  EXPECT_EQ(slurp(folder_ / "keys.bin"), key_bytes());

  // A meshopt fallback has no bytes to add to.
  std::string text = with_buffers(
      R"([{"byteLength":96,"extensions":{"EXT_meshopt_compression":{"fallback":true}}},{"uri":")" +
      data + R"(","byteLength":96}])");
  for (std::size_t at; (at = text.find("\"buffer\":0")) != std::string::npos;) text[at + 9] = '1';
  spill(folder_ / "meshopt.glb", glb(text, std::nullopt));
  export_turn(folder_ / "meshopt.glb", folder_ / "meshopt-out.glb");
  EXPECT_EQ(document("meshopt-out.glb")["buffers"][0]["byteLength"], 96);
  EXPECT_EQ(document("meshopt-out.glb")["buffers"].size(), 3u);

  // No buffer at all: keys of zeros, from accessors without a view.
  std::string bare = kText;
  bare.replace(bare.find("\"buffers\":%B,\n"), 14, "");
  for (const char* view : {"\"bufferView\":0,", "\"bufferView\":1,", "\"bufferView\":2,"}) {
    bare.erase(bare.find(view), std::strlen(view));
  }
  bare.erase(bare.find("  \"bufferViews\""),
             bare.find("  \"accessors\"") - bare.find("  \"bufferViews\""));
  spill(folder_ / "bare.glb", glb(bare, std::nullopt));
  ASSERT_TRUE(
      export_corrected(folder_ / "bare.glb", folder_ / "bare-out.glb", correction({turn_of(1)}))
          .ok());
  EXPECT_EQ(judge::load(folder_ / "bare-out.glb").buffers.size(), 1u);
  spill(folder_ / "bare.gltf", bare);
  ASSERT_TRUE(
      export_corrected(folder_ / "bare.gltf", folder_ / "bare-out.gltf", correction({turn_of(1)}))
          .ok());
  EXPECT_TRUE(fs::exists(folder_ / "bare-out.bin"));
}

TEST_F(GltfWriter, WritesASecondBinBesideAGltf) {
  const std::string json = with_buffers(R"([{"uri":"in.bin","byteLength":96}])");
  spill(folder_ / "in.gltf", "\xEF\xBB\xBF" + json);
  spill(folder_ / "in.bin", key_bytes());
  ExportReport report;
  export_turn(folder_ / "in.gltf", folder_ / "out.gltf", &report);
  ASSERT_EQ(report.side_files.size(), 1u);
  EXPECT_EQ(report.side_files[0].filename(), "out.bin");
  EXPECT_EQ(slurp(folder_ / "in.bin"), key_bytes());
  // Again, over itself and over the source: never over a file that is still named.
  export_turn(folder_ / "in.gltf", folder_ / "out.gltf", &report);
  EXPECT_EQ(report.side_files.at(0).filename(), "out.bin");
  const judge::File before = judge::load(folder_ / "in.gltf");
  ASSERT_TRUE(
      export_corrected(folder_ / "in.gltf", folder_ / "in.gltf", correction({turn_of(1)}), &report)
          .ok());
  EXPECT_EQ(report.side_files.at(0).filename(), "in-2.bin");
  EXPECT_TRUE(
      judge::compare_bytes(before, judge::load(folder_ / "in.gltf")).json_differences.empty());
  // Nor over a stranger's file.
  spill(folder_ / "other.bin", "mine");
  export_turn(folder_ / "in.gltf", folder_ / "other.gltf", &report);
  EXPECT_EQ(slurp(folder_ / "other.bin"), "mine");
  EXPECT_EQ(report.side_files.at(0).filename(), "other-2.bin");
}

// A picture by URI, in a subfolder, with a name that needs escapes.
std::string with_pictures(std::string json) {
  const std::string list =
      "\"images\":[{\"name\":\"p\",\"uri\":\"tex/a%20b.png\"},{\"uri\":\"missing.png\"},"
      "{\"uri\":\"tex/a%20b.png\",\"mimeType\":\"image/png\"}],\n  ";
  return json.insert(json.find("\"nodes\""), list);
}

TEST_F(GltfWriter, TakesAlongWhatUrisName) {
  const fs::path from = folder_ / "from", to = folder_ / "to";
  const std::string json = with_pictures(with_buffers(R"([{"uri":"in.bin","byteLength":96}])"));
  spill(from / "in.gltf", json);
  spill(from / "in.bin", key_bytes());
  spill(from / "tex" / "a b.png", "\x89PNG picture");
  fs::create_directories(to);
  ExportReport report;
  export_turn(from / "in.gltf", to / "out.gltf", &report);
  EXPECT_EQ(slurp(to / "tex" / "a b.png"), "\x89PNG picture");
  EXPECT_EQ(slurp(to / "in.bin"), key_bytes());
  EXPECT_EQ(report.warnings.size(), 1u);  // the missing picture
  EXPECT_EQ(files_in(to), 4u);

  // A stranger of the same name stays; the copy and its URI make way.
  const fs::path taken = folder_ / "taken";
  spill(taken / "tex" / "a b.png", "somebody else's");
  export_turn(from / "in.gltf", taken / "out.gltf", &report, false);
  EXPECT_EQ(slurp(taken / "tex" / "a b.png"), "somebody else's");
  EXPECT_EQ(slurp(taken / "tex" / "a b-2.png"), "\x89PNG picture");
  const auto document = nlohmann::json::parse(slurp(taken / "out.gltf"));
  EXPECT_EQ(document["images"][0]["uri"], "tex/a%20b-2.png");
  EXPECT_EQ(document["images"][2]["uri"], "tex/a%20b-2.png");

  // Nothing outside the source's folder is read or written.
  spill(folder_ / "secret.png", "secret");
  std::string escape = json;
  escape.replace(escape.find("missing.png"), 11, "../secret.png");
  spill(from / "escape.gltf", escape);
  fs::create_directories(folder_ / "far" / "away");
  ASSERT_TRUE(export_corrected(from / "escape.gltf", folder_ / "far" / "away" / "out.gltf",
                               correction({turn_of(1)}), &report)
                  .ok());
  EXPECT_FALSE(fs::exists(folder_ / "far" / "secret.png"));
  EXPECT_EQ(report.warnings.size(), 1u);
}

TEST_F(GltfWriter, PacksAGltfIntoAGlbThatStandsAlone) {
  const fs::path from = folder_ / "from";
  const std::string data = gltf_export::encode_data_uri("", "second buffer");
  std::string json =
      with_pictures(with_buffers(R"([{"name":"first","uri":"in.bin","byteLength":96},{"uri":")" +
                                 data + R"(","byteLength":13}])"));
  json.insert(json.find("{\"buffer\":0,\"byteLength\":12}"),
              "{\"byteLength\":4,\"buffer\":1,\"byteOffset\":2},");
  for (char index = '2'; index >= '0'; --index) {
    const std::string old = std::string("\"bufferView\":") + index;
    const std::size_t at = json.find(old);
    json[at + 13] = static_cast<char>(index + 1);
  }
  spill(from / "in.gltf", json);
  spill(from / "in.bin", key_bytes() + "not counted");
  spill(from / "tex" / "a b.png", "\x89PNG picture");
  const fs::path out = folder_ / "out.glb";
  ExportReport report;
  ASSERT_TRUE(export_corrected(from / "in.gltf", out, correction({turn_of(1)}), &report).ok());
  EXPECT_EQ(files_in(folder_), 4u);
  const judge::File after = judge::load(out);
  EXPECT_TRUE(after.binary);
  EXPECT_EQ(after.bin.compare(0, 96, key_bytes()), 0);
  const auto document = nlohmann::json::parse(after.json);
  ASSERT_EQ(document["buffers"].size(), 1u);
  EXPECT_EQ(document["buffers"][0]["name"], "first");
  EXPECT_FALSE(document["buffers"][0].contains("uri"));
  const auto bytes_of = [&](const nlohmann::json& view) {
    return after.bin.substr(view.value("byteOffset", std::size_t{0}), view["byteLength"]);
  };
  EXPECT_EQ(bytes_of(document["bufferViews"][0]), "cond");
  const auto& image = document["images"][0];
  EXPECT_EQ(image["mimeType"], "image/png");
  EXPECT_EQ(bytes_of(document["bufferViews"][image["bufferView"].get<std::size_t>()]),
            "\x89PNG picture");
  EXPECT_EQ(document["images"][2]["bufferView"], image["bufferView"]);
  EXPECT_EQ(document["images"][1]["uri"], "missing.png");
  EXPECT_TRUE(judge::joints_outside_limb_bit_identical(judge::load(from / "in.gltf"), after, "walk",
                                                       "walk (corrected)", {"b"})
                  .empty());

  // And back: one file for the bytes.
  const fs::path text = folder_ / "back" / "text.gltf";
  fs::create_directories(text.parent_path());
  ASSERT_TRUE(export_corrected(out, text, CorrectedClip{}, &report).ok());
  const judge::File back = judge::load(text);
  EXPECT_EQ(back.buffers.at(0), after.bin);
  const auto differences = judge::compare_bytes(after, back).json_differences;
  ASSERT_EQ(differences.size(), 1u);
  EXPECT_EQ(differences[0], "/buffers/0/uri: nothing -> \"text.bin\"");
  ASSERT_TRUE(export_corrected(out, folder_ / "back" / "more.gltf", correction({turn_of(0)})).ok());
  EXPECT_TRUE(judge::compare_bytes(after, judge::load(folder_ / "back" / "more.gltf"))
                  .buffers_are_prefixes);
}

TEST_F(GltfWriter, CopiesWhenThereIsNothingToCorrect) {
  const std::string bytes = glb(with_buffers(R"([{"byteLength":96}])"), key_bytes()) + "";
  spill(folder_ / "in.glb", bytes);
  ASSERT_TRUE(export_corrected(folder_ / "in.glb", folder_ / "out.glb", correction({})).ok());
  EXPECT_EQ(slurp(folder_ / "out.glb"), bytes);
  ASSERT_TRUE(
      export_corrected(folder_ / "in.glb", folder_ / "out.glb", std::vector<CorrectedClip>{}).ok());
  EXPECT_EQ(slurp(folder_ / "out.glb"), bytes);
  ASSERT_TRUE(export_corrected(folder_ / "in.glb", folder_ / "in.glb", correction({})).ok());
  EXPECT_EQ(slurp(folder_ / "in.glb"), bytes);
}

TEST_F(GltfWriter, TakesTheLastOfTwoEqualKeys) {
  std::string json = with_buffers(R"([{"byteLength":1,"byteLength":96}])");
  json.insert(1, "\"animations\":[],\"accessors\":7,");
  json.insert(json.rfind('}'), ",\"\\u0065xtras2\":1");
  spill(folder_ / "in.glb", glb(json, key_bytes()));
  export_turn(folder_ / "in.glb", folder_ / "out.glb");
}

TEST_F(GltfWriter, NamesAndSelectsClips) {
  spill(folder_ / "in.glb", glb(with_buffers(R"([{"byteLength":96}])"), key_bytes()));
  CorrectedClip named = correction({turn_of(1)}), plain = correction({turn_of(0)});
  named.name = "my \"walk\"";
  ExportReport report;
  ASSERT_TRUE(export_corrected(folder_ / "in.glb", folder_ / "out.glb",
                               std::vector<CorrectedClip>{named, correction({}), plain, plain},
                               &report)
                  .ok());
  ASSERT_EQ(report.animations.size(), 3u);
  EXPECT_EQ(report.animations[0].name, named.name);
  EXPECT_EQ(report.animations[1].name, "walk (corrected)");
  EXPECT_EQ(report.animations[2].name, "walk (corrected 2)");
  EXPECT_EQ(judge::load(folder_ / "out.glb").animation(named.name).channels.size(), 3u);

  Clip clip;
  clip.source_animation = 4;
  clip.channels = {turn_of(0), turn_of(1)};
  clip.channels[0].source_channel = 3;
  const CorrectedClip corrected = corrected_clip(clip);
  EXPECT_EQ(corrected.source_animation, 4);
  ASSERT_EQ(corrected.changed.size(), 1u);
  EXPECT_EQ(corrected.changed[0].joint, 1);
}

TEST_F(GltfWriter, RefusesAndWritesNothing) {
  const std::string json = with_buffers(R"([{"byteLength":96}])");
  spill(folder_ / "in.glb", glb(json, key_bytes()));
  const auto refused = [&](const CorrectedClip& clip) {
    const auto status = export_corrected(folder_ / "in.glb", folder_ / "out.glb", clip);
    EXPECT_EQ(files_in(folder_), 1u);
    if (!status.ok()) {
      EXPECT_NE(status.error().where.find("in.glb"), std::string::npos);
    }
    return !status.ok();
  };
  CorrectedClip clip = correction({turn_of(1)});
  clip.source_animation = 1;
  EXPECT_TRUE(refused(clip));
  EXPECT_TRUE(refused(correction({turn_of(3)})));
  EXPECT_TRUE(refused(correction({turn_of(-1)})));
  EXPECT_TRUE(refused(correction({turn_of(2)})));  // a matrix
  EXPECT_TRUE(refused(correction({turn_of(1), turn_of(1)})));
  Channel bad = turn_of(1);
  bad.times[1] = bad.times[0];
  EXPECT_TRUE(refused(correction({bad})));
  bad = turn_of(1);
  bad.values[3] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(refused(correction({bad})));
  bad = turn_of(1);
  bad.values.pop_back();
  EXPECT_TRUE(refused(correction({bad})));
  bad = turn_of(1);
  bad.interpolation = Interpolation::cubic_spline;
  EXPECT_TRUE(refused(correction({bad})));

  EXPECT_FALSE(export_corrected(folder_ / "no.glb", folder_ / "out.glb", correction({})).ok());
  EXPECT_FALSE(
      export_corrected(folder_ / "in.glb", folder_ / "no" / "out.glb", correction({turn_of(1)}))
          .ok());
  spill(folder_ / "short.glb", glb(with_buffers(R"([{"byteLength":960}])"), key_bytes()));
  EXPECT_FALSE(
      export_corrected(folder_ / "short.glb", folder_ / "out.glb", correction({turn_of(1)})).ok());
  spill(folder_ / "lost.gltf", with_buffers(R"([{"uri":"lost.bin","byteLength":96}])"));
  EXPECT_FALSE(
      export_corrected(folder_ / "lost.gltf", folder_ / "out.glb", correction({turn_of(1)})).ok());
  EXPECT_FALSE(fs::exists(folder_ / "out.glb"));
}

// Damaged sources: an error or a valid text, never a crash. In memory, since syncing files takes
// long.
TEST_F(GltfWriter, BearsDamagedSources) {
  const std::string good = glb(with_pictures(with_buffers(R"([{"byteLength":96}])")), key_bytes());
  Random random(3);
  int appended = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    std::string bytes = good;
    for (std::uint64_t i = 0; i <= random.below(3); ++i) {
      static constexpr char kOdd[] = "0123456789{}[]\",:-.eE nt\0\xFF";
      bytes[random.below(bytes.size())] = kOdd[random.below(sizeof kOdd - 1)];
    }
    auto container = gltf_export::parse_container(bytes, "in.glb");
    if (!container.ok()) continue;
    gltf_export::Draft draft;
    draft.container = *std::move(container);
    draft.file = folder_ / "in.glb";
    draft.free_name = "out.bin";
    if (trial % 4 == 0) draft.container.binary = false;
    std::vector<ExportedAnimation> animations;
    const auto changed = gltf_export::change_container(draft, trial % 2 == 0);
    const auto status =
        gltf_export::append_animations(draft, {correction({turn_of(0), turn_of(1)})}, animations);
    if (!changed.ok() || !status.ok()) {
      EXPECT_FALSE((changed.ok() ? status : changed).error().message().empty());
      continue;
    }
    EXPECT_TRUE(nlohmann::json::accept(draft.container.json));
    ++appended;
  }
  EXPECT_GT(appended, 1000);
}

}  // namespace
}  // namespace elbowroom
