// SPDX-License-Identifier: MIT
// Files that are wrong in few places, which is where readers go wrong: bytes flipped, numbers
// replaced by extreme ones, pieces cut, copied and moved. The same seed gives the same file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace elbowroom::test {

// One to four mutations of `bytes`.
std::string mutated(const std::string& bytes, std::uint64_t seed);

struct FuzzReport {
  int read = 0, opened = 0;
  double slowest = 0;  // seconds
};

// Reads `count` mutations of each file; each must give a sound model or an error, open nothing
// outside its folder and take less than 5 s. Reports failures to GoogleTest with the seed.
FuzzReport fuzz_reader(const std::vector<std::string>& files, int count, std::uint64_t seed);

// Samples of few bytes: .glb and self-contained .gltf files at most `most_bytes` long.
std::vector<std::string> small_samples(const std::filesystem::path& samples,
                                       std::uintmax_t most_bytes);

}  // namespace elbowroom::test
