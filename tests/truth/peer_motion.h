// SPDX-License-Identifier: MIT
// What the peer makes of a truth problem: OMPL's RRTConnect with FCL and its shortcuts, in the very
// windows and for the time that ours took, written into a file as ours is, so that both are judged
// alike. Only where the benchmarks are built (tests/bench/peer).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace elbowroom::test {

struct PeerQuestion {
  std::filesystem::path character, thing;
  int clip = 0;
  std::string limb;  // as reports name it
  struct Window {
    double begin = 0, end = 0, most_seconds = 0;
  };
  std::vector<Window> windows;
  std::uint64_t seed = 1;
};

bool peer_is_built();
// True if every window has a path; then `out` is the character with the clip so corrected, keyed
// densely enough (480 Hz) that a player shows the path. Throws std::runtime_error where the scene
// can't be had.
bool peer_motion(const PeerQuestion& question, const std::filesystem::path& out);

}  // namespace elbowroom::test
