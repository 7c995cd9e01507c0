// SPDX-License-Identifier: MIT
#include "spaces.h"

#include <algorithm>
#include <cmath>

namespace elbowroom::test {
namespace {

Vec3 at(const Ball& ball, double t) { return ball.place + t * ball.velocity; }

Quat about(double x, double y, double z) { return quat_from_rotation_vector(Vec3(x, y, z)); }

Dof dof(const char* name, DofRole role, double lower, double upper, double speed) {
  return {name, role, lower, upper, lower, upper, speed};
}

// A clip that swings to and fro about a line between its ends' postures.
std::function<Dofs(double)> wave(const Dofs& from, const Dofs& to, double begin, double end,
                                 double amplitude) {
  return [=](double t) {
    const double u = (t - begin) / (end - begin);
    Dofs q = from;
    for (int i = 0; i < q.count; ++i) {
      q[i] = from[i] + u * (to[i] - from[i]) + amplitude * std::sin(2 * kPi * u + i) -
             amplitude * std::sin(static_cast<double>(i));
    }
    return q;
  };
}

void set_ends(Problem& p, double begin, double end) {
  p.init = {p.clip(begin), begin};
  p.goal = {p.clip(end), end};
  const double h = 1e-5;
  const auto slope = [&](double t) {
    Dofs a = p.clip(t - h), b = p.clip(t + h);
    for (int i = 0; i < a.count; ++i) b[i] = (b[i] - a[i]) / (2 * h);
    return b;
  };
  p.velocity_init = slope(begin);
  p.velocity_goal = slope(end);
}

}  // namespace

double segment_distance(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  // The squared distance is convex over the unit square of the two shares: minimize over one for
  // the other's clamped best, both ways round.
  const Vec3 u = b - a, v = d - c, w = a - c;
  const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v);
  const double uw = glm::dot(u, w), vw = glm::dot(v, w);
  const auto clamp01 = [](double x) { return std::clamp(x, 0.0, 1.0); };
  const double det = uu * vv - uv * uv;
  double s = det > 1e-15 * uu * vv && det > 0 ? clamp01((uv * vw - vv * uw) / det) : 0;
  double best = 1e300;
  const auto consider = [&](double x, double y) {
    best = std::min(best, glm::length(w + x * u - y * v));
  };
  double t = vv > 0 ? clamp01((uv * s + vw) / vv) : 0;
  s = uu > 0 ? clamp01((uv * t - uw) / uu) : 0;
  consider(s, t);
  for (const double end : {0.0, 1.0}) {
    consider(end, vv > 0 ? clamp01((uv * end + vw) / vv) : 0);
    consider(uu > 0 ? clamp01((uv * end - uw) / uu) : 0, end);
  }
  return best;
}

bool SegmentSpace::valid(const Configuration& c) {
  ++calls;
  if (on_call) on_call();
  segments_.clear();
  place(c, segments_);
  for (const Segment& s : segments_) {
    for (const Ball& ball : balls) {
      if (c.t < ball.appears || c.t >= ball.vanishes) continue;
      const Vec3 p = at(ball, c.t);
      if (segment_distance(s.from, s.to, p, p) <= s.radius + ball.radius) return false;
    }
    for (const Post& post : posts) {
      if (segment_distance(s.from, s.to, post.from, post.to) <= s.radius + post.radius)
        return false;
    }
  }
  return true;
}

void SegmentSpace::metric_points(const Configuration& c, std::vector<Vec3>& points) {
  segments_.clear();
  place(c, segments_);
  points.clear();
  for (const Segment& s : segments_) {
    points.push_back(s.from);
    points.push_back(s.to);
  }
}

Dofs dofs(std::initializer_list<double> values) {
  Dofs q;
  for (const double v : values) q[q.count++] = v;
  return q;
}

SegmentSpace point_space() {
  SegmentSpace w;
  w.name = "point";
  w.space.dofs = {dof("x", DofRole::swing, -1, 1, 6), dof("y", DofRole::swing, -1, 1, 6)};
  w.place = [](const Configuration& c, std::vector<SegmentSpace::Segment>& out) {
    const Vec3 p(c.q[0], c.q[1], 0);
    out.push_back({p, p, 0.01});
  };
  return w;
}

SegmentSpace linkage_space(int links) {
  SegmentSpace w;
  w.name = "linkage of " + std::to_string(links);
  for (int i = 0; i < links; ++i) {
    w.space.dofs.push_back(dof("link", i == 1 ? DofRole::flexion : DofRole::swing, -2.5, 2.5, 8));
  }
  w.place = [links](const Configuration& c, std::vector<SegmentSpace::Segment>& out) {
    Vec3 p(0.0);
    double angle = 0;
    for (int i = 0; i < links; ++i) {
      angle += c.q[i];
      const Vec3 next = p + Vec3(std::cos(angle), std::sin(angle), 0) * (1.0 / links);
      out.push_back({p, next, 0.015});
      p = next;
    }
  };
  return w;
}

SegmentSpace arm_space(double pace, double umbrella) {
  SegmentSpace w;
  w.name = umbrella > 0 ? "arm with an umbrella" : "arm";
  w.length_unit = 0.6;
  w.space.dofs = {dof("Shoulder, swing 1", DofRole::swing, -1.4, 1.4, 9),
                  dof("Shoulder, swing 2", DofRole::swing, -1.8, 1.8, 9),
                  dof("Shoulder, twist", DofRole::twist, -1.3, 1.3, 12),
                  dof("Elbow, flexion", DofRole::flexion, -0.1, 2.5, 14),
                  dof("Elbow, twist", DofRole::twist, -1.3, 1.3, 14),
                  dof("Wrist, swing 1", DofRole::secondary_swing, -0.8, 0.8, 14),
                  dof("Wrist, swing 2", DofRole::secondary_swing, -0.5, 0.5, 14)};
  w.space.ellipses = {{0, 1, 1.4, 1.8}, {5, 6, 0.8, 0.5}};
  w.place = [pace, umbrella](const Configuration& c, std::vector<SegmentSpace::Segment>& out) {
    // The arm hangs from the shoulder along -y when q = 0; x is to the side, z ahead.
    const Vec3 shoulder(0.0, 1.4, pace * c.t);
    const Quat upper = about(c.q[0], 0, c.q[1]) * about(0, c.q[2], 0);
    const Vec3 elbow = shoulder + upper * Vec3(0, -0.28, 0);
    const Quat fore = upper * about(-c.q[3], 0, 0) * about(0, c.q[4], 0);
    const Vec3 wrist = elbow + fore * Vec3(0, -0.25, 0);
    const Quat hand = fore * about(c.q[5], 0, c.q[6]);
    const Vec3 tip = wrist + hand * Vec3(0, -0.1, 0);
    out.push_back({shoulder, elbow, 0.04});
    out.push_back({elbow, wrist, 0.035});
    out.push_back({wrist, tip, 0.03});
    if (umbrella > 0) {
      const Vec3 up = hand * Vec3(0, 0, 1);
      const Vec3 top = tip + 0.85 * umbrella * up;
      out.push_back({tip - 0.15 * umbrella * up, top, 0.012});
      for (const Vec3& across : {hand * Vec3(1, 0, 0), hand * Vec3(0, 1, 0)}) {
        out.push_back({top - 0.4 * umbrella * across, top + 0.4 * umbrella * across, 0.02});
      }
    }
  };
  return w;
}

std::vector<Problem> problems() {
  std::vector<Problem> all;
  {
    // Two doors in two walls of discs; the second one opens by moving aside.
    Problem p{point_space(), {}, {}, {}, {}, {}};
    p.world.name = "point, two doors";
    for (int i = 0; i < 21; ++i) {
      const double y = -1 + 0.1 * i;
      if (i != 16) p.world.balls.push_back({{-0.3, y, 0}, {0, 0, 0}, 0.055});
      p.world.balls.push_back({{0.4, y - 1.0, 0}, {0, 0.35, 0}, 0.055});
    }
    p.clip = wave(dofs({-0.8, 0}), dofs({0.8, 0.1}), 0, 2, 0.05);
    set_ends(p, 0, 2);
    all.push_back(std::move(p));
  }
  {
    Problem p{linkage_space(3), {}, {}, {}, {}, {}};
    p.world.name = "linkage, a disc on its way and one that flies by";
    p.world.balls = {{{0.55, 0.25, 0}, {0, 0, 0}, 0.12}, {{-0.2, 1.2, 0}, {0.4, -0.5, 0}, 0.1}};
    p.clip = wave(dofs({-0.6, 0.2, 0.2}), dofs({1.3, 0.2, 0.3}), 0.5, 2, 0.1);
    set_ends(p, 0.5, 2);
    all.push_back(std::move(p));
  }
  {
    Problem p{linkage_space(10), {}, {}, {}, {}, {}};
    p.world.name = "linkage of ten, a disc that steps in";
    p.world.balls = {{{0.6, 0.3, 0}, {0, 0, 0}, 0.1, 0.7, 1e30}};
    p.world.steps = {0.7};
    Dofs from, to;
    from.count = to.count = 10;
    from[0] = -0.2;
    to[0] = 0.9;
    p.clip = wave(from, to, 0, 1.5, 0.03);
    set_ends(p, 0, 1.5);
    all.push_back(std::move(p));
  }
  {
    // Walking past two posts with a stick in the hand: Figure 1's kind of scene.
    Problem p{arm_space(1.2, 1.1), {}, {}, {}, {}, {}};
    p.world.name = "walk between two posts with an umbrella";
    p.world.posts = {{{0.4, 0, 1.9}, {0.4, 2.6, 1.9}, 0.03},
                     {{-0.33, 0, 2.5}, {-0.33, 2.6, 2.5}, 0.03}};
    p.clip = wave(dofs({-0.3, 0.15, 0.1, 1.2, 0, 0, 0}), dofs({-0.3, 0.15, 0.1, 1.2, 0, 0, 0}), 0.4,
                  2.4, 0.08);
    set_ends(p, 0.4, 2.4);
    all.push_back(std::move(p));
  }
  {
    // The hand goes through a ring of balls that comes towards the walker.
    Problem p{arm_space(0.8, 0), {}, {}, {}, {}, {}};
    p.world.name = "arm through a moving ring";
    for (int i = 0; i < 24; ++i) {
      const double angle = 2 * kPi * i / 24;
      p.world.balls.push_back(
          {Vec3(0.05 + 0.2 * std::cos(angle), 1.15 + 0.2 * std::sin(angle), 1.75),
           {0, 0, -0.3},
           0.03});
    }
    p.clip =
        wave(dofs({-0.9, 0.9, 0, 0.4, 0, 0, 0}), dofs({-1.0, 0.05, 0, 0.8, 0, 0, 0}), 0, 1.3, 0.04);
    set_ends(p, 0, 1.3);
    all.push_back(std::move(p));
  }
  return all;
}

}  // namespace elbowroom::test
