// SPDX-License-Identifier: MIT
// Work that is not saved, kept where it can be found after a crash: the document as a project file,
// written in the background some seconds after an edit (temporary name, sync, rename) and removed
// when the document is saved or given up on purpose.
//
// A project's lies beside it, NAME.elbow.recovery; that of a document without a project, or beside
// which nothing can be written, in a folder of the user's state, under a name of this session. A
// file that this session has neither written nor taken over is never written over: it may be
// another session's, or wait for an answer. The project file itself is never touched.
//
// For the window's thread, which waits for nothing here: what it costs there is a copy of the
// document for each write.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/editor/background.h"
#include "core/editing/document.h"

namespace elbowroom {

// What a session left behind.
struct LostWork {
  std::filesystem::path file;
  std::filesystem::path project;  // that it was of; empty: none yet
  Document document;
  std::filesystem::file_time_type when{};
};

// Beside the project.
std::filesystem::path recovery_of(const std::filesystem::path& project);
// What lies beside the project, if it is not older and says something else than `saved`.
std::optional<LostWork> lost_beside(const std::filesystem::path& project, const Document& saved);
// The newest in the folder that no living session writes. Files that can't be read are passed over.
std::optional<LostWork> lost_in(const std::filesystem::path& folder);
// XDG_STATE_HOME (else ~/.local/state)/elbowroom/recovery; empty without a home.
std::filesystem::path recovery_folder();

class Recovery {
 public:
  static constexpr double kDelay = 5;  // s from an edit to its writing, at most

  // Nothing is kept where `folder` is empty. `failed` is told, on another thread, once, that
  // nothing can be written.
  explicit Recovery(std::filesystem::path folder, std::function<void(Error)> failed = {});
  // Waits for a write under way. What is not forgotten stays for the next session.
  ~Recovery();
  Recovery(const Recovery&) = delete;
  Recovery& operator=(const Recovery&) = delete;

  // In every update: what is unsaved, by History's revision. `now` in seconds of a steady clock.
  void keep(const Document& document, std::uint64_t revision, const std::filesystem::path& project,
            double now);
  // When keep() has something to write; none: nothing waits.
  std::optional<double> due() const;
  // There is nothing unsaved (any more): what this session has written or taken over goes.
  void forget();
  // Lost work that has become this session's: its file goes with the session's own.
  void take_over(const std::filesystem::path& file);
  // Lost work that nobody wants.
  void discard(const std::filesystem::path& file);

 private:
  struct Shared;  // with the writing thread

  std::filesystem::path folder_;
  std::shared_ptr<Shared> shared_;
  std::uint64_t kept_ = 0;  // the revision that has been handed over to be written
  std::uint64_t seen_ = 0;  // and the newest that waits
  std::optional<double> due_;
  bool clean_ = true;  // nothing has been handed over since the last forget()
  std::optional<BackgroundThread> thread_;
};

}  // namespace elbowroom
