// SPDX-License-Identifier: MIT
#include "core/io/gltf_writer.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/io/gltf_append.h"
#include "core/io/gltf_container.h"
#include "core/io/gltf_references.h"
#include "core/io/json_text.h"
#include "core/io/run_files.h"
#include "core/io/safe_file.h"

namespace elbowroom {
namespace {

namespace fs = std::filesystem;
namespace jt = json_text;

bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  return fs::equivalent(a, b, ignored);
}

std::string lowercase_extension(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

// Which names beside the output may be written.
class Names {
 public:
  Names(const RunFiles& run, const fs::path& folder, const fs::path& out_file)
      : run_(run), folder_(folder) {
    // A file that the output's former version names is the output's to write over.
    const auto old = read_whole_file(out_file);
    if (!old) return;
    const auto container = gltf_export::parse_container(*old, out_file);
    if (!container) return;
    for (const auto& reference : gltf_export::relative_references(container->json)) {
      own_.insert(gltf_export::percent_decoded(reference.uri));
    }
  }
  void take(const std::string& name) { taken_.insert(name); }
  bool is_free(const std::string& name) const {
    std::error_code ignored;
    return taken_.count(name) == 0 && run_.is_free(folder_ / name) &&
           (own_.count(name) > 0 || !fs::exists(folder_ / name, ignored));
  }
  // NAME.EXT, NAME-2.EXT, ...
  std::string free_like(const fs::path& wish) const {
    for (int i = 1;; ++i) {
      fs::path name = wish;
      if (i > 1) {
        name.replace_filename(wish.stem().string() + "-" + std::to_string(i) +
                              wish.extension().string());
      }
      if (is_free(name.generic_string())) return name.generic_string();
    }
  }

 private:
  const RunFiles& run_;
  fs::path folder_;
  std::set<std::string> taken_, own_;
};

// A file to be copied along.
struct Companion {
  std::string name;  // relative to the output's folder
  std::string bytes;
};

// The files that the text's URIs name, for an output in another folder; URIs of those that cannot
// keep their names are changed in `text`.
Result<std::vector<Companion>> companions(const RunFiles& run, const fs::path& source_folder,
                                          const fs::path& out_folder,
                                          const std::vector<gltf_export::SideFile>& own,
                                          Names& names, std::string& text,
                                          std::vector<std::string>& warnings) {
  std::vector<Companion> found;
  std::map<std::string, std::string> new_uris;  // by old one; empty: it stays
  jt::Patch patch(text);
  for (const auto& reference : gltf_export::relative_references(text)) {
    if (std::any_of(own.begin(), own.end(), [&](const gltf_export::SideFile& file) {
          return gltf_export::percent_encoded(file.name) == reference.uri;
        })) {
      continue;
    }
    auto known = new_uris.find(reference.uri);
    if (known == new_uris.end()) {
      known = new_uris.emplace(reference.uri, "").first;
      const auto file = gltf_export::resolve_inside(source_folder, reference.uri);
      if (!file) {
        warnings.push_back(reference.uri + " is not there or lies outside the source's folder");
        continue;
      }
      auto bytes = read_whole_file(*file);
      if (!bytes) return bytes.error();
      const fs::path wish =
          fs::path(gltf_export::percent_decoded(reference.uri)).lexically_normal();
      if (*wish.begin() == "..") {
        warnings.push_back(reference.uri + " would lie outside the output's folder");
        continue;
      }
      std::error_code ignored;
      // Another output of this run may have brought it.
      bool there = run.is_staged(out_folder / wish, *bytes);
      if (!there && fs::is_regular_file(out_folder / wish, ignored) &&
          fs::file_size(out_folder / wish, ignored) == bytes->size()) {
        const auto present = read_whole_file(out_folder / wish);
        there = present && *present == *bytes;
      }
      if (!there) {
        const std::string name = names.free_like(wish);
        if (name != wish.generic_string()) known->second = gltf_export::percent_encoded(name);
        names.take(name);
        found.push_back({name, *std::move(bytes)});
      }
    }
    if (!known->second.empty()) patch.replace(reference.value, jt::quoted(known->second));
  }
  text = patch.apply();
  return found;
}

Status stage_all(const fs::path& out_folder, const std::vector<Companion>& files,
                 const fs::path& out_file, std::string_view bytes, RunFiles& run,
                 ExportReport& report) {
  // The file that names the others comes last.
  for (const Companion& file : files) {
    const fs::path target = out_folder / file.name;
    if (Status staged = run.stage(target, file.bytes, RunFiles::Folders::are_made); !staged)
      return staged;
    report.side_files.push_back(target);
  }
  return run.stage(out_file, bytes);
}

}  // namespace

CorrectedClip corrected_clip(const Clip& clip) {
  CorrectedClip corrected;
  corrected.source_animation = clip.source_animation;
  for (const Channel& channel : clip.channels) {
    if (channel.source_channel < 0) corrected.changed.push_back(channel);
  }
  return corrected;
}

Status stage_corrected(const fs::path& source_file, const fs::path& out_file,
                       const std::vector<CorrectedClip>& clips, RunFiles& run,
                       ExportReport* report) {
  ExportReport made;
  const auto source = read_whole_file(source_file);
  if (!source) return source.error();
  auto container = gltf_export::parse_container(*source, source_file);
  if (!container) return container.error();

  const std::string extension = lowercase_extension(out_file);
  const bool to_text = extension == ".gltf";
  const bool to_binary = extension == ".glb" || extension == ".vrm" || extension == ".vrma";
  const bool binary = to_text ? false : (to_binary ? true : container->binary);

  const fs::path source_folder = folder_of(source_file), out_folder = folder_of(out_file);
  Names names(run, out_folder, out_file);
  names.take(out_file.filename().string());
  names.take(source_file.filename().string());
  for (const auto& reference : gltf_export::relative_references(container->json)) {
    names.take(gltf_export::percent_decoded(reference.uri));
  }

  gltf_export::Draft draft;
  const bool was_binary = container->binary;
  draft.container = std::move(container).value();
  draft.file = source_file;
  draft.free_name = names.free_like(out_file.stem().string() + ".bin");
  if (auto status = gltf_export::change_container(draft, binary); !status) return status;
  if (auto status = gltf_export::append_animations(draft, clips, made.animations); !status)
    return status;
  if (draft.bin_is_side_file) {
    draft.side_files.push_back({draft.free_name, *std::move(draft.container.bin)});
    draft.container.bin.reset();
  }
  made.warnings = std::move(draft.warnings);

  std::vector<Companion> files;
  if (!same_file(source_folder, out_folder)) {
    // References keep their names where they can, so these names are not taken any more.
    Names copies(run, out_folder, out_file);
    copies.take(out_file.filename().string());
    for (const gltf_export::SideFile& file : draft.side_files) copies.take(file.name);
    auto found = companions(run, source_folder, out_folder, draft.side_files, copies,
                            draft.container.json, made.warnings);
    if (!found) return found.error();
    files = *std::move(found);
  }
  for (gltf_export::SideFile& file : draft.side_files) {
    files.push_back({std::move(file.name), std::move(file.bytes)});
  }

  std::string bytes;
  const bool copy = made.animations.empty() && was_binary == binary;
  if (copy && draft.container.json == gltf_export::parse_container(*source, source_file)->json) {
    bytes = *source;
  } else {
    auto written = gltf_export::write_container(draft.container, out_file);
    if (!written) return written.error();
    bytes = *std::move(written);
  }
  if (auto status = stage_all(out_folder, files, out_file, bytes, run, made); !status)
    return status;
  if (report) *report = std::move(made);
  return Done{};
}

Status export_corrected(const fs::path& source_file, const fs::path& out_file,
                        const std::vector<CorrectedClip>& clips, ExportReport* report) {
  RunFiles run;
  if (Status staged = stage_corrected(source_file, out_file, clips, run, report); !staged)
    return staged;
  return run.commit();
}

Status export_corrected(const fs::path& source_file, const fs::path& out_file,
                        const CorrectedClip& clip, ExportReport* report) {
  return export_corrected(source_file, out_file, std::vector<CorrectedClip>{clip}, report);
}

}  // namespace elbowroom
