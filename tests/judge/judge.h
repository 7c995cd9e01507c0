// SPDX-License-Identifier: MIT
// The independent judge: takes exported files and says whether they hold what the project promises
// of a result (intersections, untouched joints, borders, the curve, bytes). It shares no code with
// the product: own reader, own sampling, own skinning; FCL and CGAL for intersections.
//
//   judge::CollisionQuery query;
//   query.character = "out.glb";
//   query.animation = "Walk (corrected)";           // name, or index as text
//   query.limb_roots = {"upperarm.l"};              // the limb is all below these nodes
//   query.obstacles = {"post.glb"};                 // each moves by its own first animation
//   query.attachments = {{"umbrella.glb", "handslot.l"}};
//   const auto file = judge::load(query.character);
//   query.times = judge::verification_times(file, query.animation, query.limb_roots, 0.5, 1.2);
//   query.source_animation = "Walk";                // whose self contacts are known and allowed
//   const judge::CollisionReport report = judge::count_intersecting_samples(query);
//   EXPECT_EQ(report.obstacle_samples, 0);
//   EXPECT_EQ(report.contained_samples, 0);
//   EXPECT_EQ(report.body_samples, 0);
//
// Wrong files and names throw std::runtime_error. Deterministic. Some milliseconds a sample.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/judge/judge_file.h"
#include "tests/judge/judge_motion.h"

namespace judge {

// An object in a hand: placed in the joint's rigid frame (its scale, shear and mirror taken out).
struct Attached {
  std::filesystem::path file;
  std::string joint;
  glm::dvec3 offset{0.0};
  glm::dquat turn{1, 0, 0, 0};
};

struct CollisionQuery {
  std::filesystem::path character;
  std::string animation = "0";
  std::vector<std::string> limb_roots;  // topmost joints of the limb
  std::vector<std::string> limb_parts;  // and what is of it but hangs from elsewhere in the tree
  std::vector<std::filesystem::path> obstacles;
  std::vector<Attached> attachments;
  std::vector<double> times;  // seconds on the animation's clock
  bool check_body = true;     // limb against the character's own body
  bool with_fcl = true;       // let FCL say it too, and count where it differs
  // Self contacts that are natural: triangles within this distance (times the figure's height, in
  // the rest pose) along the surface of the border between limb and body, or of the limb's root
  // joint, ...
  double seam_radius = 0.08;
  // ... and the surroundings of triangles that touch in the file's rest pose or, if named, at 240
  // Hz in this animation.
  std::string source_animation;
  std::size_t max_hits = 200;
};

struct Hit {
  enum class Kind { obstacle, contained, body } kind = Kind::obstacle;
  double time = 0;
  std::string mover;  // node of the limb, or file of what it carries
  std::string other;  // file and node
};

struct CollisionReport {
  int samples = 0;
  int obstacle_samples = 0;   // the limb, or what it carries, crosses or touches an obstacle
  int contained_samples = 0;  // without crossing one lies wholly inside the other
  int body_samples = 0;  // limb (or carried) against the rest of the figure, natural ones excepted
  int body_samples_all = 0;  // the same, excepting only triangles that share a corner
  int limb_triangles = 0, body_triangles = 0, obstacle_triangles = 0;
  long fcl_disagreements = 0;  // pairs of meshes and samples where FCL says otherwise
  std::vector<Hit> hits;       // at most max_hits, in order of time
};

// At how many of the query's times the limb meets what. The limb are the triangles whose weight
// mostly follows a joint at or below limb_roots or limb_parts, and the objects attached there.
CollisionReport count_intersecting_samples(const CollisionQuery& query);

// Where a result is looked at: `hz` regular samples a second from begin to end (both included),
// every key the animation has there below the limb's roots, and `random` further times.
std::vector<double> verification_times(const File& file, const std::string& animation,
                                       const std::vector<std::string>& limb_roots, double begin,
                                       double end, double hz = 240, int random = 1000,
                                       unsigned seed = 1);

// Channels of `source_animation` in `source` whose node is none of `limb_joints` (names, the
// topmost first) are in `animation` of `output` bit for bit, and nothing else moves there; of the
// limb's joints only rotations change, and translations of those that hang from elsewhere in the
// tree. Empty, or what differs.
std::vector<std::string> joints_outside_limb_bit_identical(
    const File& source, const File& output, const std::string& source_animation,
    const std::string& animation, const std::vector<std::string>& limb_joints);

struct OutsideReport {
  double difference = 0;  // largest angle between the two, radians, 1 s beyond the clip too
  double shift = 0;       // of translations, as a share of the longest of that joint
  std::vector<std::string> lost_keys;  // source keys outside the window whose bits are not kept
};
// The limb's rotations and translations outside [begin, end], at float32 times, both ends included.
OutsideReport outside_window(const File& source, const File& output,
                             const std::string& source_animation, const std::string& animation,
                             const std::vector<std::string>& limb_joints, float begin, float end);

// Largest angle between the two animations at the window's borders, radians.
double border_difference(const File& source, const File& output,
                         const std::string& source_animation, const std::string& animation,
                         const std::vector<std::string>& limb_joints, float begin, float end);

// What the keys of a joint's rotation come to as a curve, by finite differences of `step` seconds.
struct CurveFigures {
  double peak_speed = 0;         // rad/s
  double peak_acceleration = 0;  // rad/s²
  double velocity_jump = 0;  // rad/s, largest change of the angular velocity between neighbouring
                             // steps; for a C1 curve it shrinks with `step`
};
CurveFigures curve_figures(const File& file, const std::string& animation,
                           const std::vector<std::string>& limb_joints, double begin, double end,
                           double step = 1.0 / 240);

// How well `joint` keeps the relation that it has to `served` in the source: the largest distance
// of its origin from where it would be then (world units), and angle, at the times given.
struct FollowReport {
  double distance = 0, angle = 0;
};
FollowReport follows(const File& source, const File& output, const std::string& source_animation,
                     const std::string& animation, const std::string& joint,
                     const std::string& served, const std::vector<double>& times);

// Formal faults of an animation: times that do not increase, quaternions that are not unit or
// change sign from key to key (LINEAR), values that are not finite.
std::vector<std::string> key_faults(const File& file, const std::string& animation);

struct ByteReport {
  bool buffers_are_prefixes = false;          // every buffer of the source begins the output's
  std::vector<std::string> json_differences;  // beyond byteLength, appended entries, generator;
                                              // "pointer: old -> new", numbers by their text
};
ByteReport compare_bytes(const File& source, const File& output);

}  // namespace judge
