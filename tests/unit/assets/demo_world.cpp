// SPDX-License-Identifier: MIT
#include "tests/unit/assets/demo_world.h"

#include <cstdio>
#include <cstdlib>
#include <map>
#include <tuple>

#include "assets/demo.h"
#include "core/io/gltf_reader.h"

namespace elbowroom::test {

namespace {

std::shared_ptr<const Model> read(const char* name) {
  auto model = read_gltf(std::filesystem::path(ELBOWROOM_DEMO_DIR) / name);
  if (!model.ok()) {
    std::fprintf(stderr, "%s\n", model.error().message().c_str());
    std::abort();
  }
  return *model;
}

}  // namespace

const Model& mannequin() {
  static const auto model = read(demo::kMannequinFile);
  return *model;
}

const Model& umbrella() {
  static const auto model = read(demo::kUmbrellaFile);
  return *model;
}

const Model& posts() {
  static const auto model = read(demo::kPostsFile);
  return *model;
}

Body welded(const Model& model) {
  Body body;
  std::map<std::tuple<float, float, float>, std::uint32_t> known;
  std::vector<Mat4> globals;
  compute_globals(model.skeleton, rest_pose(model.skeleton), Mat4(1.0), globals);
  for (const Mesh& mesh : model.meshes) {
    std::vector<std::uint32_t> index(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      glm::vec3 p = mesh.positions[i];
      // A rigid mesh stands where its node puts it.
      if (mesh.skin < 0)
        p = glm::vec3(globals[static_cast<std::size_t>(mesh.node)] *
                      glm::dvec4(glm::dvec3(p), 1.0));
      const auto [found, fresh] =
          known.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(body.positions.size()));
      if (fresh) {
        body.positions.push_back(Vec3(p));
        body.influences.emplace_back();
        if (mesh.skin >= 0)
          body.influences.back().assign(mesh.influences.begin() + mesh.influence_begin[i],
                                        mesh.influences.begin() + mesh.influence_begin[i + 1]);
      }
      index[i] = found->second;
    }
    for (const glm::uvec3& t : mesh.triangles)
      body.triangles.push_back({index[t.x], index[t.y], index[t.z]});
  }
  return body;
}

std::vector<Mat4> globals_at(const Model& model, const std::string& clip, double t) {
  Pose pose = rest_pose(model.skeleton);
  const int index = clip.empty() ? -1 : model.find_clip(clip);
  if (index >= 0) sample_clip(model.clips[static_cast<std::size_t>(index)], t, pose);
  std::vector<Mat4> globals;
  compute_globals(model.skeleton, pose, Mat4(1.0), globals);
  return globals;
}

std::vector<Vec3> deformed(const Model& model, const Body& body, const std::vector<Mat4>& globals) {
  const Skin& skin = model.skins.front();
  std::vector<Mat4> matrices(skin.joints.size());
  for (std::size_t i = 0; i < matrices.size(); ++i)
    matrices[i] = globals[static_cast<std::size_t>(skin.joints[i])] * skin.inverse_bind[i];
  std::vector<Vec3> out(body.positions.size(), Vec3(0.0));
  for (std::size_t i = 0; i < out.size(); ++i)
    for (const Influence& f : body.influences[i])
      out[i] += static_cast<double>(f.weight) * Vec3(matrices[static_cast<std::size_t>(f.slot)] *
                                                     glm::dvec4(body.positions[i], 1.0));
  return out;
}

Vec3 joint_position(const Model& model, const std::vector<Mat4>& globals, const std::string& name) {
  const int joint = model.skeleton.find(name);
  if (joint < 0) {
    std::fprintf(stderr, "no joint %s\n", name.c_str());
    std::abort();
  }
  return Vec3(globals[static_cast<std::size_t>(joint)][3]);
}

std::vector<double> key_times(const Model& model, const std::string& clip) {
  const Clip& c = model.clips[static_cast<std::size_t>(model.find_clip(clip))];
  return {c.channels.front().times.begin(), c.channels.front().times.end()};
}

}  // namespace elbowroom::test
