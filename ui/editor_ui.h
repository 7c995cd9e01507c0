// SPDX-License-Identifier: MIT
// The whole window's contents for one frame: menu bar above, outliner left, viewport in the middle,
// inspector right, timeline below, status line under all, dialogs over them. Works in any Dear
// ImGui context, with a window or without one.
//
// The viewport's picture is not drawn here: its rectangle stays empty, and whoever owns the window
// paints it after the frame's commands have been carried out, so that a drag and what follows from
// it are in one frame.
#pragma once

#include <memory>

#include "render/frame.h"
#include "ui/commands.h"
#include "ui/editor_state.h"
#include "ui/toolkit/geometry.h"
#include "ui/toolkit/ui.h"

namespace elbowroom {

class SceneFrame;

class EditorUi {
 public:
  EditorUi();
  ~EditorUi();
  EditorUi(const EditorUi&) = delete;
  EditorUi& operator=(const EditorUi&) = delete;

  // Between ImGui::NewFrame and ImGui::Render.
  void draw(Ui& ui, const EditorState& state, ViewState& view, Commands& commands);

  // Where the viewport's picture belongs, in the pixels of the last frame drawn.
  Rect viewport() const;
  // The viewport is being dragged in, so that pictures should come fast rather than fine.
  bool dragging() const;
  // What the picture shows of a state. Moves the view's camera along with the figure. Good until
  // the next call.
  const Frame& frame(const EditorState& state, ViewState& view, double pixel_scale);

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace elbowroom
