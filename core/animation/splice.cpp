// SPDX-License-Identifier: MIT
#include "core/animation/splice.h"

#include <algorithm>
#include <cmath>

namespace elbowroom {

Clip apply_splices(const Clip& clip, const std::vector<Channel>& spliced) {
  Clip result = clip;
  for (const Channel& channel : spliced) {
    const auto same = std::find_if(
        result.channels.begin(), result.channels.end(),
        [&](const Channel& c) { return c.joint == channel.joint && c.path == channel.path; });
    Channel& place = same != result.channels.end() ? *same : result.channels.emplace_back();
    place = channel;
    place.source_channel = -1;
    if (channel.times.empty()) continue;
    const bool first = clip.channels.empty() && result.channels.size() == 1;
    const double begin = channel.times.front(), end = channel.times.back();
    result.begin = first ? begin : std::fmin(result.begin, begin);
    result.end = first ? end : std::fmax(result.end, end);
  }
  return result;
}

}  // namespace elbowroom
