// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <set>

#include "tests/judge/judge.h"

namespace judge {
namespace {

// Nodes of that name; there may be several.
std::set<int> nodes_named(const File& file, const std::vector<std::string>& names) {
  std::set<int> found;
  for (const std::string& name : names) {
    bool any = false;
    for (std::size_t i = 0; i < file.nodes.size(); ++i) {
      if (file.nodes[i].name == name) {
        found.insert(static_cast<int>(i));
        any = true;
      }
    }
    if (!any) file.node(name);  // throws
  }
  return found;
}

const KeyChannel* channel_of(const KeyAnimation& animation, int node, const std::string& path) {
  for (const KeyChannel& channel : animation.channels) {
    if (channel.node == node && channel.path == path) return &channel;
  }
  return nullptr;
}

std::string label(const File& file, const KeyChannel& channel) {
  return "node " + std::to_string(channel.node) + " " +
         file.nodes[static_cast<std::size_t>(channel.node)].name + " " + channel.path;
}

glm::dvec3 translation_at(const File& file, const KeyAnimation& animation, int node, double t) {
  const KeyChannel* channel = channel_of(animation, node, "translation");
  if (!channel) return file.nodes[static_cast<std::size_t>(node)].translation;
  const std::vector<double> v = sample(*channel, t);
  return glm::dvec3(v[0], v[1], v[2]);
}

glm::dvec3 angular_velocity(const glm::dquat& a, const glm::dquat& b, double seconds) {
  glm::dquat d = glm::conjugate(a) * b;
  if (d.w < 0) d = -d;
  const glm::dvec3 v(d.x, d.y, d.z);
  const double sine = glm::length(v);
  if (sine < 1e-14) return 2.0 * v / seconds;
  return v * (2 * std::atan2(sine, d.w) / sine / seconds);
}

}  // namespace

std::vector<double> verification_times(const File& file, const std::string& animation,
                                       const std::vector<std::string>& limb_roots, double begin,
                                       double end, double hz, int random, unsigned seed) {
  std::set<double> times{begin, end};
  const long first = static_cast<long>(std::ceil(begin * hz));
  for (long i = first; i / hz <= end; ++i) {
    if (i / hz >= begin) times.insert(i / hz);
  }
  std::vector<int> roots;
  for (const std::string& name : limb_roots) roots.push_back(file.node(name));
  for (const KeyChannel& channel : file.animation(animation).channels) {
    if (std::none_of(roots.begin(), roots.end(),
                     [&](int root) { return file.is_within(channel.node, root); })) {
      continue;
    }
    for (const float t : channel.times) {
      if (t >= begin && t <= end) times.insert(t);
    }
  }
  std::uint64_t state = seed;
  for (int i = 0; i < random; ++i) {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    times.insert(begin + (end - begin) * static_cast<double>(state >> 11) * 0x1p-53);
  }
  return {times.begin(), times.end()};
}

std::vector<std::string> joints_outside_limb_bit_identical(
    const File& source, const File& output, const std::string& source_animation,
    const std::string& animation, const std::vector<std::string>& limb_joints) {
  std::vector<std::string> faults;
  const KeyAnimation& old = source.animation(source_animation);
  const KeyAnimation& fresh = output.animation(animation);
  const std::set<int> limb = nodes_named(source, limb_joints);
  const int top = limb_joints.empty() ? -1 : source.node(limb_joints.front());
  // Only rotations of the limb's own joints may change, and what a joint that does not hang from it
  // needs to come along.
  const auto may_change = [&](const KeyChannel& channel) {
    if (!limb.count(channel.node)) return false;
    return channel.path == "rotation" ||
           (channel.path == "translation" && !source.is_within(channel.node, top));
  };
  for (const KeyChannel& channel : old.channels) {
    if (may_change(channel)) continue;
    const KeyChannel* same = channel_of(fresh, channel.node, channel.path);
    if (!same) {
      faults.push_back(label(source, channel) + ": lost");
    } else if (same->interpolation != channel.interpolation ||
               same->raw_times != channel.raw_times || same->raw_values != channel.raw_values) {
      faults.push_back(label(source, channel) + ": keys differ");
    }
  }
  for (const KeyChannel& channel : fresh.channels) {
    if (may_change(channel)) continue;
    if (!channel_of(old, channel.node, channel.path)) {
      faults.push_back(label(output, channel) + ": was not animated before");
    }
  }
  if (source.nodes.size() != output.nodes.size()) {
    faults.push_back("the number of nodes differs");
    return faults;
  }
  for (std::size_t i = 0; i < source.nodes.size(); ++i) {
    const Node &a = source.nodes[i], &b = output.nodes[i];
    if (a.parent != b.parent || a.translation != b.translation || a.rotation != b.rotation ||
        a.scale != b.scale || a.matrix != b.matrix || a.mesh != b.mesh || a.skin != b.skin) {
      faults.push_back("node " + std::to_string(i) + ": its rest differs");
    }
  }
  return faults;
}

OutsideReport outside_window(const File& source, const File& output,
                             const std::string& source_animation, const std::string& animation,
                             const std::vector<std::string>& limb_joints, float begin, float end) {
  OutsideReport report;
  const KeyAnimation& old = source.animation(source_animation);
  const KeyAnimation& fresh = output.animation(animation);
  const double first = std::fmin(old.begin, begin) - 1, last = std::fmax(old.end, end) + 1;
  std::vector<float> times;
  const auto add = [&](double t) {
    const float f = static_cast<float>(t);
    if (f <= begin || f >= end) times.push_back(f);
  };
  for (int i = 0; i <= 2000; ++i) {
    add(first + (begin - first) * i / 2000);
    add(end + (last - end) * i / 2000);
  }
  for (const int node : nodes_named(source, limb_joints)) {
    const KeyChannel* before = channel_of(old, node, "rotation");
    const KeyChannel* after = channel_of(fresh, node, "rotation");
    std::vector<float> all = times;
    for (const KeyChannel* channel : {before, after}) {
      if (!channel) continue;
      for (const float t : channel->times) {
        for (const float side : {std::nextafterf(t, -1e30f), t, std::nextafterf(t, 1e30f)})
          add(side);
      }
    }
    all.insert(all.end(), times.begin(), times.end());
    for (const float t : all) {
      report.difference = std::fmax(report.difference, angle(rotation_at(source, old, node, t),
                                                             rotation_at(output, fresh, node, t)));
    }
    double shift = 0, longest = 0;
    for (const float t : all) {
      const glm::dvec3 was = translation_at(source, old, node, t);
      shift = std::fmax(shift, glm::distance(was, translation_at(output, fresh, node, t)));
      longest = std::fmax(longest, glm::length(was));
    }
    if (shift > 0) report.shift = std::fmax(report.shift, shift / std::fmax(longest, 1e-300));
    if (!before || !after) continue;
    const auto float_value = [](const KeyChannel& channel, std::size_t key, std::size_t k) {
      const bool cubic = channel.interpolation == "CUBICSPLINE";
      return static_cast<float>(channel.values[4 * (cubic ? 3 * key + 1 : key) + k]);
    };
    for (std::size_t i = 0; i < before->times.size(); ++i) {
      const float t = before->times[i];
      if (t >= begin && t <= end) continue;
      const auto at = std::lower_bound(after->times.begin(), after->times.end(), t);
      bool kept = at != after->times.end() && *at == t;
      for (std::size_t k = 0; k < 4 && kept; ++k) {
        kept = float_value(*before, i, k) ==
               float_value(*after, static_cast<std::size_t>(at - after->times.begin()), k);
      }
      if (!kept) report.lost_keys.push_back(label(source, *before) + " at " + std::to_string(t));
    }
  }
  return report;
}

double border_difference(const File& source, const File& output,
                         const std::string& source_animation, const std::string& animation,
                         const std::vector<std::string>& limb_joints, float begin, float end) {
  double worst = 0;
  for (const int node : nodes_named(source, limb_joints)) {
    for (const double t : {static_cast<double>(begin), static_cast<double>(end)}) {
      worst =
          std::fmax(worst, angle(rotation_at(source, source.animation(source_animation), node, t),
                                 rotation_at(output, output.animation(animation), node, t)));
    }
  }
  return worst;
}

FollowReport follows(const File& source, const File& output, const std::string& source_animation,
                     const std::string& animation, const std::string& joint,
                     const std::string& served, const std::vector<double>& times) {
  FollowReport report;
  const auto of = [](const File& file, const State& state, const std::string& name) {
    return state.world[static_cast<std::size_t>(file.node(name))];
  };
  const glm::dmat4 here(1.0);
  for (const double t : times) {
    const State was = state_at(source, &source.animation(source_animation), t, here);
    const State is = state_at(output, &output.animation(animation), t, here);
    const glm::dmat4 wanted =
        of(output, is, served) * glm::inverse(of(source, was, served)) * of(source, was, joint);
    const glm::dmat4 shown = of(output, is, joint);
    report.distance = std::fmax(report.distance, glm::length(glm::dvec3(wanted[3] - shown[3])));
    report.angle = std::fmax(report.angle, angle(glm::quat_cast(glm::dmat3(rigid_frame(wanted))),
                                                 glm::quat_cast(glm::dmat3(rigid_frame(shown)))));
  }
  return report;
}

CurveFigures curve_figures(const File& file, const std::string& animation,
                           const std::vector<std::string>& limb_joints, double begin, double end,
                           double step) {
  CurveFigures figures;
  const KeyAnimation& keys = file.animation(animation);
  const int count = std::max(1, static_cast<int>(std::ceil((end - begin) / step)));
  for (const int node : nodes_named(file, limb_joints)) {
    // One step beyond each end, so that the borders count.
    glm::dquat last = rotation_at(file, keys, node, begin - step);
    glm::dvec3 velocity(0.0);
    for (int i = 0; i <= count + 1; ++i) {
      const glm::dquat q = rotation_at(file, keys, node, begin + i * step);
      const glm::dvec3 now = angular_velocity(last, q, step);
      figures.peak_speed = std::fmax(figures.peak_speed, glm::length(now));
      if (i > 0) {
        const double jump = glm::length(now - velocity);
        figures.velocity_jump = std::fmax(figures.velocity_jump, jump);
        figures.peak_acceleration = std::fmax(figures.peak_acceleration, jump / step);
      }
      velocity = now;
      last = q;
    }
  }
  return figures;
}

std::vector<std::string> key_faults(const File& file, const std::string& animation) {
  std::vector<std::string> faults;
  for (const KeyChannel& channel : file.animation(animation).channels) {
    const auto fault = [&](const std::string& what, std::size_t key) {
      faults.push_back(label(file, channel) + ": " + what + " at key " + std::to_string(key));
    };
    const bool cubic = channel.interpolation == "CUBICSPLINE";
    for (std::size_t i = 0; i < channel.times.size(); ++i) {
      if (!std::isfinite(channel.times[i])) fault("time not finite", i);
      if (i > 0 && !(channel.times[i] > channel.times[i - 1])) fault("time does not increase", i);
    }
    for (std::size_t i = 0; i < channel.values.size(); ++i) {
      if (!std::isfinite(channel.values[i])) fault("value not finite, number", i);
    }
    if (channel.path != "rotation" || channel.components != 4) continue;
    const auto value = [&](std::size_t key) {
      const double* v = channel.values.data() + 4 * (cubic ? 3 * key + 1 : key);
      return glm::dvec4(v[0], v[1], v[2], v[3]);
    };
    for (std::size_t i = 0; i < channel.times.size(); ++i) {
      if (std::fabs(glm::length(value(i)) - 1) > 1e-3) fault("quaternion not unit", i);
      // Of keys a float apart the sign may change: nothing falls between them.
      if (i > 0 && channel.times[i] > std::nextafterf(channel.times[i - 1], 1e30f) &&
          channel.interpolation != "STEP" && glm::dot(value(i), value(i - 1)) < 0) {
        fault("quaternion changes sign", i);
      }
    }
  }
  return faults;
}

}  // namespace judge
