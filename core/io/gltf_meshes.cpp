// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/io/gltf_read_parts.h"

namespace elbowroom::gltf {
namespace {

// Many nodes may show one mesh, and many primitives share one accessor, so a small file can ask for
// any amount of memory. What real files need stays far below this many vertices and corners.
std::uint64_t most_elements(const Checked& checked) { return (1u << 20) + 2 * checked.total_bytes; }

struct Place {  // of a primitive, for errors and warnings
  std::string part;
  std::string where;
};

int accessor_of(const tinygltf::Primitive& primitive, const std::string& attribute) {
  const auto it = primitive.attributes.find(attribute);
  return it == primitive.attributes.end() ? -1 : it->second;
}

bool is_triangles(int mode) {
  return mode == TINYGLTF_MODE_TRIANGLES || mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
         mode == TINYGLTF_MODE_TRIANGLE_FAN;
}

// Three numbers a vertex, finite and modest; integers only where KHR_mesh_quantization allows them.
std::vector<glm::vec3> read_points(const Conversion& to, int accessor, const std::string& what,
                                   const Place& place) {
  const int type = to.source.accessors[static_cast<std::size_t>(accessor)].componentType;
  if (type != TINYGLTF_COMPONENT_TYPE_FLOAT && !to.checked.quantized) {
    refuse(place.where, what + " are integers, but the file doesn't use KHR_mesh_quantization",
           kExportAgain);
  }
  const std::vector<float> values =
      read_floats(to.source, to.checked, accessor, 3, false, what, place.where);
  std::vector<glm::vec3> points(values.size() / 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
    for (int c = 0; c < 3; ++c) {
      if (!(std::abs(points[i][c]) <= kLargestNumber)) {
        refuse(place.where, what + " are not finite at vertex " + std::to_string(i),
               "repair the mesh and export it again");
      }
    }
  }
  return points;
}

void read_triangles(Conversion& to, const tinygltf::Primitive& primitive, const Place& place,
                    Mesh& mesh) {
  const std::size_t vertices = mesh.positions.size();
  std::vector<std::uint32_t> corners;
  const int indices = accessor_of(primitive, kIndices);
  if (indices >= 0) {
    corners = read_integers(to.source, to.checked, indices, 1, "its indices", place.where);
    for (const std::uint32_t corner : corners) {
      if (corner >= vertices) {
        refuse(place.where,
               "it refers to vertex " + std::to_string(corner) + " of " + std::to_string(vertices),
               kExportAgain);
      }
    }
  }
  const std::size_t count = indices >= 0 ? corners.size() : vertices;
  const auto corner = [&](std::size_t i) {
    return indices >= 0 ? corners[i] : static_cast<std::uint32_t>(i);
  };
  if (primitive.mode == TINYGLTF_MODE_TRIANGLES) {
    for (std::size_t i = 0; i + 2 < count; i += 3) {
      mesh.triangles.emplace_back(corner(i), corner(i + 1), corner(i + 2));
    }
    if (count % 3 != 0) {
      to.model.warnings.push_back(place.part +
                                  " ends in a triangle of fewer than three corners, "
                                  "which is left out");
    }
    return;
  }
  // Orders of corners as in glTF 2.0, 3.7.2.1: all triangles face the same way.
  for (std::size_t i = 0; i + 2 < count; ++i) {
    if (primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
      mesh.triangles.emplace_back(corner(i), corner(i + 1 + i % 2), corner(i + 2 - i % 2));
    } else {
      mesh.triangles.emplace_back(corner(i + 1), corner(i + 2), corner(0));
    }
  }
}

void read_normals(Conversion& to, const tinygltf::Primitive& primitive, const Place& place,
                  Mesh& mesh) {
  const int accessor = accessor_of(primitive, "NORMAL");
  if (accessor < 0 || !to.checked.unusable[static_cast<std::size_t>(accessor)].empty()) return;
  const std::vector<float> values =
      read_floats(to.source, to.checked, accessor, 3, true, "its normals", place.where);
  const bool finite =
      std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
  if (!finite || values.size() != 3 * mesh.positions.size()) {
    to.model.warnings.push_back(place.part + " has unusable normals; they are left out");
    return;
  }
  mesh.normals.resize(mesh.positions.size());
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    mesh.normals[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
  }
}

void read_texcoords(Conversion& to, const tinygltf::Primitive& primitive, const Place& place,
                    Mesh& mesh) {
  BaseTexture texture;
  if (mesh.material >= 0) {
    texture = to.checked.base_textures[static_cast<std::size_t>(mesh.material)];
  }
  const int accessor = accessor_of(primitive, "TEXCOORD_" + std::to_string(texture.texcoord));
  if (accessor < 0 || !to.checked.unusable[static_cast<std::size_t>(accessor)].empty()) return;
  const std::vector<float> values = read_floats(to.source, to.checked, accessor, 2, false,
                                                "its texture coordinates", place.where);
  const bool finite =
      std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
  if (!finite || values.size() != 2 * mesh.positions.size()) {
    to.model.warnings.push_back(place.part +
                                " has unusable texture coordinates; they are left out");
    return;
  }
  const double c = std::cos(texture.rotation), s = std::sin(texture.rotation);
  mesh.texcoords.resize(mesh.positions.size());
  for (std::size_t i = 0; i < mesh.texcoords.size(); ++i) {
    const glm::dvec2 uv = texture.scale * glm::dvec2(values[2 * i], values[2 * i + 1]);
    mesh.texcoords[i] =
        glm::vec2(texture.offset + glm::dvec2(c * uv.x + s * uv.y, c * uv.y - s * uv.x));
  }
}

void read_morphs(Conversion& to, const tinygltf::Primitive& primitive, const Place& place,
                 Mesh& mesh) {
  for (const auto& target : primitive.targets) {
    MorphTarget morph;
    if (const auto it = target.find("POSITION"); it != target.end()) {
      morph.offsets = read_points(to, it->second, "its morph target's positions", place);
      if (morph.offsets.size() != mesh.positions.size()) {
        refuse(place.where,
               "a morph target moves " + std::to_string(morph.offsets.size()) + " vertices of " +
                   std::to_string(mesh.positions.size()),
               kExportAgain);
      }
    }
    mesh.morphs.push_back(std::move(morph));
  }
  mesh.morph_weights.assign(mesh.morphs.size(), 0.0);
  const tinygltf::Node& node = to.source.nodes[static_cast<std::size_t>(mesh.node)];
  const tinygltf::Mesh& source = to.source.meshes[static_cast<std::size_t>(mesh.source_mesh)];
  const std::vector<double>& weights = node.weights.empty() ? source.weights : node.weights;
  std::copy_n(weights.begin(), std::min(weights.size(), mesh.morph_weights.size()),
              mesh.morph_weights.begin());
}

// All JOINTS_n/WEIGHTS_n sets, four influences a vertex each, set after set.
struct RawInfluences {
  std::vector<std::vector<std::uint32_t>> slots;
  std::vector<std::vector<float>> weights;
};

RawInfluences read_influence_sets(const Conversion& to, const tinygltf::Primitive& primitive,
                                  const Place& place, std::size_t vertices) {
  RawInfluences raw;
  for (int set = 0;; ++set) {
    const int joints = accessor_of(primitive, "JOINTS_" + std::to_string(set));
    const int weights = accessor_of(primitive, "WEIGHTS_" + std::to_string(set));
    if (joints < 0 || weights < 0) return raw;
    raw.slots.push_back(
        read_integers(to.source, to.checked, joints, 4, "its joint indices", place.where));
    raw.weights.push_back(
        read_floats(to.source, to.checked, weights, 4, true, "its weights", place.where));
    if (raw.slots.back().size() != 4 * vertices || raw.weights.back().size() != 4 * vertices) {
      refuse(place.where,
             "it has joints and weights for " + std::to_string(raw.weights.back().size() / 4) +
                 " vertices of " + std::to_string(vertices),
             kExportAgain);
    }
  }
}

void read_influences(Conversion& to, const RawInfluences& raw, const Place& place, Mesh& mesh) {
  const Skin& skin = to.model.skins[static_cast<std::size_t>(mesh.skin)];
  std::size_t weightless = 0, negative = 0;
  std::vector<std::pair<std::uint32_t, double>> found;  // slot and weight, in the file's order
  mesh.influence_begin.push_back(0);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    found.clear();
    double total = 0;
    for (std::size_t set = 0; set < raw.slots.size(); ++set) {
      for (std::size_t k = 4 * v; k < 4 * v + 4; ++k) {
        const std::uint32_t slot = raw.slots[set][k];
        const double weight = static_cast<double>(raw.weights[set][k]);
        if (!std::isfinite(weight)) {
          refuse(place.where, "the weights of vertex " + std::to_string(v) + " are not finite",
                 kExportAgain);
        }
        if (weight < 0) ++negative;
        if (!(weight > 0)) continue;
        if (slot >= skin.joints.size()) {
          refuse(place.where,
                 "vertex " + std::to_string(v) + " follows joint " + std::to_string(slot) +
                     " of a skin of " + std::to_string(skin.joints.size()),
                 kExportAgain);
        }
        total += weight;
        const auto same = std::find_if(found.begin(), found.end(),
                                       [&](const auto& entry) { return entry.first == slot; });
        if (same != found.end()) {
          same->second += weight;
        } else {
          found.emplace_back(slot, weight);
        }
      }
    }
    if (found.empty()) {
      ++weightless;
      const std::uint32_t first = raw.slots[0][4 * v];
      found.emplace_back(first < skin.joints.size() ? first : 0, 1.0);
      total = 1.0;
    }
    for (const auto& [slot, weight] : found) {
      mesh.influences.push_back(
          {skin.joints[slot], static_cast<std::int32_t>(slot), static_cast<float>(weight / total)});
    }
    mesh.influence_begin.push_back(static_cast<std::uint32_t>(mesh.influences.size()));
  }
  if (weightless > 0) {
    to.model.warnings.push_back(place.part + " has " + std::to_string(weightless) +
                                " vertices without weights; each follows its first joint");
  }
  if (negative > 0) {
    to.model.warnings.push_back(place.part + " has " + std::to_string(negative) +
                                " negative weights; they count as 0");
  }
}

enum class Outcome { mesh, no_triangles, left_out };

Outcome convert_primitive(Conversion& to, const tinygltf::Primitive& primitive, const Place& place,
                          Mesh& mesh) {
  const int positions = accessor_of(primitive, "POSITION");
  if (!is_triangles(primitive.mode)) return Outcome::no_triangles;
  if (positions < 0) {
    to.model.warnings.push_back(place.part + " has triangles without positions; they are left out");
    return Outcome::left_out;
  }
  mesh.material = primitive.material;
  mesh.positions = read_points(to, positions, "its positions", place);
  read_triangles(to, primitive, place, mesh);
  read_normals(to, primitive, place, mesh);
  read_texcoords(to, primitive, place, mesh);
  read_morphs(to, primitive, place, mesh);
  if (mesh.skin < 0) return Outcome::mesh;
  const RawInfluences raw = read_influence_sets(to, primitive, place, mesh.positions.size());
  if (raw.slots.empty()) {
    to.model.warnings.push_back(place.part +
                                " has a skin but no joints or weights; it moves with "
                                "its node");
    mesh.skin = -1;
    return Outcome::mesh;
  }
  read_influences(to, raw, place, mesh);
  return Outcome::mesh;
}

}  // namespace

void convert_meshes(Conversion& to) {
  std::uint64_t elements = 0;
  std::size_t left_out = 0;
  for (std::size_t n = 0; n < to.source.nodes.size(); ++n) {
    const tinygltf::Node& node = to.source.nodes[n];
    if (node.mesh < 0 || !to.checked.visible[n]) continue;
    const tinygltf::Mesh& source = to.source.meshes[static_cast<std::size_t>(node.mesh)];
    Place place;
    place.part = part_name("node", n, node.name) + ", " +
                 part_name("mesh", static_cast<std::size_t>(node.mesh), source.name);
    place.where = to.in_file(place.part);
    for (std::size_t p = 0; p < source.primitives.size(); ++p) {
      const tinygltf::Primitive& primitive = source.primitives[p];
      // Before anything is read: this is what reading will take.
      for (const auto& [name, accessor] : primitive.attributes) {
        elements += to.source.accessors[static_cast<std::size_t>(accessor)].count;
      }
      for (const auto& target : primitive.targets) {
        for (const auto& [name, accessor] : target) {
          elements += to.source.accessors[static_cast<std::size_t>(accessor)].count;
        }
      }
      if (node.skin >= 0) {
        elements += to.source.skins[static_cast<std::size_t>(node.skin)].joints.size();
      }
      if (elements > most_elements(to.checked)) {
        refuse(place.where,
               "the file shows the same few meshes so often that they come to more "
               "than " +
                   std::to_string(most_elements(to.checked)) + " vertices and corners",
               "show fewer copies of them");
      }
      Mesh mesh;
      mesh.name = source.name.empty() ? node.name : source.name;
      mesh.node = static_cast<int>(n);
      mesh.skin = node.skin;
      mesh.source_mesh = node.mesh;
      mesh.source_primitive = static_cast<int>(p);
      const Outcome outcome = convert_primitive(to, primitive, place, mesh);
      if (outcome == Outcome::mesh) to.model.meshes.push_back(std::move(mesh));
      if (outcome == Outcome::no_triangles) ++left_out;
    }
  }
  if (left_out > 0) {
    to.model.warnings.push_back("points and lines are left out (" + std::to_string(left_out) +
                                " of the meshes' primitives)");
  }
}

}  // namespace elbowroom::gltf
