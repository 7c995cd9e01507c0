// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/io/gltf_check_parts.h"

namespace elbowroom::gltf {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

// Attribute name → accessor. Names the reader has no use for are checked, too, and dropped.
Json check_attributes(const CheckState& state, const Json& attributes, const std::string& part) {
  if (!attributes.is_object()) state.access.refuse_part(part, "its attributes are no object");
  Json out = Json::object();
  for (const auto& [name, value] : attributes.items()) {
    const int accessor =
        state.access.required_index(attributes, name.c_str(), part, state.out.unusable.size());
    const bool wanted = name == "POSITION" || name == "NORMAL" || name.rfind("TEXCOORD_", 0) == 0 ||
                        name.rfind("JOINTS_", 0) == 0 || name.rfind("WEIGHTS_", 0) == 0;
    if (wanted) out[name] = accessor;
  }
  return out;
}

Json check_primitive(const CheckState& state, const Json& primitive, const std::string& part) {
  const JsonAccess& access = state.access;
  Json out = {{"mode", access.integer(primitive, "mode", part, 0, 6, 4)}};
  const Json* attributes = member(primitive, "attributes");
  if (!attributes) access.refuse_part(part, "a primitive has no attributes");
  out["attributes"] = check_attributes(state, *attributes, part);
  // As an attribute: tinygltf refuses indices whose accessor has no bufferView (all zeros, or
  // sparse only), which is legal.
  put_index(out["attributes"], kIndices,
            access.index(primitive, "indices", part, state.out.unusable.size()));
  // A material that isn't there costs the colour, not the shape.
  const Json* material = member(primitive, "material");
  if (material && material->is_number()) {
    const double index = material->get<double>();
    if (index >= 0 && index < static_cast<double>(state.reduced["materials"].size()) &&
        index == std::floor(index)) {
      out["material"] = static_cast<int>(index);
    }
  }
  for (const Json& target : access.objects(primitive, "targets", part)) {
    out["targets"].push_back(check_attributes(state, target, part));
  }
  return out;
}

void check_meshes(CheckState& state) {
  const JsonAccess& access = state.access;
  const Json& meshes = access.section("meshes");
  Json& reduced = state.reduced["meshes"] = Json::array();
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const std::string name = name_of(meshes[i]);
    const std::string part = part_name("mesh", i, name);
    Json entry = {{"name", name}, {"primitives", Json::array()}};
    for (const Json& primitive : access.objects(meshes[i], "primitives", part)) {
      entry["primitives"].push_back(check_primitive(state, primitive, part));
    }
    if (const auto weights = access.numbers(meshes[i], "weights", part, 0)) {
      entry["weights"] = *weights;
    }
    reduced.push_back(std::move(entry));
  }
}

void check_skins(CheckState& state, std::size_t node_count) {
  const JsonAccess& access = state.access;
  const Json& skins = access.section("skins");
  Json& reduced = state.reduced["skins"] = Json::array();
  for (std::size_t i = 0; i < skins.size(); ++i) {
    const std::string name = name_of(skins[i]);
    const std::string part = part_name("skin", i, name);
    Json entry = {{"name", name},
                  {"joints", access.index_list(skins[i], "joints", part, node_count)}};
    if (entry["joints"].empty()) access.refuse_part(part, "it has no joints");
    put_index(entry, "inverseBindMatrices",
              access.index(skins[i], "inverseBindMatrices", part, state.out.unusable.size()));
    access.index(skins[i], "skeleton", part, node_count);
    reduced.push_back(std::move(entry));
  }
}

void check_placement(CheckState& state, const Json& node, const std::string& part, Json& entry) {
  const JsonAccess& access = state.access;
  const auto matrix = access.numbers(node, "matrix", part, 16);
  const auto translation = access.numbers(node, "translation", part, 3);
  const auto rotation = access.numbers(node, "rotation", part, 4);
  const auto scale = access.numbers(node, "scale", part, 3);
  if (matrix) {
    const auto& m = *matrix;
    if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) {
      access.refuse_part(part, "its matrix is no affine transform (last row 0 0 0 1)");
    }
    if (translation || rotation || scale) {
      state.out.warnings.push_back(part +
                                   " has both a matrix and a translation, rotation or "
                                   "scale; the matrix is used");
    }
    entry["matrix"] = m;
    return;
  }
  if (translation) entry["translation"] = *translation;
  if (scale) entry["scale"] = *scale;
  if (!rotation) return;
  const auto& q = *rotation;
  const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (!(norm > 1e-6)) {
    state.out.warnings.push_back(part + " has a rotation of length 0; none is used");
    return;
  }
  if (std::abs(norm - 1.0) > 1e-2) {
    state.out.warnings.push_back(part +
                                 " has a rotation that is no unit quaternion; it is "
                                 "normalized");
  }
  entry["rotation"] = {q[0] / norm, q[1] / norm, q[2] / norm, q[3] / norm};
}

std::string node_part(const CheckState& state, int node) {
  return part_name("node", at(node), state.reduced["nodes"][at(node)]["name"].get<std::string>());
}

void check_nodes(CheckState& state) {
  const JsonAccess& access = state.access;
  const Json& nodes = access.section("nodes");
  Json& reduced = state.reduced["nodes"] = Json::array();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const std::string name = name_of(nodes[i]);
    const std::string part = part_name("node", i, name);
    Json entry = {{"name", name},
                  {"children", access.index_list(nodes[i], "children", part, nodes.size())}};
    put_index(entry, "mesh", access.index(nodes[i], "mesh", part, state.reduced["meshes"].size()));
    put_index(entry, "skin", access.index(nodes[i], "skin", part, state.reduced["skins"].size()));
    if (const auto weights = access.numbers(nodes[i], "weights", part, 0)) {
      entry["weights"] = *weights;
    }
    check_placement(state, nodes[i], part, entry);
    reduced.push_back(std::move(entry));
  }
}

// The parent of each node; refuses nodes of several parents and loops.
std::vector<int> check_hierarchy(const CheckState& state) {
  const Json& nodes = state.reduced["nodes"];
  const int count = static_cast<int>(nodes.size());
  std::vector<int> parent(at(count), -1);
  for (int i = 0; i < count; ++i) {
    for (const Json& child : nodes[at(i)]["children"]) {
      int& owner = parent[child.get<std::size_t>()];
      if (child.get<int>() == i) {
        state.access.refuse_part(node_part(state, i), "it is its own child");
      }
      if (owner >= 0) {
        state.access.refuse_part(
            node_part(state, child.get<int>()),
            "it has two parents, nodes " + std::to_string(owner) + " and " + std::to_string(i));
      }
      owner = i;
    }
  }
  // Each node has one parent at most, so what the roots don't reach hangs in a loop.
  std::vector<int> queue;
  for (int i = 0; i < count; ++i) {
    if (parent[at(i)] < 0) queue.push_back(i);
  }
  std::vector<bool> reached(at(count), false);
  for (std::size_t next = 0; next < queue.size(); ++next) {
    reached[at(queue[next])] = true;
    for (const Json& child : nodes[at(queue[next])]["children"]) queue.push_back(child.get<int>());
  }
  for (int i = 0; i < count; ++i) {
    if (!reached[at(i)]) {
      state.access.refuse_part(node_part(state, i),
                               "it is its own ancestor: the nodes form a loop");
    }
  }
  return parent;
}

void check_scenes(CheckState& state) {
  const JsonAccess& access = state.access;
  const Json& nodes = state.reduced["nodes"];
  const Json& scenes = access.section("scenes");
  const std::vector<int> parent = check_hierarchy(state);
  const int chosen = access.index(state.document, "scene", "the document", scenes.size());
  std::vector<Json> lists;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    lists.push_back(access.index_list(scenes[i], "nodes", part_name("scene", i, name_of(scenes[i])),
                                      nodes.size()));
  }
  std::vector<int> queue;
  if (lists.empty()) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (parent[i] < 0) queue.push_back(static_cast<int>(i));
    }
    if (!nodes.empty()) {
      state.out.warnings.push_back("the file has no scene; all its root nodes are shown");
    }
  } else {
    const std::size_t scene = chosen < 0 ? 0 : at(chosen);
    for (const Json& node : lists[scene]) queue.push_back(node.get<int>());
    if (lists.size() > 1) {
      state.out.warnings.push_back("the file has " + std::to_string(lists.size()) + " scenes; " +
                                   (chosen < 0 ? "none is its default, so the first"
                                               : "its default "
                                                 "scene (" +
                                                     std::to_string(chosen) + ")") +
                                   " is shown");
    }
  }
  state.out.visible.assign(nodes.size(), false);
  while (!queue.empty()) {
    const int node = queue.back();
    queue.pop_back();
    if (state.out.visible[at(node)]) continue;
    state.out.visible[at(node)] = true;
    for (const Json& child : nodes[at(node)]["children"]) queue.push_back(child.get<int>());
  }
}

}  // namespace

void check_scene(CheckState& state) {
  check_meshes(state);
  check_skins(state, state.access.section("nodes").size());
  check_nodes(state);
  check_scenes(state);
}

void check_animations(CheckState& state) {
  const JsonAccess& access = state.access;
  const Json& animations = access.section("animations");
  const std::size_t accessors = state.out.unusable.size();
  Json& reduced = state.reduced["animations"] = Json::array();
  for (std::size_t i = 0; i < animations.size(); ++i) {
    const std::string name = name_of(animations[i]);
    const std::string part = part_name("animation", i, name);
    const Json& samplers = access.objects(animations[i], "samplers", part);
    Json entry = {{"name", name}, {"samplers", Json::array()}, {"channels", Json::array()}};
    for (const Json& sampler : samplers) {
      const Json* interpolation = member(sampler, "interpolation");
      entry["samplers"].push_back(
          {{"input", access.required_index(sampler, "input", part, accessors)},
           {"output", access.required_index(sampler, "output", part, accessors)},
           {"interpolation", interpolation && interpolation->is_string()
                                 ? interpolation->get<std::string>()
                                 : std::string("LINEAR")}});
    }
    for (const Json& channel : access.objects(animations[i], "channels", part)) {
      const Json* target = member(channel, "target");
      if (!target || !target->is_object()) access.refuse_part(part, "a channel has no target");
      const Json* path = member(*target, "path");
      // tinygltf drops a channel without a node, which would shift the numbers of those after it.
      entry["channels"].push_back(
          {{"sampler", access.required_index(channel, "sampler", part, samplers.size())},
           {"target",
            {{"node", access.index(*target, "node", part, state.reduced["nodes"].size())},
             {"path", path && path->is_string() ? path->get<std::string>() : std::string()}}}});
    }
    reduced.push_back(std::move(entry));
  }
}

}  // namespace elbowroom::gltf
