// SPDX-License-Identifier: MIT
#include "ui/editor_ui.h"

#include <algorithm>
#include <cmath>

#include "ui/panels/dialogs.h"
#include "ui/panels/panel.h"
#include "ui/panels/viewport.h"
#include "ui/scene_frame.h"
#include "ui/toolkit/layout.h"

namespace elbowroom {
namespace {

constexpr float kMenuHeight = 33, kStatusHeight = 25;  // pixels at 100 %
constexpr float kLeastOutliner = 180, kLeastInspector = 270;
constexpr int kMostRowsInSight = 6;  // of the timeline, before it scrolls

}  // namespace

struct EditorUi::Data {
  SceneFrame scene;
  Viewport viewport;
  Dialogs dialogs;
  int told = 0;  // the newest notice that has been shown
};

EditorUi::EditorUi() : data_(std::make_unique<Data>()) {}
EditorUi::~EditorUi() = default;

Rect EditorUi::viewport() const { return data_->viewport.rect(); }
bool EditorUi::dragging() const { return data_->viewport.dragging(); }

const Frame& EditorUi::frame(const EditorState& state, ViewState& view, double pixel_scale) {
  const Frame& frame = data_->scene.make(state, view, pixel_scale);
  data_->viewport.follow(state, view, data_->scene);
  return frame;
}

void EditorUi::draw(Ui& ui, const EditorState& state, ViewState& view, Commands& commands) {
  const PanelContext context{ui, state, view, commands};
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float width = std::max(1.0f, std::floor(size.x)),
              height = std::max(1.0f, std::floor(size.y));
  const float menu = ui.px(kMenuHeight), status = ui.px(kStatusHeight);
  // Panels keep a size in which they can be read; the viewport takes what is left.
  const auto share_of = [](float share, float least, float whole) {
    return std::floor(std::clamp(share * whole, std::min(least, 0.4f * whole), 0.45f * whole));
  };
  const float left = share_of(view.outliner_share, ui.px(kLeastOutliner), width);
  const float right = share_of(view.inspector_share, ui.px(kLeastInspector), width);
  const int rows = state.session ? static_cast<int>(state.session->limbs.size()) : 0;
  const float least_timeline =
      kTransportHeight + least_timeline_height(std::min(rows, kMostRowsInSight));
  const float timeline = share_of(view.timeline_share, ui.px(least_timeline), height);
  const float top = menu, bottom = height - status - timeline;

  // What the picture shows is what a framing of the view and the gizmo rest on.
  frame(state, view, static_cast<double>(ui.scale()));
  draw_menu_bar(context, {{0, 0}, {width, menu}});
  draw_outliner(context, {{0, top}, {left, bottom}});
  data_->viewport.draw(context, {{left, top}, {width - right, bottom}}, data_->scene);
  draw_inspector(context, {{width - right, top}, {width, bottom}});
  draw_timeline(context, {{0, bottom}, {width, height - status}});
  draw_status_line(context, {{0, height - status}, {width, height}});

  const auto splitter_edit = [](double ratio, float& share) { share = static_cast<float>(ratio); };
  double ratio = static_cast<double>(left / width);
  if (splitter_between_columns(ui, "Outliner width", left, top, bottom, ratio, width, 0.08, 0.4,
                               0.16))
    splitter_edit(ratio, view.outliner_share);
  ratio = 1 - static_cast<double>(right / width);
  if (splitter_between_columns(ui, "Inspector width", width - right, top, bottom, ratio, width, 0.6,
                               0.92, 1 - 0.215))
    splitter_edit(1 - ratio, view.inspector_share);
  ratio = static_cast<double>(bottom / height);
  if (splitter_between_rows(ui, "Timeline height", bottom, 0, width, ratio, height, 0.4, 0.85,
                            0.68))
    splitter_edit(1 - ratio - static_cast<double>(status / height), view.timeline_share);

  data_->dialogs.draw(context);

  for (const Notice& notice : state.notices) {
    if (notice.id <= data_->told) continue;
    data_->told = notice.id;
    if (notice.kind == Notice::Kind::error) {
      Error text = notice.text;
      text.what = sentence(text.what);
      ui.toast(text);
    } else {
      const std::string where = notice.text.where.empty() ? "" : notice.text.where + ": ";
      ui.toast(notice.kind == Notice::Kind::good ? Tone::good : Tone::selection,
               where + sentence(notice.text.what), notice.text.remedy);
    }
  }
}

}  // namespace elbowroom
