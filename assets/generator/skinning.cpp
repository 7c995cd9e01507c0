// SPDX-License-Identifier: MIT
#include "assets/generator/skinning.h"

#include <algorithm>
#include <map>

namespace elbowroom::demo {

namespace {

// A bone as the skin sees it: a stretch of line that owns what is nearest to it.
struct Bone {
  int joint;
  BodyPart part;
  Vec3 a, b;
};

// How short the blend between two bones is, against their distance from the skin.
constexpr double kHeat = 1.8;

double segment_distance(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double t = std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0, 1.0);
  return glm::length(p - a - t * ab);
}

std::vector<Bone> make_bones(const Figure& figure) {
  std::vector<Bone> bones;
  const auto at = [&](const std::string& name) {
    return figure.joints[static_cast<std::size_t>(figure.find(name))].position;
  };
  const auto add = [&](const std::string& joint, BodyPart part, const Vec3& a, const Vec3& b) {
    bones.push_back({figure.find(joint), part, a, b});
  };
  const Vec3 hips = at("Hips"), spine = at("Spine"), chest = at("Chest"), neck = at("Neck"),
             head = at("Head");
  add("Hips", BodyPart::trunk, hips, spine);
  add("Spine", BodyPart::trunk, spine, chest);
  add("Chest", BodyPart::trunk, chest, neck);
  add("Neck", BodyPart::trunk, neck, head);
  add("Head", BodyPart::trunk, head, head + Vec3(0, 0.14, 0.02));
  for (const double side : {1.0, -1.0}) {
    const std::string s = side > 0 ? "Left" : "Right";
    const Vec3 clavicle = at(s + "Shoulder"), shoulder = at(s + "UpperArm"),
               elbow = at(s + "LowerArm"), wrist = at(s + "Hand"), hip = at(s + "UpperLeg"),
               knee = at(s + "LowerLeg"), ankle = at(s + "Foot"), toes = at(s + "Toes");
    const Vec3 in(-side, 0, 0);
    // The chest reaches out to the armpits and the hips down beside the legs' roots, so that
    // neither clavicle nor thigh takes hold of the trunk.
    add(s + "Shoulder", BodyPart::trunk, glm::mix(clavicle, shoulder, 0.55), shoulder);
    add("Chest", BodyPart::trunk, chest, shoulder + Vec3(-0.085 * side, -0.11, 0));
    add("Hips", BodyPart::trunk, hips, hip + Vec3(0, 0.01, 0));
    for (const BodyPart part : {BodyPart::trunk, BodyPart::arm}) {
      const Vec3 along = glm::normalize(elbow - shoulder);
      add(s + "UpperArm", part, shoulder + 0.02 * along, elbow);
    }
    for (const BodyPart part : {BodyPart::trunk, BodyPart::leg})
      add(s + "UpperLeg", part, hip + Vec3(0, -0.03, 0), knee);
    add(s + "LowerArm", BodyPart::arm, elbow, wrist);
    add(s + "LowerLeg", BodyPart::leg, knee, ankle);
    add(s + "Foot", BodyPart::leg, ankle, toes);
    add(s + "Foot", BodyPart::leg, ankle, ankle + Vec3(0, -0.04, -0.03));
    add(s + "Toes", BodyPart::leg, toes, toes + Vec3(0, 0, 0.06));
    const std::vector<Finger> fingers = left_fingers();
    for (const Finger& f : fingers) {
      const auto mirror = [&](const Vec3& p) { return Vec3(side * p.x, p.y, p.z); };
      for (int i = 0; i < 3; ++i)
        add(s + f.name + std::to_string(i + 1), BodyPart::arm, mirror(f.points[i]),
            mirror(f.points[i + 1]));
      if (std::string(f.name) != "Thumb")
        add(s + "Hand", BodyPart::arm, wrist,
            mirror(glm::mix(f.points[0], left_hand_frame().wrist, 0.12)));
    }
  }
  return bones;
}

// Joints that may share a vertex: parent and child, grandparent, and siblings.
bool related(const Figure& figure, int a, int b) {
  const auto parent = [&](int j) {
    return j < 0 ? -1 : figure.joints[static_cast<std::size_t>(j)].parent;
  };
  return a == b || parent(a) == b || parent(b) == a || parent(parent(a)) == b ||
         parent(parent(b)) == a || parent(a) == parent(b);
}

}  // namespace

std::vector<VertexWeights> skin_weights(const Surface& surface, const BodyShape& shape,
                                        const Figure& figure) {
  const std::size_t n = surface.positions.size();
  const std::vector<Bone> bones = make_bones(figure);

  // Each vertex's owner and how strongly it heats.
  std::vector<int> owner(n);
  std::vector<double> heat(n), area(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3& p = surface.positions[i];
    const BodyPart part = shape.part(p);
    double nearest = 1e9;
    for (const Bone& bone : bones) {
      if (bone.part != part) continue;
      const double d = segment_distance(p, bone.a, bone.b);
      if (d < nearest) nearest = d, owner[i] = bone.joint;
    }
    heat[i] = kHeat / (nearest * nearest);
  }

  // Rows of L; std::map keeps the columns' order fixed.
  std::vector<std::map<std::uint32_t, double>> rows(n);
  for (const auto& t : surface.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
      const Vec3 u = surface.positions[a] - surface.positions[c],
                 v = surface.positions[b] - surface.positions[c];
      const double doubled = glm::length(glm::cross(u, v));
      // Negative cotangents would break the maximum principle: no weight below 0 or above 1.
      const double cotangent = std::max(0.5 * glm::dot(u, v) / doubled, 0.02);
      rows[a][b] += cotangent;
      rows[b][a] += cotangent;
      area[a] += doubled / 6.0;
    }
  std::vector<double> diagonal(n);
  for (std::size_t i = 0; i < n; ++i) {
    diagonal[i] = area[i] * heat[i];
    for (const auto& [j, w] : rows[i]) diagonal[i] += w;
  }
  std::vector<std::uint32_t> row_begin(n + 1, 0), column;
  std::vector<double> entry;
  for (std::size_t i = 0; i < n; ++i) {
    for (const auto& [j, w] : rows[i]) column.push_back(j), entry.push_back(-w);
    row_begin[i + 1] = static_cast<std::uint32_t>(column.size());
  }

  // One solve a joint by conjugate gradients, Jacobi preconditioned.
  std::vector<std::vector<double>> weights(figure.joints.size());
  std::vector<double> r(n), z(n), direction(n), image(n);
  for (std::size_t joint = 0; joint < figure.joints.size(); ++joint) {
    std::vector<double>& x = weights[joint];
    x.assign(n, 0.0);
    double norm = 0, rho = 0;
    for (std::size_t i = 0; i < n; ++i) {
      r[i] = owner[i] == static_cast<int>(joint) ? area[i] * heat[i] : 0.0;
      z[i] = r[i] / diagonal[i];
      direction[i] = z[i];
      rho += r[i] * z[i];
      norm += r[i] * r[i];
    }
    double residual = norm;
    for (int iteration = 0; iteration < 400 && residual > 1e-16 * norm; ++iteration) {
      double curvature = 0;
      for (std::size_t i = 0; i < n; ++i) {
        double sum = diagonal[i] * direction[i];
        for (std::uint32_t k = row_begin[i]; k < row_begin[i + 1]; ++k)
          sum += entry[k] * direction[column[k]];
        image[i] = sum;
        curvature += sum * direction[i];
      }
      const double alpha = rho / curvature;
      double next = 0;
      residual = 0;
      for (std::size_t i = 0; i < n; ++i) {
        x[i] += alpha * direction[i];
        r[i] -= alpha * image[i];
        z[i] = r[i] / diagonal[i];
        next += r[i] * z[i];
        residual += r[i] * r[i];
      }
      const double beta = next / rho;
      rho = next;
      for (std::size_t i = 0; i < n; ++i) direction[i] = z[i] + beta * direction[i];
    }
  }

  std::vector<VertexWeights> result(n);
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<std::pair<double, int>> sorted;
    int main_joint = 0;
    for (std::size_t j = 1; j < weights.size(); ++j)
      if (weights[j][i] > weights[static_cast<std::size_t>(main_joint)][i])
        main_joint = static_cast<int>(j);
    for (std::size_t j = 0; j < weights.size(); ++j)
      if (weights[j][i] > 0.004 && related(figure, static_cast<int>(j), main_joint))
        sorted.push_back({weights[j][i], static_cast<int>(j)});
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    if (sorted.size() > 4) sorted.resize(4);
    double sum = 0;
    for (const auto& s : sorted) sum += s.first;
    int left = 65536;
    for (std::size_t k = sorted.size(); k-- > 1;) {
      const int units = static_cast<int>(std::lround(sorted[k].first / sum * 65536.0));
      if (units == 0) continue;
      result[i].joint[k] = static_cast<std::uint8_t>(sorted[k].second);
      result[i].weight[k] = static_cast<float>(units) / 65536.0f;
      left -= units;
    }
    result[i].joint[0] = static_cast<std::uint8_t>(sorted[0].second);
    result[i].weight[0] = static_cast<float>(left) / 65536.0f;
  }
  return result;
}

}  // namespace elbowroom::demo
