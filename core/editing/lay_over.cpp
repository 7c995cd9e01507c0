// SPDX-License-Identifier: MIT
#include "core/editing/correct.h"

namespace elbowroom {

Result<Clip> lay_over(const Skeleton& skeleton, const Clip& source,
                      const std::vector<Correction>& corrections) {
  Clip clip = source;
  for (const Correction& correction : corrections) {
    if (correction.muted) continue;
    std::vector<Channel> spliced;
    for (const JointKeys& joint : correction.joints) {
      if (joint.node < 0 || joint.node >= skeleton.size())
        return Error{
            "the correction \"" + correction.name + "\" has keys for a joint that is not there",
            joint.joint, "replan it for this character"};
      const int found = clip.find_channel(joint.node, Path::rotation);
      const Channel* channel =
          found < 0 ? nullptr : &clip.channels[static_cast<std::size_t>(found)];
      // A joint without a channel becomes LINEAR: its keys are dense, and every player has it.
      RotationKeys keys = joint.keys;
      if (!channel) keys.derivatives.clear();
      auto result = splice_rotation(
          channel, skeleton.joints[static_cast<std::size_t>(joint.node)].rest.rotation, joint.node,
          correction.begin, correction.end, keys);
      if (!result) {
        Error error = result.error();
        error.where = joint.joint + (error.where.empty() ? "" : ", " + error.where);
        return error;
      }
      spliced.push_back(std::move(*result));
    }
    clip = apply_splices(clip, spliced);
  }
  return clip;
}

}  // namespace elbowroom
