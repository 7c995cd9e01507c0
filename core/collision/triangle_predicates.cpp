// SPDX-License-Identifier: MIT
#include "core/collision/triangle_predicates.h"

#include <algorithm>
#include <limits>

#include "core/collision/expansion.h"

namespace elbowroom {
namespace {

constexpr double kEps = 0x1.0p-53;
// Shewchuk's ccwerrboundA and o3derrboundA.
constexpr double kBound2 = (3.0 + 16.0 * kEps) * kEps;
constexpr double kBound3 = (7.0 + 56.0 * kEps) * kEps;

[[gnu::noinline]] int orient3d_exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  Expansion<2> r[3][3];
  const Vec3* rows[3] = {&a, &b, &c};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) r[i][k] = exact_difference((*rows[i])[k], d[k]);
  }
  Expansion<192> det;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    Expansion<16> minor;
    add_product(minor, r[j][0], r[k][1], 1.0);
    add_product(minor, r[k][0], r[j][1], -1.0);
    add_product(det, minor, r[i][2], 1.0);
  }
  return det.sign();
}

[[gnu::noinline]] int orient2d_exact(double ax, double ay, double bx, double by, double cx,
                                     double cy) {
  Expansion<16> det;
  add_product(det, exact_difference(ax, cx), exact_difference(by, cy), 1.0);
  add_product(det, exact_difference(ay, cy), exact_difference(bx, cx), -1.0);
  return det.sign();
}

int sign_of(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

// The closed intervals [a, b] and [c, d] (ends in any order) overlap on every axis. For segments of
// one line this is the exact test of their overlap.
bool boxes_overlap(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, int skip_axis) {
  for (int k = 0; k < 3; ++k) {
    if (k == skip_axis) continue;
    if (std::max(a[k], b[k]) < std::min(c[k], d[k])) return false;
    if (std::max(c[k], d[k]) < std::min(a[k], b[k])) return false;
  }
  return true;
}

// Closed segments p-q and a-b, projected along `axis`.
bool segments_meet_2d(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, int axis) {
  const int o1 = orient2d(p, q, a, axis), o2 = orient2d(p, q, b, axis);
  if (o1 * o2 > 0) return false;
  const int o3 = orient2d(a, b, p, axis), o4 = orient2d(a, b, q, axis);
  if (o3 * o4 > 0) return false;
  if (o1 == 0 && o2 == 0 && o3 == 0 && o4 == 0) return boxes_overlap(p, q, a, b, axis);
  return true;
}

// Closed segments in space; either may be a point.
bool segments_meet(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b) {
  if (orient3d(p, q, a, b) != 0) return false;
  // All four lie in one plane. A projection that keeps some three of them a triangle is one-to-one
  // on that plane.
  for (int axis = 0; axis < 3; ++axis) {
    if (orient2d(p, q, a, axis) != 0 || orient2d(p, q, b, axis) != 0 ||
        orient2d(a, b, p, axis) != 0 || orient2d(a, b, q, axis) != 0) {
      return segments_meet_2d(p, q, a, b, axis);
    }
  }
  return boxes_overlap(p, q, a, b, -1);
}

bool inside_2d(const Vec3& p, const TrianglePoints& t, int orientation, int axis) {
  return orient2d(t[0], t[1], p, axis) * orientation >= 0 &&
         orient2d(t[1], t[2], p, axis) * orientation >= 0 &&
         orient2d(t[2], t[0], p, axis) * orientation >= 0;
}

// p, q and t in one plane, or t without area.
bool segment_meets_in_plane(const Vec3& p, const Vec3& q, const TrianglePoints& t) {
  for (int axis = 0; axis < 3; ++axis) {
    const int orientation = orient2d(t[0], t[1], t[2], axis);
    if (orientation == 0) continue;
    return inside_2d(p, t, orientation, axis) || inside_2d(q, t, orientation, axis) ||
           segments_meet_2d(p, q, t[0], t[1], axis) || segments_meet_2d(p, q, t[1], t[2], axis) ||
           segments_meet_2d(p, q, t[2], t[0], axis);
  }
  // The three points lie on one line.
  return segments_meet(p, q, t[0], t[1]) || segments_meet(p, q, t[1], t[2]) ||
         segments_meet(p, q, t[2], t[0]);
}

// side_p, side_q: signs of p and q against t's plane.
bool segment_meets(const Vec3& p, const Vec3& q, const TrianglePoints& t, int side_p, int side_q) {
  if (side_p * side_q > 0) return false;
  if (side_p == 0 && side_q == 0) return segment_meets_in_plane(p, q, t);
  const int s0 = orient3d(p, q, t[0], t[1]);
  const int s1 = orient3d(p, q, t[1], t[2]);
  if (s0 * s1 < 0) return false;
  const int s2 = orient3d(p, q, t[2], t[0]);
  return s0 * s2 >= 0 && s1 * s2 >= 0;
}

// Signs of three points against a triangle's plane: those of orient3d(plane, point), with the
// normal computed once for the filter.
void sides(const TrianglePoints& plane, const TrianglePoints& points, int out[3]) {
  const Vec3 u = plane[1] - plane[0], v = plane[2] - plane[0];
  const double xy = u.x * v.y, yx = u.y * v.x, yz = u.y * v.z, zy = u.z * v.y, zx = u.z * v.x,
               xz = u.x * v.z;
  const Vec3 n(yz - zy, zx - xz, xy - yx);
  const Vec3 m(std::abs(yz) + std::abs(zy), std::abs(zx) + std::abs(xz),
               std::abs(xy) + std::abs(yx));
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 w = points[i] - plane[0];
    const double s = n.x * w.x + n.y * w.y + n.z * w.z;
    // Three roundings of differences, one of products and one of the difference in n, one of the
    // product and two of the sum: below 9 units of 2^-53 of the permanent, with room to spare.
    const double bound =
        16 * kEps * (m.x * std::abs(w.x) + m.y * std::abs(w.y) + m.z * std::abs(w.z));
    // orient3d() is positive below the plane.
    out[i] = s > bound ? -1 : s < -bound ? 1 : orient3d(plane[0], plane[1], plane[2], points[i]);
  }
}

bool all_on_one_side(const int s[3]) {
  return (s[0] > 0 && s[1] > 0 && s[2] > 0) || (s[0] < 0 && s[1] < 0 && s[2] < 0);
}

void keep_closer(ClosestPoints& best, const Vec3& on_a, const Vec3& on_b) {
  const Vec3 d = on_a - on_b;
  const double d2 = glm::dot(d, d);
  if (d2 < best.distance2) best = {d2, on_a, on_b};
}

Vec3 closest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double dd = glm::dot(d, d);
  if (!(dd > 0)) return a;
  const double u = glm::dot(p - a, d) / dd;
  if (u <= 0) return a;
  if (u >= 1) return b;
  return a + u * d;
}

// Closest points of segments: their ends against the other, and the common perpendicular where its
// feet lie inside both. The cross product keeps the feet accurate for nearly parallel segments,
// where the usual determinant a·c − b² has lost all digits.
void closest_of_segments(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b,
                         ClosestPoints& best) {
  const Vec3 u = q - p, v = b - a, w = a - p;
  // Spheres around the two are farther apart than the best so far?
  const Vec3 between = w + 0.5 * (v - u);
  const double reach2 = 0.5 * (glm::dot(u, u) + glm::dot(v, v));  // ≥ (|u|/2 + |v|/2)²
  const double gap2 = glm::dot(between, between);
  // |between| > reach + best  if  |between|² > 2 (reach² + best²).
  if (gap2 > 2 * (reach2 + best.distance2) * (1 + 1e-12)) return;
  const Vec3 n = glm::cross(u, v);
  const double nn = glm::dot(n, n);
  // Nearly parallel: the ends are tried as well, whatever the perpendicular says.
  const bool parallel = !(nn > 1e-12 * glm::dot(u, u) * glm::dot(v, v));
  if (nn > 0) {
    // If the perpendicular itself is no shorter than the best so far, nothing here is.
    const double h = glm::dot(w, n);
    if (!parallel && h * h > best.distance2 * nn * (1 + 1e-9)) return;
    const double s = glm::dot(glm::cross(w, v), n) / nn;
    const double t = glm::dot(glm::cross(w, u), n) / nn;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) {
      keep_closer(best, p + s * u, a + t * v);
      if (!parallel) return;
    }
  }
  keep_closer(best, p, closest_on_segment(p, a, b));
  keep_closer(best, q, closest_on_segment(q, a, b));
  keep_closer(best, closest_on_segment(a, p, q), a);
  keep_closer(best, closest_on_segment(b, p, q), b);
}

// Foot of the perpendicular from p onto t's plane, if it lies in t and may be nearer than the root
// of `at_most`. A triangle and its normal, to ask about several points.
struct Foot {
  const TrianglePoints& t;
  Vec3 u, v, n;
  double nn;

  explicit Foot(const TrianglePoints& triangle)
      : t(triangle), u(t[1] - t[0]), v(t[2] - t[0]), n(glm::cross(u, v)), nn(glm::dot(n, n)) {}
  bool inside(const Vec3& p, double at_most, Vec3& foot) const;
};

bool Foot::inside(const Vec3& p, double at_most, Vec3& foot) const {
  if (!(nn > 0)) return false;
  const Vec3 w = p - t[0];
  const double h = glm::dot(w, n);
  // Normals of slivers are too rough to leave a point out by.
  if (h * h > at_most * nn * (1 + 1e-9) && nn > 1e-12 * glm::dot(u, u) * glm::dot(v, v))
    return false;
  const double b = glm::dot(glm::cross(w, v), n) / nn;
  const double c = glm::dot(glm::cross(u, w), n) / nn;
  if (b < 0 || c < 0 || b + c > 1) return false;
  foot = t[0] + b * u + c * v;
  return true;
}

// The two are farther apart than `distance` along t's normal, by more than rounding.
bool apart_along_normal(const TrianglePoints& t, const TrianglePoints& other, double distance) {
  const Vec3 u = t[1] - t[0], v = t[2] - t[0];
  const Vec3 n = glm::cross(u, v);
  const double length = glm::length(n);
  const double uv = glm::length(u) * glm::length(v);
  double low = std::numeric_limits<double>::infinity(), high = -low, reach = 0;
  for (const Vec3& p : other) {
    const Vec3 w = p - t[0];
    const double s = glm::dot(n, w);
    low = std::min(low, s);
    high = std::max(high, s);
    reach = std::max(reach, glm::dot(w, w));
  }
  const double limit = distance * length * (1 + 1e-12) + 32 * kEps * uv * std::sqrt(reach);
  return low > limit || high < -limit;
}

}  // namespace

int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const double adx = a.x - d.x, ady = a.y - d.y, adz = a.z - d.z;
  const double bdx = b.x - d.x, bdy = b.y - d.y, bdz = b.z - d.z;
  const double cdx = c.x - d.x, cdy = c.y - d.y, cdz = c.z - d.z;
  const double bc1 = bdx * cdy, bc2 = cdx * bdy;
  const double ca1 = cdx * ady, ca2 = adx * cdy;
  const double ab1 = adx * bdy, ab2 = bdx * ady;
  const double det = adz * (bc1 - bc2) + bdz * (ca1 - ca2) + cdz * (ab1 - ab2);
  const double permanent = (std::abs(bc1) + std::abs(bc2)) * std::abs(adz) +
                           (std::abs(ca1) + std::abs(ca2)) * std::abs(bdz) +
                           (std::abs(ab1) + std::abs(ab2)) * std::abs(cdz);
  const double bound = kBound3 * permanent;
  if (det > bound) return 1;
  if (-det > bound) return -1;
  return orient3d_exact(a, b, c, d);
}

int orient2d(const Vec3& a, const Vec3& b, const Vec3& c, int axis) {
  const int x = axis == 0 ? 1 : 0, y = axis == 2 ? 1 : 2;
  const double left = (a[x] - c[x]) * (b[y] - c[y]);
  const double right = (a[y] - c[y]) * (b[x] - c[x]);
  const double det = left - right;
  if (std::abs(det) > kBound2 * (std::abs(left) + std::abs(right))) return sign_of(det);
  return orient2d_exact(a[x], a[y], b[x], b[y], c[x], c[y]);
}

bool triangles_intersect(const TrianglePoints& a, const TrianglePoints& b) {
  // Closed triangles share a point if and only if an edge of one meets the other: if they lie in
  // different planes, an end of their common segment lies on some edge; if in one plane, edges
  // cross or one holds the other's.
  int side_b[3], side_a[3];
  sides(a, b, side_b);
  if (all_on_one_side(side_b)) return false;
  sides(b, a, side_a);
  if (all_on_one_side(side_a)) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (segment_meets(b[i], b[j], a, side_b[i], side_b[j])) return true;
    if (segment_meets(a[i], a[j], b, side_a[i], side_a[j])) return true;
  }
  return false;
}

Passing segment_passes(const Vec3& p, const Vec3& q, const TrianglePoints& t) {
  const int side_p = orient3d(t[0], t[1], t[2], p);
  const int side_q = orient3d(t[0], t[1], t[2], q);
  if (side_p * side_q > 0) return Passing::misses;
  if (side_p == 0 || side_q == 0) {
    return segment_meets(p, q, t, side_p, side_q) ? Passing::grazes : Passing::misses;
  }
  const int s0 = orient3d(p, q, t[0], t[1]);
  const int s1 = orient3d(p, q, t[1], t[2]);
  const int s2 = orient3d(p, q, t[2], t[0]);
  if ((s0 > 0 && s1 > 0 && s2 > 0) || (s0 < 0 && s1 < 0 && s2 < 0)) return Passing::crosses;
  const bool positive = s0 > 0 || s1 > 0 || s2 > 0, negative = s0 < 0 || s1 < 0 || s2 < 0;
  return positive && negative ? Passing::misses : Passing::grazes;
}

ClosestPoints closest_points(const TrianglePoints& a, const TrianglePoints& b, double enough,
                             double at_most) {
  ClosestPoints best;
  best.distance2 = at_most;
  Vec3 foot;
  const Foot on_a(a), on_b(b);
  for (std::size_t i = 0; i < 3; ++i) {
    if (on_a.inside(b[i], best.distance2, foot)) keep_closer(best, foot, b[i]);
    if (on_b.inside(a[i], best.distance2, foot)) keep_closer(best, a[i], foot);
  }
  if (best.distance2 <= enough) return best;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      closest_of_segments(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3], best);
      if (best.distance2 <= enough) return best;
    }
  }
  return best;
}

Vec3 closest_point(const Vec3& p, const TrianglePoints& t) {
  Vec3 foot;
  ClosestPoints best;
  best.distance2 = std::numeric_limits<double>::infinity();
  if (Foot(t).inside(p, best.distance2, foot)) return foot;
  for (std::size_t i = 0; i < 3; ++i) {
    keep_closer(best, p, closest_on_segment(p, t[i], t[(i + 1) % 3]));
  }
  return best.on_b;
}

bool surely_apart(const TrianglePoints& a, const TrianglePoints& b, double distance) {
  return apart_along_normal(a, b, distance) || apart_along_normal(b, a, distance);
}

bool triangles_touch(const TrianglePoints& a, const TrianglePoints& b, double distance) {
  if (!(distance > 0)) return triangles_intersect(a, b);
  if (surely_apart(a, b, distance)) return false;
  const double d2 = distance * distance;
  return triangles_intersect(a, b) || closest_points(a, b, d2, d2 * (1 + 1e-9)).distance2 <= d2;
}

Vec3 intersection_point(const TrianglePoints& a, const TrianglePoints& b) {
  // The mean of the points where edges cross the other triangle: their common segment is convex.
  Vec3 sum(0.0);
  int count = 0;
  const auto add_crossings = [&](const TrianglePoints& edges, const TrianglePoints& t) {
    const Vec3 n = glm::cross(t[1] - t[0], t[2] - t[0]);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 &p = edges[i], &q = edges[(i + 1) % 3];
      if (segment_passes(p, q, t) != Passing::crosses) continue;
      const double hp = glm::dot(n, p - t[0]), hq = glm::dot(n, q - t[0]);
      const double u = hp == hq ? 0.5 : std::clamp(hp / (hp - hq), 0.0, 1.0);
      sum += p + u * (q - p);
      ++count;
    }
  };
  add_crossings(a, b);
  add_crossings(b, a);
  if (count > 0) return sum / static_cast<double>(count);
  // Only edges, vertices or a common plane: the closest points coincide there.
  const ClosestPoints closest = closest_points(a, b);
  return 0.5 * (closest.on_a + closest.on_b);
}

}  // namespace elbowroom
