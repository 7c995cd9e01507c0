// SPDX-License-Identifier: MIT
// elbowroom_generate_demo FOLDER: writes the demo's files there (assets/demo.h).
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "assets/demo.h"
#include "assets/generator/demo_files.h"

namespace {

// Through a temporary name, so that an interrupted build leaves no half file.
bool write(const std::filesystem::path& path, const std::string& bytes) {
  const std::filesystem::path temporary = path.string() + ".part";
  {
    std::ofstream out(temporary, std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!out.flush()) return false;
  }
  std::error_code error;
  std::filesystem::rename(temporary, path, error);
  return !error;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace elbowroom::demo;
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s FOLDER\n", argv[0]);
    return 1;
  }
  const std::filesystem::path folder = argv[1];
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const std::pair<const char*, GlbFile (*)()> files[] = {
      {kMannequinFile, make_mannequin}, {kUmbrellaFile, make_umbrella}, {kPostsFile, make_posts}};
  for (const auto& [name, make] : files)
    if (!write(folder / name, to_glb(make()))) {
      std::fprintf(stderr, "%s: cannot be written\n", (folder / name).c_str());
      return 2;
    }
  return 0;
}
