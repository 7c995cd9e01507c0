// SPDX-License-Identifier: MIT
// What tests of the command line call: the program and the demo's files.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/support/run_program.h"

namespace elbowroom::test {

inline const std::string kProgram = ELBOWROOM_PROGRAM;
inline const std::filesystem::path kDemo = ELBOWROOM_DEMO_DIR;
inline const std::string kMannequin = kDemo / "mannequin.glb";

inline ProgramRun run(const std::vector<std::string>& arguments, int interrupt_after_ms = 0) {
  return run_program(kProgram, arguments, interrupt_after_ms);
}

inline std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace elbowroom::test
