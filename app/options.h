// SPDX-License-Identifier: MIT
// Options that several commands share: one definition and one spelling.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/editing/document.h"
#include "core/scene/scene_description.h"

namespace CLI {
class App;
}

namespace elbowroom {

// SCENE-ARGS as typed: PROJECT.elbow, or --character and what goes with it.
struct SceneOptions {
  std::string project;
  std::string character;
  std::string clip;
  std::vector<std::string> obstacles;
  std::vector<std::string> attachments;
};
void add_scene_options(CLI::App& command, SceneOptions& options);

// What SCENE-ARGS and LIMB mean. Errors are wrong usage (exit 1) unless a project file can't be
// read.
Result<Document> document_from(const SceneOptions& options);

// O.glb@JOINT[,X,Y,Z[,QX,QY,QZ,QW]]
Result<AttachedFile> parse_attachment(const std::string& text);
// X,Y,Z[,QX,QY,QZ,QW], world; the time is left at 0.
Result<HandTarget> parse_target(const std::string& text);
// A:B in seconds, or "auto" (none).
Result<std::optional<Interval>> parse_window(const std::string& text);
// T1,T2,... in seconds.
Result<std::vector<double>> parse_times(const std::string& text);

}  // namespace elbowroom
