// SPDX-License-Identifier: MIT
#include "tests/support/post_in_the_way.h"

#include <algorithm>
#include <cmath>

#include "core/scene/world.h"
#include "tests/support/simple_glb.h"

namespace elbowroom::test {
namespace {

struct Frame {
  double t = 0;
  std::vector<Vec3> limb, rest;  // vertices
  Vec3 end{0.0};                 // wrist or ankle
  Vec3 centre{0.0};              // of the rest
};

// Every k-th vertex: enough to place a post by.
void thin(std::vector<Vec3>& vertices, std::size_t at_most) {
  const std::size_t stride = vertices.size() / at_most + 1;
  std::size_t kept = 0;
  for (std::size_t v = 0; v < vertices.size(); v += stride) vertices[kept++] = vertices[v];
  vertices.resize(kept);
}

std::vector<Frame> frames_of(const Model& model, const Character& character, const Limb& limb,
                             const Clip& clip) {
  std::vector<Frame> frames;
  const int count = static_cast<int>(clip.duration() * 60) + 1;
  std::vector<Vec3> vertices;
  std::vector<Mat4> globals;
  const auto is_limbs = [&](int node) {
    return model.skeleton.is_within(node, limb.root) ||
           std::any_of(limb.following.begin(), limb.following.end(),
                       [&](const auto& own) { return model.skeleton.is_within(node, own.joint); });
  };
  for (int i = 0; i < count; ++i) {
    Frame frame;
    frame.t = clip.begin + i / 60.0;
    Pose pose = rest_pose(model.skeleton);
    sample_clip(clip, frame.t, pose);
    compute_globals(model.skeleton, pose, Mat4(1.0), globals);
    for (const int m : character.meshes) {
      const Mesh& mesh = model.meshes[static_cast<std::size_t>(m)];
      deform(model, mesh, pose, globals, vertices);
      for (std::size_t v = 0; v < vertices.size(); ++v) {
        double share = 0;
        if (mesh.skin < 0)
          share = is_limbs(mesh.node) ? 1 : 0;
        else
          for (auto k = mesh.influence_begin[v]; k < mesh.influence_begin[v + 1]; ++k)
            if (is_limbs(mesh.influences[k].joint))
              share += static_cast<double>(mesh.influences[k].weight);
        (share > 0.5 ? frame.limb : frame.rest).push_back(vertices[v]);
      }
    }
    thin(frame.limb, 300);
    thin(frame.rest, 500);
    for (const Vec3& v : frame.rest) frame.centre += v / static_cast<double>(frame.rest.size());
    frame.end = Vec3(globals[static_cast<std::size_t>(limb.end)][3]);
    frames.push_back(std::move(frame));
  }
  return frames;
}

double horizontal_distance(const Vec3& p, double x, double z) {
  return std::hypot(p.x - x, p.z - z);
}

std::optional<PostProblem> try_clip(const Model& model, const Character& character,
                                    const Limb& limb, int clip_index, unsigned variant) {
  const Clip& clip = model.clips[static_cast<std::size_t>(clip_index)];
  if (clip.duration() < 0.5) return std::nullopt;
  // A limb that hardly moves passes nothing.
  double moved = 0;
  Vec3 first_place(0.0);
  std::vector<Mat4> globals;
  for (int i = 0; i <= 12; ++i) {
    Pose pose = rest_pose(model.skeleton);
    sample_clip(clip, clip.begin + clip.duration() * i / 12, pose);
    compute_globals(model.skeleton, pose, Mat4(1.0), globals);
    const Vec3 place(globals[static_cast<std::size_t>(limb.end)][3]);
    if (i == 0) first_place = place;
    moved = std::max(moved, glm::length(place - first_place));
  }
  if (moved < 0.1 * character.height) return std::nullopt;
  const auto frames = frames_of(model, character, limb, clip);
  if (frames.front().limb.empty() || frames.front().rest.empty()) return std::nullopt;
  const double h = character.height;
  double floor = frames.front().rest.front().y;
  for (const auto& frame : frames)
    for (const auto& v : frame.rest) floor = std::min(floor, v.y);

  unsigned found = 0;
  std::optional<PostProblem> last;
  // Middle of the clip first: there is most time before and after.
  std::vector<std::size_t> order(frames.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const double middle = 0.5 * static_cast<double>(frames.size() - 1);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(static_cast<double>(a) - middle) < std::abs(static_cast<double>(b) - middle);
  });
  for (const double depth : {0.02, 0.035, 0.012}) {
    for (std::size_t k = 0; k < order.size(); k += 3) {
      const Frame& frame = frames[order[k]];
      const Vec3 away = frame.end - frame.centre;
      const double heading = std::atan2(away.z, away.x);
      for (const double turn : {0.0, 0.5, -0.5, 1.0, -1.0}) {
        const double cosine = std::cos(heading + turn), sine = std::sin(heading + turn);
        double reach = -1e300;
        Vec3 outermost(0.0);
        for (const auto& v : frame.limb)
          if (v.x * cosine + v.z * sine > reach) {
            reach = v.x * cosine + v.z * sine;
            outermost = v;
          }
        PostProblem post;
        post.clip = clip_index;
        post.radius = 0.02 * h;
        post.x = outermost.x + cosine * (post.radius - depth * h);
        post.z = outermost.z + sine * (post.radius - depth * h);
        post.y_low = floor;
        post.y_high = floor + 1.15 * h;
        bool clear = true;
        int first = -1, final = -1, hits = 0;
        for (std::size_t i = 0; i < frames.size() && clear; ++i) {
          for (const auto& v : frames[i].rest)
            if (horizontal_distance(v, post.x, post.z) < post.radius + 0.035 * h) {
              clear = false;
              break;
            }
          double nearest = 1e300;
          for (const auto& v : frames[i].limb)
            if (v.y > post.y_low && v.y < post.y_high)
              nearest = std::min(nearest, horizontal_distance(v, post.x, post.z));
          if (nearest < post.radius) {
            if (first < 0) first = static_cast<int>(i);
            final = static_cast<int>(i);
            ++hits;
            post.depth = std::max(post.depth, post.radius - nearest);
          }
        }
        const int last_frame = static_cast<int>(frames.size()) - 1;
        if (!clear || hits < 2 || final - first + 1 != hits || first < 9 || final > last_frame - 9)
          continue;
        post.hit_begin = frames[static_cast<std::size_t>(first)].t;
        post.hit_end = frames[static_cast<std::size_t>(final)].t;
        last = post;
        if (found++ == variant) return last;
      }
    }
  }
  return last;
}

}  // namespace

std::optional<PostProblem> post_in_the_way(const Model& model, const Character& character,
                                           const Limb& limb, int clip, unsigned variant) {
  if (clip >= 0) return try_clip(model, character, limb, clip, variant);
  for (int c = 0; c < static_cast<int>(model.clips.size()); ++c)
    if (auto post = try_clip(model, character, limb, c, variant)) return post;
  return std::nullopt;
}

bool write_post(const PostProblem& problem, const std::filesystem::path& file) {
  return write_simple_glb(
      file, "post",
      upright_post(problem.x, problem.z, problem.radius, problem.y_low, problem.y_high));
}

}  // namespace elbowroom::test
