// SPDX-License-Identifier: MIT
// The whole program but its window: an Editor with its threads, the panels, and a user who sees
// widgets by name and uses mouse and keyboard. Every frame does what the window does, but for the
// picture.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "app/editor/editor.h"
#include "tests/gui/driver/ui_driver.h"
#include "ui/editor_ui.h"
#include "ui/toolkit/timeline_scale.h"

namespace elbowroom {

// The demo, from the build folder; as app/demo_document.h makes it.
Document demo_scene();

// A folder of its own for a test's files, removed with all that is in it.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

class EditorDriver {
 public:
  // Unsaved work is kept in `recovery`; empty: nowhere.
  explicit EditorDriver(float width = 1600, float height = 1000,
                        const std::filesystem::path& recovery = {});

  const EditorState& state() const { return editor.state(); }
  ViewState& view() { return editor.view(); }
  const Document& document() const { return *state().document; }
  const Draft& draft() const { return document().draft; }

  void handle(const Command& command) {
    editor.handle(command);
    ui.frame();
  }
  // Frames in real time until it holds; false (and a test failure) if it doesn't in time.
  bool wait_until(const std::function<bool()>& holds, double seconds = 60);
  // Nothing is going on in the background.
  bool settle(double seconds = 60);

  // A scene that is read; its contacts may still be looked for.
  bool open(const Document& document);
  // The demo with its strip.
  bool open_demo();
  // The same scene's first problem of that limb, planned. Needs a complete strip.
  bool plan(int limb, int window = 0);

  int limb(const std::string& name) const;  // index in the session; -1: none
  // The first limb with a problem, -1 if none has.
  int colliding_limb() const;

  // Chooses "Clip/Next problem".
  void choose_menu(const std::string& menu, const std::string& item);
  // Where a time is on the timeline's rows.
  float x_of(double t) const;
  ImVec2 on_row(int limb, double t);
  std::string row_name(int limb) const;

  Editor editor;
  EditorUi panels;
  UiDriver ui;
  Commands said;          // by the panels, since it was cleared last
  bool carry_out = true;  // what the panels say; false: it is only written down

 private:
  void draw(Ui& toolkit);
  double clock_ = 0;
};

}  // namespace elbowroom
