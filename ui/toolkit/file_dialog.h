// SPDX-License-Identifier: MIT
// Opens and saves files inside the window: a list of the folder, a path to type (Tab completes),
// places and recent folders on the left. Errors are shown inside, and a file that exists is
// replaced only after a question.
//
//   open_dialog(dialog, start_folder);                       // once
//   if (auto path = file_dialog(ui, dialog, options)) …      // in every frame
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ui/toolkit/file_listing.h"
#include "ui/toolkit/ui.h"

namespace elbowroom {

enum class FilePurpose { open, save };

struct FileDialogOptions {
  std::string title = "Open";
  std::string action = "Open";  // the button: "Open", "Save", "Export"
  FilePurpose purpose = FilePurpose::open;
  std::vector<std::string> extensions = {};  // ".glb", ".gltf", ".vrm", ".elbow"; empty: all
  // When saving, what a name without one of these gets: the first one.
};

// Keep one; `recent` may be filled from the settings and saved with them.
struct FileDialog {
  bool open = false;
  std::filesystem::path folder;
  std::string path_text;  // as typed
  std::vector<std::filesystem::path> recent;  // folders, newest first; at most 8
  bool hidden = false, all_files = false;

  // What was found in the folder, when it was read, and where the keyboard is.
  std::vector<FileEntry> entries;
  std::optional<Error> error;
  std::string suggested_name;
  int selected = -1;
  bool stale = true, just_opened = false, scroll_to_selected = false, follow_text = false;
  std::optional<std::filesystem::path> to_replace;  // asked about
};

// Opens it at a folder, or at a file's folder with that name filled in. A folder that is not there
// gives way to its nearest parent that is.
void open_dialog(FileDialog& dialog, const std::filesystem::path& start);

// The chosen path, absolute, in the frame it is chosen in; the dialog is then closed. Escape closes
// it without one. Up and Down choose, Enter enters a folder or takes the file, Alt+Up goes up.
std::optional<std::filesystem::path> file_dialog(Ui& ui, FileDialog& dialog,
                                                 const FileDialogOptions& options);

}  // namespace elbowroom
