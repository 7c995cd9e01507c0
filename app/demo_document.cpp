// SPDX-License-Identifier: MIT
#include "app/demo_document.h"

#include <cstdlib>
#include <filesystem>

#include "assets/demo.h"

namespace elbowroom {
namespace {

namespace fs = std::filesystem;

// The build puts the program into app/ and the demo into assets/ beside it; an installed one stands
// in bin/, its demo in share/elbowroom/. ELBOWROOM_ASSETS overrides both.
std::vector<fs::path> demo_folders() {
  std::vector<fs::path> folders;
  if (const char* given = std::getenv("ELBOWROOM_ASSETS"); given && *given)
    folders.emplace_back(given);
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) {
    const fs::path above = program.parent_path().parent_path();
    folders.push_back(above / "assets");
    folders.push_back(above / "share" / "elbowroom");
  }
  return folders;
}

}  // namespace

Result<Document> demo_document() {
  std::string looked;
  for (const fs::path& folder : demo_folders()) {
    std::error_code error;
    looked += (looked.empty() ? "" : ", ") + folder.string();
    if (!fs::exists(folder / demo::kMannequinFile, error)) continue;
    Document document;
    document.scene.character = folder / demo::kMannequinFile;
    document.scene.clip = demo::kDemoClip;
    document.scene.obstacles.push_back(folder / demo::kPostsFile);
    AttachedFile umbrella;
    umbrella.file = folder / demo::kUmbrellaFile;
    umbrella.joint = demo::kAttachJoint;
    umbrella.joint_from_object.translation = {demo::kGripX, demo::kGripY, demo::kGripZ};
    document.scene.attachments.push_back(umbrella);
    return document;
  }
  return Error{"the demo scene is not beside the program", looked,
               "build the target elbowroom_demo_files, or set ELBOWROOM_ASSETS to its folder"};
}

}  // namespace elbowroom
