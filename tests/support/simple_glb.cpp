// SPDX-License-Identifier: MIT
#include "tests/support/simple_glb.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

namespace elbowroom::test {

SimpleMesh upright_post(double x, double z, double radius, double y_low, double y_high, int sides) {
  SimpleMesh mesh;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * 3.14159265358979323846 * i / sides;
    for (const double y : {y_low, y_high})
      mesh.positions.emplace_back(x + radius * std::cos(angle), y, z + radius * std::sin(angle));
  }
  const auto low_centre = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.emplace_back(x, y_low, z);
  mesh.positions.emplace_back(x, y_high, z);
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(sides); ++i) {
    const std::uint32_t j = (i + 1) % static_cast<std::uint32_t>(sides);
    const std::uint32_t a = 2 * i, b = 2 * i + 1, c = 2 * j, d = 2 * j + 1;
    mesh.triangles.emplace_back(a, b, c);
    mesh.triangles.emplace_back(b, d, c);
    mesh.triangles.emplace_back(low_centre, a, c);
    mesh.triangles.emplace_back(low_centre + 1, d, b);
  }
  return mesh;
}

SimpleMesh box(const glm::vec3& lower, const glm::vec3& upper) {
  SimpleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.emplace_back(i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y,
                                i & 4 ? upper.z : lower.z);
  const std::uint32_t quads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                     {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& q : quads) {
    mesh.triangles.emplace_back(q[0], q[1], q[2]);
    mesh.triangles.emplace_back(q[0], q[2], q[3]);
  }
  return mesh;
}

bool write_simple_glb(const std::filesystem::path& file, const std::string& name,
                      const SimpleMesh& mesh, const glm::vec3& move_to, float seconds) {
  using nlohmann::json;
  std::string bin;
  const auto append = [&bin](const void* data, std::size_t size) {
    const std::size_t at = bin.size();
    bin.append(static_cast<const char*>(data), size);
    while (bin.size() % 4) bin.push_back('\0');
    return at;
  };
  glm::vec3 lower(mesh.positions.front()), upper(lower);
  for (const auto& p : mesh.positions) {
    lower = glm::min(lower, p);
    upper = glm::max(upper, p);
  }
  const std::size_t positions = append(mesh.positions.data(), mesh.positions.size() * 12);
  const std::size_t indices = append(mesh.triangles.data(), mesh.triangles.size() * 12);
  json root;
  root["asset"] = {{"version", "2.0"}};
  root["scene"] = 0;
  root["scenes"] = {{{"nodes", {0}}}};
  root["nodes"] = {{{"name", name}, {"mesh", 0}}};
  root["meshes"] = {
      {{"name", name}, {"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}};
  root["bufferViews"] = {
      {{"buffer", 0}, {"byteOffset", positions}, {"byteLength", mesh.positions.size() * 12}},
      {{"buffer", 0}, {"byteOffset", indices}, {"byteLength", mesh.triangles.size() * 12}}};
  root["accessors"] = {{{"bufferView", 0},
                        {"componentType", 5126},
                        {"count", mesh.positions.size()},
                        {"type", "VEC3"},
                        {"min", {lower.x, lower.y, lower.z}},
                        {"max", {upper.x, upper.y, upper.z}}},
                       {{"bufferView", 1},
                        {"componentType", 5125},
                        {"count", mesh.triangles.size() * 3},
                        {"type", "SCALAR"}}};
  if (seconds > 0) {
    const float times[2] = {0.0f, seconds};
    const glm::vec3 values[2] = {glm::vec3(0.0f), move_to};
    const std::size_t input = append(times, sizeof times);
    const std::size_t output = append(values, sizeof values);
    root["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", input}, {"byteLength", 8}});
    root["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", output}, {"byteLength", 24}});
    root["accessors"].push_back({{"bufferView", 2},
                                 {"componentType", 5126},
                                 {"count", 2},
                                 {"type", "SCALAR"},
                                 {"min", {0.0f}},
                                 {"max", {seconds}}});
    root["accessors"].push_back(
        {{"bufferView", 3}, {"componentType", 5126}, {"count", 2}, {"type", "VEC3"}});
    root["animations"] = {
        {{"name", "move"},
         {"samplers", {{{"input", 2}, {"output", 3}, {"interpolation", "LINEAR"}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
  }
  root["buffers"] = {{{"byteLength", bin.size()}}};
  std::string text = root.dump();
  while (text.size() % 4) text.push_back(' ');

  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  const auto word = [&out](std::size_t value) {
    const auto number = static_cast<std::uint32_t>(value);
    out.write(reinterpret_cast<const char*>(&number), 4);
  };
  word(0x46546C67);
  word(2);
  word(12 + 8 + text.size() + 8 + bin.size());
  word(text.size());
  word(0x4E4F534A);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  word(bin.size());
  word(0x004E4942);
  out.write(bin.data(), static_cast<std::streamsize>(bin.size()));
  return out.good();
}

}  // namespace elbowroom::test
