// SPDX-License-Identifier: MIT
// The viewport: the camera under the mouse, picking, the gizmo at the hand target, and the few
// words that lie over the picture.
#pragma once

#include "render/gizmo.h"
#include "ui/panels/panel.h"
#include "ui/scene_frame.h"

namespace elbowroom {

class Viewport {
 public:
  void draw(const PanelContext& context, const Rect& rect, const SceneFrame& scene);

  // Moves the camera along with the figure, if the view asks for it. After each frame made.
  void follow(const EditorState& state, ViewState& view, const SceneFrame& scene);

  const Rect& rect() const { return rect_; }
  bool dragging() const { return drag_ != Drag::none; }

 private:
  enum class Drag { none, press, orbit, pan, zoom, gizmo, place };

  void camera_keys(const PanelContext& context, const SceneFrame& scene);
  void mouse(const PanelContext& context, bool hovered);
  void gizmo(const PanelContext& context, bool hovered);
  void overlay(const PanelContext& context) const;
  GizmoView gizmo_view(const ViewState& view) const;
  void emit_click(const PanelContext& context) const;
  glm::dvec2 mouse_in_picture() const;

  Rect rect_{};
  Drag drag_ = Drag::none;
  int button_ = 0;
  ImVec2 pressed_at_{0, 0}, last_{0, 0};
  std::optional<Vec3> followed_;  // where the figure was
  const Session* followed_session_ = nullptr;
  GizmoDrag gizmo_drag_;
  GizmoHandle hovered_ = GizmoHandle::none;
};

}  // namespace elbowroom
