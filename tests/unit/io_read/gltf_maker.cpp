// SPDX-License-Identifier: MIT
#include "tests/unit/io_read/gltf_maker.h"

namespace elbowroom::test {

GltfMaker everything() {
  GltfMaker m;
  const int positions = m.points({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 2, 0});
  const int normals = m.points({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
  const int texcoords = m.floats({0, 0, 1, 0, 0, 1, 1, 1}, "VEC2", 2);
  const int joints =
      m.accessor<std::uint8_t>({0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 5121, "VEC4", 4);
  const int weights = m.accessor<std::uint16_t>(
      {32768, 32767, 0, 0, 65535, 0, 0, 0, 65535, 0, 0, 0, 65535, 0, 0, 0}, 5123, "VEC4", 4, true);
  const int indices = m.indices({0, 1, 2, 2, 1, 3});
  const int sparse =
      m.accessor({{"componentType", 5126},
                  {"count", 4},
                  {"type", "VEC3"},
                  {"sparse",
                   {{"count", 1},
                    {"indices",
                     {{"bufferView", m.view(GltfMaker::bytes_of<std::uint16_t>({3}))},
                      {"componentType", 5123}}},
                    {"values", {{"bufferView", m.view(GltfMaker::bytes_of<float>({0, 1, 0}))}}}}}});
  const int bind = m.floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,  //
                             1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1},
                            "MAT4", 16);
  const int skinned = m.mesh({{"attributes",
                               {{"POSITION", positions},
                                {"NORMAL", normals},
                                {"TEXCOORD_0", texcoords},
                                {"JOINTS_0", joints},
                                {"WEIGHTS_0", weights}}},
                              {"indices", indices},
                              {"material", 0},
                              {"targets", {{{"POSITION", sparse}}}}});
  m.json["meshes"][static_cast<std::size_t>(skinned)]["weights"] = {0.5};
  const int strip = m.mesh({{"attributes", {{"POSITION", positions}}}, {"mode", 5}});

  m.node({{"name", "hips"}, {"children", {1}}});
  m.node({{"name", "head"}, {"translation", {0, 1, 0}}, {"children", {3}}});
  m.node({{"name", "body"}, {"mesh", skinned}, {"skin", 0}});
  m.node({{"name", "hat"},
          {"mesh", strip},
          {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 1}}});
  m.node({{"name", "wall"}, {"mesh", strip}, {"scale", {2, 2, 2}}});
  m.json["skins"] = {{{"joints", {0, 1}}, {"inverseBindMatrices", bind}}};
  m.json["scenes"] = {{{"nodes", {0, 2, 4}}}};
  m.json["scene"] = 0;
  m.json["materials"] = {
      {{"name", "skin"}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 0.5, 0.25, 1}}}}}};

  const int times = m.scalars({0, 0.5, 1});
  const int turns = m.accessor<std::int16_t>({0, 0, 0, 32767, 0, 0, 23170, 23170, 0, 0, 0, 32767},
                                             5122, "VEC4", 4, true);
  const int moves = m.points({0, 0, 0, 0, 1, 0, 0, 0, 0});
  const int spline = m.points({0, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0, 2, 2, 2, 0, 0, 0,  //
                               0, 0, 0, 1, 1, 1, 0, 0, 0});
  const int morphs = m.scalars({0, 1, 0});
  m.json["animations"] = {
      {{"name", "nod"},
       {"samplers",
        {{{"input", times}, {"output", turns}},
         {{"input", times}, {"output", moves}, {"interpolation", "STEP"}},
         {{"input", times}, {"output", spline}, {"interpolation", "CUBICSPLINE"}},
         {{"input", times}, {"output", morphs}}}},
       {"channels",
        {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "rotation"}}}},
         {{"sampler", 1}, {"target", {{"node", 0}, {"path", "translation"}}}},
         {{"sampler", 2}, {"target", {{"node", 0}, {"path", "scale"}}}},
         {{"sampler", 3}, {"target", {{"node", 2}, {"path", "weights"}}}},
         {{"sampler", 0}, {"target", {{"path", "rotation"}}}}}}}};
  return m;
}

}  // namespace elbowroom::test
