// SPDX-License-Identifier: MIT
// Export of every sample that has a clip: a limb joint takes a detour, and the file that comes out
// is judged by code of its own and by the Khronos validator.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <sstream>

#include "core/animation/splice.h"
#include "core/io/gltf_reader.h"
#include "core/io/gltf_writer.h"
#include "tests/judge/judge.h"
#include "tests/support/samples.h"
#include "tests/unit/io_write/folder.h"

namespace elbowroom {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> sample_files() {
  std::vector<fs::path> files;
  const fs::path root = test::samples_dir();
  if (root.empty()) return files;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    const std::string extension = entry.path().extension().string();
    const bool known =
        extension == ".glb" || extension == ".gltf" || extension == ".vrm" || extension == ".vrma";
    const auto inside = entry.path().lexically_relative(root);
    if (entry.is_regular_file() && known && *inside.begin() != "malformed") {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

// The joint turns away from the clip and comes back, at 120 Hz.
Result<Channel> detour(const Model& model, const Clip& clip, int joint, float begin, float end) {
  const int index = clip.find_channel(joint, Path::rotation);
  const Channel* source = index < 0 ? nullptr : &clip.channels[static_cast<std::size_t>(index)];
  const Quat rest = model.skeleton.joints[static_cast<std::size_t>(joint)].rest.rotation;
  const int count = std::max(4, static_cast<int>((end - begin) * 120));
  RotationKeys keys;
  const auto curve = [&](double t) {
    const double u = (t - begin) / (static_cast<double>(end) - begin);
    return (source ? sample_rotation(*source, t) : rest) *
           quat_from_rotation_vector(Vec3(0.3 * std::pow(std::sin(kPi * u), 2), 0, 0));
  };
  for (int i = 0; i <= count; ++i) {
    const float t = i == count
                        ? end
                        : begin + (end - begin) * static_cast<float>(i) / static_cast<float>(count);
    if (!keys.times.empty() && !(t > keys.times.back() && t <= end)) continue;
    keys.times.push_back(t);
    keys.values.push_back(curve(t));
    const Quat a = curve(t - 1e-4), b = curve(t + 1e-4);
    const auto along = [&](const Quat& q) { return glm::dot(q, keys.values.back()) < 0 ? -q : q; };
    keys.derivatives.push_back((along(b) - along(a)) * 5e3);
  }
  return splice_rotation(source, rest, joint, begin, end, keys);
}

// One sample exported with two corrected joints: one of the clip's, and one that has no channel.
struct Exported {
  fs::path source, out;
  bool same_container = false;
  std::shared_ptr<const Model> model;
  const Clip* clip = nullptr;
  std::vector<Channel> changed;
  float begin = 0, end = 0;
  ExportReport report;
};

class ExportOfSamples : public test::InFolder {
 protected:
  // Every sample that can be read and has a clip, in its own container and in the other one. Each
  // into a folder of its own.
  void for_each_export(const std::function<void(const Exported&)>& visit) {
    int number = 0;
    for (const fs::path& file : sample_files()) {
      SCOPED_TRACE(file.string());
      ReadOptions options;
      options.images = false;
      const auto model = read_gltf(file, options);
      if (!model.ok()) continue;  // that it is refused with reason is the reader's test
      Exported one;
      one.source = file;
      one.model = *model;
      if (!correct(one)) continue;
      const std::string own = file.extension().string();
      for (const std::string& extension : {own, std::string(own == ".gltf" ? ".glb" : ".gltf")}) {
        one.same_container = extension == own;
        one.out = folder_ / std::to_string(number++) / ("out" + extension);
        one.report = {};
        fs::create_directories(one.out.parent_path());
        const auto status = export_corrected(
            file, one.out, corrected_clip(apply_splices(*one.clip, one.changed)), &one.report);
        ASSERT_TRUE(status.ok()) << status.error().message();
        visit(one);
      }
    }
    EXPECT_GT(number, 0);
  }

  // Codes of the validator's messages for each file; empty if it cannot be run.
  std::vector<std::string> validate(const std::vector<fs::path>& files) {
    std::string list;
    for (const fs::path& file : files) list += file.string() + "\n";
    spill(folder_ / "list.txt", list);
    const std::string command = "node '" ELBOWROOM_SOURCE_DIR "/tests/validator/validate.mjs' '" +
                                (folder_ / "list.txt").string() + "' > '" +
                                (folder_ / "codes.txt").string() + "'";
    if (std::system(command.c_str()) != 0) return {};
    std::vector<std::string> codes;
    std::istringstream lines(slurp(folder_ / "codes.txt"));
    for (std::string line; std::getline(lines, line);) codes.push_back(line);
    return codes;
  }

 private:
  // In the clip with the most rotation channels.
  static bool correct(Exported& one) {
    std::vector<int> joints;
    for (const Clip& clip : one.model->clips) {
      std::vector<int> turned;
      for (const Channel& channel : clip.channels) {
        if (channel.path == Path::rotation) turned.push_back(channel.joint);
      }
      if (!one.clip || turned.size() > joints.size()) {
        one.clip = &clip;
        joints = turned;
      }
    }
    if (!one.clip) return false;
    std::vector<int> limb;
    if (!joints.empty()) limb.push_back(joints[joints.size() / 2]);
    const Skeleton& skeleton = one.model->skeleton;
    for (int i = 0; i < skeleton.size(); ++i) {
      // No limb has the node of a skinned mesh, and the validator rightly warns where one is moved.
      const bool holds_skin =
          std::any_of(one.model->meshes.begin(), one.model->meshes.end(),
                      [&](const Mesh& mesh) { return mesh.node == i && mesh.skin >= 0; });
      if (!holds_skin && !skeleton.joints[static_cast<std::size_t>(i)].rest_matrix &&
          one.clip->find_channel(i, Path::rotation) < 0) {
        limb.push_back(i);
        break;
      }
    }
    const double length = std::max(one.clip->duration(), 0.3);
    one.begin = static_cast<float>(one.clip->begin + 0.31 * length);
    one.end = static_cast<float>(one.clip->begin + 0.77 * length);
    for (const int joint : limb) {
      auto channel = detour(*one.model, *one.clip, joint, one.begin, one.end);
      EXPECT_TRUE(channel.ok()) << channel.error().message();
      if (channel.ok()) one.changed.push_back(*std::move(channel));
    }
    return !one.changed.empty();
  }
};

std::vector<std::string> split(const std::string& codes) {
  std::vector<std::string> all;
  std::istringstream parts(codes);
  for (std::string code; std::getline(parts, code, ',');) all.push_back(code);
  return all;
}

TEST_F(ExportOfSamples, KeepsBytesValuesAndMotion) {
  if (test::samples_dir().empty()) GTEST_SKIP() << test::samples_missing();
  for_each_export([&](const Exported& one) {
    const judge::File before = judge::load(one.source), after = judge::load(one.out);
    ASSERT_EQ(one.report.animations.size(), 1u);
    const std::string old_animation = std::to_string(one.clip->source_animation);
    const std::string animation = one.report.animations[0].name;
    EXPECT_EQ(after.animations.size(), before.animations.size() + 1);
    EXPECT_EQ(after.animations.back().name, animation);
    if (one.same_container) {
      const judge::ByteReport bytes = judge::compare_bytes(before, after);
      EXPECT_TRUE(bytes.buffers_are_prefixes);
      EXPECT_TRUE(bytes.json_differences.empty()) << bytes.json_differences.front();
    }
    // Names of nodes may be missing or stand twice.
    judge::File old_named = before, new_named = after;
    std::vector<std::string> limb;
    for (const Channel& channel : one.changed) {
      limb.push_back("limb " + std::to_string(channel.joint));
      old_named.nodes[static_cast<std::size_t>(channel.joint)].name = limb.back();
      new_named.nodes[static_cast<std::size_t>(channel.joint)].name = limb.back();
    }
    const auto faults = judge::joints_outside_limb_bit_identical(old_named, new_named,
                                                                 old_animation, animation, limb);
    EXPECT_TRUE(faults.empty()) << faults.front();
    const auto outside = judge::outside_window(old_named, new_named, old_animation, animation, limb,
                                               one.begin, one.end);
    EXPECT_LT(outside.difference, 1e-6);
    EXPECT_TRUE(outside.lost_keys.empty()) << outside.lost_keys.front();
    EXPECT_LT(judge::border_difference(old_named, new_named, old_animation, animation, limb,
                                       one.begin, one.end),
              1e-6);

    // The product reads it as it was meant.
    ReadOptions options;
    options.images = false;
    const auto again = read_gltf(one.out, options);
    ASSERT_TRUE(again.ok()) << again.error().message();
    ASSERT_EQ((*again)->clips.size(), one.model->clips.size() + 1);
    const Clip& read = (*again)->clips.back();
    EXPECT_EQ(read.name, animation);
    for (const Channel& channel : one.changed) {
      const int at = read.find_channel(channel.joint, Path::rotation);
      ASSERT_GE(at, 0);
      EXPECT_EQ(read.channels[static_cast<std::size_t>(at)].times, channel.times);
      EXPECT_EQ(read.channels[static_cast<std::size_t>(at)].values, channel.values);
    }
  });
}

TEST_F(ExportOfSamples, GiveTheKhronosValidatorNoNewMessage) {
  if (test::samples_dir().empty()) GTEST_SKIP() << test::samples_missing();
  if (!std::getenv("ELBOWROOM_GLTF_VALIDATOR")) {
    GTEST_SKIP()
        << "no validator: set ELBOWROOM_GLTF_VALIDATOR to the node_modules folder that has "
           "gltf-validator";
  }
  std::vector<fs::path> files;  // source, export, source, export, ...
  for_each_export([&](const Exported& one) {
    files.push_back(one.source);
    files.push_back(one.out);
  });
  const auto codes = validate(files);
  ASSERT_EQ(codes.size(), files.size()) << "the validator did not run";
  for (std::size_t i = 0; i < codes.size(); i += 2) {
    const auto known = split(codes[i]);
    for (const std::string& code : split(codes[i + 1])) {
      EXPECT_TRUE(code == "-" || std::find(known.begin(), known.end(), code) != known.end())
          << files[i] << " has not " << code << ", which its export " << files[i + 1].filename()
          << " has";
    }
  }
}

// The judge and the product see the same world: all points of all samples, at times in and beyond
// their clips. Two programs that share no code agree, so neither has read the file wrongly.
TEST_F(ExportOfSamples, AreSeenAlikeByJudgeAndProduct) {
  const auto files = sample_files();
  if (files.empty()) GTEST_SKIP() << test::samples_missing();
  int compared = 0;
  for (const fs::path& file : files) {
    SCOPED_TRACE(file.string());
    ReadOptions options;
    options.images = false;
    const auto model = read_gltf(file, options);
    if (!model.ok()) continue;
    const judge::File other = judge::load(file);
    const judge::Soup soup = judge::soup_of(other);
    std::size_t triangles = 0;
    for (const Mesh& mesh : (*model)->meshes) triangles += mesh.triangles.size();
    EXPECT_EQ(triangles, soup.triangles.size());
    const Skeleton& skeleton = (*model)->skeleton;
    for (int c = -1; c < std::min<int>(3, static_cast<int>((*model)->clips.size())); ++c) {
      const Clip* clip = c < 0 ? nullptr : &(*model)->clips[static_cast<std::size_t>(c)];
      for (const double u : {-0.1, 0.0, 0.237, 0.71, 1.0}) {
        if (!clip && u > -0.1) break;
        const double t = clip ? clip->begin + u * clip->duration() : 0;
        Pose pose = rest_pose(skeleton);
        if (clip) sample_clip(*clip, t, pose);
        std::vector<Mat4> globals;
        compute_globals(skeleton, pose, Mat4(1.0), globals);
        std::vector<Vec3> points, all;
        std::vector<glm::dvec3> theirs;
        const judge::KeyAnimation* animation =
            clip ? &other.animations[static_cast<std::size_t>(clip->source_animation)] : nullptr;
        judge::place(other, judge::state_at(other, animation, t), theirs);
        // Corner by corner, as the two may keep points in a different order.
        double worst = 0, size = 0;
        std::size_t at = 0;
        for (const Mesh& mesh : (*model)->meshes) {
          deform(**model, mesh, pose, globals, points);
          for (const glm::uvec3& triangle : mesh.triangles) {
            if (at >= soup.triangles.size()) break;
            // Of a strip's or fan's triangle any corner may be the first.
            double best = 1e300;
            for (int first = 0; first < 3; ++first) {
              double off = 0;
              for (int k = 0; k < 3; ++k) {
                const glm::dvec3& p = theirs[soup.triangles[at][(first + k) % 3]];
                off = std::max(off, glm::distance(points[triangle[k]], p));
                size = std::max(size, glm::length(p));
              }
              best = std::min(best, off);
            }
            worst = std::max(worst, best);
            ++at;
          }
        }
        EXPECT_LE(worst, 1e-5 * (1 + size)) << "clip " << c << " at " << t;
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 0);
}

}  // namespace
}  // namespace elbowroom
