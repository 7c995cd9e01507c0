// SPDX-License-Identifier: MIT
// The demo's mannequin walking, with nothing around it: what tests of a session begin with.
#pragma once

#include <filesystem>

#include "core/editing/document.h"

namespace elbowroom::test {

// `demo`: the folder of the demo's files.
inline Document walking(const std::filesystem::path& demo) {
  Document document;
  document.scene.character = demo / "mannequin.glb";
  document.scene.clip = "Walk";
  return document;
}

}  // namespace elbowroom::test
