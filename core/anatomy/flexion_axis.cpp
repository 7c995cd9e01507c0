// SPDX-License-Identifier: MIT
#include "core/anatomy/flexion_axis.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace elbowroom {
namespace {

constexpr double kDegree = kPi / 180.0;
constexpr double kLeastClipBend = 10 * kDegree;  // less says little about the axis
constexpr double kLeastBindBend = 4 * kDegree;
constexpr double kClearBindBend = 15 * kDegree;  // a modeller who bends so far means the axis
constexpr double kFarFromBody = 45 * kDegree;    // a slight bend about another axis is none
constexpr double kOtherAxis = 30 * kDegree;      // clips so far from a clear bend mean another axis
constexpr double kBindShare = 0.1;               // weight of the bind pose beside the clips
constexpr double kOneSided = 0.8;                // share of the bends that must agree on the sign
constexpr double kNear = 1 * kDegree;            // out-of-plane angles below this are noise
constexpr int kRounds = 30;

struct Bend {
  double a = 0, b = 0;  // upper × lower in a basis of the plane across upper; length sin(bend)
  double weight = 0;
};

// Angle of the direction z in the plane that minimizes Σ w (d·z)², d·z being the component of the
// bend's normal across z: the principal axis of the normals' scatter.
double principal_angle(const std::vector<Bend>& bends, const std::vector<double>& weights) {
  double aa = 0, ab = 0, bb = 0;
  for (std::size_t i = 0; i < bends.size(); ++i) {
    aa += weights[i] * bends[i].a * bends[i].a;
    ab += weights[i] * bends[i].a * bends[i].b;
    bb += weights[i] * bends[i].b * bends[i].b;
  }
  return 0.5 * std::atan2(2 * ab, aa - bb);
}

// The same for Σ w |d·z|, which a minority of odd poses sways less: least squares, reweighted.
double robust_angle(const std::vector<Bend>& bends) {
  std::vector<double> weights;
  for (const Bend& bend : bends) weights.push_back(bend.weight);
  double angle = principal_angle(bends, weights);
  for (int round = 0; round < kRounds; ++round) {
    const double c = std::cos(angle), s = std::sin(angle);
    for (std::size_t i = 0; i < bends.size(); ++i) {
      const double off = std::abs(bends[i].b * c - bends[i].a * s);
      weights[i] = bends[i].weight / std::fmax(off, kNear);
    }
    const double next = principal_angle(bends, weights);
    const bool settled = std::abs(std::remainder(next - angle, kPi)) < 1e-9;
    angle = next;
    if (settled) break;
  }
  return angle;
}

std::string degrees(double angle) {
  char text[32];
  std::snprintf(text, sizeof text, "%.0f°", angle / kDegree);
  return text;
}

// Whether a hinge about z keeps the directions in its plane.
bool keeps_plane(const std::vector<Vec3>& directions, const Vec3& z, double median_allowed,
                 double high_allowed) {
  std::vector<double> out;
  for (const Vec3& d : directions) {
    out.push_back(std::asin(std::clamp(std::abs(glm::dot(d, z)), 0.0, 1.0)));
  }
  if (out.empty()) return true;
  std::sort(out.begin(), out.end());
  const auto at = [&](double share) {
    return out[static_cast<std::size_t>(share * static_cast<double>(out.size() - 1) + 0.5)];
  };
  return at(0.5) <= median_allowed && at(0.99) <= high_allowed;
}

}  // namespace

FlexionAxis find_flexion_axis(const FlexionEvidence& evidence) {
  const Vec3& upper = evidence.upper;
  const Vec3 e1 = evidence.anatomical;
  const Vec3 e2 = glm::cross(upper, e1);
  const auto bend_of = [&](const Vec3& lower) {
    const Vec3 normal = glm::cross(upper, lower);
    return Bend{glm::dot(normal, e1), glm::dot(normal, e2), 1.0};
  };
  const auto bend_angle = [&](const Vec3& lower) {
    return std::atan2(glm::length(glm::cross(upper, lower)), glm::dot(upper, lower));
  };

  std::vector<Bend> bends;
  for (const Vec3& lower : evidence.clips) {
    if (bend_angle(lower) >= kLeastClipBend) bends.push_back(bend_of(lower));
  }
  const std::size_t from_clips = bends.size();
  const double bound = bend_angle(evidence.bound);
  const bool clear_bind = bound >= kClearBindBend && bound <= kPi - kClearBindBend;
  const Vec3 bind_normal = glm::cross(upper, evidence.bound);
  const bool from_bind = clear_bind || (bound >= kLeastBindBend && bound <= kPi - kClearBindBend &&
                                        glm::dot(bind_normal, evidence.anatomical) >=
                                            std::cos(kFarFromBody) * std::sin(bound));
  if (from_bind) {
    Bend bend = bend_of(evidence.bound);
    bend.weight = std::fmax(1.0, kBindShare * static_cast<double>(from_clips));
    bends.push_back(bend);
  }

  FlexionAxis found;
  if (bends.empty()) {
    found.axis = evidence.anatomical;
    found.from = "the body's axes (bound nearly straight, and no clip bends it)";
    return found;
  }
  const std::string bind_text = "the bind pose's bend of " + degrees(bound);
  const std::string clips_text =
      "what it does in the clips (" + std::to_string(from_clips) + " bent poses)";
  const auto keeps = [&](const Vec3& z) {
    return keeps_plane(evidence.clips, z, evidence.median_allowed, evidence.high_allowed);
  };
  const Vec3 bind_axis = from_bind ? glm::normalize(bind_normal) : evidence.anatomical;
  if (clear_bind && keeps(bind_axis)) {
    found.axis = bind_axis;
    found.from = bind_text + (from_clips > 0 ? ", which the clips keep to" : "");
  } else {
    const double angle = robust_angle(bends);
    found.axis = glm::normalize(e1 * std::cos(angle) + e2 * std::sin(angle));
    found.from = from_clips == 0 ? bind_text : clips_text;
    if (from_clips > 0 && from_bind) found.from += " and " + bind_text;
    const bool hinge = from_clips == 0 || keeps(found.axis);
    const double apart = std::abs(glm::dot(found.axis, bind_axis));
    if (clear_bind && (!hinge || apart >= std::cos(kOtherAxis))) {
      found.axis = bind_axis;
      found.from = bind_text + "; the clips do not keep to it";
    } else if (!hinge) {
      found.axis = evidence.anatomical;
      found.from = "the body's axes; the clips bend it about several axes";
    }
  }

  double along = 0, against = 0;
  for (const Bend& bend : bends) {
    const double component = bend.a * glm::dot(found.axis, e1) + bend.b * glm::dot(found.axis, e2);
    (component > 0 ? along : against) += bend.weight * std::abs(component);
  }
  const bool one_sided = std::fmax(along, against) >= kOneSided * (along + against);
  const bool flip = one_sided ? against > along : glm::dot(found.axis, evidence.anatomical) < 0;
  if (flip) found.axis = -found.axis;
  if (!one_sided) found.from += "; it bends both ways, so the sign is the body's";
  return found;
}

}  // namespace elbowroom
