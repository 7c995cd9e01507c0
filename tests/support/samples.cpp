// SPDX-License-Identifier: MIT
#include "tests/support/samples.h"

#include <cstdlib>

namespace elbowroom::test {

std::filesystem::path samples_dir() {
  if (const char* named = std::getenv("ELBOWROOM_SAMPLES")) {
    return std::filesystem::is_directory(named) ? std::filesystem::path(named)
                                                : std::filesystem::path();
  }
  const auto beside =
      std::filesystem::path(ELBOWROOM_SOURCE_DIR).parent_path() / "shared" / "samples";
  return std::filesystem::is_directory(beside) ? beside : std::filesystem::path();
}

std::string samples_missing() {
  return "no sample files: set ELBOWROOM_SAMPLES to a folder of them, or put it at shared/samples "
         "beside the source tree";
}

}  // namespace elbowroom::test
