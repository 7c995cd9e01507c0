// SPDX-License-Identifier: MIT
#include "render/render_geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace elbowroom {
namespace {

bool finite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool finite(const Mat4& m) {
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 4; ++r) {
      if (!std::isfinite(m[c][r])) return false;
    }
  }
  return true;
}

// Vertices at the same place get the same number.
std::vector<std::uint32_t> weld(const std::vector<glm::vec3>& positions) {
  std::vector<std::uint32_t> order(positions.size()), group(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto less = [&](std::uint32_t a, std::uint32_t b) {
    const auto &p = positions[a], &q = positions[b];
    if (p.x != q.x) return p.x < q.x;
    if (p.y != q.y) return p.y < q.y;
    if (p.z != q.z) return p.z < q.z;
    return a < b;
  };
  std::sort(order.begin(), order.end(), less);
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i > 0 && positions[order[i]] != positions[order[i - 1]]) ++count;
    group[order[i]] = count;
  }
  return group;
}

struct Corner {
  glm::dvec3 normal;  // of the face, unit
  double angle;       // of the face at this corner
};

// A normal for each corner of each triangle: the mean of the faces about the corner, weighted by
// their angles there, of those within the crease angle of the corner's own face.
std::vector<glm::vec3> corner_normals(const std::vector<glm::vec3>& positions,
                                      const std::vector<glm::uvec3>& triangles) {
  const auto group = weld(positions);
  const std::size_t groups = group.empty() ? 0 : 1u + *std::max_element(group.begin(), group.end());
  std::vector<Corner> corners(3 * triangles.size());
  std::vector<std::vector<std::uint32_t>> around(groups);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const glm::dvec3 p[3] = {glm::dvec3(positions[triangles[t][0]]),
                             glm::dvec3(positions[triangles[t][1]]),
                             glm::dvec3(positions[triangles[t][2]])};
    const glm::dvec3 cross = glm::cross(p[1] - p[0], p[2] - p[0]);
    // Slivers have angles but no direction worth a vote.
    const double longest =
        std::max({glm::length(p[1] - p[0]), glm::length(p[2] - p[1]), glm::length(p[0] - p[2])});
    const double length = glm::length(cross);
    const double area = length > 1e-7 * longest * longest ? length : 0.0;
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 a = p[(k + 1) % 3] - p[k], b = p[(k + 2) % 3] - p[k];
      Corner& corner = corners[3 * t + static_cast<std::size_t>(k)];
      corner.normal = area > 0 ? cross / area : glm::dvec3(0.0);
      corner.angle = area > 0 ? std::atan2(area, glm::dot(a, b)) : 0.0;
      around[group[triangles[t][k]]].push_back(static_cast<std::uint32_t>(3 * t + k));
    }
  }
  const double crease = std::cos(kCreaseAngle);
  std::vector<glm::vec3> normals(corners.size(), glm::vec3(0, 1, 0));
  // A vertex that very many faces share (the tip of a fan) would cost their square; there all
  // faces are taken for smooth.
  constexpr std::size_t kFan = 64;
  for (const auto& ring : around) {
    glm::dvec3 all(0.0);
    if (ring.size() > kFan) {
      for (const auto c : ring) all += corners[c].angle * corners[c].normal;
    }
    for (const auto c : ring) {
      glm::dvec3 sum = all;
      if (ring.size() <= kFan) {
        for (const auto other : ring) {
          if (corners[c].angle == 0 ||
              glm::dot(corners[c].normal, corners[other].normal) >= crease) {
            sum += corners[other].angle * corners[other].normal;
          }
        }
      }
      const double length = glm::length(sum);
      if (length > 0) normals[c] = glm::vec3(sum / length);
    }
  }
  return normals;
}

// Appends the influences of source vertex v and returns their range.
std::pair<std::uint32_t, std::uint32_t> append_influences(const Mesh& mesh, std::size_t v,
                                                          const RenderMesh& target,
                                                          RenderGeometry& out) {
  const auto begin = static_cast<std::uint32_t>(out.influences.size());
  if (mesh.skin >= 0 && v + 1 < mesh.influence_begin.size()) {
    for (auto i = mesh.influence_begin[v]; i < mesh.influence_begin[v + 1]; ++i) {
      if (i >= mesh.influences.size()) break;
      const Influence& influence = mesh.influences[i];
      const auto entry = target.palette_begin + static_cast<std::uint32_t>(influence.slot);
      if (influence.slot < 0 || entry >= target.palette_end || !std::isfinite(influence.weight)) {
        continue;
      }
      if (influence.weight != 0) out.influences.push_back({entry, influence.weight});
    }
  } else if (mesh.skin < 0) {
    out.influences.push_back({target.palette_begin, 1.0f});
  }
  return {begin, static_cast<std::uint32_t>(out.influences.size())};
}

void grow_boxes(const glm::vec3& position, std::uint32_t begin, std::uint32_t end,
                RenderGeometry& out) {
  for (auto i = begin; i < end; ++i) {
    auto& box = out.palette_boxes[out.influences[i].palette];
    box.lower = glm::min(box.lower, position);
    box.upper = glm::max(box.upper, position);
  }
}

void append_mesh(const Mesh& mesh, std::uint32_t index, RenderGeometry& out) {
  RenderMesh& target = out.meshes[index];
  target.first_vertex = static_cast<std::uint32_t>(out.vertices.size());
  target.first_index = static_cast<std::uint32_t>(out.indices.size());
  target.first_triangle = out.triangle_count;

  std::vector<glm::vec3> positions = mesh.positions;
  std::vector<bool> sound(positions.size());
  for (std::size_t v = 0; v < positions.size(); ++v) {
    sound[v] = finite(positions[v]);
    if (!sound[v]) positions[v] = glm::vec3(0.0f);
  }
  std::vector<glm::uvec3> triangles = mesh.triangles;
  for (auto& triangle : triangles) {
    bool drawable = true;
    for (int k = 0; k < 3; ++k) {
      drawable = drawable && triangle[k] < positions.size() && sound[triangle[k]];
    }
    if (!drawable) triangle = glm::uvec3(0);
  }
  if (positions.empty()) triangles.clear();

  const bool made = mesh.normals.size() != positions.size();
  const auto normals = made ? corner_normals(positions, triangles) : std::vector<glm::vec3>();

  // For each source vertex the vertices made of it; one unless normals split it.
  std::vector<std::vector<std::uint32_t>> copies(made ? positions.size() : 0);
  const auto append = [&](std::size_t v, const glm::vec3& normal) {
    const glm::vec2 uv =
        mesh.texcoords.size() == positions.size() ? mesh.texcoords[v] : glm::vec2(0.0f);
    const bool uv_sound = std::isfinite(uv.x) && std::isfinite(uv.y);
    const auto name = static_cast<std::uint32_t>(out.vertices.size());
    out.vertices.push_back({positions[v], uv_sound ? uv.x : 0.0f,
                            finite(normal) ? normal : glm::vec3(0, 1, 0), uv_sound ? uv.y : 0.0f});
    const auto [begin, end] = append_influences(mesh, v, target, out);
    out.bindings.push_back({begin, end, index, static_cast<std::uint32_t>(v)});
    if (sound[v]) grow_boxes(positions[v], begin, end, out);
    return name;
  };
  if (!made) {
    for (std::size_t v = 0; v < positions.size(); ++v) append(v, mesh.normals[v]);
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const auto v = triangles[t][k];
      if (!made) {
        out.indices.push_back(target.first_vertex + v);
        continue;
      }
      const glm::vec3& normal = normals[3 * t + static_cast<std::size_t>(k)];
      std::uint32_t found = std::numeric_limits<std::uint32_t>::max();
      for (const auto copy : copies[v]) {
        if (glm::dot(out.vertices[copy].normal, normal) > 0.9999f) found = copy;
      }
      if (found == std::numeric_limits<std::uint32_t>::max()) {
        found = append(v, normal);
        copies[v].push_back(found);
      }
      out.indices.push_back(found);
    }
  }
  target.vertex_count = static_cast<std::uint32_t>(out.vertices.size()) - target.first_vertex;
  target.index_count = static_cast<std::uint32_t>(out.indices.size()) - target.first_index;
  out.triangle_count += static_cast<std::uint32_t>(triangles.size());

  for (const auto& morph : mesh.morphs) {
    if (morph.offsets.size() != mesh.positions.size() || morph.offsets.empty()) {
      target.morph_block.push_back(-1);
      continue;
    }
    target.morph_block.push_back(static_cast<std::int32_t>(out.morph_offsets.size()));
    for (const auto& offset : morph.offsets) {
      out.morph_offsets.push_back(finite(offset) ? offset : glm::vec3(0.0f));
    }
    out.has_morphs = true;
  }
}

}  // namespace

RenderGeometry make_render_geometry(const Model& model) {
  RenderGeometry out;
  for (const auto& skin : model.skins) {
    out.skin_palette.push_back(out.palette_size);
    out.palette_size += static_cast<std::uint32_t>(skin.joints.size());
  }
  out.meshes.resize(model.meshes.size());
  for (std::size_t m = 0; m < model.meshes.size(); ++m) {
    const Mesh& mesh = model.meshes[m];
    RenderMesh& target = out.meshes[m];
    if (mesh.skin >= 0 && mesh.skin < static_cast<int>(model.skins.size())) {
      const auto skin = static_cast<std::size_t>(mesh.skin);
      target.palette_begin = out.skin_palette[skin];
      target.palette_end =
          target.palette_begin + static_cast<std::uint32_t>(model.skins[skin].joints.size());
    } else {
      target.palette_begin = out.palette_size++;
      target.palette_end = out.palette_size;
    }
  }
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  out.palette_boxes.assign(out.palette_size, {glm::vec3(kInfinity), glm::vec3(-kInfinity)});
  for (std::size_t m = 0; m < model.meshes.size(); ++m) {
    append_mesh(model.meshes[m], static_cast<std::uint32_t>(m), out);
  }
  return out;
}

std::vector<int> make_palette(const Model& model, const RenderGeometry& geometry,
                              const std::vector<Mat4>& world_from_joint, const Vec3& origin,
                              const std::vector<float>& emphasis,
                              std::vector<PaletteEntry>& palette) {
  palette.assign(geometry.palette_size, PaletteEntry{});
  // 0: not finite, else the sign of the determinant.
  std::vector<int> sign(geometry.palette_size, 0);
  const auto set = [&](std::uint32_t entry, int node, const Mat4& inverse_bind) {
    if (node < 0 || node >= static_cast<int>(world_from_joint.size())) return;
    Mat4 m = world_from_joint[static_cast<std::size_t>(node)] * inverse_bind;
    m[3] -= glm::dvec4(origin, 0.0);
    if (!finite(m)) return;
    for (int r = 0; r < 3; ++r) {
      palette[entry].row[r] = glm::vec4(static_cast<float>(m[0][r]), static_cast<float>(m[1][r]),
                                        static_cast<float>(m[2][r]), static_cast<float>(m[3][r]));
    }
    if (node < static_cast<int>(emphasis.size())) {
      palette[entry].emphasis.x = emphasis[static_cast<std::size_t>(node)];
    }
    sign[entry] = glm::determinant(Mat3(m)) < 0 ? -1 : 1;
  };
  for (std::size_t s = 0; s < model.skins.size(); ++s) {
    const Skin& skin = model.skins[s];
    for (std::size_t j = 0; j < skin.joints.size(); ++j) {
      const Mat4 inverse_bind = j < skin.inverse_bind.size() ? skin.inverse_bind[j] : Mat4(1.0);
      set(geometry.skin_palette[s] + static_cast<std::uint32_t>(j), skin.joints[j], inverse_bind);
    }
  }
  std::vector<int> result(geometry.meshes.size(), 1);
  for (std::size_t m = 0; m < geometry.meshes.size(); ++m) {
    const RenderMesh& mesh = geometry.meshes[m];
    if (model.meshes[m].skin < 0) set(mesh.palette_begin, model.meshes[m].node, Mat4(1.0));
    int positive = 0, negative = 0;
    bool sound = true;
    for (auto entry = mesh.palette_begin; entry < mesh.palette_end; ++entry) {
      // Joints that move no vertex of the model have no say.
      if (geometry.palette_boxes[entry].lower.x > geometry.palette_boxes[entry].upper.x) continue;
      sound = sound && sign[entry] != 0;
      (sign[entry] < 0 ? negative : positive) += 1;
    }
    result[m] = !sound ? 0 : negative > positive ? -1 : 1;
  }
  return result;
}

}  // namespace elbowroom
