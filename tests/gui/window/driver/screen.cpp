// SPDX-License-Identifier: MIT
#include "tests/gui/window/driver/screen.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <sstream>

#include "tests/support/run_program.h"

namespace elbowroom::test {
namespace {

constexpr int kStartMs = 20000;  // that Xvfb may take to say its display

std::string path_of(const std::string& tool) {
  const char* all = std::getenv("PATH");
  std::istringstream folders(all ? all : "/usr/bin:/bin");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::string file = folder + "/" + tool;
    if (access(file.c_str(), X_OK) == 0) return file;
  }
  return {};
}

}  // namespace

std::string missing_packages() {
  static constexpr std::array<std::array<const char*, 2>, 3> kTools = {
      {{"Xvfb", "xvfb"}, {"xdotool", "xdotool"}, {"import", "imagemagick"}}};
  std::string missing;
  for (const auto& [tool, package] : kTools)
    if (path_of(tool).empty())
      missing += (missing.empty() ? "needs the package " : ", ") + std::string(package);
  return missing;
}

Screen::Screen(int width, int height) {
  int ends[2];
  if (pipe(ends) != 0) return;
  const std::string program = path_of("Xvfb"), number = std::to_string(ends[1]),
                    size = std::to_string(width) + "x" + std::to_string(height) + "x24";
  server_ = fork();
  if (server_ == 0) {
    close(ends[0]);
    const int nowhere = open("/dev/null", O_RDWR);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    // Without -noreset it starts over when the last client leaves, just as the next one comes.
    execl(program.c_str(), "Xvfb", "-displayfd", number.c_str(), "-screen", "0", size.c_str(),
          "-nolisten", "tcp", "-noreset", static_cast<char*>(nullptr));
    _exit(127);
  }
  close(ends[1]);
  std::string text;
  pollfd waiting{ends[0], POLLIN, 0};
  while (text.find('\n') == std::string::npos && poll(&waiting, 1, kStartMs) > 0) {
    char buffer[32];
    const ssize_t count = read(ends[0], buffer, sizeof buffer);
    if (count <= 0) break;
    text.append(buffer, static_cast<std::size_t>(count));
  }
  close(ends[0]);
  if (text.find('\n') != std::string::npos) display_ = ":" + text.substr(0, text.find('\n'));
}

Screen::~Screen() {
  if (server_ <= 0) return;
  kill(server_, SIGTERM);
  waitpid(server_, nullptr, 0);
}

bool Screen::picture(const std::filesystem::path& file) const {
  std::filesystem::create_directories(file.parent_path());
  return run_program(path_of("import"), {"-display", display_, "-window", "root", file})
             .exit_code == 0;
}

}  // namespace elbowroom::test
