// SPDX-License-Identifier: MIT
// Holds a delivered correction against the whole table of results that a motion must meet, from the
// exported file alone and by the independent judge.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/anatomy/limb.h"
#include "tests/judge/judge.h"

namespace elbowroom::test {

struct Delivered {
  std::filesystem::path source, output;
  std::string source_animation;  // index as text, or name
  std::string animation;         // of the output
  std::vector<std::filesystem::path> obstacles;
  std::vector<judge::Attached> attachments;
  // One for each correction.
  struct Window {
    std::string limb_root;                 // node name
    std::vector<std::string> limb_joints;  // node names, root to end; then what follows the limb
    // from elsewhere in the tree, with the joint it serves.
    std::vector<std::pair<std::string, std::string>> following{};
    double follows_within = 0;  // scene units
    double begin = 0, end = 0;
  };
  std::vector<Window> windows;
  int random_times = 1000;
};

// What the limb is, for the judge.
inline Delivered::Window window_of(const Model& model, const Character& figure, const Limb& limb) {
  const auto name = [&](int joint) {
    return model.skeleton.joints[static_cast<std::size_t>(joint)].name;
  };
  Delivered::Window window;
  for (const int joint : limb.joints) window.limb_joints.push_back(name(joint));
  window.limb_root = window.limb_joints.front();
  for (const FollowingJoint& own : limb.following) {
    window.limb_joints.push_back(name(own.joint));
    window.following.emplace_back(name(own.joint), name(own.serves));
  }
  window.follows_within = 0.001 / 1.75 * figure.height;
  return window;
}

// Adds a failure for each promise that does not hold. Returns the number of samples looked at.
inline int expect_delivered(const Delivered& delivered) {
  const auto source = judge::load(delivered.source);
  const auto output = judge::load(delivered.output);
  int samples = 0;

  const auto bytes = judge::compare_bytes(source, output);
  EXPECT_TRUE(bytes.buffers_are_prefixes);
  for (const auto& difference : bytes.json_differences) ADD_FAILURE() << difference;
  // Keys that are kept bring their own faults along; none may be added.
  const auto faults = judge::key_faults(output, delivered.animation);
  EXPECT_LE(faults.size(), judge::key_faults(source, delivered.source_animation).size())
      << (faults.empty() ? std::string() : faults.front());

  std::vector<std::string> all_joints;
  for (const auto& window : delivered.windows)
    all_joints.insert(all_joints.end(), window.limb_joints.begin(), window.limb_joints.end());
  for (const auto& difference : judge::joints_outside_limb_bit_identical(
           source, output, delivered.source_animation, delivered.animation, all_joints))
    ADD_FAILURE() << difference;

  for (const auto& window : delivered.windows) {
    judge::CollisionQuery query;
    query.character = delivered.output;
    query.animation = delivered.animation;
    query.limb_roots = {window.limb_root};
    for (const auto& [joint, served] : window.following) query.limb_parts.push_back(joint);
    query.obstacles = delivered.obstacles;
    query.attachments = delivered.attachments;
    query.source_animation = delivered.source_animation;
    query.with_fcl = false;
    std::vector<std::string> keyed = query.limb_roots;
    keyed.insert(keyed.end(), query.limb_parts.begin(), query.limb_parts.end());
    query.times = judge::verification_times(output, delivered.animation, keyed, window.begin,
                                            window.end, 240, delivered.random_times);
    const auto report = judge::count_intersecting_samples(query);
    EXPECT_EQ(report.obstacle_samples, 0);
    EXPECT_EQ(report.contained_samples, 0);
    EXPECT_EQ(report.body_samples, 0);
    EXPECT_GT(report.limb_triangles, 0);
    for (std::size_t i = 0; i < report.hits.size() && i < 5; ++i)
      ADD_FAILURE() << report.hits[i].mover << " meets " << report.hits[i].other << " at "
                    << report.hits[i].time << " s";
    samples += report.samples;

    for (const auto& [joint, served] : window.following) {
      const auto follows = judge::follows(source, output, delivered.source_animation,
                                          delivered.animation, joint, served, query.times);
      EXPECT_LT(follows.distance, window.follows_within) << joint << " leaves " << served;
      EXPECT_LT(follows.angle, 0.01) << joint << " turns from " << served;
    }

    const auto begin = static_cast<float>(window.begin), end = static_cast<float>(window.end);
    EXPECT_LT(judge::border_difference(source, output, delivered.source_animation,
                                       delivered.animation, window.limb_joints, begin, end),
              1e-4);
    // Several windows of one limb: what lies outside one may be inside another.
    if (delivered.windows.size() == 1) {
      const auto outside =
          judge::outside_window(source, output, delivered.source_animation, delivered.animation,
                                window.limb_joints, begin, end);
      EXPECT_LT(outside.difference, 1e-6);
      EXPECT_LT(outside.shift, 1e-6);
      for (const auto& key : outside.lost_keys) ADD_FAILURE() << key;
    }
  }
  return samples;
}

}  // namespace elbowroom::test
