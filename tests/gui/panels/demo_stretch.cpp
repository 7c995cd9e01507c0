// SPDX-License-Identifier: MIT
#include "tests/gui/panels/demo_stretch.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/gui/panels/editor_driver.h"

namespace elbowroom {
namespace {

using Json = nlohmann::json;

struct Glb {
  Json json;
  std::string rest;  // the binary chunk, with its header
};

Glb read_glb(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  std::uint32_t length = 0;
  if (bytes.size() < 20) {
    ADD_FAILURE() << file;
    return {};
  }
  std::memcpy(&length, bytes.data() + 12, 4);
  return {Json::parse(bytes.substr(20, length)), bytes.substr(20 + length)};
}

void write_glb(const Glb& glb, const std::filesystem::path& file) {
  std::string json = glb.json.dump();
  json.append((4 - json.size() % 4) % 4, ' ');
  const std::uint32_t words[5] = {0x46546c67, 2,
                                  static_cast<std::uint32_t>(20 + json.size() + glb.rest.size()),
                                  static_cast<std::uint32_t>(json.size()), 0x4e4f534a};
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(words), sizeof words);
  out << json << glb.rest;
}

void cut(Json& accessor, std::size_t first, std::size_t count, std::size_t bytes_each) {
  accessor["byteOffset"] = accessor.value("byteOffset", std::size_t{0}) + first * bytes_each;
  accessor["count"] = count;
}

void cut_clip(Glb& glb, const Json& animation, double from, double to, std::set<int>& done) {
  Json& accessors = glb.json["accessors"];
  std::size_t first = 0, count = 0;  // all channels of a clip have the same times
  for (const Json& sampler : animation["samplers"]) {
    const int input = sampler["input"], output = sampler["output"];
    Json& times = accessors[static_cast<std::size_t>(input)];
    const Json& view = glb.json["bufferViews"][times["bufferView"].get<std::size_t>()];
    const std::size_t offset = view.value("byteOffset", std::size_t{0});
    std::vector<float> t(done.contains(input) ? 0 : times["count"].get<std::size_t>());
    std::memcpy(t.data(), glb.rest.data() + 8 + offset, 4 * t.size());
    if (done.insert(input).second) {
      first = 0;
      while (first < t.size() && static_cast<double>(t[first]) < from - 1e-4) ++first;
      if (first + 4 >= t.size()) first = 0;
      count = 0;
      while (first + count < t.size() &&
             (count < 4 || static_cast<double>(t[first + count]) <= to + 1e-4) &&
             (first > 0 || from <= 0 || count < 8))
        ++count;
      cut(times, first, count, 4);
      times["min"] = {t[first]};
      times["max"] = {t[first + count - 1]};
    }
    if (!done.insert(output).second) continue;
    Json& values = accessors[static_cast<std::size_t>(output)];
    cut(values, first, count, values["type"] == "VEC4" ? 16 : 12);
    values.erase("min");
    values.erase("max");
  }
}

}  // namespace

Document demo_stretch(const std::filesystem::path& folder, double from, double to, Props props) {
  Document document = demo_scene();
  Glb glb = read_glb(document.scene.character);
  std::set<int> done;
  for (const Json& animation : glb.json["animations"]) cut_clip(glb, animation, from, to, done);
  const auto file = folder / document.scene.character.filename();
  write_glb(glb, file);
  document.scene.character = file;
  if (props == Props::none) {
    document.scene.obstacles.clear();
    document.scene.attachments.clear();
  }
  return document;
}

}  // namespace elbowroom
