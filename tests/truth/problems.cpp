// SPDX-License-Identifier: MIT
#include "tests/truth/problems.h"

#include <algorithm>
#include <cmath>

#include "core/animation/skeleton.h"
#include "core/base/random.h"

namespace elbowroom::test {
namespace {

constexpr double kRate = 60;          // Hz, of the moments looked at
constexpr int kFreeMoments = 9;       // before and after the stretch that collides
constexpr double kBodyRoom = 0.035;   // × height, from the rest of the figure
constexpr double kLeastTravel = 0.1;  // × height, of the wrist or ankle
constexpr int kTries = 80;

// A convex piece: a box, or with `round` a capsule along its longest axis (a ball, if a cube).
struct Piece {
  Vec3 centre{0.0};
  Mat3 axes{1.0};  // columns
  Vec3 half{0.0};
  bool round = false;
};

double distance(const Piece& piece, const Vec3& p) {
  const Vec3 local = glm::transpose(piece.axes) * (p - piece.centre);
  if (piece.round) {
    const double radius = piece.half.x, reach = piece.half.y - piece.half.x;
    const double y = std::clamp(local.y, -reach, reach);
    return glm::length(local - Vec3(0, y, 0)) - radius;
  }
  const Vec3 q = glm::abs(local) - piece.half;
  return glm::length(glm::max(q, Vec3(0.0))) + std::min(0.0, std::max({q.x, q.y, q.z}));
}

void add_box(const Piece& piece, SimpleMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const SimpleMesh part = box(-glm::vec3(piece.half), glm::vec3(piece.half));
  for (const auto& p : part.positions)
    mesh.positions.emplace_back(piece.centre + piece.axes * Vec3(p));
  for (const auto& t : part.triangles) mesh.triangles.push_back(t + first);
}

// A capsule along the piece's y, of rings and a point at each end.
void add_round(const Piece& piece, SimpleMesh& mesh) {
  constexpr int kRings = 10, kSides = 16;
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const double radius = piece.half.x, reach = std::max(0.0, piece.half.y - radius);
  const auto put = [&](const Vec3& local) {
    mesh.positions.emplace_back(piece.centre + piece.axes * local);
  };
  put({0, -reach - radius, 0});
  for (int ring = 1; ring < kRings; ++ring) {
    const double angle = kPi * (static_cast<double>(ring) / kRings - 0.5);
    const double y = (angle < 0 ? -reach : reach) + radius * std::sin(angle);
    for (int side = 0; side < kSides; ++side) {
      const double turn = 2 * kPi * side / kSides;
      put({radius * std::cos(angle) * std::cos(turn), y,
           radius * std::cos(angle) * std::sin(turn)});
    }
  }
  put({0, reach + radius, 0});
  const std::uint32_t top = first + 1 + (kRings - 1) * kSides;
  const auto at = [&](int ring, int side) {
    return first + 1 + static_cast<std::uint32_t>((ring - 1) * kSides + side % kSides);
  };
  for (int side = 0; side < kSides; ++side) {
    mesh.triangles.emplace_back(first, at(1, side), at(1, side + 1));
    mesh.triangles.emplace_back(top, at(kRings - 1, side + 1), at(kRings - 1, side));
    for (int ring = 1; ring + 1 < kRings; ++ring) {
      mesh.triangles.emplace_back(at(ring, side), at(ring + 1, side), at(ring, side + 1));
      mesh.triangles.emplace_back(at(ring, side + 1), at(ring + 1, side), at(ring + 1, side + 1));
    }
  }
}

Mat3 turned(double heading, double tilt, double roll) {
  const Quat q = glm::angleAxis(-heading, Vec3(0, 1, 0)) * glm::angleAxis(tilt, Vec3(0, 0, 1)) *
                 glm::angleAxis(roll, Vec3(1, 0, 0));
  return glm::mat3_cast(q);
}

// The pieces of a thing about a place that the limb passes; x of `axes` points away from the body.
std::vector<Piece> pieces_of(Thing thing, const Vec3& place, double heading, double h, double floor,
                             Random& random) {
  const double scale = h / 1.75;
  const auto tilted = [&](double most) {
    return turned(heading, random.uniform(-most, most), random.uniform(-most, most));
  };
  switch (thing) {
    case Thing::post: {
      const double radius = h * random.uniform(0.012, 0.035);
      Piece post{place, tilted(0.15), Vec3(radius, 0.6 * h, radius), true};
      post.centre.y = floor + 0.6 * h;
      return {post};
    }
    case Thing::plate:
      return {{place, tilted(0.6),
               Vec3(0.0015 * scale, h * random.uniform(0.06, 0.18), h * random.uniform(0.06, 0.18)),
               false}};
    case Thing::wire: {
      const double radius = 0.003 * scale;
      Mat3 axes = tilted(1.2);
      // Along y or across, but never along the way out.
      if (random.below(2) == 0) axes = axes * Mat3(Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0, -1, 0));
      return {{place, axes, Vec3(radius, h * random.uniform(0.2, 0.5), radius), true}};
    }
    case Thing::frame: {
      // A window to reach past: four bars, the nearest of them in the limb's way.
      const Mat3 axes = tilted(0.3);
      const double bar = h * random.uniform(0.01, 0.02);
      const double wide = h * random.uniform(0.16, 0.3), tall = h * random.uniform(0.16, 0.3);
      const Vec3 middle = place + axes * Vec3(wide, 0, 0);
      return {{middle - axes[0] * wide, axes, Vec3(bar, tall, bar)},
              {middle + axes[0] * wide, axes, Vec3(bar, tall, bar)},
              {middle - axes[1] * tall, axes, Vec3(wide, bar, bar)},
              {middle + axes[1] * tall, axes, Vec3(wide, bar, bar)}};
    }
    case Thing::ball:
      break;
  }
  const double radius = h * random.uniform(0.02, 0.05);
  return {{place, Mat3(1.0), Vec3(radius), true}};
}

// Every k-th vertex.
void thin(std::vector<Vec3>& vertices, std::size_t at_most) {
  const std::size_t stride = vertices.size() / at_most + 1;
  std::size_t kept = 0;
  for (std::size_t v = 0; v < vertices.size(); v += stride) vertices[kept++] = vertices[v];
  vertices.resize(kept);
}

}  // namespace

const char* name_of(Thing thing) {
  switch (thing) {
    case Thing::post:
      return "post";
    case Thing::plate:
      return "plate";
    case Thing::wire:
      return "wire";
    case Thing::frame:
      return "frame";
    case Thing::ball:
      break;
  }
  return "ball";
}

std::optional<TruthStage> TruthStage::make(std::shared_ptr<const Model> model,
                                           const Character& character, const Limb& limb,
                                           int clip_index) {
  const Clip& clip = model->clips[static_cast<std::size_t>(clip_index)];
  const double duration = clip.duration();
  if (duration < 0.5 || duration > 20) return std::nullopt;
  TruthStage stage;
  stage.model_ = model;
  stage.limb_ = limb;
  stage.clip_ = clip_index;
  stage.height_ = character.height;
  std::vector<Vec3> vertices;
  std::vector<Mat4> globals;
  stage.floor_ = 1e300;
  double travel = 0;
  for (int i = 0; i <= static_cast<int>(duration * kRate); ++i) {
    Moment moment;
    moment.t = clip.begin + i / kRate;
    Pose pose = rest_pose(model->skeleton);
    sample_clip(clip, moment.t, pose);
    compute_globals(model->skeleton, pose, Mat4(1.0), globals);
    for (const int m : character.meshes) {
      const Mesh& mesh = model->meshes[static_cast<std::size_t>(m)];
      deform(*model, mesh, pose, globals, vertices);
      for (std::size_t v = 0; v < vertices.size(); ++v) {
        double share = 0;
        if (mesh.skin < 0)
          share = model->skeleton.is_within(mesh.node, limb.root) ? 1 : 0;
        else
          for (auto k = mesh.influence_begin[v]; k < mesh.influence_begin[v + 1]; ++k)
            if (model->skeleton.is_within(mesh.influences[k].joint, limb.root))
              share += static_cast<double>(mesh.influences[k].weight);
        (share > 0.5 ? moment.limb : moment.rest).push_back(vertices[v]);
      }
    }
    thin(moment.limb, 400);
    thin(moment.rest, 600);
    if (moment.limb.empty() || moment.rest.empty()) return std::nullopt;
    for (const Vec3& v : moment.rest) {
      moment.centre += v / static_cast<double>(moment.rest.size());
      stage.floor_ = std::min(stage.floor_, v.y);
    }
    moment.end = Vec3(globals[static_cast<std::size_t>(limb.end)][3]);
    if (!stage.moments_.empty())
      travel = std::max(travel, glm::distance(moment.end, stage.moments_.front().end));
    stage.moments_.push_back(std::move(moment));
  }
  if (travel < kLeastTravel * character.height) return std::nullopt;
  return stage;
}

std::optional<TruthProblem> TruthStage::problem(Thing thing, std::uint64_t seed) const {
  Random random(seed);
  const int count = static_cast<int>(moments_.size());
  const double h = height_;
  // What a limb that is sampled by some vertices may pass unseen.
  const double blur = thing == Thing::plate || thing == Thing::wire ? 0.008 * h : 0.0;
  for (int attempt = 0; attempt < kTries; ++attempt) {
    const int at = kFreeMoments + static_cast<int>(random.below(static_cast<std::uint64_t>(
                                      std::max(1, count - 2 * kFreeMoments))));
    if (at >= count) return std::nullopt;
    const Moment& moment = moments_[static_cast<std::size_t>(at)];
    const Vec3 away = moment.end - moment.centre;
    const double heading = std::atan2(away.z, away.x) + random.uniform(-1.2, 1.2);
    const Vec3 out(std::cos(heading), 0, std::sin(heading));
    Vec3 outermost = moment.limb.front();
    for (const Vec3& v : moment.limb)
      if (glm::dot(v, out) > glm::dot(outermost, out)) outermost = v;
    // Moved inwards until that vertex is as deep in it as is wanted.
    auto pieces = pieces_of(thing, outermost + 0.3 * h * out, heading, h, floor_, random);
    const double depth = h * random.uniform(0.008, 0.03);
    double moved = 0;
    for (int i = 0; i < 64; ++i) {
      double nearest = 1e300;
      for (const Piece& piece : pieces) nearest = std::min(nearest, distance(piece, outermost));
      if (nearest <= 1e-4 * h) break;
      for (Piece& piece : pieces) piece.centre -= nearest * out;
      moved += nearest;
      if (moved > 2 * h) break;
    }
    if (moved > 2 * h) continue;
    for (Piece& piece : pieces) piece.centre -= depth * out;
    // A ball flies across the limb's way and is there at the moment chosen.
    Vec3 velocity(0.0);
    if (thing == Thing::ball) {
      velocity = h * random.uniform(0.15, 0.8) *
                 glm::normalize(Vec3(-out.z, random.uniform(-0.7, 0.7), out.x) *
                                (random.below(2) == 0 ? 1.0 : -1.0));
    }
    int first = -1, last = -1, hits = 0;
    bool clear = true;
    for (int i = 0; i < count && clear; ++i) {
      const Moment& now = moments_[static_cast<std::size_t>(i)];
      const Vec3 shift = velocity * (now.t - moment.t);
      const auto nearest = [&](const Vec3& v) {
        double d = 1e300;
        for (const Piece& piece : pieces) d = std::min(d, distance(piece, v - shift));
        return d;
      };
      for (const Vec3& v : now.rest)
        if (nearest(v) < kBodyRoom * h) {
          clear = false;
          break;
        }
      bool hit = false;
      for (const Vec3& v : now.limb) hit = hit || nearest(v) < blur;
      if (!hit) continue;
      if (first < 0) first = i;
      last = i;
      ++hits;
    }
    if (!clear || hits < 1 || last - first + 1 > hits + 2) continue;
    if (first < kFreeMoments || last > count - 1 - kFreeMoments) continue;
    TruthProblem problem;
    problem.thing = thing;
    problem.hit_begin = moments_[static_cast<std::size_t>(first)].t;
    problem.hit_end = moments_[static_cast<std::size_t>(last)].t;
    if (thing == Thing::ball) {
      const double end = moments_.back().t + 1;
      for (Piece& piece : pieces) piece.centre -= velocity * moment.t;  // at time 0
      problem.seconds = static_cast<float>(end);
      problem.move_to = glm::vec3(velocity * end);
    }
    for (const Piece& piece : pieces)
      piece.round ? add_round(piece, problem.mesh) : add_box(piece, problem.mesh);
    return problem;
  }
  return std::nullopt;
}

bool write_thing(const TruthProblem& problem, const std::filesystem::path& file) {
  return write_simple_glb(file, name_of(problem.thing), problem.mesh, problem.move_to,
                          problem.seconds);
}

}  // namespace elbowroom::test
