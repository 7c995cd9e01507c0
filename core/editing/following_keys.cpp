// SPDX-License-Identifier: MIT
#include "core/editing/following_keys.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/anatomy/following.h"
#include "core/editing/correct.h"

namespace elbowroom {
namespace {

constexpr double kLeastInterval = 1.0 / 2000;  // s, which is not divided further
constexpr double kApart = 1e-4;                // s; of keys nearer to each other one will do
constexpr double kReach = 0.3;                 // of the limb's length: what a turn is felt at

// The channels that move some nodes.
Clip channels_of(const Clip& clip, const std::set<int>& nodes) {
  Clip some = clip;
  std::erase_if(some.channels, [&](const Channel& channel) {
    return channel.path == Path::weights || !nodes.contains(channel.joint);
  });
  return some;
}

class Follower {
 public:
  Follower(const Model& model, const LimbModel& limb, const FollowingJoint& own, const Clip& source,
           const Clip& laid)
      : skeleton_(model.skeleton),
        own_(own),
        parent_(skeleton_.joints[static_cast<std::size_t>(own.joint)].parent),
        clip_pose_(rest_pose(skeleton_)),
        pose_(clip_pose_) {
    for (const int from : {own.joint, own.serves, limb.limb.end})
      for (int at = from; at >= 0; at = skeleton_.joints[static_cast<std::size_t>(at)].parent)
        nodes_.insert(at);
    source_ = channels_of(source, nodes_);
    laid_ = channels_of(laid, nodes_);
    sample_clip(source_, source.begin, clip_pose_);
    const auto place = [&](int joint) { return Vec3(global_of(skeleton_, clip_pose_, joint)[3]); };
    length_ = glm::distance(place(limb.limb.root), place(limb.limb.middle)) +
              glm::distance(place(limb.limb.middle), place(limb.limb.end));
  }

  JointKeys keys(const Correction& correction) {
    JointKeys result;
    result.node = own_.joint;
    result.joint = skeleton_.joints[static_cast<std::size_t>(own_.joint)].name;
    begin_ = correction.begin;
    end_ = correction.end;
    const std::vector<float> times = times_of();
    put(local_at(times.front()), result);
    for (std::size_t i = 1; i < times.size(); ++i) {
      const Moment last = local_at(times[i]);
      divide(local_at(times[i - 1]), last, result);
      put(last, result);
    }
    return result;
  }

 private:
  struct Moment {
    float time = 0;
    Transform local;
    Mat4 parent{1.0};
  };

  Moment local_at(float time) {
    const auto t = static_cast<double>(time);
    sample_clip(source_, t, clip_pose_);
    sample_clip(laid_, t, pose_);
    Moment moment{time, clip_pose_.local[static_cast<std::size_t>(own_.joint)],
                  global_of(skeleton_, pose_, parent_)};
    if (time != begin_ && time != end_)
      moment.local = following_local(moment.parent, global_of(skeleton_, pose_, own_.serves),
                                     global_of(skeleton_, clip_pose_, own_.serves),
                                     global_of(skeleton_, clip_pose_, parent_), moment.local);
    return moment;
  }

  // Where keys have to be; ascending.
  std::vector<float> times_of() const {
    std::set<float> wanted, needed{begin_, end_};
    for (const Clip* clip : {&source_, &laid_})
      for (const Channel& channel : clip->channels)
        for (const float t : channel.times) {
          if (!(t > begin_ && t < end_)) continue;
          wanted.insert(t);
          if (channel.interpolation != Interpolation::step) continue;
          const float before = std::nextafter(t, -std::numeric_limits<float>::infinity());
          needed.insert(t);
          if (before > begin_) needed.insert(before);
        }
    // A step that was made straight stands between two neighbouring times.
    for (auto at = wanted.begin(); at != wanted.end(); ++at)
      if (const auto next = std::next(at);
          next != wanted.end() &&
          std::nextafter(*at, std::numeric_limits<float>::infinity()) == *next) {
        needed.insert(*at);
        needed.insert(*next);
      }
    std::vector<float> times(needed.begin(), needed.end());
    for (const float t : wanted) {
      const auto next = std::lower_bound(times.begin(), times.end(), t);
      if (static_cast<double>(*next) - t >= kApart &&
          static_cast<double>(t) - *(next - 1) >= kApart)
        times.insert(next, t);
    }
    return times;
  }

  // How far the straight line between two keys is from where the joint belongs at a time between.
  double off(const Moment& a, const Moment& b, const Moment& between) const {
    const double u = (static_cast<double>(between.time) - a.time) /
                     (static_cast<double>(b.time) - static_cast<double>(a.time));
    const Vec3 place = a.local.translation + u * (b.local.translation - a.local.translation);
    const Quat turn = slerp_shortest(a.local.rotation, b.local.rotation, u);
    return glm::length(Mat3(between.parent) * (place - between.local.translation)) +
           kReach * length_ * angle_between(turn, between.local.rotation);
  }

  // Keys strictly between two.
  void divide(const Moment& a, const Moment& b, JointKeys& result) {
    const double length = static_cast<double>(b.time) - static_cast<double>(a.time);
    if (!(length >= 2 * kLeastInterval)) return;
    const auto at = [&](double u) { return local_at(static_cast<float>(a.time + u * length)); };
    const Moment middle = at(0.5);
    const double most = kFollowingTolerance * length_;
    if (off(a, b, middle) <= most && off(a, b, at(0.25)) <= most && off(a, b, at(0.75)) <= most)
      return;
    divide(a, middle, result);
    put(middle, result);
    divide(middle, b, result);
  }

  static void put(const Moment& moment, JointKeys& result) {
    result.keys.times.push_back(moment.time);
    result.keys.values.push_back(moment.local.rotation);
    result.translations.push_back(moment.local.translation);
  }

  const Skeleton& skeleton_;
  FollowingJoint own_;
  int parent_;
  std::set<int> nodes_;
  Clip source_, laid_;
  Pose clip_pose_, pose_;
  double length_ = 0;
  float begin_ = 0, end_ = 0;
};

}  // namespace

Status add_following_keys(const Model& model, const LimbModel& limb, const Clip& source,
                          Correction& correction) {
  // One after the other: what hangs below another has its parent's keys to go by.
  for (const FollowingJoint& own : limb.limb.following) {
    const auto laid = lay_over(model.skeleton, source, {correction});
    if (!laid) return laid.error();
    correction.joints.push_back(Follower(model, limb, own, source, *laid).keys(correction));
  }
  return Done{};
}

}  // namespace elbowroom
