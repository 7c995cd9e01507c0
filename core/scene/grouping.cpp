// SPDX-License-Identifier: MIT
#include "core/scene/grouping.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>

namespace elbowroom {
namespace {

std::size_t index_of(int i) { return static_cast<std::size_t>(i); }

// Rank of each node when its tree is walked depth first, parents before children.
std::vector<int> preorder_ranks(const Skeleton& skeleton) {
  std::vector<int> rank(skeleton.joints.size(), 0), stack;
  for (auto it = skeleton.order.rbegin(); it != skeleton.order.rend(); ++it) {
    if (skeleton.joints[index_of(*it)].parent < 0) stack.push_back(*it);
  }
  for (int next = 0; !stack.empty(); ++next) {
    const int node = stack.back();
    stack.pop_back();
    rank[index_of(node)] = next;
    const std::vector<int>& children = skeleton.children[index_of(node)];
    stack.insert(stack.end(), children.rbegin(), children.rend());
  }
  return rank;
}

struct Tree {
  std::vector<int> depth, rank;  // by node
};

// The lowest node at or above all joints of a skin, -1 if they have no common root: it is the one
// of the first and the last of them in depth-first order.
int common_root(const Skeleton& skeleton, const Tree& tree, const Skin& skin) {
  if (skin.joints.empty()) return -1;
  const auto by_rank = [&](int a, int b) {
    return tree.rank[index_of(a)] < tree.rank[index_of(b)];
  };
  int common = *std::min_element(skin.joints.begin(), skin.joints.end(), by_rank);
  int other = *std::max_element(skin.joints.begin(), skin.joints.end(), by_rank);
  while (common != other) {
    if (common < 0 || other < 0) return -1;
    int& lower = tree.depth[index_of(common)] >= tree.depth[index_of(other)] ? common : other;
    lower = skeleton.joints[index_of(lower)].parent;
  }
  return common;
}

// Union-find over skins, smallest index first.
int find_group(std::vector<int>& group, int skin) {
  while (group[index_of(skin)] != skin) {
    group[index_of(skin)] = group[index_of(group[index_of(skin)])];
    skin = group[index_of(skin)];
  }
  return skin;
}

void join_groups(std::vector<int>& group, int a, int b) {
  a = find_group(group, a);
  b = find_group(group, b);
  group[index_of(std::max(a, b))] = std::min(a, b);
}

std::vector<int> skin_groups(const Model& model, const Tree& tree) {
  std::vector<int> group(model.skins.size());
  std::iota(group.begin(), group.end(), 0);
  // The first skin that claims a node as a joint or as its common root.
  std::vector<int> claim(model.skeleton.joints.size(), -1);
  for (std::size_t s = 0; s < model.skins.size(); ++s) {
    std::vector<int> nodes = model.skins[s].joints;
    if (const int root = common_root(model.skeleton, tree, model.skins[s]); root >= 0) {
      nodes.push_back(root);
    }
    for (const int node : nodes) {
      int& owner = claim[index_of(node)];
      if (owner < 0) {
        owner = static_cast<int>(s);
      } else {
        join_groups(group, owner, static_cast<int>(s));
      }
    }
  }
  // A claimed node below another claimed node hangs together with it.
  std::vector<int> above(model.skeleton.joints.size(), -1);
  for (const int node : model.skeleton.order) {
    const int parent = model.skeleton.joints[index_of(node)].parent;
    const int inherited = parent < 0 ? -1 : above[index_of(parent)];
    const int own = claim[index_of(node)];
    if (own >= 0 && inherited >= 0) join_groups(group, own, inherited);
    above[index_of(node)] = own >= 0 ? own : inherited;
  }
  for (std::size_t s = 0; s < group.size(); ++s) {
    group[s] = find_group(group, static_cast<int>(s));
  }
  return group;
}

// Places in the bind pose: corners of triangles, skinned and rigid, or joints.
struct BindPlaces {
  std::vector<Vec3> corners, joints;
};
BindPlaces bind_places(const Model& model, const Character& character) {
  const std::vector<Mat4> bind = bind_globals(model, character);
  const Pose pose = rest_pose(model.skeleton);
  BindPlaces places;
  std::vector<Vec3> vertices;
  for (const int index : character.meshes) {
    const Mesh& mesh = model.meshes[index_of(index)];
    deform(model, mesh, pose, bind, vertices);
    for (const glm::uvec3& triangle : mesh.triangles)
      for (int c = 0; c < 3; ++c) places.corners.push_back(vertices[triangle[c]]);
  }
  for (const int joint : character.joints) places.joints.emplace_back(bind[index_of(joint)][3]);
  return places;
}

// What each node's subtree holds: -1 nothing, the character, or kMixed for more than one thing.
constexpr int kMixed = -2;

int mix(int a, int b) {
  if (a == -1 || a == b) return b;
  return b == -1 ? a : kMixed;
}

std::vector<int> subtree_owners(const Model& model, const std::vector<int>& node_owner) {
  std::vector<int> owner = node_owner;
  for (auto it = model.skeleton.order.rbegin(); it != model.skeleton.order.rend(); ++it) {
    const int parent = model.skeleton.joints[index_of(*it)].parent;
    if (parent >= 0) owner[index_of(parent)] = mix(owner[index_of(parent)], owner[index_of(*it)]);
  }
  return owner;
}

std::string character_name(const Model& model, const Character& character, int self,
                           const std::vector<int>& owner) {
  std::vector<int> path;  // from the first joint up to the topmost node of its own
  for (int node = character.joints.empty() ? -1 : character.joints[0]; node >= 0;
       node = model.skeleton.joints[index_of(node)].parent) {
    if (owner[index_of(node)] != self) break;
    path.push_back(node);
  }
  for (auto it = path.rbegin(); it != path.rend(); ++it) {
    const std::string& name = model.skeleton.joints[index_of(*it)].name;
    if (!name.empty()) return name;
  }
  for (const int skin : character.skins) {
    if (!model.skins[index_of(skin)].name.empty()) return model.skins[index_of(skin)].name;
  }
  return model.path.stem().string();
}

void find_characters(Model& model, const Tree& tree, std::vector<int>& joint_owner) {
  const std::vector<int> group = skin_groups(model, tree);
  std::vector<bool> used(model.skins.size(), false);
  for (const Mesh& mesh : model.meshes) {
    if (mesh.skin >= 0) used[index_of(group[index_of(mesh.skin)])] = true;
  }
  const bool any_used = std::find(used.begin(), used.end(), true) != used.end();
  std::vector<int> character_of_group(model.skins.size(), -1);
  for (std::size_t s = 0; s < model.skins.size(); ++s) {
    if (any_used && !used[index_of(group[s])]) continue;
    int& index = character_of_group[index_of(group[s])];
    if (index < 0) {
      index = static_cast<int>(model.characters.size());
      model.characters.emplace_back();
    }
    Character& character = model.characters[index_of(index)];
    character.skins.push_back(static_cast<int>(s));
    for (const int joint : model.skins[s].joints) {
      if (joint_owner[index_of(joint)] >= 0) continue;
      joint_owner[index_of(joint)] = index;
      character.joints.push_back(joint);
    }
  }
  for (Character& character : model.characters) {
    std::sort(character.joints.begin(), character.joints.end());
  }
}

bool moves(const Channel& channel) {
  const auto components = static_cast<std::ptrdiff_t>(channel.components);
  const auto stride =
      channel.interpolation == Interpolation::cubic_spline ? 3 * components : components;
  const auto first = channel.values.begin();
  for (auto key = first; channel.values.end() - key >= stride; key += stride) {
    if (!std::equal(key, key + stride, first)) return true;
  }
  // Equal spline keys still bulge between them by their tangents.
  const auto still = [&](auto tangent) {
    return std::all_of(tangent, tangent + components, [](float v) { return v == 0; });
  };
  return channel.interpolation == Interpolation::cubic_spline && channel.times.size() > 1 &&
         !(still(first) && still(first + 2 * components));
}

void find_objects(Model& model, const std::vector<int>& mesh_character) {
  const Skeleton& skeleton = model.skeleton;
  std::vector<bool> bears(skeleton.joints.size(), false);
  for (std::size_t m = 0; m < model.meshes.size(); ++m) {
    if (mesh_character[m] < 0) bears[index_of(model.meshes[m].node)] = true;
  }
  std::vector<int> top(skeleton.joints.size(), -1);  // topmost mesh-bearing node at or above
  for (const int node : skeleton.order) {
    const int parent = skeleton.joints[index_of(node)].parent;
    const int inherited = parent < 0 ? -1 : top[index_of(parent)];
    top[index_of(node)] = inherited < 0 && bears[index_of(node)] ? node : inherited;
  }

  std::vector<bool> moved(skeleton.joints.size(),
                          false);  // by a channel of its own or of a node above
  for (const Clip& clip : model.clips) {
    for (const Channel& channel : clip.channels) {
      if (channel.joint >= 0 && moves(channel)) moved[index_of(channel.joint)] = true;
    }
  }

  for (const int node : skeleton.order) {
    const int parent = skeleton.joints[index_of(node)].parent;
    if (parent >= 0 && moved[index_of(parent)]) moved[index_of(node)] = true;
  }

  std::vector<int> object_of_node(skeleton.joints.size(), -1);
  for (std::size_t m = 0; m < model.meshes.size(); ++m) {
    if (mesh_character[m] >= 0) continue;
    const Mesh& mesh = model.meshes[m];
    const int node = top[index_of(mesh.node)];
    int& index = object_of_node[index_of(node)];
    if (index < 0) {
      index = static_cast<int>(model.objects.size());
      Object object;
      object.node = node;
      object.name = skeleton.joints[index_of(node)].name;
      if (object.name.empty()) object.name = mesh.name;
      if (object.name.empty()) object.name = "object " + std::to_string(index);
      model.objects.push_back(std::move(object));
    }
    Object& object = model.objects[index_of(index)];
    object.meshes.push_back(static_cast<int>(m));
    object.triangles += static_cast<int>(mesh.triangles.size());
    object.animated = object.animated || moved[index_of(mesh.node)];
  }
}

}  // namespace

double bind_extent(const Model& model, const Character& character, const Vec3& along) {
  const BindPlaces places = bind_places(model, character);
  for (const auto* points : {&places.corners, &places.joints}) {
    if (points->empty()) continue;
    Vec3 low = points->front(), high = low;
    double least = glm::dot(low, along), most = least;
    for (const Vec3& p : *points) {
      low = glm::min(low, p);
      high = glm::max(high, p);
      least = std::min(least, glm::dot(p, along));
      most = std::max(most, glm::dot(p, along));
    }
    const double diagonal = glm::length(high - low);
    if (!std::isfinite(diagonal) || !(diagonal > 0)) continue;
    return most - least > 1e-6 * diagonal ? most - least : diagonal;
  }
  return 1.0;
}

void group_characters_and_objects(Model& model) {
  model.characters.clear();
  model.objects.clear();
  const Skeleton& skeleton = model.skeleton;
  Tree tree;
  tree.rank = preorder_ranks(skeleton);
  tree.depth.assign(skeleton.joints.size(), 0);
  for (const int node : skeleton.order) {
    const int parent = skeleton.joints[index_of(node)].parent;
    if (parent >= 0) tree.depth[index_of(node)] = tree.depth[index_of(parent)] + 1;
  }

  std::vector<int> joint_owner(skeleton.joints.size(), -1);
  find_characters(model, tree, joint_owner);

  // The character whose joint is nearest above each node.
  std::vector<int> carrier = joint_owner;
  for (const int node : skeleton.order) {
    const int parent = skeleton.joints[index_of(node)].parent;
    if (carrier[index_of(node)] < 0 && parent >= 0) {
      carrier[index_of(node)] = carrier[index_of(parent)];
    }
  }
  std::vector<int> mesh_character(model.meshes.size(), -1);
  std::vector<int> node_owner = joint_owner;
  for (std::size_t m = 0; m < model.meshes.size(); ++m) {
    const Mesh& mesh = model.meshes[m];
    int character = carrier[index_of(mesh.node)];
    if (mesh.skin >= 0) {
      const std::vector<int>& joints = model.skins[index_of(mesh.skin)].joints;
      character = joints.empty() ? -1 : joint_owner[index_of(joints[0])];
    }
    mesh_character[m] = character;
    // Anything else than this character in a subtree makes the node above it no name for it.
    node_owner[index_of(mesh.node)] =
        mix(node_owner[index_of(mesh.node)], character >= 0 ? character : kMixed);
    if (character < 0) continue;
    model.characters[index_of(character)].meshes.push_back(static_cast<int>(m));
    model.characters[index_of(character)].triangles += static_cast<int>(mesh.triangles.size());
  }

  const std::vector<int> owner = subtree_owners(model, node_owner);
  for (std::size_t c = 0; c < model.characters.size(); ++c) {
    Character& character = model.characters[c];
    character.name = character_name(model, character, static_cast<int>(c), owner);
    character.height = bind_extent(model, character, Vec3(0, 1, 0));
  }
  find_objects(model, mesh_character);
}

}  // namespace elbowroom
