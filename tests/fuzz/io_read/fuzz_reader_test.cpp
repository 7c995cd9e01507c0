// SPDX-License-Identifier: MIT
// Mutations of many files, for minutes. ELBOWROOM_FUZZ_ROUNDS sets how many a file (default 300),
// ELBOWROOM_FUZZ_SEED where the seeds begin.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <string>

#include "tests/support/samples.h"
#include "tests/unit/io_read/gltf_maker.h"
#include "tests/unit/io_read/mutation.h"

namespace elbowroom {
namespace {

std::uint64_t setting(const char* name, std::uint64_t fallback) {
  const char* text = std::getenv(name);
  return text ? std::stoull(text) : fallback;
}

TEST(FuzzReaderLong, MutationsOfAllKindsOfFiles) {
  std::vector<std::string> files = test::small_samples(test::samples_dir(), 700000);
  const auto rounds = static_cast<int>(setting("ELBOWROOM_FUZZ_ROUNDS", 300));
  const std::uint64_t seed = setting("ELBOWROOM_FUZZ_SEED", 1000);
  for (int copies = 0; copies < 20; ++copies) files.push_back(test::everything().glb());
  const test::FuzzReport report = test::fuzz_reader(files, rounds, seed);
  std::cout << report.read << " read, " << report.opened << " opened, slowest " << report.slowest
            << " s\n";
  EXPECT_GT(report.opened, 0);
}

}  // namespace
}  // namespace elbowroom
