// SPDX-License-Identifier: MIT
// Who judges the judge: scenes and triangles whose verdict is known by construction.
#include "tests/judge/judge.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <random>

#include "tests/judge/judge_triangles.h"

namespace {

using glm::dvec3;
using judge::Corners;

// A .gltf of boxes: each a node with a mesh of 12 triangles, one animation that turns some.
class BoxFile {
 public:
  // Half extents and centre in the node's frame; extent 0 gives a node without a mesh.
  int node(const std::string& name, int parent, dvec3 translation, dvec3 half,
           dvec3 centre = dvec3(0)) {
    std::string text = "{\"name\":\"" + name + "\",\"translation\":" + list(translation);
    if (half.x > 0) {
      text += ",\"mesh\":" + std::to_string(meshes_.size());
      std::vector<float> points;
      for (int i = 0; i < 8; ++i) {
        for (int k = 0; k < 3; ++k) {
          points.push_back(static_cast<float>(centre[k] + (i >> k & 1 ? half[k] : -half[k])));
        }
      }
      const std::string positions = accessor(points, "VEC3", 3);
      // Counterclockwise from outside.
      static const std::vector<float> kCorners = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6,
                                                  0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7,
                                                  0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
      std::string indices_bytes;
      for (const float corner : kCorners) {
        const auto index = static_cast<std::uint16_t>(corner);
        indices_bytes.append(reinterpret_cast<const char*>(&index), 2);
      }
      const std::string indices = raw_accessor(indices_bytes, 5123, "SCALAR", kCorners.size());
      meshes_.push_back("{\"primitives\":[{\"attributes\":{\"POSITION\":" + positions +
                        "},\"indices\":" + indices + "}]}");
    }
    nodes_.push_back(text);
    children_.emplace_back();
    if (parent >= 0)
      children_[static_cast<std::size_t>(parent)].push_back(static_cast<int>(nodes_.size()) - 1);
    if (parent < 0) roots_.push_back(static_cast<int>(nodes_.size()) - 1);
    return static_cast<int>(nodes_.size()) - 1;
  }
  // Turns a node about z by `angle` at each time.
  void turn(int node, const std::vector<float>& times, const std::vector<double>& angles) {
    std::vector<float> values;
    for (const double a : angles) {
      values.insert(values.end(), {0, 0, static_cast<float>(std::sin(a / 2)),
                                   static_cast<float>(std::cos(a / 2))});
    }
    const std::string input = accessor(times, "SCALAR", 1), output = accessor(values, "VEC4", 4);
    channels_.push_back("{\"sampler\":" + std::to_string(samplers_.size()) +
                        ",\"target\":{\"node\":" + std::to_string(node) +
                        ",\"path\":\"rotation\"}}");
    samplers_.push_back("{\"input\":" + input + ",\"output\":" + output + "}");
  }
  void write(const std::filesystem::path& path) {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (!children_[i].empty()) nodes_[i] += ",\"children\":" + join(children_[i]);
      nodes_[i] += "}";
    }
    std::filesystem::path bin = path;
    bin.replace_extension(".bin");
    std::ofstream(bin, std::ios::binary) << bytes_;
    std::ofstream(path) << "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":"
                        << join(roots_) << "}],\"nodes\":" << join(nodes_)
                        << ",\"meshes\":" << join(meshes_) << ",\"accessors\":" << join(accessors_)
                        << ",\"bufferViews\":" << join(views_) << ",\"buffers\":[{\"uri\":\""
                        << bin.filename().string() << "\",\"byteLength\":" << bytes_.size() << "}]"
                        << (channels_.empty()
                                ? ""
                                : ",\"animations\":[{\"name\":\"move\",\"channels\":" +
                                      join(channels_) + ",\"samplers\":" + join(samplers_) + "}]")
                        << "}";
  }

 private:
  static std::string list(const dvec3& v) {
    return "[" + std::to_string(v.x) + "," + std::to_string(v.y) + "," + std::to_string(v.z) + "]";
  }
  static std::string text_of(const std::string& s) { return s; }
  static std::string text_of(int i) { return std::to_string(i); }
  template <typename T>
  static std::string join(const std::vector<T>& all) {
    std::string text = "[";
    for (const T& one : all) text += (text.size() > 1 ? "," : "") + text_of(one);
    return text + "]";
  }
  std::string raw_accessor(const std::string& bytes, int type, const char* shape,
                           std::size_t count) {
    views_.push_back("{\"buffer\":0,\"byteOffset\":" + std::to_string(bytes_.size()) +
                     ",\"byteLength\":" + std::to_string(bytes.size()) + "}");
    bytes_ += bytes;
    while (bytes_.size() % 4 != 0) bytes_ += '\0';
    accessors_.push_back("{\"bufferView\":" + std::to_string(views_.size() - 1) +
                         ",\"componentType\":" + std::to_string(type) +
                         ",\"count\":" + std::to_string(count) + ",\"type\":\"" + shape + "\"}");
    return std::to_string(accessors_.size() - 1);
  }
  std::string accessor(const std::vector<float>& values, const char* shape, int width) {
    std::string bytes(values.size() * 4, '\0');
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return raw_accessor(bytes, 5126, shape, values.size() / static_cast<std::size_t>(width));
  }

  std::string bytes_;
  std::vector<std::string> nodes_, meshes_, accessors_, views_, channels_, samplers_;
  std::vector<std::vector<int>> children_;
  std::vector<int> roots_;
};

class JudgeFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              ("judge-" + std::string(info->name()) + "-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_;
};

dvec3 random_point(std::mt19937_64& engine) {
  const auto coordinate = [&] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
  const double x = coordinate(), y = coordinate(), z = coordinate();
  return {x, y, z};
}

TEST(JudgeTriangles, KnowsCrossingTouchingAndFlatCases) {
  const Corners flat = {dvec3(0, 0, 0), dvec3(1, 0, 0), dvec3(0, 1, 0)};
  const auto meets = [&](dvec3 a, dvec3 b, dvec3 c) {
    const Corners other = {a, b, c};
    const bool one = judge::triangles_meet(flat, other), two = judge::triangles_meet(other, flat);
    EXPECT_EQ(one, two);
    return one;
  };
  EXPECT_TRUE(meets({0.2, 0.2, -1}, {0.2, 0.2, 1}, {2, 2, 1}));  // an edge goes through
  EXPECT_FALSE(meets({0.2, 0.2, 1e-9}, {0.4, 0.2, 1}, {0.2, 0.4, 1}));
  EXPECT_TRUE(meets({0.2, 0.2, 0}, {0.4, 0.2, 1}, {0.2, 0.4, 1}));   // a corner touches
  EXPECT_TRUE(meets({0.1, 0.1, 0}, {0.2, 0.1, 0}, {0.1, 0.2, 0}));   // in its plane, inside
  EXPECT_TRUE(meets({-1, 0.2, 0}, {2, 0.2, 0}, {2, 0.3, 0}));        // in its plane, across
  EXPECT_FALSE(meets({1.1, 1.1, 0}, {2, 1, 0}, {2, 2, 0}));          // in its plane, beside
  EXPECT_TRUE(meets({0.2, 0.2, -1}, {0.2, 0.2, 1}, {0.2, 0.2, 3}));  // a needle
  EXPECT_FALSE(meets({0.9, 0.9, -1}, {0.9, 0.9, 1}, {0.9, 0.9, 3}));
  EXPECT_TRUE(meets({0.2, 0.2, 0}, {0.2, 0.2, 0}, {0.2, 0.2, 0}));  // a point
  EXPECT_FALSE(meets({0.2, 0.2, 0.1}, {0.2, 0.2, 0.1}, {0.2, 0.2, 0.1}));
  const Corners needle = {dvec3(0, 0, 0), dvec3(1, 0, 0), dvec3(2, 0, 0)};
  EXPECT_TRUE(judge::triangles_meet(needle, {dvec3(1, -1, 0), dvec3(1, 1, 0), dvec3(1, 2, 0)}));
  EXPECT_FALSE(judge::triangles_meet(needle, {dvec3(3, -1, 0), dvec3(3, 1, 0), dvec3(3, 2, 0)}));
}

TEST(JudgeTriangles, FindsThroughBoxesWhatAllPairsFind) {
  std::mt19937_64 engine(7);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<dvec3> points;
    std::vector<glm::uvec3> triangles;
    for (unsigned i = 0; i < 100; ++i) {
      const dvec3 base = random_point(engine);
      for (int k = 0; k < 3; ++k) points.push_back(base + 0.1 * random_point(engine));
      triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    judge::BoxTree tree(triangles, points);
    judge::FclMesh fcl(triangles, points);
    for (dvec3& p : points) p = 0.5 * p + dvec3(0.1);
    tree.refit(points);
    fcl.refit(points);
    for (int query = 0; query < 50; ++query) {
      const dvec3 base = random_point(engine);
      const Corners c = {base, base + 0.2 * random_point(engine),
                         base + 0.2 * random_point(engine)};
      judge::Box box;
      for (const dvec3& p : c) box.add(p);
      std::vector<int> found, expected;
      const auto check = [&](int i, std::vector<int>& to) {
        const glm::uvec3& t = triangles[static_cast<std::size_t>(i)];
        if (judge::triangles_meet(c, {points[t[0]], points[t[1]], points[t[2]]})) to.push_back(i);
        return false;
      };
      tree.visit(box, [&](int i) { return check(i, found); });
      for (int i = 0; i < 100; ++i) check(i, expected);
      std::sort(found.begin(), found.end());
      EXPECT_EQ(found, expected);
      const judge::FclMesh other({glm::uvec3(0, 1, 2)}, {c[0], c[1], c[2]});
      EXPECT_EQ(fcl.collides(other), !expected.empty());
    }
  }
}

TEST(JudgeTriangles, CountsWindings) {
  const std::vector<dvec3> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<glm::uvec3> closed = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  EXPECT_NEAR(judge::winding_number(closed, points, {0.1, 0.1, 0.1}), 1, 1e-12);
  EXPECT_NEAR(judge::winding_number(closed, points, {0.9, 0.9, 0.9}), 0, 1e-12);
  int count = 0;
  judge::pieces(closed, points, count);
  EXPECT_EQ(count, 1);
}

// An arm of 1 m turns through a post at 90°: the samples that hit are known from the angle.
TEST_F(JudgeFiles, CountsTheSamplesInWhichAnArmMeetsAPost) {
  BoxFile figure;
  const int body = figure.node("body", -1, {0, 0, 0}, {0.2, 0.5, 0.2});
  const int arm = figure.node("arm", body, {0.25, 0, 0}, {0, 0, 0});
  figure.node("bone", arm, {0.5, 0, 0}, {0.45, 0.02, 0.02});
  figure.turn(arm, {0, 1}, {0, 1});
  figure.write(folder_ / "figure.gltf");
  BoxFile post;
  // At radius 0.8, direction 0.5 rad, 0.02 thin: met when the angle is within about ±0.05 of 0.5.
  post.node("post", -1, {0.25 + 0.8 * std::cos(0.5), 0.8 * std::sin(0.5), 0}, {0.01, 0.01, 1});
  post.write(folder_ / "post.gltf");
  BoxFile swinging;  // the same post, carried there by an animation only at the end
  const int pivot = swinging.node("pivot", -1, {0.25, 0, 0}, {0, 0, 0});
  swinging.node("post", pivot, {0.8, 0, 0}, {0.01, 0.01, 1});
  swinging.turn(pivot, {0, 1}, {-1, 1});
  swinging.write(folder_ / "swinging.gltf");

  judge::CollisionQuery query;
  query.character = folder_ / "figure.gltf";
  query.limb_roots = {"arm"};
  query.obstacles = {folder_ / "post.gltf"};
  const judge::File file = judge::load(query.character);
  query.times = judge::verification_times(file, "move", query.limb_roots, 0, 1, 240, 200);
  EXPECT_GE(query.times.size(), 440u);
  const judge::CollisionReport report = judge::count_intersecting_samples(query);
  EXPECT_EQ(report.samples, static_cast<int>(query.times.size()));
  EXPECT_EQ(report.limb_triangles, 12);
  EXPECT_EQ(report.body_triangles, 12);
  EXPECT_EQ(report.fcl_disagreements, 0);
  EXPECT_EQ(report.contained_samples, 0);
  int expected = 0;
  for (const double t : query.times) {
    // Slerp turns evenly: the angle is t. The post's corners in the arm's frame decide.
    bool meets = false, left = false, right = false;
    for (int i = 0; i < 4; ++i) {
      const double x = 0.8 * std::cos(0.5) + (i & 1 ? 0.01 : -0.01),
                   y = 0.8 * std::sin(0.5) + (i & 2 ? 0.01 : -0.01);
      const double across = std::cos(t) * y - std::sin(t) * x;
      meets = meets || std::fabs(across) <= 0.02;
      left = left || across > 0.02;
      right = right || across < -0.02;
    }
    if (meets || (left && right)) ++expected;
  }
  EXPECT_GT(expected, 20);
  EXPECT_NEAR(report.obstacle_samples, expected, 1);
  ASSERT_FALSE(report.hits.empty());
  EXPECT_EQ(report.hits.front().mover, "bone");
  EXPECT_EQ(report.hits.front().other, "post.gltf / post");

  query.obstacles = {folder_ / "swinging.gltf"};
  const judge::CollisionReport moving = judge::count_intersecting_samples(query);
  // The post's angle 2t-1 meets the arm's t only near t = 1.
  EXPECT_GT(moving.obstacle_samples, 5);
  for (const judge::Hit& hit : moving.hits) EXPECT_GT(hit.time, 0.9);
  EXPECT_EQ(moving.fcl_disagreements, 0);
}

TEST_F(JudgeFiles, SeesWhatLiesInsideAndWhatIsCarried) {
  BoxFile figure;
  const int body = figure.node("body", -1, {0, 0, 0}, {0.2, 0.5, 0.2});
  const int arm = figure.node("arm", body, {0.5, 0, 0}, {0, 0, 0});
  figure.node("hand", arm, {0.5, 0, 0}, {0.1, 0.1, 0.1});
  figure.turn(arm, {0, 1}, {0, 3});
  figure.write(folder_ / "figure.gltf");
  const auto box = [&](const char* name, dvec3 at, double half) {
    BoxFile file;
    file.node(name, -1, at, dvec3(half));
    file.write(folder_ / (std::string(name) + ".gltf"));
  };
  box("pearl", {1, 0, 0}, 0.01);  // inside the hand at t = 0
  box("hall", {1, 0, 0}, 0.4);    // holds the hand at t = 0
  box("stick", {0, 0, 0}, 0.05);
  judge::CollisionQuery query;
  query.character = folder_ / "figure.gltf";
  query.limb_roots = {"arm"};
  query.times = {0};
  query.obstacles = {folder_ / "pearl.gltf"};
  EXPECT_EQ(judge::count_intersecting_samples(query).contained_samples, 1);
  query.obstacles = {folder_ / "hall.gltf"};
  EXPECT_EQ(judge::count_intersecting_samples(query).contained_samples, 1);
  EXPECT_EQ(judge::count_intersecting_samples(query).obstacle_samples, 0);

  // What the hand carries meets the body once the arm points back at it (t = 1, angle 3).
  query.obstacles.clear();
  query.times = {0, 1};
  EXPECT_EQ(judge::count_intersecting_samples(query).body_samples, 0);
  query.attachments = {{folder_ / "stick.gltf", "hand", dvec3(-0.2, 0, 0)}};
  const auto carried = judge::count_intersecting_samples(query);
  EXPECT_EQ(carried.body_samples, 1);
  ASSERT_EQ(carried.hits.size(), 1u);
  EXPECT_EQ(carried.hits[0].mover, "stick.gltf");
  EXPECT_EQ(carried.hits[0].time, 1);
  // Known from the source, so natural.
  query.source_animation = "move";
  EXPECT_EQ(judge::count_intersecting_samples(query).body_samples, 0);
  EXPECT_EQ(judge::count_intersecting_samples(query).body_samples_all, 1);
}

TEST_F(JudgeFiles, TellsWhatChangedBetweenTwoFiles) {
  BoxFile first;
  const int body = first.node("body", -1, {0, 0, 0}, {0.2, 0.5, 0.2});
  const int arm = first.node("arm", body, {0.5, 0, 0}, {0.1, 0.1, 0.1});
  BoxFile second = first;
  first.turn(body, {0, 1, 2}, {0, 1, 0});
  second.turn(body, {0, 1, 2}, {0, 1, 0.001});
  first.turn(arm, {0, 1, 2, 3}, {0, 1, 0, 1});
  second.turn(arm, {0, 1, 2, 3}, {0, 1.1, 0, 1});
  first.write(folder_ / "a.gltf");
  second.write(folder_ / "b.gltf");
  const judge::File a = judge::load(folder_ / "a.gltf"), b = judge::load(folder_ / "b.gltf");
  EXPECT_TRUE(judge::joints_outside_limb_bit_identical(a, a, "move", "move", {"arm"}).empty());
  EXPECT_EQ(judge::joints_outside_limb_bit_identical(a, b, "move", "0", {"arm"}).size(), 1u);
  EXPECT_TRUE(judge::joints_outside_limb_bit_identical(a, b, "move", "0", {"arm", "body"}).empty());

  // The arm differs from 0 to 2, most at 1.
  const auto outside = judge::outside_window(a, b, "move", "move", {"arm"}, 0.f, 2.f);
  EXPECT_LT(outside.difference, 1e-7);
  EXPECT_TRUE(outside.lost_keys.empty());
  const auto narrow = judge::outside_window(a, b, "move", "move", {"arm"}, 1.25f, 2.f);
  EXPECT_NEAR(narrow.difference, 0.1, 1e-6);
  EXPECT_EQ(narrow.lost_keys.size(), 1u);
  EXPECT_NEAR(judge::border_difference(a, b, "move", "move", {"arm"}, 0.5f, 2.f), 0.05, 1e-6);

  const auto figures = judge::curve_figures(a, "move", {"arm"}, 0.5, 1.5, 0.01);
  EXPECT_NEAR(figures.peak_speed, 1, 1e-6);
  EXPECT_NEAR(figures.velocity_jump, 2, 0.1);  // the corner at 1 s
  EXPECT_TRUE(judge::key_faults(a, "move").empty());

  const auto bytes = judge::compare_bytes(a, b);
  EXPECT_FALSE(bytes.buffers_are_prefixes);
  EXPECT_EQ(bytes.json_differences.size(), 1u);  // the buffer's name
  EXPECT_TRUE(judge::compare_bytes(a, a).buffers_are_prefixes);
  EXPECT_TRUE(judge::compare_bytes(a, a).json_differences.empty());
}

// What it is worth hangs on this.
TEST(JudgeItself, SharesNoCodeWithTheProduct) {
  int files = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(ELBOWROOM_SOURCE_DIR "/tests/judge")) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".h" && extension != ".cpp") continue;
    ++files;
    std::ifstream in(entry.path());
    for (std::string line; std::getline(in, line);) {
      if (line.compare(0, 10, "#include \"") != 0) continue;
      EXPECT_EQ(line.compare(10, 12, "tests/judge/"), 0) << entry.path() << ": " << line;
    }
  }
  EXPECT_GE(files, 8);
}

TEST(JudgeBytes, SeesEveryChangeOfAValue) {
  judge::File a, b;
  a.json = R"({"asset":{"version":"2.0","generator":"x"},"n":1.0,"e":[],"o":{"k":1},
               "buffers":[{"byteLength":4}],"accessors":[{"count":1}]})";
  b.json = R"({"asset":{"version":"2.0","generator":"y"},"n":1.0,"e":[],"o":{"k":1},
               "buffers":[{"byteLength":8}],"accessors":[{"count":1},{"count":2}],"animations":[{}]})";
  EXPECT_TRUE(judge::compare_bytes(a, b).json_differences.empty());
  const auto differs = [&](const std::string& from, const std::string& to) {
    judge::File c = b;
    c.json.replace(c.json.find(from), from.size(), to);
    return judge::compare_bytes(a, c).json_differences.size();
  };
  EXPECT_EQ(differs("1.0,", "1,"), 1u);
  EXPECT_EQ(differs("[]", "{}"), 1u);
  EXPECT_EQ(differs(",\"e\":[]", ""), 1u);
  EXPECT_EQ(differs("{\"k\":1}", "{\"k\":1,\"l\":null}"), 1u);
  EXPECT_EQ(differs("{\"count\":1}", "{\"count\":3}"), 1u);
  EXPECT_EQ(differs("\"k\":1", "\"k\":2,\"k\":1"), 0u);  // of two keys the last counts
}

}  // namespace
