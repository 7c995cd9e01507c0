// SPDX-License-Identifier: MIT
// A few seconds of mutations; tests/fuzz/io_read does the same for long.
#include <gtest/gtest.h>

#include "tests/support/samples.h"
#include "tests/unit/io_read/gltf_maker.h"
#include "tests/unit/io_read/mutation.h"

namespace elbowroom {
namespace {

TEST(FuzzReader, MutationsOfAMadeFile) {
  const test::FuzzReport report = test::fuzz_reader({test::everything().glb()}, 1500, 1);
  EXPECT_EQ(report.read, 1500);
  EXPECT_GT(report.opened, 50) << "mutations so coarse that all are refused test little";
}

TEST(FuzzReader, MutationsOfSamples) {
  const std::vector<std::string> files = test::small_samples(test::samples_dir(), 60000);
  if (files.empty()) GTEST_SKIP() << test::samples_missing();
  const test::FuzzReport report = test::fuzz_reader(files, 10, 2);
  EXPECT_GT(report.opened, 50);
}

TEST(FuzzReader, TheSameSeedGivesTheSameFile) {
  const std::string file = test::everything().glb();
  EXPECT_EQ(test::mutated(file, 5), test::mutated(file, 5));
  EXPECT_NE(test::mutated(file, 5), test::mutated(file, 6));
}

}  // namespace
}  // namespace elbowroom
