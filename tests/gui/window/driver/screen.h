// SPDX-License-Identifier: MIT
// A screen of its own that nobody sees: Xvfb on a free display, for as long as this lives.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

namespace elbowroom::test {

// What has to be installed for a window to be driven; empty: all is there.
std::string missing_packages();

class Screen {
 public:
  Screen(int width, int height);
  ~Screen();
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  // ":7"; empty if Xvfb did not come up.
  const std::string& display() const { return display_; }
  // Everything on it, as a PNG file.
  bool picture(const std::filesystem::path& file) const;

 private:
  pid_t server_ = -1;
  std::string display_;
};

}  // namespace elbowroom::test
