// SPDX-License-Identifier: MIT
#include "core/planning/tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace elbowroom {

double metric_distance(const MetricWeights& weights, double t_a, const std::vector<Vec3>& points_a,
                       double t_b, const std::vector<Vec3>& points_b) {
  double square = 0;
  for (std::size_t k = 0; k < points_a.size() && k < points_b.size(); ++k) {
    const Vec3 d = points_a[k] - points_b[k];
    square = std::max(square, d.x * d.x + d.y * d.y + d.z * d.z);
  }
  return weights.time * std::abs(t_a - t_b) + weights.posture * std::sqrt(square);
}

Tree::Tree(Direction direction, const MetricWeights& weights)
    : direction_(direction), weights_(weights) {}

int Tree::add(const Configuration& c, const std::vector<Vec3>& points, int parent) {
  if (nodes_.empty()) coordinates_.resize(3 * points.size());
  const std::size_t count = coordinates_.size() / 3;
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3 p = k < points.size() ? points[k] : Vec3(0.0);
    coordinates_[3 * k].push_back(p.x);
    coordinates_[3 * k + 1].push_back(p.y);
    coordinates_[3 * k + 2].push_back(p.z);
  }
  nodes_.push_back(c);
  parents_.push_back(parent);
  times_.push_back(c.t);
  return size() - 1;
}

void Tree::cut(int i) {
  const double never = std::numeric_limits<double>::quiet_NaN();
  times_[static_cast<std::size_t>(i)] = never;
  // Children come after their parents.
  for (int k = i + 1; k < size(); ++k) {
    if (parent(k) >= 0 && is_cut(parent(k))) times_[static_cast<std::size_t>(k)] = never;
  }
}

bool Tree::is_cut(int i) const { return std::isnan(times_[static_cast<std::size_t>(i)]); }

int Tree::nearest(double t, const std::vector<Vec3>& points, double time_step) {
  const std::size_t n = nodes_.size();
  squares_.assign(n, 0.0);
  double* squares = squares_.data();
  for (std::size_t k = 0; k < coordinates_.size() / 3 && k < points.size(); ++k) {
    const double* x = coordinates_[3 * k].data();
    const double* y = coordinates_[3 * k + 1].data();
    const double* z = coordinates_[3 * k + 2].data();
    const Vec3 p = points[k];
    for (std::size_t i = 0; i < n; ++i) {
      const double dx = x[i] - p.x, dy = y[i] - p.y, dz = z[i] - p.z;
      const double square = dx * dx + dy * dy + dz * dz;
      squares[i] = square > squares[i] ? square : squares[i];
    }
  }
  int best = -1;
  double best_distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < n; ++i) {
    const double ahead = direction_ == Direction::forward ? t - times_[i] : times_[i] - t;
    if (!(ahead >= time_step)) continue;
    const double distance = weights_.time * ahead + weights_.posture * std::sqrt(squares[i]);
    if (distance < best_distance) {
      best_distance = distance;
      best = static_cast<int>(i);
    }
  }
  return best;
}

}  // namespace elbowroom
