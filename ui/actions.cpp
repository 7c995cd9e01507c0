// SPDX-License-Identifier: MIT
#include "ui/actions.h"

#include <vector>

namespace elbowroom {
namespace {

using State = const EditorState&;
using View = const ViewState&;

template <typename T>
auto emit(T command) {
  return [command](State, ViewState&, Commands& commands) { commands.emplace_back(command); };
}

bool is_open(State s, View) { return s.open(); }
bool has_clip(State s, View) { return s.source != nullptr; }
bool has_limb(State s, View) { return s.limb >= 0; }

Shortcut key(int k) { return {k, false, false, false, false}; }
Shortcut repeating(int k) { return {k, false, false, false, true}; }
Shortcut ctrl(int k, bool shift = false) { return {k, true, shift, false, false}; }
Shortcut shifted(int k) { return {k, false, true, false, false}; }

Action view_action(std::string_view title, Shortcut shortcut, ViewPreset preset) {
  return {"View",
          title,
          shortcut,
          {},
          [preset](State, ViewState& view, Commands&) {
            view.camera = with_preset(view.camera, preset, true);
          },
          {},
          false};
}

Action compare_action(std::string_view title, Shortcut shortcut, Compare compare, bool separated) {
  return {"View",
          title,
          shortcut,
          has_clip,
          [compare](State, ViewState& view, Commands&) { view.compare = compare; },
          [compare](State, View view) { return view.compare == compare; },
          separated};
}

std::vector<Action> make_actions() {
  using namespace command;
  const auto dialog = [](Dialog which) {
    return [which](State, ViewState& view, Commands&) { view.dialog = which; };
  };
  std::vector<Action> list;
  const auto add = [&list](Action action) { list.push_back(std::move(action)); };

  add({"File", "Open…", ctrl('O'), {}, dialog(Dialog::open), {}, false});
  add({"File", "Open the demo", {}, {}, emit(OpenDemo{}), {}, false});
  add({"File", "Add object…", {}, is_open, dialog(Dialog::add_object), {}, false});
  add({"File",
       "Save project",
       ctrl('S'),
       is_open,
       [](State s, ViewState& view, Commands& commands) {
         if (s.has_project)
           commands.emplace_back(SaveProject{});
         else
           view.dialog = Dialog::save_project;
       },
       {},
       true});
  add({"File",
       "Save project as…",
       ctrl('S', true),
       is_open,
       dialog(Dialog::save_project),
       {},
       false});
  add({"File", "Export clip…", ctrl('E'), has_clip, dialog(Dialog::export_clip), {}, true});
  add({"File", "Quit", ctrl('Q'), {}, emit(Quit{}), {}, true});

  add({"Edit",
       "Undo",
       ctrl('Z'),
       [](State s, View) { return !s.undo_name.empty(); },
       emit(Undo{}),
       {},
       false});
  add({"Edit",
       "Redo",
       ctrl('Z', true),
       [](State s, View) { return !s.redo_name.empty(); },
       emit(Redo{}),
       {},
       false});
  add({"",
       "Redo",
       ctrl('Y'),
       [](State s, View) { return !s.redo_name.empty(); },
       emit(Redo{}),
       {},
       false});

  add({"Edit",
       "Rename correction",
       key(Shortcut::f2),
       [](State s, View) {
         return s.selected_correction >= 0 &&
                s.selected_correction < static_cast<int>(s.document->corrections.size());
       },
       [](State s, ViewState& view, Commands&) {
         const int index = s.selected_correction;
         view.rename = {index, s.document->corrections[static_cast<std::size_t>(index)].name, true};
       },
       {},
       true});

  add({"View",
       "Frame selection",
       key('F'),
       is_open,
       [](State, ViewState& view, Commands&) { view.frame_selection = true; },
       {},
       false});
  add({"View",
       "Frame all",
       key(Shortcut::home),
       is_open,
       [](State, ViewState& view, Commands&) { view.frame_all = true; },
       {},
       false});
  list.push_back(view_action("Front", key('1'), ViewPreset::front));
  list.push_back(view_action("Side", key('3'), ViewPreset::side));
  list.push_back(view_action("Top", key('7'), ViewPreset::top));
  add({"View",
       "Orthographic",
       key('5'),
       {},
       [](State, ViewState& view, Commands&) {
         view.camera.orthographic = !view.camera.orthographic;
       },
       [](State, View view) { return view.camera.orthographic; },
       false});
  add({"View",
       "Follow the figure",
       key('C'),
       {},
       [](State, ViewState& view, Commands&) { view.follow = !view.follow; },
       [](State, View view) { return view.follow; },
       false});
  list.push_back(compare_action("After", shifted('1'), Compare::after, true));
  list.push_back(compare_action("Before", shifted('2'), Compare::before, false));
  list.push_back(compare_action("Before and after", shifted('3'), Compare::both, false));
  add({"View",
       "Motion trails",
       key('M'),
       {},
       [](State, ViewState& view, Commands&) { view.show_trails = !view.show_trails; },
       [](State, View view) { return view.show_trails; },
       true});
  add({"View",
       "Selected limb",
       key('L'),
       {},
       [](State, ViewState& view, Commands&) { view.show_limb = !view.show_limb; },
       [](State, View view) { return view.show_limb; },
       false});
  add({"View",
       "Light theme",
       {},
       {},
       [](State, ViewState& view, Commands&) { view.light_theme = !view.light_theme; },
       [](State, View view) { return view.light_theme; },
       true});
  add({"View",
       "Larger interface",
       ctrl('+'),
       {},
       [](State, ViewState& view, Commands&) { view.scale = std::min(3.0, view.scale + 0.25); },
       {},
       false});
  add({"View",
       "Smaller interface",
       ctrl('-'),
       {},
       [](State, ViewState& view, Commands&) { view.scale = std::max(0.75, view.scale - 0.25); },
       {},
       false});
  add({"View",
       "Interface at 100 %",
       ctrl('0'),
       {},
       [](State, ViewState& view, Commands&) { view.scale = 1; },
       {},
       false});
  add({"View",
       "Mouse as in Maya",
       {},
       {},
       [](State, ViewState& view, Commands&) {
         view.navigation =
             view.navigation == Navigation::maya ? Navigation::blender : Navigation::maya;
       },
       [](State, View view) { return view.navigation == Navigation::maya; },
       false});

  add({"Clip", "Play or pause", key(Shortcut::space), has_clip, emit(TogglePlay{}), {}, false});
  add({"Clip",
       "Loop",
       {},
       has_clip,
       emit(ToggleLoop{}),
       [](State s, View) { return s.loop; },
       false});
  add({"Clip", "Next frame", repeating(Shortcut::right), has_clip, emit(StepFrames{1}), {}, true});
  add({"Clip",
       "Previous frame",
       repeating(Shortcut::left),
       has_clip,
       emit(StepFrames{-1}),
       {},
       false});
  add({"Clip", "First frame", shifted(Shortcut::left), has_clip, emit(GoToEnd{false}), {}, false});
  add({"Clip", "Last frame", shifted(Shortcut::right), has_clip, emit(GoToEnd{true}), {}, false});
  add({"Clip", "Next problem", key('N'), has_clip, emit(GoToProblem{1}), {}, true});
  add({"Clip", "Previous problem", key('B'), has_clip, emit(GoToProblem{-1}), {}, false});
  add({"Clip",
       "Times as frames",
       {},
       {},
       [](State, ViewState& view, Commands&) { view.frames = !view.frames; },
       [](State, View view) { return view.frames; },
       true});

  add({"Plan",
       "Plan",
       key('P'),
       [](State s, View) { return s.source && !s.planning.active; },
       emit(Plan{}),
       {},
       false});
  add({"Plan",
       "Stop planning",
       key(Shortcut::escape),
       [](State s, View) { return s.planning.active; },
       emit(CancelPlan{}),
       {},
       false});
  add({"Plan",
       "Accept",
       key(Shortcut::enter),
       [](State s, View) { return s.candidate.has_value(); },
       emit(Accept{}),
       {},
       true});
  add({"Plan",
       "Discard",
       key(Shortcut::del),
       [](State s, View) { return s.candidate.has_value(); },
       emit(Discard{}),
       {},
       false});
  const auto several_ways = [](State s, View) { return s.candidate && s.ways.size() > 1; };
  add({"Plan",
       "Earlier way around",
       key(Shortcut::page_up),
       several_ways,
       [](State s, ViewState&, Commands& commands) { commands.emplace_back(ShowWay{s.way - 1}); },
       {},
       false});
  add({"Plan",
       "Later way around",
       key(Shortcut::page_down),
       several_ways,
       [](State s, ViewState&, Commands& commands) { commands.emplace_back(ShowWay{s.way + 1}); },
       {},
       false});
  add({"Plan",
       "Joints of the limbs…",
       {},
       [](State s, View) { return s.open(); },
       [](State, ViewState& view, Commands&) { view.dialog = Dialog::limb_joints; },
       {},
       true});
  add({"Plan",
       "Clear window",
       {},
       [](State s, View) { return s.document->draft.window.has_value(); },
       emit(SetWindow{std::nullopt, Phase::committed}),
       {},
       false});
  add({"Plan",
       "Hand target here",
       key('T'),
       has_limb,
       [](State, ViewState& view, Commands& commands) {
         view.tab = InspectorTab::target;
         commands.emplace_back(TargetFromPosture{});
       },
       {},
       true});
  add({"Plan", "Place hand target on a surface", shifted('T'), has_limb,
       [](State, ViewState& view, Commands&) {
         view.placing_target = !view.placing_target;
         view.tab = InspectorTab::target;
       },
       [](State, View view) { return view.placing_target; }, false});
  add({"Plan", "Move the target", key('G'), has_limb,
       [](State, ViewState& view, Commands&) { view.gizmo_mode = GizmoMode::translate; },
       [](State, View view) { return view.gizmo_mode == GizmoMode::translate; }, true});
  add({"Plan", "Turn the target", key('R'), has_limb,
       [](State, ViewState& view, Commands&) { view.gizmo_mode = GizmoMode::rotate; },
       [](State, View view) { return view.gizmo_mode == GizmoMode::rotate; }, false});
  add({"",
       "Move the target",
       key('W'),
       has_limb,
       [](State, ViewState& view, Commands&) { view.gizmo_mode = GizmoMode::translate; },
       {},
       false});
  add({"",
       "Turn the target",
       key('E'),
       has_limb,
       [](State, ViewState& view, Commands&) { view.gizmo_mode = GizmoMode::rotate; },
       {},
       false});
  add({"Plan", "Target in its own axes", key('X'), has_limb,
       [](State, ViewState& view, Commands&) {
         view.gizmo_space =
             view.gizmo_space == GizmoSpace::world ? GizmoSpace::local : GizmoSpace::world;
       },
       [](State, View view) { return view.gizmo_space == GizmoSpace::local; }, false});

  add({"Help", "Keyboard shortcuts", shifted('/'), {}, dialog(Dialog::shortcuts), {}, false});
  return list;
}

}  // namespace

std::span<const Action> actions() {
  static const std::vector<Action> list = make_actions();
  return list;
}

std::span<const std::string_view> menus() {
  static constexpr std::string_view list[] = {"File", "Edit", "View", "Clip", "Plan", "Help"};
  return list;
}

bool is_enabled(const Action& action, const EditorState& state, const ViewState& view) {
  return !action.enabled || action.enabled(state, view);
}

bool press(const Shortcut& key, const EditorState& state, ViewState& view, Commands& commands) {
  for (const Action& action : actions()) {
    Shortcut own = action.shortcut;
    own.repeats = key.repeats;
    if (own.key == Shortcut::none || !(own == key)) continue;
    if (key.repeats && !action.shortcut.repeats) continue;
    if (!is_enabled(action, state, view)) continue;
    action.run(state, view, commands);
    return true;
  }
  return false;
}

std::string shortcut_text(const Shortcut& shortcut) {
  if (shortcut.key == Shortcut::none) return {};
  std::string text;
  if (shortcut.ctrl) text += "Ctrl ";
  if (shortcut.alt) text += "Alt ";
  // What is typed with the shift key is known by its own sign.
  if (shortcut.key == '/' && shortcut.shift) return text + "?";
  if (shortcut.shift) text += "Shift ";
  switch (shortcut.key) {
    case Shortcut::space:
      return text + "Space";
    case Shortcut::escape:
      return text + "Esc";
    case Shortcut::enter:
      return text + "Enter";
    case Shortcut::tab:
      return text + "Tab";
    case Shortcut::home:
      return text + "Home";
    case Shortcut::end:
      return text + "End";
    case Shortcut::left:
      return text + "←";
    case Shortcut::right:
      return text + "→";
    case Shortcut::page_up:
      return text + "PgUp";
    case Shortcut::page_down:
      return text + "PgDn";
    case Shortcut::del:
      return text + "Del";
    case Shortcut::f1:
      return text + "F1";
    case Shortcut::f2:
      return text + "F2";
    default:
      return text + static_cast<char>(shortcut.key);
  }
}

}  // namespace elbowroom
