// SPDX-License-Identifier: MIT
// The files that one run reads and those that it writes: no output takes the place of an input or
// of another output, and outputs appear together or not at all.
//
//     RunFiles files;
//     files.reads(scene);                       // and what its glTF files name
//     files.writes("out.glb", "-o");
//     files.check_distinct(), files.check_places()   // before any work is done
//     files.stage(...), ...                     // stage_clip, stage_corrected do
//     files.commit();
//
// Two names are one file if they lead to the same place: through symbolic links, "." and "..", and
// as hard links. That holds for files that do not exist yet too. Blocking; one thread at a time.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/io/safe_file.h"
#include "core/scene/scene_description.h"

namespace elbowroom {

class RunFiles {
 public:
  enum class Folders { must_be_there, are_made };

  RunFiles() = default;
  // What has not been committed is gone, with the folders that were made for it.
  ~RunFiles();
  RunFiles(const RunFiles&) = delete;
  RunFiles& operator=(const RunFiles&) = delete;

  // A file that is read and, if it is glTF, the buffers and images that it names. `what` is for
  // messages: "the character". A file that isn't there is left to its reader to tell of.
  void reads(const std::filesystem::path& file, const std::string& what);
  void reads(const SceneDescription& scene);

  // A file that will be written; `what` is how the user has named it: "--report". `over`: a file
  // that this output is allowed to replace although it is read (a project that is saved again).
  void writes(const std::filesystem::path& file, const std::string& what,
              Folders folders = Folders::must_be_there, const std::filesystem::path& over = {});

  // Error: the first output that is also read, or that two are to write.
  Status check_distinct() const;
  // Error: the first output that can't be written where it is to be: a folder that is not there or
  // not writable, a folder or a device of that name.
  Status check_places() const;

  // Neither read, nor promised to an output, nor staged: a buffer or an image that goes with an
  // output may have the name.
  bool is_free(const std::filesystem::path& file) const;

  // Writes and syncs the bytes under a temporary name. `folders` is for files that were not
  // announced by writes(). Errors: those of StagedFile; a file that is
  // read and no output of this run; one that is staged already.
  Status stage(const std::filesystem::path& file, std::string_view bytes,
               Folders folders = Folders::must_be_there);
  // Whether that file is staged, with these bytes.
  bool is_staged(const std::filesystem::path& file, std::string_view bytes) const;
  // The temporary name under which it can be read meanwhile; empty if it isn't staged.
  std::filesystem::path staged_at(const std::filesystem::path& file) const;

  // Gives all that is staged its names, in the order of staging. On an error what has got its name
  // already is taken back: older files stand there again (where the file system has hard links).
  Status commit();

 private:
  // Where a name leads to.
  struct Place {
    std::filesystem::path path;
    bool exists = false;
    std::uint64_t device = 0, inode = 0;
    bool operator==(const Place& other) const;
  };
  struct Read {
    Place place;
    std::string what;
  };
  struct Output {
    std::filesystem::path file;
    Place place;
    std::string what;
    Folders folders;
    std::filesystem::path over;
  };
  struct Staged {
    Place place;
    StagedFile file;
  };
  static Place place_of(const std::filesystem::path& file);
  const Staged* find_staged(const std::filesystem::path& file) const;

  std::vector<Read> reads_;
  std::vector<Output> outputs_;
  std::vector<Staged> staged_;
  std::vector<std::filesystem::path> made_;  // folders, outer ones first
};

}  // namespace elbowroom
