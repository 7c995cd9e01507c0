// SPDX-License-Identifier: MIT
#include "tests/unit/rigs/skeleton_text.h"

#include <cstdio>
#include <cstdlib>
#include <sstream>

namespace elbowroom::test {
namespace {

struct Line {
  std::size_t depth = 0;
  std::string name;
  Vec3 offset{0.0};
  Carries carries = Carries::skin;
};

[[noreturn]] void fail(const std::string& line) {
  std::fprintf(stderr, "no line of a skeleton: \"%s\"\n", line.c_str());
  std::abort();
}

std::vector<Line> lines_of(const std::string& text) {
  std::vector<Line> lines;
  std::istringstream stream(text);
  std::string raw;
  while (std::getline(stream, raw)) {
    if (raw.find_first_not_of(' ') == std::string::npos) continue;
    const std::size_t equals = raw.rfind(" = ");
    if (equals == std::string::npos) fail(raw);
    Line line;
    while (raw[line.depth] == ' ') ++line.depth;
    if (line.depth <= equals) line.name = raw.substr(line.depth, equals - line.depth);
    std::istringstream rest(raw.substr(equals + 3));
    if (!(rest >> line.offset.x >> line.offset.y >> line.offset.z)) fail(raw);
    std::string mark;
    if (rest >> mark) {
      if (mark != "-" && mark != "~") fail(raw);
      line.carries = mark == "-" ? Carries::nothing : Carries::no_joint;
    }
    lines.push_back(line);
  }
  return lines;
}

class Reader {
 public:
  explicit Reader(const std::string& text) : lines_(lines_of(text)) {
    std::size_t at = 0;
    while (at < lines_.size()) at = add(at, -1, false, false);
  }
  std::vector<WrittenJoint> joints;

 private:
  // The line and all below it; the first line after them.
  std::size_t add(std::size_t at, int parent, bool doubled, bool right) {
    const Line& line = lines_[at];
    const bool splits = !doubled && line.name.find('{') != std::string::npos;
    std::size_t next = at;
    for (const bool of_right : {false, true}) {
      if (of_right && !splits) break;
      WrittenJoint joint;
      joint.name = sided(line.name, splits ? !of_right : !right);
      joint.parent = parent;
      Vec3 offset = line.offset;
      if (splits ? of_right : right) offset.x = -offset.x;
      joint.place =
          offset + (parent < 0 ? Vec3(0.0) : joints[static_cast<std::size_t>(parent)].place);
      joint.carries = line.carries;
      const auto own = static_cast<int>(joints.size());
      joints.push_back(joint);
      next = at + 1;
      while (next < lines_.size() && lines_[next].depth > line.depth) {
        next = add(next, own, doubled || splits, splits ? of_right : right);
      }
    }
    return next;
  }

  std::vector<Line> lines_;
};

}  // namespace

std::vector<WrittenJoint> read_skeleton(const std::string& text) { return Reader(text).joints; }

MadeRig rig_of(const std::vector<WrittenJoint>& written, const Placement& placement,
               bool nonsense_names) {
  std::vector<PlacedJoint> placed;
  for (const WrittenJoint& joint : written) {
    placed.push_back({joint.name, joint.parent + 1, joint.place, joint.carries});
  }
  return make_rig(placed, placement, nonsense_names);
}

}  // namespace elbowroom::test
