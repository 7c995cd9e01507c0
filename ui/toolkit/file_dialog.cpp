// SPDX-License-Identifier: MIT
#include "ui/toolkit/file_dialog.h"

#include <algorithm>

#include "ui/toolkit/buttons.h"
#include "ui/toolkit/feedback.h"
#include "ui/toolkit/fields.h"
#include "ui/toolkit/layout.h"
#include "ui/toolkit/lists.h"
#include "ui/toolkit/text.h"

namespace elbowroom {
namespace {

namespace fs = std::filesystem;

ListingFilter filter_of(const FileDialog& dialog, const FileDialogOptions& options) {
  return {dialog.all_files ? std::vector<std::string>() : options.extensions, dialog.hidden};
}

std::string with_slash(const fs::path& folder) {
  std::string text = folder.string();
  if (text.empty() || text.back() != '/') text += '/';
  return text;
}

void go_to(FileDialog& dialog, fs::path folder) {
  folder = folder.lexically_normal();
  if (!folder.has_filename() && folder.has_relative_path()) folder = folder.parent_path();
  dialog.folder = folder;
  dialog.path_text = with_slash(folder) + dialog.suggested_name;
  dialog.selected = -1;
  dialog.stale = true;
  dialog.to_replace.reset();
}

void read(FileDialog& dialog, const FileDialogOptions& options) {
  dialog.stale = false;
  dialog.error.reset();
  auto listing = list_folder(dialog.folder, filter_of(dialog, options));
  if (listing) {
    dialog.entries = std::move(listing).value();
  } else {
    dialog.entries.clear();
    dialog.error = listing.error();
  }
  dialog.selected = std::min(dialog.selected, static_cast<int>(dialog.entries.size()) - 1);
}

void select(FileDialog& dialog, int index) {
  dialog.selected = index;
  dialog.scroll_to_selected = true;
  if (index < 0) return;
  const FileEntry& entry = dialog.entries[static_cast<std::size_t>(index)];
  dialog.path_text = with_slash(dialog.folder) + entry.name + (entry.folder ? "/" : "");
  if (!entry.folder && !dialog.suggested_name.empty()) dialog.suggested_name = entry.name;
}

void remember(FileDialog& dialog, const fs::path& folder) {
  std::erase(dialog.recent, folder);
  dialog.recent.insert(dialog.recent.begin(), folder);
  if (dialog.recent.size() > 8) dialog.recent.resize(8);
}

// The typed path: a folder is entered, a file taken, everything else is an error said inside.
std::optional<fs::path> take(FileDialog& dialog, const FileDialogOptions& options) {
  fs::path path = path_meant(dialog.path_text, dialog.folder);
  std::error_code ignored;
  dialog.error.reset();
  if (fs::is_directory(path, ignored)) {
    const bool here = (path / "").lexically_normal() == (dialog.folder / "").lexically_normal();
    if (here) {
      dialog.error = Error{options.purpose == FilePurpose::save ? "The file has no name yet"
                                                                : "No file is chosen",
                           {}, options.purpose == FilePurpose::save
                                   ? "Type a name after the folder"
                                   : "Choose one in the list, or type its name"};
    } else {
      go_to(dialog, path);
    }
    return std::nullopt;
  }
  if (options.purpose == FilePurpose::open) {
    if (!fs::exists(path, ignored)) {
      dialog.error = Error{"There is no such file", path.string(), "Choose one in the list"};
      return std::nullopt;
    }
    if (!fs::is_regular_file(path, ignored)) {
      dialog.error = Error{"This is no file", path.string(), "Choose one in the list"};
      return std::nullopt;
    }
    return path;
  }
  if (path.filename().empty()) {
    dialog.error = Error{"There is no such folder", path.string(), "Create it first"};
    return std::nullopt;
  }
  if (!options.extensions.empty()) {
    std::string extension = path.extension().string();
    for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    const auto& known = options.extensions;
    if (std::find(known.begin(), known.end(), extension) == known.end()) path += known.front();
  }
  if (!fs::is_directory(path.parent_path(), ignored)) {
    dialog.error = Error{"There is no such folder", path.parent_path().string(), "Create it first"};
    return std::nullopt;
  }
  if (fs::exists(path, ignored)) {
    dialog.to_replace = path;
    return std::nullopt;
  }
  return path;
}

void places(Ui& ui, FileDialog& dialog) {
  const auto scope = ui.scope("Places");
  const auto place = [&](std::string_view name, Icon icon, const fs::path& folder) {
    const std::string where = folder.string();
    if (list_row(ui, name, {.icon = icon, .selected = dialog.folder == folder, .hint = where})
            .clicked) {
      go_to(dialog, folder);
    }
  };
  place("Home", Icon::home, home_folder());
  place("Computer", Icon::folder, "/");
  if (dialog.recent.empty()) return;
  heading(ui, "Recent");
  const std::vector<fs::path> recent = dialog.recent;  // a click may reorder it
  for (std::size_t i = 0; i < recent.size(); ++i) {
    const std::string name = recent[i].filename().string();
    place((name.empty() ? "/" : name) + "##" + std::to_string(i), Icon::folder, recent[i]);
  }
}

// True when an entry is to be taken (double-click on a file).
bool listing(Ui& ui, FileDialog& dialog) {
  const auto scope = ui.scope("Files");
  bool chosen = false;
  const float row = ui.px(ui.theme().metrics.row);
  if (dialog.entries.empty() && !dialog.error) {
    label(ui, "Nothing to show here", {}, Tone::faint);
  }
  if (dialog.scroll_to_selected && dialog.selected >= 0) {
    const float top = row * static_cast<float>(dialog.selected);
    const float seen = ImGui::GetWindowHeight() - 2 * ImGui::GetStyle().WindowPadding.y;
    if (top < ImGui::GetScrollY()) ImGui::SetScrollY(top);
    if (top + row > ImGui::GetScrollY() + seen) ImGui::SetScrollY(top + row - seen);
    dialog.scroll_to_selected = false;
  }
  std::optional<fs::path> enter;
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(dialog.entries.size()), row);
  while (clipper.Step()) {
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      const FileEntry& entry = dialog.entries[static_cast<std::size_t>(i)];
      const auto id = ui.scope(i);
      const std::string size = entry.folder ? std::string() : size_text(entry.bytes);
      // "##" in a file's name is no id.
      std::string name = entry.name;
      for (std::size_t at = 0; (at = name.find("##", at)) != std::string::npos; at += 2) {
        name.replace(at, 2, "#\u200b#");
      }
      const RowResult result =
          list_row(ui, name, {.icon = entry.folder ? Icon::folder : Icon::file,
                              .icon_tone = entry.folder ? Tone::accent : Tone::quiet,
                              .right = size, .selected = i == dialog.selected});
      if (result.clicked) {
        select(dialog, i);
        dialog.to_replace.reset();
      }
      if (result.double_clicked) {
        select(dialog, i);
        if (entry.folder) {
          enter = dialog.folder / entry.name;
        } else {
          chosen = true;
        }
      }
    }
  }
  clipper.End();
  if (enter) go_to(dialog, *enter);
  return chosen;
}

bool pressed(ImGuiKey key, bool repeat = false) {
  return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), repeat);
}

}  // namespace

void open_dialog(FileDialog& dialog, const fs::path& start) {
  std::error_code ignored;
  fs::path folder = start.empty() ? fs::current_path(ignored) : fs::absolute(start, ignored);
  dialog.suggested_name.clear();
  if (!fs::is_directory(folder, ignored)) {
    dialog.suggested_name = folder.filename().string();
    folder = folder.parent_path();
  }
  while (!fs::is_directory(folder, ignored) && folder.has_relative_path()) {
    folder = folder.parent_path();
  }
  go_to(dialog, folder.empty() ? fs::path("/") : folder);
  dialog.open = dialog.just_opened = true;
  dialog.error.reset();
}

std::optional<fs::path> file_dialog(Ui& ui, FileDialog& dialog, const FileDialogOptions& options) {
  if (!dialog.open) return std::nullopt;
  if (dialog.stale) read(dialog, options);
  if (!begin_dialog(ui, options.title, dialog.open, {760, 520}, false)) return std::nullopt;
  const bool asking = dialog.to_replace.has_value();
  bool accept = false;
  std::optional<fs::path> result;

  // The path.
  if (icon_button(ui, "Up", Icon::chevron_up, {.shortcut = "Alt Up", .hint = "The folder above"}) ||
      (ImGui::GetIO().KeyAlt && pressed(ImGuiKey_UpArrow))) {
    go_to(dialog, dialog.folder.parent_path());
  }
  ImGui::SameLine();
  const auto complete = [&](const std::string& text) {
    return completed(text, dialog.folder, filter_of(dialog, options));
  };
  const TextEdit typed = text_input(ui, "Path", dialog.path_text,
                                    {.placeholder = "Type a path; Tab completes",
                                     .focus = dialog.just_opened, .label_shown = false,
                                     .complete = complete});
  dialog.just_opened = false;
  if (typed.changed) {
    dialog.to_replace.reset();
    dialog.selected = -1;
  }
  accept |= typed.entered;
  space(ui, 2);

  // Places and the folder's list.
  const float footer = ui.px(ui.theme().metrics.control) + ui.px(10) +
                       (dialog.error || asking ? ui.px(58) : 0);
  const float height = std::max(ui.px(60), ImGui::GetContentRegionAvail().y - footer);
  const float side = std::min(ui.px(150), ImGui::GetContentRegionAvail().x / 3);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(8), ui.px(4)});
  ImGui::BeginChild("places", {side, height}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
  places(ui, dialog);
  ImGui::EndChild();
  ImGui::SameLine();
  ImGui::PushStyleColor(ImGuiCol_ChildBg, ui.palette().ground);
  ImGui::BeginChild("files", {0, height}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
  accept |= listing(ui, dialog);
  ImGui::EndChild();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar();

  const int count = static_cast<int>(dialog.entries.size());
  if (count > 0 && !ImGui::GetIO().KeyAlt) {
    if (pressed(ImGuiKey_DownArrow, true)) select(dialog, std::min(dialog.selected + 1, count - 1));
    if (pressed(ImGuiKey_UpArrow, true)) select(dialog, std::max(dialog.selected - 1, 0));
  }
  // Enter outside the field (after a click in the list) does the same.
  accept |= !ImGui::GetIO().WantTextInput && !typed.entered && pressed(ImGuiKey_Enter);
  if (dialog.error) inline_error(ui, *dialog.error, false);
  if (asking) {
    inline_note(ui, Tone::problem, "Replace " + dialog.to_replace->filename().string() + "?",
                "The file is there already.");
  }

  // The last line.
  if (toggle(ui, "All files", dialog.all_files)) dialog.stale = true;
  ImGui::SameLine(0, ui.px(16));
  if (toggle(ui, "Hidden", dialog.hidden)) dialog.stale = true;
  const std::string action = asking ? std::string("Replace") : options.action;
  const ButtonOptions look{.look = asking ? ButtonLook::danger : ButtonLook::primary};
  const float buttons = button_width(ui, action, look) + button_width(ui, "Cancel") + ui.px(8);
  ImGui::SameLine(ImGui::GetWindowWidth() - buttons - ui.px(18));
  bool cancel = button(ui, "Cancel");
  ImGui::SameLine();
  const bool action_pressed = button(ui, action, look);
  if (pressed(ImGuiKey_Escape)) cancel = true;

  if (cancel && asking) {
    dialog.to_replace.reset();
  } else if (cancel) {
    dialog.open = false;
  } else if (asking && (action_pressed || accept)) {
    result = dialog.to_replace;
  } else if (accept || action_pressed) {
    result = take(dialog, options);
    if (!result && !dialog.to_replace) dialog.just_opened = true;  // back to the field
  }
  if (result) {
    remember(dialog, result->parent_path());
    dialog.open = false;
  }
  if (!dialog.open) ImGui::CloseCurrentPopup();
  end_dialog(ui);
  return result;
}

}  // namespace elbowroom
