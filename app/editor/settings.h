// SPDX-License-Identifier: MIT
// What the editor remembers between runs, apart from documents: how the window looks and which
// files were open. A JSON file under XDG_CONFIG_HOME (else ~/.config)/elbowroom.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "ui/view_state.h"

namespace elbowroom {

struct Settings {
  ViewState view;  // only what outlives a run: shares, theme, scale, navigation, display modes
  std::vector<std::string> recent_files;
  int window_width = 1600, window_height = 1000;
};

// Empty if there is no home.
std::filesystem::path settings_file();

// Defaults for whatever is missing or makes no sense; a damaged file is as none.
Settings read_settings(const std::filesystem::path& file);
Status write_settings(const std::filesystem::path& file, const Settings& settings);

}  // namespace elbowroom
