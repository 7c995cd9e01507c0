// SPDX-License-Identifier: MIT
#include "tests/unit/render/scenes.h"

#include <algorithm>
#include <cmath>

namespace elbowroom::test {

int add_node(Model& model, int parent, const Transform& rest) {
  Joint joint;
  joint.parent = parent;
  joint.rest = rest;
  joint.name = "node" + std::to_string(model.skeleton.size());
  model.skeleton.joints.push_back(joint);
  link_skeleton(model.skeleton);
  return model.skeleton.size() - 1;
}

Mesh box_mesh(const glm::vec3& half) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.positions.push_back(half *
                             glm::vec3((i & 1) ? 1 : -1, (i & 2) ? 1 : -1, (i & 4) ? 1 : -1));
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

Mesh sphere_mesh(float radius, int rings, int segments) {
  Mesh mesh;
  for (int r = 0; r <= rings; ++r) {
    const double polar = kPi * r / rings;
    for (int s = 0; s < segments; ++s) {
      const double around = 2.0 * kPi * s / segments;
      mesh.positions.push_back(radius * glm::vec3(std::sin(polar) * std::cos(around),
                                                  std::cos(polar),
                                                  std::sin(polar) * std::sin(around)));
    }
  }
  const auto at = [segments](int r, int s) {
    return static_cast<unsigned>(r * segments + s % segments);
  };
  for (int r = 0; r < rings; ++r) {
    for (int s = 0; s < segments; ++s) {
      mesh.triangles.emplace_back(at(r, s), at(r, s + 1), at(r + 1, s));
      mesh.triangles.emplace_back(at(r, s + 1), at(r + 1, s + 1), at(r + 1, s));
    }
  }
  return mesh;
}

Mesh cylinder_mesh(float radius, float height, int rings, int segments) {
  Mesh mesh;
  for (int r = 0; r <= rings; ++r) {
    for (int s = 0; s < segments; ++s) {
      const double around = 2.0 * kPi * s / segments;
      mesh.positions.emplace_back(radius * static_cast<float>(std::cos(around)),
                                  height * static_cast<float>(r) / static_cast<float>(rings),
                                  radius * static_cast<float>(std::sin(around)));
    }
  }
  const auto at = [segments](int r, int s) {
    return static_cast<unsigned>(r * segments + s % segments);
  };
  for (int r = 0; r < rings; ++r) {
    for (int s = 0; s < segments; ++s) {
      mesh.triangles.emplace_back(at(r, s), at(r + 1, s), at(r, s + 1));
      mesh.triangles.emplace_back(at(r, s + 1), at(r + 1, s), at(r + 1, s + 1));
    }
  }
  const auto bottom = static_cast<unsigned>(mesh.positions.size());
  mesh.positions.emplace_back(0.0f);
  mesh.positions.emplace_back(0.0f, height, 0.0f);
  for (int s = 0; s < segments; ++s) {
    mesh.triangles.emplace_back(bottom, at(0, s), at(0, s + 1));
    mesh.triangles.emplace_back(bottom + 1, at(rings, s + 1), at(rings, s));
  }
  return mesh;
}

int add_mesh(Model& model, Mesh mesh, int node) {
  mesh.node = node;
  model.meshes.push_back(std::move(mesh));
  return static_cast<int>(model.meshes.size()) - 1;
}

void add_object(Model& model, int mesh) {
  Object object;
  object.node = model.meshes[static_cast<std::size_t>(mesh)].node;
  object.meshes = {mesh};
  object.triangles =
      static_cast<int>(model.meshes[static_cast<std::size_t>(mesh)].triangles.size());
  model.objects.push_back(object);
}

std::shared_ptr<Model> bending_character(int joints, int influences) {
  constexpr float kHeight = 1.5f;
  auto model = std::make_shared<Model>();
  const int root = add_node(*model, -1, {});
  Skin skin;
  const double step = double{kHeight} / joints;
  int parent = root;
  for (int j = 0; j < joints; ++j) {
    Transform rest;
    rest.translation = Vec3(0, j == 0 ? 0.0 : step, 0);
    parent = add_node(*model, parent, rest);
    skin.joints.push_back(parent);
    Mat4 inverse(1.0);
    inverse[3] = glm::dvec4(0, -step * j, 0, 1);
    skin.inverse_bind.push_back(inverse);
  }
  Mesh mesh = cylinder_mesh(0.15f, kHeight, 30);
  mesh.skin = 0;
  for (const auto& p : mesh.positions) {
    mesh.influence_begin.push_back(static_cast<std::uint32_t>(mesh.influences.size()));
    std::vector<std::pair<double, int>> nearest;
    for (int j = 0; j < joints; ++j) {
      nearest.emplace_back(std::abs(double{p.y} - step * (j + 0.5)), j);
    }
    std::sort(nearest.begin(), nearest.end());
    double sum = 0;
    const auto weight = [&](int k) {
      return std::exp(-3.0 * nearest[static_cast<std::size_t>(k)].first / step);
    };
    for (int k = 0; k < std::min(influences, joints); ++k) sum += weight(k);
    for (int k = 0; k < std::min(influences, joints); ++k) {
      const int slot = nearest[static_cast<std::size_t>(k)].second;
      mesh.influences.push_back(
          {skin.joints[static_cast<std::size_t>(slot)], slot, static_cast<float>(weight(k) / sum)});
    }
  }
  mesh.influence_begin.push_back(static_cast<std::uint32_t>(mesh.influences.size()));
  Character character;
  character.name = "cylinder";
  character.skins = {0};
  character.meshes = {add_mesh(*model, std::move(mesh), root)};
  character.joints = skin.joints;
  character.height = double{kHeight};
  character.triangles = static_cast<int>(model->meshes[0].triangles.size());
  model->skins.push_back(skin);
  model->characters.push_back(character);
  return model;
}

Actor actor_of(std::shared_ptr<const Model> model, const Mat4& place) {
  Actor actor;
  actor.name = "actor";
  actor.model = std::move(model);
  actor.world_from_file = place;
  return actor;
}

std::shared_ptr<Clip> bending_clip(const Model& model, double angle) {
  auto clip = std::make_shared<Clip>();
  clip->name = "bend";
  const auto& joints = model.characters.front().joints;
  for (std::size_t j = 1; j < joints.size(); ++j) {
    Channel channel;
    channel.joint = joints[j];
    channel.times = {0, 1};
    const double half = 0.5 * angle / static_cast<double>(joints.size());
    channel.values = {
        0, 0, 0, 1, 0, 0, static_cast<float>(std::sin(half)), static_cast<float>(std::cos(half))};
    clip->channels.push_back(channel);
  }
  clip->end = 1;
  return clip;
}

}  // namespace elbowroom::test
