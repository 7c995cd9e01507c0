// SPDX-License-Identifier: MIT
#include "core/io/run_files.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>

#include "core/io/gltf_references.h"

namespace elbowroom {
namespace {

namespace fs = std::filesystem;

// The folders above a file that are not there, outer ones first.
std::vector<fs::path> missing_folders(const fs::path& file) {
  std::vector<fs::path> missing;
  std::error_code ignored;
  for (fs::path folder = folder_of(file); !fs::exists(folder, ignored);) {
    missing.insert(missing.begin(), folder);
    const fs::path above = folder_of(folder);
    if (above == folder) break;
    folder = above;
  }
  return missing;
}

}  // namespace

bool RunFiles::Place::operator==(const Place& other) const {
  if (exists && other.exists && device == other.device && inode == other.inode) return true;
  return path == other.path;
}

RunFiles::Place RunFiles::place_of(const fs::path& file) {
  Place place;
  place.path = place_written(file);
  struct stat info {};
  if (::stat(file.c_str(), &info) == 0) {
    place.exists = true;
    place.device = static_cast<std::uint64_t>(info.st_dev);
    place.inode = static_cast<std::uint64_t>(info.st_ino);
  }
  return place;
}

RunFiles::~RunFiles() {
  staged_.clear();
  std::error_code ignored;
  for (auto folder = made_.rbegin(); folder != made_.rend(); ++folder) fs::remove(*folder, ignored);
}

void RunFiles::reads(const fs::path& file, const std::string& what) {
  if (file.empty()) return;
  reads_.push_back({place_of(file), what});
  for (const fs::path& named : gltf_export::referenced_files(file))
    reads_.push_back({place_of(named), "\"" + named.filename().string() + "\", which belongs to " +
                                           file.filename().string()});
}

void RunFiles::reads(const SceneDescription& scene) {
  reads(scene.character, "the character");
  for (const fs::path& file : scene.obstacles) reads(file, "an obstacle of the scene");
  for (const AttachedFile& held : scene.attachments)
    reads(held.file, "an attached object of the scene");
}

void RunFiles::writes(const fs::path& file, const std::string& what, Folders folders,
                      const fs::path& over) {
  if (!file.empty()) outputs_.push_back({file, place_of(file), what, folders, over});
}

Status RunFiles::check_distinct() const {
  for (auto output = outputs_.begin(); output != outputs_.end(); ++output) {
    const bool may_replace = !output->over.empty() && place_of(output->over) == output->place;
    for (const Read& read : reads_)
      if (!may_replace && read.place == output->place)
        return Error{output->what + " would write over " + read.what, output->file.string(),
                     "choose another name"};
    for (auto other = outputs_.begin(); other != output; ++other)
      if (other->place == output->place)
        return Error{other->what + " and " + output->what + " would write the same file",
                     output->file.string(), "give one of them another name"};
  }
  return Done{};
}

Status RunFiles::check_places() const {
  for (const Output& output : outputs_) {
    std::error_code ignored;
    const std::string where = output.file.string();
    if (fs::exists(output.file, ignored) && !fs::is_regular_file(output.file, ignored))
      return Error{
          output.what + " can't be written: something that is no regular file stands there", where,
          "choose another name"};
    fs::path folder = folder_of(output.place.path);
    if (output.folders == Folders::are_made)
      if (const auto missing = missing_folders(output.place.path); !missing.empty())
        folder = folder_of(missing.front());
    if (!fs::is_directory(folder, ignored))
      return Error{output.what + " can't be written: there is no folder " + folder.string(), where,
                   "make it first, or choose another place"};
    if (::access(folder.c_str(), W_OK | X_OK) != 0)
      return Error{output.what + " can't be written: the folder is not writable", where,
                   "check its permissions, or choose another place"};
  }
  return Done{};
}

bool RunFiles::is_free(const fs::path& file) const {
  const Place place = place_of(file);
  const auto is_it = [&](const auto& entry) { return entry.place == place; };
  return std::none_of(reads_.begin(), reads_.end(), is_it) &&
         std::none_of(outputs_.begin(), outputs_.end(), is_it) &&
         std::none_of(staged_.begin(), staged_.end(), is_it);
}

const RunFiles::Staged* RunFiles::find_staged(const fs::path& file) const {
  const Place place = place_of(file);
  for (const Staged& staged : staged_)
    if (staged.place == place) return &staged;
  return nullptr;
}

Status RunFiles::stage(const fs::path& file, std::string_view bytes, Folders folders) {
  const Place place = place_of(file);
  const auto promised = std::find_if(outputs_.begin(), outputs_.end(),
                                     [&](const Output& output) { return output.place == place; });
  if (promised != outputs_.end())
    folders = promised->folders;
  else
    for (const Read& read : reads_)
      if (read.place == place)
        return Error{"this would write over " + read.what, file.string(), "choose another name"};
  if (find_staged(file) != nullptr)
    return Error{"two results would be written to the same file", file.string(),
                 "give one of them another name"};
  if (folders == Folders::are_made)
    for (const fs::path& folder : missing_folders(file)) {
      std::error_code failed;
      if (fs::create_directory(folder, failed)) made_.push_back(folder);
      if (failed)
        return Error{"the folder can't be made: " + failed.message(), folder.string(),
                     "choose another place"};
    }
  auto staged = StagedFile::stage(file, bytes);
  if (!staged) return staged.error();
  staged_.push_back({place, std::move(staged).value()});
  return Done{};
}

bool RunFiles::is_staged(const fs::path& file, std::string_view bytes) const {
  const Staged* staged = find_staged(file);
  if (staged == nullptr) return false;
  const auto there = read_whole_file(staged->file.temporary());
  return there && *there == bytes;
}

fs::path RunFiles::staged_at(const fs::path& file) const {
  const Staged* staged = find_staged(file);
  return staged == nullptr ? fs::path() : staged->file.temporary();
}

Status RunFiles::commit() {
  struct Undo {
    fs::path target, older;  // `older` is empty where nothing stood there
    bool lost = false;       // something did, and it could not be kept
  };
  std::vector<Undo> done;
  Status result = Done{};
  for (Staged& staged : staged_) {
    Undo undo{staged.file.target(), {}};
    std::error_code failed;
    if (fs::exists(undo.target, failed)) {
      undo.older = staged.file.temporary();
      undo.older.replace_extension(".old");
      fs::create_hard_link(undo.target, undo.older, failed);
      if (failed) undo.older.clear();
      undo.lost = undo.older.empty();
    }
    result = staged.file.commit();
    done.push_back(std::move(undo));
    if (!result) break;
  }
  std::error_code ignored;
  if (!result) {
    // The last one has failed itself: what stands there is what stood there.
    for (auto undo = done.rbegin() + 1; undo != done.rend(); ++undo) {
      if (!undo->older.empty())
        fs::rename(undo->older, undo->target, ignored);
      else if (!undo->lost)
        fs::remove(undo->target, ignored);
    }
  }
  for (const Undo& undo : done)
    if (!undo.older.empty()) fs::remove(undo.older, ignored);
  staged_.clear();
  if (result) made_.clear();
  return result;
}

}  // namespace elbowroom
