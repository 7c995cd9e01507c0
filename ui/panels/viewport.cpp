// SPDX-License-Identifier: MIT
#include "ui/panels/viewport.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "render/style.h"
#include "ui/toolkit/text.h"

namespace elbowroom {
namespace {

constexpr float kClickReach = 4;           // pixels that a click may move
constexpr double kOrbitPerPixel = 0.0075;  // radians
constexpr double kZoomPerNotch = 0.88;     // of the distance
constexpr double kZoomPerPixel = 0.006;
constexpr double kSnapLength = 0.01;  // scene units, with Ctrl
constexpr double kSnapAngle = 5 * kPi / 180;

ImU32 packed(Rgb rgb, float opacity) {
  return IM_COL32((rgb >> 16) & 0xffu, (rgb >> 8) & 0xffu, rgb & 0xffu,
                  static_cast<int>(255 * std::clamp(opacity, 0.0f, 1.0f)));
}

void paint(ImDrawList& list, ImVec2 origin, const GizmoPart& part) {
  std::vector<ImVec2> points;
  points.reserve(part.points.size());
  for (const auto& p : part.points)
    points.emplace_back(origin.x + static_cast<float>(p.x), origin.y + static_cast<float>(p.y));
  const ImU32 colour = packed(part.colour, part.opacity);
  const auto size = static_cast<float>(part.size);
  const int count = static_cast<int>(points.size());
  switch (part.kind) {
    case GizmoPart::Kind::line:
      list.AddPolyline(points.data(), count, colour, ImDrawFlags_None, size);
      break;
    case GizmoPart::Kind::loop:
      list.AddPolyline(points.data(), count, colour, ImDrawFlags_Closed, size);
      break;
    case GizmoPart::Kind::polygon:
      list.AddConvexPolyFilled(points.data(), count, colour);
      break;
    case GizmoPart::Kind::disc:
      if (count > 0) list.AddCircleFilled(points.front(), size, colour);
      break;
  }
}

float pill_width(const Ui& ui, const std::string& text) {
  return size_of(ui.fonts().small, text).x + 2 * ui.px(9);
}

// A few words on a quiet ground. `anchor`: 0 left, 0.5 middle, 1 right of the place given.
void pill(const Ui& ui, ImDrawList& list, ImVec2 at, float anchor, const std::string& text,
          Tone tone = Tone::quiet) {
  ImFont* font = ui.fonts().small;
  const float pad = ui.px(9), height = ui.px(25);
  const float width = pill_width(ui, text);
  const ImVec2 min{std::floor(at.x - anchor * width), std::floor(at.y)};
  list.AddRectFilled(min, {min.x + width, min.y + height}, with_opacity(ui.palette().panel, 0.86f),
                     ui.px(4));
  draw_text(list, font, {min.x + pad, middle(min.y, height, font)}, ui.colour(tone), text);
}

// How far a handle has been dragged, beside the pointer; in the picture, wherever that has gone.
void show_drag_amount(const Ui& ui, ImDrawList& list, const Rect& picture, std::string amount) {
  for (auto at = amount.find('-'); at != std::string::npos; at = amount.find('-', at))
    amount.replace(at, 1, "−");
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const bool to_the_left = mouse.x + ui.px(18) + pill_width(ui, amount) > picture.max.x;
  const float x = to_the_left ? std::min(mouse.x - ui.px(18), picture.max.x - ui.px(8))
                              : std::max(mouse.x + ui.px(18), picture.min.x + ui.px(8));
  const float y = std::clamp(mouse.y + ui.px(14), picture.min.y + ui.px(8),
                             std::max(picture.min.y + ui.px(8), picture.max.y - ui.px(36)));
  pill(ui, list, {x, y}, to_the_left ? 1.0f : 0.0f, amount, Tone::selection);
}

const char* compare_text(Compare compare) {
  switch (compare) {
    case Compare::after:
      return "After";
    case Compare::before:
      return "Before";
    case Compare::both:
      return "Before + after";
  }
  return "";
}

Tone target_tone(TargetView::Status status) {
  switch (status) {
    case TargetView::Status::solved:
      return Tone::good;
    case TargetView::Status::none:
    case TargetView::Status::solving:
      return Tone::quiet;
    default:
      return Tone::problem;
  }
}

}  // namespace

GizmoView Viewport::gizmo_view(const ViewState& view) const {
  GizmoView result;
  result.camera = view.camera;
  result.width = std::max(1.0, static_cast<double>(rect_.width()));
  result.height = std::max(1.0, static_cast<double>(rect_.height()));
  return result;
}

glm::dvec2 Viewport::mouse_in_picture() const {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  return {static_cast<double>(mouse.x - rect_.min.x), static_cast<double>(mouse.y - rect_.min.y)};
}

void Viewport::draw(const PanelContext& context, const Rect& rect, const SceneFrame& scene) {
  rect_ = rect;
  camera_keys(context, scene);
  // Not inside the viewport's own panel, which would lie over it and take its clicks: of panels,
  // the one made first is on top.
  if (!context.state.open()) {
    drag_ = Drag::none;
    draw_welcome(context, rect);
    return;
  }
  const Panel panel(context.ui, "Viewport", rect, {PanelGround::none, false, false});
  ImGui::SetCursorScreenPos(rect.min);
  ImGui::InvisibleButton("picture", {rect.width(), rect.height()},
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
  context.ui.record(WidgetKind::picture, "Picture", rect.min, rect.max);
  const bool hovered = ImGui::IsItemHovered();
  gizmo(context, hovered);
  mouse(context, hovered);
  overlay(context);
}

void Viewport::camera_keys(const PanelContext& context, const SceneFrame& scene) {
  ViewState& view = context.view;
  if (!context.state.open() || scene.states().empty()) return;
  const double aspect =
      static_cast<double>(rect_.width()) / std::max(1.0, static_cast<double>(rect_.height()));
  if (!view.framed) {
    view.camera = with_preset(view.camera, ViewPreset::three_quarter);
    view.camera =
        elbowroom::framed(view.camera, scene.points_of_figure(context.state, false), aspect, 0.14);
    view.framed = true;
  }
  if (view.frame_all) {
    view.camera =
        elbowroom::framed(view.camera, scene.points_of_figure(context.state, true), aspect, 0.08);
    view.frame_all = false;
  }
  if (view.frame_selection) {
    view.camera =
        elbowroom::framed(view.camera, scene.points_of_selection(context.state), aspect, 0.15);
    view.frame_selection = false;
  }
}

void Viewport::follow(const EditorState& state, ViewState& view, const SceneFrame& scene) {
  const auto place = scene.figure_place();
  if (place && followed_ && followed_session_ == state.session && view.follow) {
    // Along the ground only: a step's up and down is to be seen.
    view.camera.focus.x += place->x - followed_->x;
    view.camera.focus.z += place->z - followed_->z;
  }
  followed_ = place;
  followed_session_ = state.session;
}

void Viewport::gizmo(const PanelContext& context, bool hovered) {
  hovered_ = drag_ == Drag::gizmo ? gizmo_drag_.handle() : GizmoHandle::none;
  const auto& target = context.state.document->draft.target;
  if (!target || context.state.limb < 0 || context.view.compare == Compare::before) {
    if (drag_ == Drag::gizmo) drag_ = Drag::none;
    return;
  }
  const GizmoView gizmo_view = this->gizmo_view(context.view);
  GizmoPose pose;
  pose.place = target->position;
  if (target->orientation) pose.rotation = *target->orientation;
  GizmoOptions options;
  options.mode = context.view.gizmo_mode;
  options.space = context.view.gizmo_space;
  options.pixel_scale = static_cast<double>(context.ui.scale());
  options.size *= options.pixel_scale;
  if (drag_ == Drag::none && hovered)
    hovered_ =
        hit(make_gizmo(gizmo_view, pose, options), mouse_in_picture(), 6 * options.pixel_scale);
  options.hovered = hovered_;
  if (drag_ == Drag::gizmo) {
    options.dragged = gizmo_drag_.handle();
    const bool snap = ImGui::GetIO().KeyCtrl;
    const GizmoPose moved = gizmo_drag_.drag_to(
        mouse_in_picture(), !snap                                          ? 0
                            : context.view.gizmo_mode == GizmoMode::rotate ? kSnapAngle
                                                                           : kSnapLength);
    // Escape and the right button put it back.
    if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape)) ||
        ImGui::IsMouseClicked(ImGuiMouseButton_Right)) {
      drag_ = Drag::none;
      context.emit(command::SetTarget{target, Phase::cancelled});
      return;
    }
    HandTarget next = *target;
    next.position = moved.place;
    if (context.view.gizmo_mode == GizmoMode::rotate || target->orientation)
      next.orientation = moved.rotation;
    const bool released = !ImGui::IsMouseDown(ImGuiMouseButton_Left);
    const char* what =
        context.view.gizmo_mode == GizmoMode::rotate ? "Turn hand target" : "Move hand target";
    if (released || next != *target)
      context.emit(command::SetTarget{next, released ? Phase::committed : Phase::changing, what});
    if (released) drag_ = Drag::none;
    pose = moved;
  } else if (hovered_ != GizmoHandle::none) {
    context.ui.hint(context.view.gizmo_mode == GizmoMode::rotate
                        ? "Drag to turn the hand target; Ctrl snaps, Esc puts it back"
                        : "Drag to move the hand target; Ctrl snaps, Esc puts it back");
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
      gizmo_drag_ =
          begin_drag(gizmo_view, pose, options.space, hovered_, mouse_in_picture(), options.size);
      drag_ = Drag::gizmo;
    }
  }
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.PushClipRect(rect_.min, rect_.max, true);
  if (drag_ == Drag::gizmo)
    for (const GizmoPart& part : gizmo_drag_.guides()) paint(list, rect_.min, part);
  const GizmoShape shape = make_gizmo(gizmo_view, pose, options);
  for (const GizmoPart& part : shape.parts) paint(list, rect_.min, part);
  if (drag_ == Drag::gizmo) show_drag_amount(context.ui, list, rect_, gizmo_drag_.label());
  list.PopClipRect();
  // The middle of the gizmo, for tests and for whoever reads the window as text.
  const Vec3 middle = gizmo_view.to_pixels(pose.place);
  if (gizmo_view.can_show(pose.place)) {
    const ImVec2 at{rect_.min.x + static_cast<float>(middle.x),
                    rect_.min.y + static_cast<float>(middle.y)};
    context.ui.record(WidgetKind::mark, "Hand target", {at.x - 5, at.y - 5}, {at.x + 5, at.y + 5});
  }
}

void Viewport::emit_click(const PanelContext& context) const {
  const glm::dvec2 at = mouse_in_picture();
  const GizmoView view = gizmo_view(context.view);
  const WorldRay ray = view.ray(at);
  context.emit(command::Click{ray.origin, ray.direction, context.view.placing_target});
}

void Viewport::mouse(const PanelContext& context, bool hovered) {
  const ImGuiIO& io = ImGui::GetIO();
  ViewState& view = context.view;
  if (hovered && io.MouseWheel != 0)
    view.camera = zoomed(view.camera, std::pow(kZoomPerNotch, static_cast<double>(io.MouseWheel)));
  if (drag_ == Drag::gizmo) return;
  if (hovered && drag_ == Drag::none && hovered_ == GizmoHandle::none) {
    const bool maya = view.navigation == Navigation::maya;
    for (int button = 0; button < 3; ++button) {
      if (!ImGui::IsMouseClicked(button)) continue;
      button_ = button;
      pressed_at_ = last_ = io.MousePos;
      const bool left = button == ImGuiMouseButton_Left, right = button == ImGuiMouseButton_Right;
      if (maya && io.KeyAlt)
        drag_ = left ? Drag::orbit : right ? Drag::zoom : Drag::pan;
      else if (left)
        drag_ = view.placing_target ? Drag::place : Drag::press;
      else if (right || maya)
        drag_ = Drag::pan;
      else  // Blender's middle button
        drag_ = io.KeyShift ? Drag::pan : io.KeyCtrl ? Drag::zoom : Drag::orbit;
    }
    if (view.placing_target)
      context.ui.hint("Click a surface to put the hand target there; Esc leaves this mode");
    else
      context.ui.hint(maya
                          ? "Click: choose a limb · Alt drag: orbit · Alt middle: pan · Wheel: zoom"
                          : "Click: choose a limb · Drag: orbit · Right or Shift middle: pan · "
                            "Wheel: zoom");
  }
  if (view.placing_target && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape)))
    view.placing_target = false;
  if (drag_ == Drag::none) return;
  const ImVec2 moved{io.MousePos.x - last_.x, io.MousePos.y - last_.y};
  last_ = io.MousePos;
  const double height = std::max(1.0, static_cast<double>(rect_.height()));
  const double dx = static_cast<double>(moved.x), dy = static_cast<double>(moved.y);
  const bool far = std::hypot(io.MousePos.x - pressed_at_.x, io.MousePos.y - pressed_at_.y) >
                   context.ui.px(kClickReach);
  if (drag_ == Drag::press && far) {
    drag_ = Drag::orbit;
    view.camera =
        orbited(view.camera, -static_cast<double>(io.MousePos.x - pressed_at_.x) * kOrbitPerPixel,
                static_cast<double>(io.MousePos.y - pressed_at_.y) * kOrbitPerPixel);
  } else if (drag_ == Drag::orbit) {
    if (view.camera.orthographic && (dx != 0 || dy != 0)) view.camera.orthographic = false;
    view.camera = orbited(view.camera, -dx * kOrbitPerPixel, dy * kOrbitPerPixel);
  } else if (drag_ == Drag::pan) {
    view.camera = panned(view.camera, -dx / height, dy / height);
  } else if (drag_ == Drag::zoom) {
    view.camera = zoomed(view.camera, std::exp((dy - dx) * kZoomPerPixel));
  }
  if (ImGui::IsMouseDown(button_)) return;
  if (drag_ == Drag::press || (drag_ == Drag::place && !far)) {
    emit_click(context);
    view.placing_target = false;
  }
  drag_ = Drag::none;
}

void Viewport::overlay(const PanelContext& context) const {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const Ui& ui = context.ui;
  const EditorState& state = context.state;
  const float inset = ui.px(12);
  list.PushClipRect(rect_.min, rect_.max, true);
  const std::string shown = compare_text(context.view.compare);
  const std::string view_words =
      std::string(context.view.camera.orthographic ? "Orthographic" : "Perspective") + " · " +
      shown;
  float room = rect_.width() - 3 * inset;  // for the words at the upper left
  // How much room the selected limb has now.
  const auto& strip = context.view.compare == Compare::before ? state.source_strip : state.strip;
  const bool known = context.view.compare == Compare::before || state.strip_is_current;
  if (strip && known && state.limb >= 0 && state.limb < static_cast<int>(strip->limbs.size())) {
    if (const StripSample* sample =
            strip_sample_at(strip->limbs[static_cast<std::size_t>(state.limb)], state.time)) {
      const bool far = !sample->contact && state.session &&
                       sample->clearance >= 0.999 * kStripReach * state.session->character().height;
      const std::string text =
          sample->contact
              ? (sample->depth > 0 ? "Collides, " + length_text(sample->depth) + " deep"
                                   : std::string("Collides"))
              : "Clearance " + std::string(far ? "over " : "") + length_text(sample->clearance);
      const std::string whole = text + " at " + time_text(state, context.view, state.time);
      pill(ui, list, {rect_.max.x - inset, rect_.min.y + inset}, 1, whole,
           sample->contact ? Tone::problem : Tone::quiet);
      room -= pill_width(ui, whole);
    }
  }
  for (const std::string& words : {view_words, shown}) {
    if (pill_width(ui, words) > room) continue;
    pill(ui, list, {rect_.min.x + inset, rect_.min.y + inset}, 0, words);
    break;
  }
  std::string words;
  Tone tone = Tone::text;
  if (context.view.placing_target) {
    words = "Click a surface to put the hand target there. Esc leaves it.";
  } else if (state.document->draft.target && state.target.status != TargetView::Status::none) {
    words = state.target.text;
    tone = target_tone(state.target.status);
  } else if (state.candidate) {
    words = "The plan is shown as a ghost. Enter accepts it, Del discards it.";
    if (pill_width(ui, words) > rect_.width() - 2 * inset) words = "Enter accepts, Del discards";
  }
  // What doesn't fit on one line is shortened; the inspector says it whole.
  if (pill_width(ui, words) > rect_.width() - 2 * inset) {
    const std::size_t end = words.find(": ");
    if (end != std::string::npos) words.resize(end);
  }
  if (!words.empty())
    pill(ui, list, {0.5f * (rect_.min.x + rect_.max.x), rect_.max.y - inset - ui.px(25)}, 0.5f,
         words, tone);
  list.PopClipRect();
}

}  // namespace elbowroom
