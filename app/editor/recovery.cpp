// SPDX-License-Identifier: MIT
#include "app/editor/recovery.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <set>
#include <utility>

#include "core/io/project_file.h"

namespace elbowroom {
namespace fs = std::filesystem;

// A file that is locked for as long as its session lives, however it ends.
class SessionLock {
 public:
  explicit SessionLock(fs::path file) : file_(std::move(file)) {
    handle_ = open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (handle_ >= 0) flock(handle_, LOCK_EX | LOCK_NB);
  }
  ~SessionLock() {
    if (handle_ < 0) return;
    unlink(file_.c_str());
    close(handle_);
  }
  SessionLock(const SessionLock&) = delete;
  SessionLock& operator=(const SessionLock&) = delete;

  static bool held(const fs::path& file) {
    const int handle = open(file.c_str(), O_RDWR | O_CLOEXEC);
    if (handle < 0) return false;
    const bool locked = flock(handle, LOCK_EX | LOCK_NB) != 0;
    close(handle);
    return locked;
  }

 private:
  fs::path file_;
  int handle_ = -1;
};

namespace {

constexpr const char* kExtension = ".recovery";

// "<pid>-<time>", no other session's, living or dead.
std::string session_name() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::to_string(getpid()) + "-" +
         std::to_string(std::chrono::duration_cast<std::chrono::microseconds>(now).count());
}

fs::path lock_of(const fs::path& folder, const std::string& session) {
  return folder / (session + ".lock");
}

// "mannequin.<session>.recovery" in the folder.
std::string session_of(const fs::path& file) {
  const std::string name = file.stem().string();
  const auto dot = name.rfind('.');
  return dot == std::string::npos ? "" : name.substr(dot + 1);
}

}  // namespace

fs::path recovery_of(const fs::path& project) { return project.string() + kExtension; }

std::optional<LostWork> lost_beside(const fs::path& project, const Document& saved) {
  std::error_code error;
  const fs::path file = recovery_of(project);
  const auto when = fs::last_write_time(file, error);
  if (error) return std::nullopt;
  const auto saved_at = fs::last_write_time(project, error);
  // Files written within one tick of the clock are of the same time; what differs is not thrown
  // away.
  if (error || when < saved_at) return std::nullopt;
  auto document = read_project(file);
  if (!document || *document == saved) return std::nullopt;
  return LostWork{file, project, std::move(*document), when};
}

std::optional<LostWork> lost_in(const fs::path& folder) {
  std::optional<LostWork> newest;
  std::error_code error;
  if (folder.empty()) return newest;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const fs::path& file = at->path();
    if (file.extension() != kExtension) continue;
    if (SessionLock::held(lock_of(folder, session_of(file)))) continue;
    std::error_code unreadable;
    const auto when = fs::last_write_time(file, unreadable);
    if (unreadable || (newest && newest->when >= when)) continue;
    auto document = read_project(file);
    if (!document) continue;
    // They are relative to the folder of the user's state, which nobody wants to read.
    SceneDescription& scene = document->scene;
    scene.character = scene.character.lexically_normal();
    for (fs::path& obstacle : scene.obstacles) obstacle = obstacle.lexically_normal();
    for (AttachedFile& held : scene.attachments) held.file = held.file.lexically_normal();
    newest = LostWork{file, {}, std::move(*document), when};
  }
  return newest;
}

fs::path recovery_folder() {
  fs::path folder;
  if (const char* state = std::getenv("XDG_STATE_HOME"); state && *state)
    folder = state;
  else if (const char* home = std::getenv("HOME"); home && *home)
    folder = fs::path(home) / ".local" / "state";
  return folder.empty() ? folder : folder / "elbowroom" / "recovery";
}

// Used by the writing thread's jobs alone, one after the other, and by ~Recovery after them.
struct Recovery::Shared {
  fs::path folder;
  std::function<void(Error)> failed;
  std::string session = session_name();
  std::optional<SessionLock> lock;
  std::set<fs::path> own;  // written or taken over by this session
  bool told = false;

  Status write_in_folder(const Document& document, const fs::path& project, fs::path& place) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (!lock) lock.emplace(lock_of(folder, session));
    const fs::path& named = project.empty() ? document.scene.character : project;
    place = folder / (named.stem().string() + "." + session + kExtension);
    return write_project(place, document, project);
  }

  void write(const Document& document, const fs::path& project) {
    fs::path place;
    Status written = Error{};
    std::error_code error;
    if (!project.empty()) {
      place = recovery_of(project);
      if (own.contains(place) || !fs::exists(place, error))
        written = write_project(place, document, project);
    }
    if (!written) written = write_in_folder(document, project, place);
    if (!written) {
      if (failed && !std::exchange(told, true)) failed(written.error());
      return;
    }
    // One is enough: what was written elsewhere, or was taken over, is older.
    for (const fs::path& old : own)
      if (old != place) fs::remove(old, error);
    own = {place};
  }

  void remove_all() {
    std::error_code error;
    for (const fs::path& file : own) fs::remove(file, error);
    own.clear();
  }
};

Recovery::Recovery(fs::path folder, std::function<void(Error)> failed)
    : folder_(std::move(folder)), shared_(std::make_shared<Shared>()) {
  shared_->folder = folder_;
  shared_->failed = std::move(failed);
  if (!folder_.empty()) thread_.emplace();
}

Recovery::~Recovery() {
  if (!thread_) return;
  thread_.reset();
  // Jobs that were waiting are forgotten with the thread; nothing unsaved, nothing left.
  if (clean_) shared_->remove_all();
}

void Recovery::keep(const Document& document, std::uint64_t revision, const fs::path& project,
                    double now) {
  if (!thread_) return;
  if (revision != seen_) {
    seen_ = revision;
    // Counted from the first edit that has not been written, so that a hand that never rests
    // loses no more than the delay.
    if (revision != kept_ && !due_) due_ = now + kDelay;
  }
  if (!due_ || now < *due_) return;
  due_.reset();
  kept_ = revision;
  clean_ = false;
  thread_->run([shared = shared_, document, project](const std::stop_token&) {
    shared->write(document, project);
  });
}

std::optional<double> Recovery::due() const { return due_; }

void Recovery::forget() {
  due_.reset();
  kept_ = seen_ = 0;
  if (!thread_ || std::exchange(clean_, true)) return;
  thread_->run([shared = shared_](const std::stop_token&) { shared->remove_all(); });
}

void Recovery::take_over(const fs::path& file) {
  if (!thread_) return;
  clean_ = false;
  thread_->run([shared = shared_, file](const std::stop_token&) { shared->own.insert(file); });
}

void Recovery::discard(const fs::path& file) {
  if (!thread_) return;
  thread_->run([file](const std::stop_token&) {
    std::error_code error;
    fs::remove(file, error);
  });
}

}  // namespace elbowroom
