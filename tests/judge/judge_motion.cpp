// SPDX-License-Identifier: MIT
#include "tests/judge/judge_motion.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <map>

namespace judge {
namespace {

using glm::dmat3;
using glm::dmat4;
using glm::dquat;
using glm::dvec3;

void normalize(std::vector<double>& q) {
  double sum = 0;
  for (const double v : q) sum += v * v;
  for (double& v : q) v /= std::sqrt(sum);
}

// Visits every triangle primitive of the scene with the node that shows it, always in one order.
template <typename Visit>
void each_primitive(const File& file, Visit visit) {
  for (std::size_t i = 0; i < file.nodes.size(); ++i) {
    const Node& node = file.nodes[i];
    if (node.mesh < 0 || !node.in_scene) continue;
    const MeshData& mesh = file.meshes.at(static_cast<std::size_t>(node.mesh));
    for (const Primitive& primitive : mesh.primitives) {
      visit(static_cast<int>(i), node, mesh, primitive);
    }
  }
}

}  // namespace

std::vector<double> sample(const KeyChannel& channel, double t) {
  const auto width = static_cast<std::size_t>(channel.components);
  const bool cubic = channel.interpolation == "CUBICSPLINE", turn = channel.path == "rotation";
  const std::size_t count = channel.times.size();
  const auto value = [&](std::size_t key, std::size_t part) {
    const std::size_t at = width * (cubic ? 3 * key + part : key);
    return std::vector<double>(channel.values.begin() + static_cast<std::ptrdiff_t>(at),
                               channel.values.begin() + static_cast<std::ptrdiff_t>(at + width));
  };
  // The last key at or before t.
  std::size_t next = 0;
  while (next < count && static_cast<double>(channel.times[next]) <= t) ++next;
  std::vector<double> a = value(next == 0 ? 0 : next - 1, 1);
  if (next > 0 && next < count && channel.interpolation != "STEP") {
    const double h = static_cast<double>(channel.times[next]) - channel.times[next - 1];
    const double s = (t - channel.times[next - 1]) / h;
    std::vector<double> b = value(next, 1);
    if (cubic) {
      const std::vector<double> out = value(next - 1, 2), in = value(next, 0);
      for (std::size_t i = 0; i < width; ++i) {
        // De Casteljau on the Bezier form of the Hermite segment.
        double p0 = a[i], p1 = a[i] + h * out[i] / 3, p2 = b[i] - h * in[i] / 3, p3 = b[i];
        const double p01 = p0 + s * (p1 - p0), p12 = p1 + s * (p2 - p1), p23 = p2 + s * (p3 - p2);
        const double q0 = p01 + s * (p12 - p01), q1 = p12 + s * (p23 - p12);
        a[i] = q0 + s * (q1 - q0);
      }
    } else if (turn) {
      normalize(a);
      normalize(b);
      double cosine = 0;
      for (std::size_t i = 0; i < 4; ++i) cosine += a[i] * b[i];
      const double sign = cosine < 0 ? -1 : 1;
      double chord = 0;
      for (std::size_t i = 0; i < 4; ++i) chord += (sign * b[i] - a[i]) * (sign * b[i] - a[i]);
      const double whole = 2 * std::asin(std::fmin(1.0, std::sqrt(chord) / 2));
      const double wa = whole < 1e-9 ? 1 - s : std::sin((1 - s) * whole) / std::sin(whole);
      const double wb = whole < 1e-9 ? s : std::sin(s * whole) / std::sin(whole);
      for (std::size_t i = 0; i < 4; ++i) a[i] = wa * a[i] + wb * sign * b[i];
    } else {
      for (std::size_t i = 0; i < width; ++i) a[i] += s * (b[i] - a[i]);
    }
  }
  if (turn) normalize(a);
  return a;
}

dquat sample_rotation(const KeyChannel& channel, double t) {
  const std::vector<double> v = sample(channel, t);
  return dquat(v[3], v[0], v[1], v[2]);
}

dquat rotation_at(const File& file, const KeyAnimation& animation, int node, double t) {
  for (const KeyChannel& channel : animation.channels) {
    if (channel.node == node && channel.path == "rotation" && channel.components == 4) {
      return sample_rotation(channel, t);
    }
  }
  return file.nodes.at(static_cast<std::size_t>(node)).rotation;
}

double angle(const dquat& a, const dquat& b) {
  const dquat d = glm::conjugate(a) * b;
  return 2 * std::atan2(std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z), std::fabs(d.w));
}

State state_at(const File& file, const KeyAnimation* animation, double t, const dmat4& placement) {
  std::vector<Node> nodes = file.nodes;
  State state;
  state.weights.resize(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) state.weights[i] = nodes[i].weights;
  if (animation) {
    for (const KeyChannel& channel : animation->channels) {
      Node& node = nodes.at(static_cast<std::size_t>(channel.node));
      if (channel.components == 0 || (node.matrix && channel.path != "weights")) continue;
      const std::vector<double> v = sample(channel, t);
      if (channel.path == "translation") node.translation = dvec3(v[0], v[1], v[2]);
      if (channel.path == "scale") node.scale = dvec3(v[0], v[1], v[2]);
      if (channel.path == "rotation") node.rotation = dquat(v[3], v[0], v[1], v[2]);
      if (channel.path == "weights") state.weights[static_cast<std::size_t>(channel.node)] = v;
    }
  }
  state.world.resize(nodes.size());
  for (const int i : file.order) {
    const Node& node = nodes[static_cast<std::size_t>(i)];
    dmat4 local = node.matrix.value_or(dmat4(1.0));
    if (!node.matrix) {
      local = glm::translate(dmat4(1.0), node.translation) * glm::mat4_cast(node.rotation) *
              glm::scale(dmat4(1.0), node.scale);
    }
    state.world[static_cast<std::size_t>(i)] =
        (node.parent < 0 ? placement : state.world[static_cast<std::size_t>(node.parent)]) * local;
  }
  return state;
}

dmat4 rigid_frame(const dmat4& m) {
  dmat3 r(m);
  if (glm::determinant(r) < 0) r = -r;
  for (int c = 0; c < 3; ++c) r[c] = glm::normalize(r[c]);
  // The rotation nearest to what is left, by averaging with its inverse transposed.
  for (int i = 0; i < 50; ++i) r = 0.5 * (r + glm::transpose(glm::inverse(r)));
  dmat4 frame(r);
  frame[3] = m[3];
  return frame;
}

Soup soup_of(const File& file) {
  Soup soup;
  each_primitive(file,
                 [&](int index, const Node& node, const MeshData&, const Primitive& primitive) {
                   const auto base = static_cast<unsigned>(soup.point_count);
                   soup.point_count += primitive.positions.size();
                   for (const glm::uvec3& triangle : primitive.triangles) {
                     soup.triangles.push_back(triangle + base);
                     soup.mesh_node.push_back(index);
                     soup.rigid.push_back(node.skin < 0 && primitive.morphs.empty());
                     int joint = index;
                     if (node.skin >= 0) {
                       const SkinData& skin = file.skins.at(static_cast<std::size_t>(node.skin));
                       std::map<int, double> sums;
                       for (int k = 0; k < 3; ++k) {
                         for (const auto& [slot, weight] : primitive.influences.at(triangle[k])) {
                           sums[skin.joints.at(static_cast<std::size_t>(slot))] += weight;
                         }
                       }
                       double most = -1;
                       for (const auto& [candidate, sum] : sums) {
                         if (sum > most + 1e-12) {
                           most = sum;
                           joint = candidate;
                         }
                       }
                     }
                     soup.joint.push_back(joint);
                   }
                 });
  return soup;
}

void place(const File& file, const State& state, std::vector<dvec3>& points) {
  points.clear();
  each_primitive(file, [&](int index, const Node& node, const MeshData& mesh,
                           const Primitive& primitive) {
    const auto& own = state.weights[static_cast<std::size_t>(index)];
    const std::vector<double>& weights = own.empty() ? mesh.weights : own;
    std::vector<dmat4> palette;
    if (node.skin >= 0) {
      const SkinData& skin = file.skins.at(static_cast<std::size_t>(node.skin));
      for (std::size_t j = 0; j < skin.joints.size(); ++j) {
        palette.push_back(state.world.at(static_cast<std::size_t>(skin.joints[j])) *
                          skin.inverse_bind[j]);
      }
    }
    for (std::size_t v = 0; v < primitive.positions.size(); ++v) {
      dvec3 p = primitive.positions[v];
      for (std::size_t m = 0; m < std::min(weights.size(), primitive.morphs.size()); ++m) {
        if (!primitive.morphs[m].empty()) p += weights[m] * primitive.morphs[m][v];
      }
      if (node.skin < 0) {
        points.push_back(dvec3(state.world[static_cast<std::size_t>(index)] * glm::dvec4(p, 1)));
      } else {
        dvec3 sum(0.0);
        for (const auto& [slot, weight] : primitive.influences[v]) {
          sum += weight * dvec3(palette.at(static_cast<std::size_t>(slot)) * glm::dvec4(p, 1));
        }
        points.push_back(sum);
      }
    }
  });
}

}  // namespace judge
