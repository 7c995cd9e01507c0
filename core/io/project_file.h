// SPDX-License-Identifier: MIT
// The project file, NAME.elbow: JSON that holds everything a document holds; a person can read it
// and merge it with git. Paths in it are relative to the file's own folder. Version 1.
//
//     {
//       "version": 1,
//       "scene": {"character": "ada.glb", "clip": "Walk", "obstacles": ["posts.glb"],
//                 "attachments": [{"file": "umbrella.glb", "joint": "RightHand",
//                                  "translation": [x, y, z], "rotation": [x, y, z, w]}]},
//       "limbs": {"left_arm": ["Shoulder", "Wrist"], "tail": ["Tail1", "Tail3", "Tail6"],
//                 "right_leg": "none"},
//       "swing_limits": {"right_arm": {"root": [[-0.9, -1.2], [1.1, -1.2], [0.4, 1.3]]}},
//       "tasks": [{"kind": "correct", "name": "...", "clip": "Walk", "limb": "right_arm",
//                  "window": [1.2, 2.05], "seed": 7, "alternatives": 1, "clearance": 0,
//                  "max_iterations": 4000, "max_seconds": 0, "sampling": {"Elbow, flexion":
//                  [1.2, 2.4]}}],
//       "draft": {"limb": "right_arm", "window": [1.2, 2.05], "wishes": {"right_arm": {...}}},
//       "corrections": [{"name": "...", "task": "...", "clip": "Walk", "limb": "right_arm",
//                        "window": [1.2, 2.05], "muted": false,
//                        "made_with": {"seed": 7, ...},
//                        "joints": [{"joint": "RightUpperArm", "node": 12, "times": [...],
//                                    "rotations": [[x, y, z, w], ...],
//                                    "derivatives": [[x, y, z, w], ...]}]}]
//     }
//
// A task without a clip is any clip's, a correction without one that of the clip chosen in `scene`.
// Limbs set by hand go from a joint to one below it, or over a middle between them, or are none;
// others are found. A limb's swing limits are polygons of its root, middle and end, their corners
// (first swing, second swing) from the zero pose in radians, in order round it. A window that is
// absent or "auto" is automatic. A target without orientation leaves the hand free. The draft is
// what the editor is preparing. Keys that this version doesn't know survive a save over the same
// file, at the top level, in the scene, in a limb's swing limits, and in tasks and corrections.
#pragma once

#include <filesystem>
#include <string>

#include "core/base/result.h"
#include "core/editing/document.h"

namespace elbowroom {

// Paths in the document are made absolute or relative to the current folder, ready to be opened.
// Error: not a project, damaged (with the place), or of a newer version than this program knows.
Result<Document> read_project(const std::filesystem::path& file);

// The text of the project that stands (or will stand) at `file`: paths relative to it, unknown keys
// carried over as write_project does. Error: something that is no project stands there, or one of a
// newer version.
Result<std::string> project_text(const std::filesystem::path& file, const Document& document,
                                 const std::filesystem::path& opened_from = {});

// Writes to a temporary name and renames. Unknown keys are carried over from the project that the
// document was opened from; without one, from a project that stands there already.
Status write_project(const std::filesystem::path& file, const Document& document,
                     const std::filesystem::path& opened_from = {});

}  // namespace elbowroom
