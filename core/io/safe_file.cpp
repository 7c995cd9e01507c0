// SPDX-License-Identifier: MIT
#include "core/io/safe_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>

namespace elbowroom {
namespace {

namespace fs = std::filesystem;

constexpr int kMostLinks = 40;  // in a row, as the system has it

std::string remedy_of(int code, bool writing) {
  switch (code) {
    case ENOENT:
      return writing ? "make its folder first, or choose another place" : "check the path";
    case EACCES:
    case EPERM:
      return "check the permissions of the file and its folder";
    case ENOSPC:
    case EDQUOT:
      return "make room on the disk, or choose another place";
    case EROFS:
      return "choose another place";
    case EFBIG:
      return "choose another file system";
    case EMFILE:
    case ENFILE:
      return "close other programs";
    case ENOTDIR:
    case EISDIR:
    case ELOOP:
    case ENAMETOOLONG:
      return "check the path";
    default:
      return writing ? "choose another place" : "check the disk, or take a copy of the file";
  }
}

Error unreadable(const std::string& doing, const fs::path& file, int code) {
  return Error{doing + ": " + std::strerror(code), file.string(), remedy_of(code, false)};
}

Error unwritable(const fs::path& file, int code) {
  return Error{std::string("cannot be written: ") + std::strerror(code), file.string(),
               remedy_of(code, true)};
}

// A file descriptor that closes itself.
struct Descriptor {
  int fd;
  ~Descriptor() {
    if (fd >= 0) ::close(fd);
  }
};

int open_retrying(const fs::path& file, int flags, mode_t mode = 0) {
  int fd;
  do {
    fd = ::open(file.c_str(), flags | O_CLOEXEC, mode);
  } while (fd < 0 && errno == EINTR);
  return fd;
}

int sync_retrying(int fd) {
  int result;
  do {
    result = ::fsync(fd);
  } while (result < 0 && errno == EINTR);
  return result;
}

// The folder's entry for a renamed file is synced too; file systems that cannot are left to it.
void sync_folder(const fs::path& folder) {
  const Descriptor directory{open_retrying(folder, O_RDONLY | O_DIRECTORY)};
  if (directory.fd >= 0) sync_retrying(directory.fd);
}

}  // namespace

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

Result<std::string> read_whole_file(const fs::path& file, std::uint64_t max_bytes) {
  // Non-blocking, so that a pipe somebody names does not hang the program before it is refused.
  const Descriptor in{open_retrying(file, O_RDONLY | O_NONBLOCK)};
  if (in.fd < 0) return unreadable("cannot be opened", file, errno);
  struct stat info {};
  if (::fstat(in.fd, &info) != 0) return unreadable("cannot be read", file, errno);
  if (!S_ISREG(info.st_mode)) return Error{"is not a regular file", file.string(), "name a file"};
  const auto size = static_cast<std::uint64_t>(info.st_size);
  if (size > max_bytes) {
    return Error{"is larger than " + std::to_string(max_bytes) + " bytes", file.string(),
                 "use a smaller file"};
  }
  std::string bytes(size, '\0');
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = ::read(in.fd, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return unreadable("cannot be read", file, errno);
    if (count == 0) break;
    done += static_cast<std::size_t>(count);
  }
  bytes.resize(done);
  return bytes;
}

fs::path place_written(const fs::path& file) {
  std::error_code failed;
  fs::path real = file;
  for (int links = 0; links < kMostLinks && fs::is_symlink(real, failed); ++links) {
    const fs::path to = fs::read_symlink(real, failed);
    if (failed) break;
    real = to.is_absolute() ? to : folder_of(real) / to;
  }
  const fs::path absolute = fs::absolute(real, failed);
  if (failed) return file.lexically_normal();
  const fs::path canonical = fs::weakly_canonical(absolute, failed);
  return failed ? absolute.lexically_normal() : canonical;
}

StagedFile::StagedFile(fs::path temporary, fs::path target)
    : temporary_(std::move(temporary)), target_(std::move(target)) {}

StagedFile::StagedFile(StagedFile&& other) noexcept
    : temporary_(std::move(other.temporary_)), target_(std::move(other.target_)) {
  other.temporary_.clear();
}

StagedFile& StagedFile::operator=(StagedFile&& other) noexcept {
  std::swap(temporary_, other.temporary_);
  std::swap(target_, other.target_);
  return *this;
}

StagedFile::~StagedFile() {
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

Result<StagedFile> StagedFile::stage(const fs::path& target, std::string_view bytes) {
  std::error_code ignored;
  const fs::path real = fs::is_symlink(target, ignored) ? place_written(target) : target;
  struct stat old {};
  const bool exists = ::stat(real.c_str(), &old) == 0;
  if (exists && !S_ISREG(old.st_mode)) {
    return Error{"is not a regular file, so it is not written over", target.string(),
                 "choose another name"};
  }

  static std::atomic<unsigned> counter{0};
  Descriptor out{-1};
  fs::path temporary;
  for (int tries = 0; out.fd < 0; ++tries) {
    temporary = folder_of(real) / (".elbowroom-" + std::to_string(::getpid()) + "-" +
                                   std::to_string(counter++) + ".tmp");
    out.fd = open_retrying(temporary, O_WRONLY | O_CREAT | O_EXCL, 0666);
    if (out.fd < 0 && (errno != EEXIST || tries == 100)) {
      return unwritable(target, errno);
    }
  }
  StagedFile staged(temporary, real);
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = ::write(out.fd, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return unwritable(target, errno);
    done += static_cast<std::size_t>(count);
  }
  if (exists && ::fchmod(out.fd, old.st_mode & 07777) != 0) {
    return unwritable(target, errno);
  }
  if (sync_retrying(out.fd) != 0) return unwritable(target, errno);
  const int closed = ::close(out.fd);
  out.fd = -1;
  if (closed != 0) return unwritable(target, errno);
  return staged;
}

Status StagedFile::commit() {
  if (temporary_.empty())
    return Error{"has been committed before", target_.string(), "stage it again"};
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) {
    return unwritable(target_, errno);
  }
  temporary_.clear();
  sync_folder(folder_of(target_));
  return Done{};
}

Status write_file_safely(const fs::path& target, std::string_view bytes) {
  auto staged = StagedFile::stage(target, bytes);
  if (!staged) return staged.error();
  return staged->commit();
}

Status copy_file_safely(const fs::path& from, const fs::path& to) {
  const auto bytes = read_whole_file(from);
  if (!bytes) return bytes.error();
  std::error_code ignored;
  if (fs::equivalent(from, to, ignored)) return Done{};
  return write_file_safely(to, *bytes);
}

}  // namespace elbowroom
