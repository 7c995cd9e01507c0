// SPDX-License-Identifier: MIT
// Where real characters, clips and props for tests are; they are no part of the project.
#pragma once

#include <filesystem>
#include <string>

namespace elbowroom::test {

// The folder named by ELBOWROOM_SAMPLES, else shared/samples beside the source tree; empty if there
// is none. A test that needs it skips with samples_missing().
std::filesystem::path samples_dir();

// What a skipped test says.
std::string samples_missing();

}  // namespace elbowroom::test
