// SPDX-License-Identifier: MIT
// What the samples' INDEX.md says of each file: independent numbers to hold the reader against.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace elbowroom::test {

struct SampleFacts {
  std::string file;  // relative to the samples
  std::optional<int> triangles, joints, clips;
  bool compressed = false;  // it requires an extension that the reader refuses by name
};

// Facts of all glTF files outside malformed/. Both layouts of the index are read: a heading a file
// with a list below it, and tables with a header row.
std::vector<SampleFacts> read_sample_index(const std::filesystem::path& samples);

// All glTF files below a folder, sorted.
std::vector<std::filesystem::path> gltf_files(const std::filesystem::path& folder);

}  // namespace elbowroom::test
