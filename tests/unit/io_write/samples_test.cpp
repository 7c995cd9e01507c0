// SPDX-License-Identifier: MIT
// Export of every sample that has a clip: a limb joint takes a detour, and the file that comes out
// is judged by code of its own and by the Khronos validator.
#include <cmath>
#include <cstdlib>
#include <map>
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

class ExportOfSamples : public test::InFolder {
 protected:
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
};

std::vector<std::string> split(const std::string& codes) {
  std::vector<std::string> all;
  std::istringstream parts(codes);
  for (std::string code; std::getline(parts, code, ',');) all.push_back(code);
  return all;
}

TEST_F(ExportOfSamples, KeepsBytesValuesAndMotionAndStaysValid) {
  const auto files = sample_files();
  if (files.empty()) GTEST_SKIP() << test::samples_missing();
  std::vector<fs::path> to_validate;
  std::vector<bool> is_source;
  int exported = 0, number = 0;
  std::map<Interpolation, int> kinds;
  for (const fs::path& file : files) {
    SCOPED_TRACE(file.string());
    ReadOptions options;
    options.images = false;
    const auto model = read_gltf(file, options);
    if (!model.ok()) continue;  // that it is refused with reason is the reader's test
    const auto& clips = (*model)->clips;
    if (clips.empty()) continue;
    const judge::File before = judge::load(file);
    // The clip with the most rotation channels, and its last joint but one: deep in some chain.
    std::size_t chosen = 0, most = 0;
    for (std::size_t i = 0; i < clips.size(); ++i) {
      std::size_t count = 0;
      for (const Channel& channel : clips[i].channels) count += channel.path == Path::rotation;
      if (count > most) {
        most = count;
        chosen = i;
      }
    }
    const Clip& clip = clips[chosen];
    std::vector<int> joints;
    for (const Channel& channel : clip.channels) {
      if (channel.path == Path::rotation) joints.push_back(channel.joint);
    }
    std::vector<int> limb;
    if (!joints.empty()) limb.push_back(joints[joints.size() / 2]);
    for (int i = 0; i < (*model)->skeleton.size(); ++i) {  // and a joint that has no channel
      // The validator rightly warns of a skinned mesh's node that is animated; no limb has one.
      if (before.nodes[static_cast<std::size_t>(i)].skin < 0 &&
          !(*model)->skeleton.joints[static_cast<std::size_t>(i)].rest_matrix &&
          clip.find_channel(i, Path::rotation) < 0) {
        limb.push_back(i);
        break;
      }
    }
    if (limb.empty()) continue;

    const double length = std::max(clip.duration(), 0.3);
    const float begin = static_cast<float>(clip.begin + 0.31 * length),
                end = static_cast<float>(clip.begin + 0.77 * length);
    std::vector<Channel> changed;
    std::vector<std::string> names;
    for (const int joint : limb) {
      auto channel = detour(**model, clip, joint, begin, end);
      ASSERT_TRUE(channel.ok()) << channel.error().message();
      ++kinds[channel->interpolation];
      changed.push_back(*std::move(channel));
      names.push_back(before.nodes[static_cast<std::size_t>(joint)].name);
    }
    const Clip corrected = apply_splices(clip, changed);

    // Into a folder of its own, in the same container and in the other one.
    const std::string own = file.extension().string();
    for (const std::string& extension : {own, std::string(own == ".gltf" ? ".glb" : ".gltf")}) {
      const fs::path out = folder_ / std::to_string(number++) / ("out" + extension);
      fs::create_directories(out.parent_path());
      ExportReport report;
      const auto status = export_corrected(file, out, corrected_clip(corrected), &report);
      ASSERT_TRUE(status.ok()) << status.error().message();
      ASSERT_EQ(report.animations.size(), 1u);
      to_validate.insert(to_validate.end(), {file, out});
      ++exported;

      const judge::File after = judge::load(out);
      const std::string old_animation = std::to_string(clip.source_animation);
      const std::string animation = report.animations[0].name;
      EXPECT_EQ(after.animations.size(), before.animations.size() + 1);
      EXPECT_EQ(after.animations.back().name, animation);
      const judge::ByteReport bytes = judge::compare_bytes(before, after);
      if (extension == own) {
        EXPECT_TRUE(bytes.buffers_are_prefixes);
        EXPECT_TRUE(bytes.json_differences.empty()) << bytes.json_differences.front();
      }
      // Nodes without a name or with a common one are told by index alone.
      judge::File old_named = before, new_named = after;
      std::vector<std::string> limb_names;
      for (const int joint : limb) {
        limb_names.push_back("limb " + std::to_string(joint));
        old_named.nodes[static_cast<std::size_t>(joint)].name = limb_names.back();
        new_named.nodes[static_cast<std::size_t>(joint)].name = limb_names.back();
      }
      const auto faults = judge::joints_outside_limb_bit_identical(
          old_named, new_named, old_animation, animation, limb_names);
      EXPECT_TRUE(faults.empty()) << faults.front();
      const auto outside = judge::outside_window(old_named, new_named, old_animation, animation,
                                                 limb_names, begin, end);
      EXPECT_LT(outside.difference, 1e-6);
      EXPECT_TRUE(outside.lost_keys.empty()) << outside.lost_keys.front();
      EXPECT_LT(judge::border_difference(old_named, new_named, old_animation, animation, limb_names,
                                         begin, end),
                1e-6);

      // The product reads it as it was meant.
      const auto again = read_gltf(out, options);
      ASSERT_TRUE(again.ok()) << again.error().message();
      ASSERT_EQ((*again)->clips.size(), clips.size() + 1);
      const Clip& read = (*again)->clips.back();
      EXPECT_EQ(read.name, animation);
      for (const Channel& channel : changed) {
        const int at = read.find_channel(channel.joint, Path::rotation);
        ASSERT_GE(at, 0);
        EXPECT_EQ(read.channels[static_cast<std::size_t>(at)].times, channel.times);
        EXPECT_EQ(read.channels[static_cast<std::size_t>(at)].values, channel.values);
      }
    }
  }
  EXPECT_GT(exported, 0);
  RecordProperty("exported", exported);
  std::cout << exported << " exports; channels: " << kinds[Interpolation::linear] << " linear, "
            << kinds[Interpolation::cubic_spline] << " cubic\n";

  if (!std::getenv("ELBOWROOM_GLTF_VALIDATOR")) {
    GTEST_SKIP()
        << "all but the validator passed: set ELBOWROOM_GLTF_VALIDATOR to the node_modules "
           "folder that has gltf-validator";
  }
  const auto codes = validate(to_validate);
  ASSERT_EQ(codes.size(), to_validate.size()) << "the validator did not run";
  for (std::size_t i = 0; i < codes.size(); i += 2) {
    const auto known = split(codes[i]);
    for (const std::string& code : split(codes[i + 1])) {
      EXPECT_TRUE(code == "-" || std::find(known.begin(), known.end(), code) != known.end())
          << to_validate[i] << " has not " << code << ", which its export "
          << to_validate[i + 1].filename() << " has";
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
