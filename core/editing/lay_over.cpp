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
      const auto channel_of = [&](Path path) {
        const int found = clip.find_channel(joint.node, path);
        return found < 0 ? nullptr : &clip.channels[static_cast<std::size_t>(found)];
      };
      const Channel* channel = channel_of(Path::rotation);
      const Transform& rest = skeleton.joints[static_cast<std::size_t>(joint.node)].rest;
      // A joint without a channel becomes LINEAR: its keys are dense, and every player has it.
      RotationKeys keys = joint.keys;
      if (!channel) keys.derivatives.clear();
      auto result = splice_rotation(channel, rest.rotation, joint.node, correction.begin,
                                    correction.end, keys);
      const auto in_joint = [&](Error error) {
        error.where = joint.joint + (error.where.empty() ? "" : ", " + error.where);
        return error;
      };
      if (!result) return in_joint(result.error());
      spliced.push_back(std::move(*result));
      if (joint.translations.empty()) continue;
      auto moved = splice_translation(channel_of(Path::translation), rest.translation, joint.node,
                                      correction.begin, correction.end,
                                      {joint.keys.times, joint.translations});
      if (!moved) return in_joint(moved.error());
      spliced.push_back(std::move(*moved));
    }
    clip = apply_splices(clip, spliced);
  }
  return clip;
}

}  // namespace elbowroom
