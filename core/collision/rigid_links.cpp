// SPDX-License-Identifier: MIT
#include "core/collision/rigid_links.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace elbowroom {

std::vector<int> rigid_links(const World& world, int actor, double begin, double end,
                             const std::vector<int>& apart, double tolerance) {
  const Actor& self = world.actors[static_cast<std::size_t>(actor)];
  const Skeleton& skeleton = self.model->skeleton;
  const std::size_t count = skeleton.joints.size();
  std::vector<bool> moves(count, false);
  for (const int joint : apart) moves[static_cast<std::size_t>(joint)] = true;

  if (self.clip) {
    const Pose rest = rest_pose(skeleton);
    Pose first = rest, now = rest;
    sample_clip(*self.clip, begin, first);
    const int samples = std::clamp(static_cast<int>(std::ceil((end - begin) * 60.0)), 1, 3600);
    for (int i = 1; i <= samples; ++i) {
      now = rest;
      sample_clip(*self.clip, begin + (end - begin) * i / samples, now);
      for (std::size_t n = 0; n < count; ++n) {
        if (moves[n]) continue;
        const Transform &a = first.local[n], &b = now.local[n];
        moves[n] = !(angle_between(a.rotation, b.rotation) <= 2e-3 &&
                     glm::distance(a.translation, b.translation) <= tolerance &&
                     glm::distance(a.scale, b.scale) <= 1e-4 * glm::length(a.scale));
      }
    }
  }
  std::vector<int> link(count);
  for (const int n : skeleton.order) {
    const auto at = static_cast<std::size_t>(n);
    const int parent = skeleton.joints[at].parent;
    link[at] = moves[at] || parent < 0 ? n : link[static_cast<std::size_t>(parent)];
  }
  return link;
}

}  // namespace elbowroom
