// SPDX-License-Identifier: MIT
// What every panel is handed: the style, the record of widgets, the hint of the status line and the
// messages that pop up. A thin layer over Dear ImGui: panels may call ImGui for layout (SameLine,
// columns), but make their widgets through the toolkit, so that tests can find them.
//
// One Ui serves one Dear ImGui context, on the thread that draws.
#pragma once

#include <imgui.h>

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/base/result.h"
#include "ui/toolkit/fonts.h"
#include "ui/toolkit/probe.h"
#include "ui/toolkit/theme.h"

namespace elbowroom {

// Where an edit stands. A drag is `began`, any number of `changing`, then `committed` or
// `cancelled`; a click is `committed` alone. The value belongs into the document's history at
// `committed` only: one drag is one undo step.
struct Edit {
  bool began = false;
  bool changed = false;    // the value is another than in the last frame
  bool committed = false;  // let go, and the value is another than at the beginning
  bool cancelled = false;  // Escape, or let go there: the value is the one from the beginning
  explicit operator bool() const { return changed || committed; }
};

struct Toast {
  Tone tone = Tone::text;
  std::string what, where, remedy;
  double seconds_left = 5;  // problems stay until they are dismissed
};

class Ui {
 public:
  Ui(Theme theme, Fonts fonts, double scale);

  // After ImGui::NewFrame: forgets the last frame's widgets and hint.
  void begin_frame();
  // Before ImGui::Render: draws the toasts, above `bottom` (0: the window's edge).
  void end_frame(float bottom = 0);
  // After load_fonts and apply with another theme or scale.
  void restyle(Theme theme, Fonts fonts, double scale);

  const Theme& theme() const { return theme_; }
  const Palette& palette() const { return theme_.palette; }
  ImU32 colour(Tone tone) const { return theme_.palette.of(tone); }
  const Fonts& fonts() const { return fonts_; }
  float scale() const { return scale_; }
  // Pixels at 100 % as whole pixels on this screen; at least 1 where size is above 0.
  float px(float size) const;

  // The status line: what a click would do here. The last word of the frame holds.
  void hint(std::string_view text) { hint_ = text; }
  // What the status line shows: the hint of the last whole frame, so that any panel may draw it.
  const std::string& hint_text() const { return last_hint_; }

  void toast(Tone tone, std::string text, std::string remedy = {});
  void toast(const Error& error);
  const std::vector<Toast>& toasts() const { return toasts_; }
  // Whether something moves by itself (a toast about to go), so that idle windows draw on.
  bool animating() const;

  // For widgets that answer arrows, Home and Enter while they were clicked last, in every frame in
  // which they do; shortcuts then leave these keys alone.
  // Enter only where the widget was come to by keyboard: after a drag by mouse it is still the
  // window's (Accept).
  void take_keys(bool enter) {
    takes_keys_ = true;
    takes_enter_ = takes_enter_ || enter;
  }
  // Whether a widget has that key of Dear ImGui's, as of the last whole frame.
  bool has_keys(int key) const;

  Probe& probe() { return probe_; }
  const Probe& probe() const { return probe_; }
  // Records a widget of this frame. `label` in Dear ImGui's form ("Shown##id").
  void record(WidgetKind kind, std::string_view label, ImVec2 min, ImVec2 max,
              std::string value = {}, bool enabled = true, bool selected = false);

  // Names and Dear ImGui ids inside belong together: "Inspector", then "Limb".
  class Scope {
   public:
    Scope(Ui& ui, std::string_view name);
    Scope(Ui& ui, int number);  // for the rows of a list; no part of the path
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Ui* ui_;
    bool named_;
  };
  [[nodiscard]] Scope scope(std::string_view name) { return Scope(*this, name); }
  [[nodiscard]] Scope scope(int number) { return Scope(*this, number); }

  // A part of the path without an id of its own, for menus and dialogs.
  void enter(std::string_view name) { path_.emplace_back(name_part(name)); }
  void leave() {
    if (!path_.empty()) path_.pop_back();
  }

  // For widgets of the toolkit: numbers that an item keeps while it is dragged.
  std::vector<double>& memory(ImGuiID item) { return memory_[item]; }
  // And the text being typed into it.
  std::string& text_memory(ImGuiID item) { return text_memory_[item]; }

 private:
  void draw_toast(std::size_t index, float& bottom);

  Theme theme_;
  Fonts fonts_;
  float scale_ = 1;
  Probe probe_;
  std::vector<std::string> path_;
  std::string hint_, last_hint_;
  bool takes_keys_ = false, last_takes_keys_ = false;
  bool takes_enter_ = false, last_takes_enter_ = false;
  std::vector<Toast> toasts_;
  std::unordered_map<ImGuiID, std::vector<double>> memory_;
  std::unordered_map<ImGuiID, std::string> text_memory_;
  friend class Scope;
};

// ---- Text on whole pixels -----------------------------------------------------------------------

ImVec2 size_of(ImFont* font, std::string_view text);
// Draws with the upper left at `at`, rounded; what is wider than `width` (> 0) ends in "…".
// Returns the width drawn.
float draw_text(ImDrawList& list, ImFont* font, ImVec2 at, ImU32 colour, std::string_view text,
                float width = 0);

}  // namespace elbowroom
