// SPDX-License-Identifier: MIT
#include "app/outputs.h"

#include <string>

namespace elbowroom {

std::filesystem::path other_way_file(const std::filesystem::path& out, std::size_t rank) {
  std::filesystem::path file = out;
  file.replace_filename(out.stem().string() + "-" + std::to_string(rank) +
                        out.extension().string());
  return file;
}

std::filesystem::path per_file_target(const Outputs& outputs, const std::filesystem::path& source) {
  if (outputs.per_file.empty() || source.empty()) return {};
  return outputs.per_file / source.filename();
}

void declare_outputs(const Outputs& outputs, const std::filesystem::path& source,
                     const std::filesystem::path& project, RunFiles& files) {
  using Folders = RunFiles::Folders;
  files.writes(outputs.out, "-o");
  for (int rank = 2; rank <= outputs.ways && !outputs.out.empty(); ++rank)
    files.writes(other_way_file(outputs.out, static_cast<std::size_t>(rank)), "--alternatives");
  files.writes(per_file_target(outputs, source), "--per-file", Folders::are_made);
  files.writes(outputs.save_project, "--save-project", Folders::must_be_there, project);
  files.writes(outputs.report, "--report");
}

}  // namespace elbowroom
