// SPDX-License-Identifier: MIT
// How the window looks at the document: camera, modes, tabs and sizes of panels. Changed by panels
// directly; kept in the settings file, not in the document.
#pragma once

#include <optional>
#include <string>

#include "render/camera.h"
#include "render/gizmo.h"
#include "ui/toolkit/timeline.h"

namespace elbowroom {

// What of a motion is shown.
enum class Compare {
  after,   // the corrected motion
  before,  // the source clip
  both,    // the corrected one, and the source as a ghost
};

enum class InspectorTab { limb, target, planner };

// Whose mouse habits: which button and key orbits, pans and zooms.
enum class Navigation { blender, maya };

// What the dialog that is open is for.
enum class Dialog {
  none,
  open,
  save_project,
  export_clip,
  add_object,
  shortcuts,
  limb_joints,          // which joints a limb has
  discard,              // unsaved work, before the window closes
  discard_for_opening,  // and before something else is opened
  recover,              // unsaved work of a session that did not end well
};

struct ViewState {
  Camera camera;
  bool framed = false;           // the camera has been set for this scene
  bool frame_all = false;        // asked for; the viewport does it
  bool frame_selection = false;  // asked for; the viewport does it
  Compare compare = Compare::both;
  bool follow = true;  // the camera goes along with the figure
  bool show_trails = true;
  bool show_limb = true;  // the selected limb in its own tone, its joints marked
  Navigation navigation = Navigation::blender;
  bool frames = false;  // times as frame numbers
  bool light_theme = false;
  double scale = 1;  // of the interface, 0.75 to 3

  InspectorTab tab = InspectorTab::limb;
  GizmoMode gizmo_mode = GizmoMode::translate;
  GizmoSpace gizmo_space = GizmoSpace::world;
  Vec3 turns{0.0};  // degrees, the hand target's orientation as its fields show it
  struct Rename {   // a correction's name that is being typed
    int correction = -1;
    std::string text;
    bool begins = false;  // the field takes the keyboard
  } rename;
  int swing_joint = 0;            // which of the limb's swings the map shows
  bool swing_in_picture = false;  // its cone is at the joint: while the pointer is on the map
  std::string joints_of;          // whose joints the dialog begins with; empty: the selected limb's
  bool placing_target = false;    // the next click on a surface puts the hand target there

  // Shares of the window that the panels take.
  float outliner_share = 0.16f, inspector_share = 0.215f, timeline_share = 0.29f;
  TimelineView timeline;

  Dialog dialog = Dialog::none;
};

}  // namespace elbowroom
