// SPDX-License-Identifier: MIT
#include "assets/generator/implicit.h"

#include <algorithm>
#include <utility>

namespace elbowroom::demo {

double smooth_union(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0);
  return std::min(a, b) - h * h / (4.0 * k);
}

double smooth_intersection(double a, double b, double k) { return -smooth_union(-a, -b, k); }

double tapered_capsule(const Vec3& p, const Vec3& a, const Vec3& b, double ra, double rb) {
  // The distance to a cone between two spheres: shift the foot of the perpendicular along the axis
  // by the slope of the side, then measure to the sphere there.
  const Vec3 ab = b - a;
  const double length = glm::length(ab);
  const Vec3 axis = ab / length;
  const Vec3 ap = p - a;
  const double along = glm::dot(ap, axis);
  const double across = std::sqrt(std::max(glm::dot(ap, ap) - along * along, 0.0));
  const double sine = std::clamp((ra - rb) / length, -0.999, 0.999);
  const double slope = sine / std::sqrt(1.0 - sine * sine);
  const double t = std::clamp((along - across * slope) / length, 0.0, 1.0);
  const double from_along = along - t * length;
  return std::sqrt(from_along * from_along + across * across) - (ra + t * (rb - ra));
}

double ellipsoid(const Vec3& p, const Vec3& centre, const Vec3& radii) {
  const Vec3 q = (p - centre) / radii;
  const double k0 = glm::length(q);
  const double k1 = glm::length(q / radii);
  if (k1 < 1e-9) return -std::min({radii.x, radii.y, radii.z});
  return k0 * (k0 - 1.0) / k1;
}

namespace {

// Tangents that make the curve C2 (natural cubic spline): shading shows a jump of curvature as a
// band round the limb.
void fill_slopes(const std::vector<Section>& s, double Section::*member,
                 std::vector<Section>& slopes) {
  const std::size_t n = s.size();
  // Tridiagonal system for the slopes, eliminated downwards and solved upwards.
  std::vector<double> upper(n), right(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double h0 = i > 0 ? s[i].at - s[i - 1].at : 0.0;
    const double h1 = i + 1 < n ? s[i + 1].at - s[i].at : 0.0;
    const double rise0 = i > 0 ? (s[i].*member - s[i - 1].*member) / h0 : 0.0;
    const double rise1 = i + 1 < n ? (s[i + 1].*member - s[i].*member) / h1 : 0.0;
    double lower = 0, middle = 2, above = 1, value = 3 * rise1;
    if (i + 1 == n) {
      lower = 1, above = 0, value = 3 * rise0;
    } else if (i > 0) {
      lower = h1, middle = 2 * (h0 + h1), above = h0, value = 3 * (h1 * rise0 + h0 * rise1);
    }
    const double pivot = middle - (i > 0 ? lower * upper[i - 1] : 0.0);
    upper[i] = above / pivot;
    right[i] = (value - (i > 0 ? lower * right[i - 1] : 0.0)) / pivot;
  }
  for (std::size_t i = n; i-- > 0;)
    slopes[i].*member = right[i] - (i + 1 < n ? upper[i] * slopes[i + 1].*member : 0.0);
}

}  // namespace

Loft::Loft(const Vec3& origin, const Vec3& axis, const Vec3& u, std::vector<Section> sections,
           double squareness)
    : origin_(origin),
      axis_(axis),
      u_(u),
      v_(glm::cross(axis, u)),
      sections_(std::move(sections)),
      slopes_(sections_.size(), Section{0, 0, 0}),
      squareness_(squareness) {
  for (auto member : {&Section::half_u, &Section::half_v, &Section::shift_u, &Section::shift_v})
    fill_slopes(sections_, member, slopes_);
}

double Loft::operator()(const Vec3& p) const {
  const Vec3 d = p - origin_;
  const double along = glm::dot(d, axis_);
  const double s = std::clamp(along, sections_.front().at, sections_.back().at);
  std::size_t i = 0;
  while (i + 2 < sections_.size() && s > sections_[i + 1].at) ++i;
  const Section &a = sections_[i], &b = sections_[i + 1];
  const double h = b.at - a.at;
  const double t = (s - a.at) / h;
  const double t2 = t * t, t3 = t2 * t;
  const auto value = [&](double Section::*m) {
    return (2 * t3 - 3 * t2 + 1) * (a.*m) + (t3 - 2 * t2 + t) * h * (slopes_[i].*m) +
           (3 * t2 - 2 * t3) * (b.*m) + (t3 - t2) * h * (slopes_[i + 1].*m);
  };
  const double ru = value(&Section::half_u), rv = value(&Section::half_v);
  const double x = std::abs(glm::dot(d, u_) - value(&Section::shift_u));
  const double y = std::abs(glm::dot(d, v_) - value(&Section::shift_v));
  const double qx = x / ru, qy = y / rv;
  // First-order distance: value over gradient length. The section's norm lies between that of an
  // ellipse and that of fourth powers, both by square roots alone, so that every machine's library
  // gives the same bits.
  double norm = std::sqrt(qx * qx + qy * qy);
  double side;
  if (norm < 1e-6) {
    side = -std::min(ru, rv);
  } else {
    double gx = qx / norm, gy = qy / norm;
    if (squareness_ > 0) {
      const double x2 = qx * qx, y2 = qy * qy;
      const double fourth = std::sqrt(std::sqrt(x2 * x2 + y2 * y2));
      const double cube = fourth * fourth * fourth;
      gx = glm::mix(gx, x2 * qx / cube, squareness_);
      gy = glm::mix(gy, y2 * qy / cube, squareness_);
      norm = glm::mix(norm, fourth, squareness_);
    }
    gx /= ru;
    gy /= rv;
    side = (norm - 1.0) / std::sqrt(gx * gx + gy * gy);
  }
  const double end = std::abs(along - s);
  if (end <= 0) return side;
  return side <= 0 ? std::max(end, side) : std::sqrt(side * side + end * end);
}

void Bounds::add(const Vec3& p, double radius) {
  low = glm::min(low, p - Vec3(radius));
  high = glm::max(high, p + Vec3(radius));
}

double Bounds::distance(const Vec3& p) const {
  return glm::length(glm::max(glm::max(low - p, p - high), Vec3(0.0)));
}

}  // namespace elbowroom::demo
