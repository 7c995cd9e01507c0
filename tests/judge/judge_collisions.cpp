// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <memory>
#include <queue>
#include <set>
#include <stdexcept>
#include <tuple>

#include "tests/judge/judge.h"
#include "tests/judge/judge_triangles.h"

namespace judge {
namespace {

using glm::dmat4;
using glm::dvec3;

// Hz. Fast hands sweep past triangles between coarser looks, which are contacts of the clip no
// less.
constexpr double kSourceRate = 240;

Corners corners(const glm::uvec3& t, const std::vector<dvec3>& points) {
  return {points[t[0]], points[t[1]], points[t[2]]};
}

Box box_of(const Corners& c) {
  Box box;
  for (const dvec3& p : c) box.add(p);
  return box;
}

std::string node_label(const File& file, int node) {
  const std::string& name = file.nodes[static_cast<std::size_t>(node)].name;
  return name.empty() ? "node " + std::to_string(node) : name;
}

// Triangles that move with the limb or stand still together, in points shared by all.
struct Part {
  std::vector<glm::uvec3> triangles;
  std::vector<std::string> labels;  // by triangle
};

// One file in the scene besides the character.
struct Extra {
  File file;
  Soup soup;
  const KeyAnimation* animation = nullptr;
};

Extra load_extra(const std::filesystem::path& path) {
  Extra extra;
  extra.file = load(path);
  extra.soup = soup_of(extra.file);
  return extra;
}

// The character and what it carries at a time: all points in one array.
class Figure {
 public:
  explicit Figure(const CollisionQuery& query)
      : file_(load(query.character)), soup_(soup_of(file_)), attached_(query.attachments) {
    for (const std::string& name : query.limb_roots) roots_.push_back(file_.node(name));
    parts_ = roots_;
    for (const std::string& name : query.limb_parts) parts_.push_back(file_.node(name));
    for (std::size_t i = 0; i < soup_.triangles.size(); ++i) {
      Part& part = in_limb(soup_.joint[i]) ? limb_ : body_;
      part.triangles.push_back(soup_.triangles[i]);
      part.labels.push_back(node_label(file_, soup_.joint[i]));
    }
    std::size_t base = soup_.point_count;
    for (const Attached& attached : attached_) {
      extras_.push_back(load_extra(attached.file));
      carriers_.push_back(file_.node(attached.joint));
      const Extra& extra = extras_.back();
      Part& part = in_limb(carriers_.back()) ? limb_ : body_;
      for (const glm::uvec3& t : extra.soup.triangles) {
        part.triangles.push_back(t + static_cast<unsigned>(base));
        part.labels.push_back(attached.file.filename().string());
      }
      base += extra.soup.point_count;
    }
    for (Extra& extra : extras_) {
      if (!extra.file.animations.empty()) extra.animation = &extra.file.animations.front();
    }
  }

  // Null: the rest pose.
  void points_at(const KeyAnimation* animation, double t, std::vector<dvec3>& points) const {
    const State state = state_at(file_, animation, t);
    place(file_, state, points);
    std::vector<dvec3> more;
    for (std::size_t i = 0; i < extras_.size(); ++i) {
      const dmat4 placement = rigid_frame(state.world[static_cast<std::size_t>(carriers_[i])]) *
                              glm::translate(dmat4(1.0), attached_[i].offset) *
                              glm::mat4_cast(attached_[i].turn);
      place(extras_[i].file, state_at(extras_[i].file, extras_[i].animation, t, placement), more);
      points.insert(points.end(), more.begin(), more.end());
    }
  }

  const File& file() const { return file_; }
  const Part& limb() const { return limb_; }
  const Part& body() const { return body_; }
  // Where the limb begins, in the rest pose.
  std::vector<dvec3> root_places() const {
    const State state = state_at(file_, nullptr, 0);
    std::vector<dvec3> places;
    for (const int root : roots_) {
      places.push_back(dvec3(state.world[static_cast<std::size_t>(root)][3]));
    }
    return places;
  }

 private:
  bool in_limb(int node) const {
    return std::any_of(parts_.begin(), parts_.end(),
                       [&](int root) { return file_.is_within(node, root); });
  }

  File file_;
  Soup soup_;
  std::vector<Attached> attached_;
  std::vector<Extra> extras_;
  std::vector<int> roots_, parts_, carriers_;
  Part limb_, body_;
};

// Which pairs of limb and body are natural neighbours.
class Neighbours {
 public:
  Neighbours(const Figure& figure, const CollisionQuery& query)
      : limb_(figure.limb().triangles), body_(figure.body().triangles) {
    std::vector<dvec3> rest;
    figure.points_at(nullptr, 0, rest);
    weld(rest);
    mark_seam(rest, figure.root_places(), query.seam_radius);
    known_limb_.assign(limb_.size(), false);
    known_body_.assign(body_.size(), false);
    if (limb_.empty() || body_.empty()) return;
    BoxTree tree(body_, rest);
    learn(tree, rest);
    if (query.source_animation.empty()) return;
    const KeyAnimation& source = figure.file().animation(query.source_animation);
    const int steps = static_cast<int>(std::ceil((source.end - source.begin) * kSourceRate));
    std::vector<dvec3> points;
    for (int i = 0; i <= steps; ++i) {
      figure.points_at(&source, source.begin + (source.end - source.begin) * i / std::max(steps, 1),
                       points);
      tree.refit(points);
      learn(tree, points);
    }
    spread(limb_, known_limb_);
    spread(body_, known_body_);
  }

  bool share_corner(int limb, int body) const {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        if (weld_[limb_[static_cast<std::size_t>(limb)][i]] ==
            weld_[body_[static_cast<std::size_t>(body)][j]])
          return true;
      }
    }
    return false;
  }
  bool natural(int limb, int body) const {
    const auto l = static_cast<std::size_t>(limb), b = static_cast<std::size_t>(body);
    return (seam_limb_[l] && seam_body_[b]) || (known_limb_[l] && known_body_[b]);
  }

 private:
  void weld(const std::vector<dvec3>& rest) {
    std::map<std::tuple<double, double, double>, int> places;
    for (const dvec3& p : rest) {
      weld_.push_back(
          places.emplace(std::tuple(p.x, p.y, p.z), static_cast<int>(places.size())).first->second);
    }
    place_count_ = places.size();
  }

  // Dijkstra along edges from the corners that limb and body share. Figures made of separate pieces
  // share none: there the joint itself is the middle.
  void mark_seam(const std::vector<dvec3>& rest, const std::vector<dvec3>& roots, double radius) {
    std::vector<std::vector<std::pair<int, double>>> edges(place_count_);
    std::vector<char> in_limb(place_count_, 0), in_body(place_count_, 0);
    Box all;
    for (const bool limb : {true, false}) {
      for (const glm::uvec3& t : limb ? limb_ : body_) {
        for (int k = 0; k < 3; ++k) {
          const unsigned a = t[k], b = t[(k + 1) % 3];
          const double length = glm::distance(rest[a], rest[b]);
          edges[static_cast<std::size_t>(weld_[a])].emplace_back(weld_[b], length);
          edges[static_cast<std::size_t>(weld_[b])].emplace_back(weld_[a], length);
          (limb ? in_limb : in_body)[static_cast<std::size_t>(weld_[a])] = 1;
          all.add(rest[a]);
        }
      }
    }
    const double reach = radius * (all.high.y - all.low.y);
    std::vector<double> far(place_count_, 1e300);
    std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>>
        open;
    for (std::size_t i = 0; i < place_count_; ++i) {
      if (in_limb[i] && in_body[i]) open.emplace(far[i] = 0, static_cast<int>(i));
    }
    while (!open.empty()) {
      const auto [distance, at] = open.top();
      open.pop();
      if (distance > far[static_cast<std::size_t>(at)] || distance > reach) continue;
      for (const auto& [next, length] : edges[static_cast<std::size_t>(at)]) {
        if (distance + length < far[static_cast<std::size_t>(next)]) {
          open.emplace(far[static_cast<std::size_t>(next)] = distance + length, next);
        }
      }
    }
    const auto near = [&](const glm::uvec3& t) {
      for (const dvec3& root : roots) {
        for (int k = 0; k < 3; ++k) {
          if (glm::distance(rest[t[k]], root) <= reach) return true;
        }
      }
      return far[static_cast<std::size_t>(weld_[t[0]])] <= reach ||
             far[static_cast<std::size_t>(weld_[t[1]])] <= reach ||
             far[static_cast<std::size_t>(weld_[t[2]])] <= reach;
    };
    for (const glm::uvec3& t : limb_) seam_limb_.push_back(near(t));
    for (const glm::uvec3& t : body_) seam_body_.push_back(near(t));
  }

  void learn(const BoxTree& tree, const std::vector<dvec3>& points) {
    for (std::size_t i = 0; i < limb_.size(); ++i) {
      const Corners mine = corners(limb_[i], points);
      tree.visit(box_of(mine), [&](int other) {
        const auto o = static_cast<std::size_t>(other);
        if (!(known_limb_[i] && known_body_[o]) && !share_corner(static_cast<int>(i), other) &&
            triangles_meet(mine, corners(body_[o], points))) {
          known_limb_[i] = known_body_[o] = true;
        }
        return false;
      });
    }
  }

  // To the triangles that share a corner.
  void spread(const std::vector<glm::uvec3>& triangles, std::vector<bool>& marked) const {
    std::set<int> touched;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      for (int k = 0; k < 3 && marked[i]; ++k) touched.insert(weld_[triangles[i][k]]);
    }
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      for (int k = 0; k < 3; ++k) {
        if (touched.count(weld_[triangles[i][k]])) marked[i] = true;
      }
    }
  }

  const std::vector<glm::uvec3>&limb_, &body_;
  std::vector<int> weld_;  // by point: its place
  std::size_t place_count_ = 0;
  std::vector<bool> seam_limb_, seam_body_, known_limb_, known_body_;
};

// Triangles of an obstacle file that keep their shape in some frame, or all that don't.
struct ObstaclePart {
  int node = -1;       // in whose frame `points` are; -1: in the world
  bool moves = false;  // points are placed anew for every sample
  std::vector<glm::uvec3> triangles;
  std::vector<int> label_node;
  std::vector<dvec3> points;
  std::unique_ptr<BoxTree> tree;
  std::unique_ptr<FclMesh> fcl;
  std::vector<std::vector<glm::uvec3>> solids;  // pieces that hang together
};

class Obstacle {
 public:
  explicit Obstacle(const std::filesystem::path& path) : extra_(load_extra(path)) {
    if (!extra_.file.animations.empty()) extra_.animation = &extra_.file.animations.front();
    std::set<int> driven;  // nodes that a channel moves, and all below
    if (extra_.animation) {
      for (const int i : extra_.file.order) {
        const int parent = extra_.file.nodes[static_cast<std::size_t>(i)].parent;
        bool moved = parent >= 0 && driven.count(parent);
        for (const KeyChannel& c : extra_.animation->channels) moved = moved || c.node == i;
        if (moved) driven.insert(i);
      }
    }
    std::vector<dvec3> world;
    const State state = state_at(extra_.file, extra_.animation, 0);
    place(extra_.file, state, world);
    std::map<int, ObstaclePart> parts;
    const Soup& soup = extra_.soup;
    for (std::size_t i = 0; i < soup.triangles.size(); ++i) {
      const int node = soup.mesh_node[i];
      const bool still = driven.empty() || (soup.rigid[i] && !driven.count(node));
      // -1: at rest; -2: skinned or morphed while something moves; else the node's own.
      const int key = still ? -1 : (soup.rigid[i] ? node : -2);
      ObstaclePart& part = parts[key];
      part.node = key >= 0 ? key : -1;
      part.moves = key == -2;
      glm::uvec3 t = soup.triangles[i];
      const dmat4& m = state.world[static_cast<std::size_t>(node)];
      if (key < 0 && soup.rigid[i] && glm::determinant(glm::dmat3(m)) < 0) std::swap(t[1], t[2]);
      part.triangles.push_back(t);
      part.label_node.push_back(soup.joint[i]);
    }
    for (auto& [key, part] : parts) {
      part.points = world;
      if (part.node >= 0) {
        const dmat4 inverse = glm::inverse(state.world[static_cast<std::size_t>(part.node)]);
        for (dvec3& p : part.points) p = dvec3(inverse * glm::dvec4(p, 1));
      }
      compact(part);
      part.tree = std::make_unique<BoxTree>(part.triangles, part.points);
      part.fcl = std::make_unique<FclMesh>(part.triangles, part.points);
      int count = 0;
      const std::vector<int> piece = pieces(part.triangles, part.points, count);
      part.solids.resize(static_cast<std::size_t>(count));
      for (std::size_t i = 0; i < piece.size(); ++i) {
        part.solids[static_cast<std::size_t>(piece[i])].push_back(part.triangles[i]);
      }
      parts_.push_back(std::move(part));
    }
  }

  // Brings everything to time t.
  void move_to(double t) {
    state_ = state_at(extra_.file, extra_.animation, t);
    std::vector<dvec3> world;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      ObstaclePart& part = parts_[i];
      if (!part.moves) continue;
      if (world.empty()) place(extra_.file, state_, world);
      for (std::size_t k = 0; k < part.points.size(); ++k) part.points[k] = world[sources_[i][k]];
      part.tree->refit(part.points);
      part.fcl->refit(part.points);
    }
  }

  std::vector<ObstaclePart>& parts() { return parts_; }
  // world_from_part.
  dmat4 frame(const ObstaclePart& part) const {
    return part.node < 0 ? dmat4(1.0) : state_.world[static_cast<std::size_t>(part.node)];
  }
  std::string label(int node) const {
    return extra_.file.path.filename().string() + " / " + node_label(extra_.file, node);
  }

 private:
  // Leaves only the points that the part's triangles use.
  void compact(ObstaclePart& part) {
    std::map<unsigned, unsigned> number;
    std::vector<dvec3> points;
    std::vector<unsigned> source;
    for (glm::uvec3& t : part.triangles) {
      for (int k = 0; k < 3; ++k) {
        const auto [at, fresh] = number.emplace(t[k], static_cast<unsigned>(points.size()));
        if (fresh) {
          points.push_back(part.points[t[k]]);
          source.push_back(t[k]);
        }
        t[k] = at->second;
      }
    }
    part.points = std::move(points);
    sources_.push_back(std::move(source));
  }

  Extra extra_;
  State state_;
  std::vector<ObstaclePart> parts_;
  std::vector<std::vector<unsigned>> sources_;  // by part and point: index in the file's soup
};

// The limb as a set of its own, its points by themselves so that FCL need not carry the body's.
struct Mover {
  std::vector<glm::uvec3> triangles;
  std::vector<unsigned> source;  // by point
  std::vector<dvec3> points;
  std::vector<unsigned> probes;  // one point of each piece
  std::unique_ptr<FclMesh> fcl;
};

}  // namespace

CollisionReport count_intersecting_samples(const CollisionQuery& query) {
  CollisionReport report;
  const Figure figure(query);
  const KeyAnimation& animation = figure.file().animation(query.animation);
  const Part &limb = figure.limb(), &body = figure.body();
  if (limb.triangles.empty()) throw std::runtime_error("judge: the limb has no triangles");
  report.limb_triangles = static_cast<int>(limb.triangles.size());
  report.body_triangles = static_cast<int>(body.triangles.size());

  std::vector<std::unique_ptr<Obstacle>> obstacles;
  for (const auto& path : query.obstacles) {
    obstacles.push_back(std::make_unique<Obstacle>(path));
    for (const ObstaclePart& part : obstacles.back()->parts()) {
      report.obstacle_triangles += static_cast<int>(part.triangles.size());
    }
  }

  std::vector<dvec3> points;
  figure.points_at(nullptr, 0, points);
  Mover mover;
  {
    std::map<unsigned, unsigned> number;
    for (const glm::uvec3& t : limb.triangles) {
      glm::uvec3 own;
      for (int k = 0; k < 3; ++k) {
        const auto [at, fresh] = number.emplace(t[k], static_cast<unsigned>(mover.source.size()));
        if (fresh) mover.source.push_back(t[k]);
        own[k] = at->second;
      }
      mover.triangles.push_back(own);
    }
    for (const unsigned s : mover.source) mover.points.push_back(points[s]);
    int count = 0;
    const std::vector<int> piece = pieces(mover.triangles, mover.points, count);
    std::set<int> seen;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      if (seen.insert(piece[i]).second) mover.probes.push_back(mover.triangles[i][0]);
    }
    if (query.with_fcl && !obstacles.empty()) {
      mover.fcl = std::make_unique<FclMesh>(mover.triangles, mover.points);
    }
  }
  std::vector<glm::uvec3> whole = body.triangles;
  whole.insert(whole.end(), limb.triangles.begin(), limb.triangles.end());

  const bool with_body = query.check_body && !body.triangles.empty();
  std::unique_ptr<Neighbours> neighbours;
  std::unique_ptr<BoxTree> body_tree;
  if (with_body) {
    neighbours = std::make_unique<Neighbours>(figure, query);
    body_tree = std::make_unique<BoxTree>(body.triangles, points);
  }
  const auto add_hit = [&](Hit::Kind kind, double t, std::string mine, std::string other) {
    if (report.hits.size() < query.max_hits) {
      report.hits.push_back({kind, t, std::move(mine), std::move(other)});
    }
  };

  for (const double t : query.times) {
    ++report.samples;
    figure.points_at(&animation, t, points);
    bool crossed = false, contained = false;
    for (auto& obstacle : obstacles) {
      obstacle->move_to(t);
      for (ObstaclePart& part : obstacle->parts()) {
        const dmat4 frame = obstacle->frame(part);
        const bool flat = std::fabs(glm::determinant(glm::dmat3(frame))) < 1e-30;
        const dmat4 inverse = flat ? dmat4(1.0) : glm::inverse(frame);
        for (std::size_t i = 0; i < mover.source.size(); ++i) {
          const dvec3& p = points[mover.source[i]];
          mover.points[i] = part.node < 0 || flat ? p : dvec3(inverse * glm::dvec4(p, 1));
        }
        // A node scaled to nothing has no frame to look from: its triangles go to the world
        // instead.
        std::vector<dvec3> flattened;
        std::unique_ptr<BoxTree> flat_tree;
        if (flat) {
          for (const dvec3& p : part.points) flattened.push_back(dvec3(frame * glm::dvec4(p, 1)));
          flat_tree = std::make_unique<BoxTree>(part.triangles, flattened);
        }
        const std::vector<dvec3>& others = flat ? flattened : part.points;
        const BoxTree& tree = flat ? *flat_tree : *part.tree;

        Box mine_box;
        for (const dvec3& p : mover.points) mine_box.add(p);
        if (!mine_box.meets(tree.bounds())) continue;
        int mine = -1, other = -1;
        for (std::size_t i = 0; i < mover.triangles.size() && mine < 0; ++i) {
          const Corners c = corners(mover.triangles[i], mover.points);
          tree.visit(box_of(c), [&](int candidate) {
            if (!triangles_meet(
                    c, corners(part.triangles[static_cast<std::size_t>(candidate)], others)))
              return false;
            mine = static_cast<int>(i);
            other = candidate;
            return true;
          });
        }
        if (mover.fcl && !flat) {
          mover.fcl->refit(mover.points);
          if (mover.fcl->collides(*part.fcl) != (mine >= 0)) ++report.fcl_disagreements;
        }
        if (mine >= 0) {
          crossed = true;
          add_hit(Hit::Kind::obstacle, t, limb.labels[static_cast<std::size_t>(mine)],
                  obstacle->label(part.label_node[static_cast<std::size_t>(other)]));
          continue;
        }
        if (flat) continue;
        for (const auto& solid : part.solids) {
          Box box;
          for (const glm::uvec3& s : solid) box.add(box_of(corners(s, others)));
          bool inside = false;
          const double sign = glm::determinant(glm::dmat3(frame)) < 0 && part.node >= 0 ? -1 : 1;
          for (const unsigned probe : mover.probes) {
            inside = inside || (box.holds(mover.points[probe]) &&
                                sign * winding_number(solid, others, mover.points[probe]) > 0.5);
          }
          const dvec3 probe = others[solid.front()[0]];
          if (!inside && mine_box.holds(probe)) {
            const dvec3 at = part.node < 0 ? probe : dvec3(frame * glm::dvec4(probe, 1));
            inside = std::fabs(winding_number(whole, points, at)) > 0.5;
          }
          if (!inside) continue;
          contained = true;
          add_hit(Hit::Kind::contained, t, "limb", obstacle->label(part.label_node.front()));
          break;
        }
      }
    }
    if (crossed) ++report.obstacle_samples;
    if (contained && !crossed) ++report.contained_samples;

    if (!with_body) continue;
    body_tree->refit(points);
    bool any = false, unnatural = false;
    for (std::size_t i = 0; i < limb.triangles.size() && !unnatural; ++i) {
      const Corners c = corners(limb.triangles[i], points);
      body_tree->visit(box_of(c), [&](int other) {
        const int mine = static_cast<int>(i);
        if (neighbours->share_corner(mine, other)) return false;
        const bool natural = neighbours->natural(mine, other);
        if (any && natural) return false;
        if (!triangles_meet(c, corners(body.triangles[static_cast<std::size_t>(other)], points)))
          return false;
        any = true;
        if (natural) return false;
        unnatural = true;
        add_hit(Hit::Kind::body, t, limb.labels[i], body.labels[static_cast<std::size_t>(other)]);
        return true;
      });
    }
    if (any) ++report.body_samples_all;
    if (unnatural) ++report.body_samples;
  }
  return report;
}

}  // namespace judge
