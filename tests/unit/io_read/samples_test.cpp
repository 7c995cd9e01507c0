// SPDX-License-Identifier: MIT
// The reader against real files, good and bad.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

#include "core/io/gltf_reader.h"
#include "tests/support/samples.h"
#include "tests/unit/io_read/model_checks.h"
#include "tests/unit/io_read/sample_index.h"

namespace elbowroom {
namespace {

namespace fs = std::filesystem;

using test::expect_sound;
using test::joints_of;
using test::triangles_of;

TEST(Samples, OpenWithTheNumbersOfTheIndex) {
  const fs::path samples = test::samples_dir();
  if (samples.empty()) GTEST_SKIP() << test::samples_missing();
  const std::vector<test::SampleFacts> index = test::read_sample_index(samples);
  int with_triangles = 0, with_joints = 0, with_clips = 0;
  for (const test::SampleFacts& facts : index) {
    with_triangles += facts.triangles.has_value();
    with_joints += facts.joints.has_value();
    with_clips += facts.clips.has_value();
  }
  ASSERT_GT(std::min({with_triangles, with_joints, with_clips}), 50)
      << "the index was not understood";
  for (const test::SampleFacts& facts : index) {
    SCOPED_TRACE(facts.file);
    const auto model = read_gltf(samples / facts.file);
    if (facts.compressed) {
      ASSERT_FALSE(model.ok());
      EXPECT_NE(model.error().what.find("compression"), std::string::npos);
      EXPECT_FALSE(model.error().remedy.empty());
      continue;
    }
    EXPECT_TRUE(model.ok()) << model.error().message();
    if (!model.ok()) continue;
    if (facts.triangles) {
      EXPECT_EQ(triangles_of(**model), *facts.triangles);
    }
    if (facts.joints) {
      EXPECT_EQ(joints_of(**model), *facts.joints);
    }
    if (facts.clips) {
      EXPECT_EQ(static_cast<int>((*model)->clips.size()), *facts.clips);
    }
    expect_sound(**model);
  }
}

// Also what the index doesn't list under a heading of its own.
TEST(Samples, AllOpenButThoseThatNeedAnUnpacker) {
  const fs::path samples = test::samples_dir();
  if (samples.empty()) GTEST_SKIP() << test::samples_missing();
  int opened = 0;
  for (const fs::path& file : test::gltf_files(samples)) {
    if (file.string().find("/malformed/") != std::string::npos) continue;
    SCOPED_TRACE(file.string());
    const auto model = read_gltf(file);
    if (!model.ok()) {
      EXPECT_NE(model.error().what.find("_compression"), std::string::npos)
          << model.error().message();
      EXPECT_NE(model.error().remedy.find("gltf-transform"), std::string::npos);
      continue;
    }
    ++opened;
    expect_sound(**model);
  }
  EXPECT_GT(opened, 0);
}

// A malformed file gives a Model that keeps its promises or an error that names the file; in little
// time, and nothing outside the file's folder is opened.
TEST(MalformedSamples, GiveASoundModelOrAnError) {
  const fs::path samples = test::samples_dir();
  if (samples.empty()) GTEST_SKIP() << test::samples_missing();
  int refused = 0;
  for (const fs::path& file : test::gltf_files(samples / "malformed")) {
    SCOPED_TRACE(file.string());
    const fs::path folder = fs::canonical(file.parent_path());
    ReadOptions options;
    options.on_open = [&](const fs::path& opened) {
      const fs::path real = fs::canonical(opened);
      EXPECT_EQ(real.string().rfind(folder.string() + "/", 0), 0u) << "opened " << real;
    };
    const auto begin = std::chrono::steady_clock::now();
    const auto model = read_gltf(file, options);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    EXPECT_LT(took.count(), 5.0);
    if (model.ok()) {
      expect_sound(**model);
      continue;
    }
    ++refused;
    EXPECT_FALSE(model.error().what.empty());
    EXPECT_FALSE(model.error().remedy.empty());
    EXPECT_NE(model.error().where.find(file.filename().string()), std::string::npos)
        << model.error().message();
  }
  EXPECT_GT(refused, 50);
}

}  // namespace
}  // namespace elbowroom
