// SPDX-License-Identifier: MIT
// Options that several commands share: one definition and one spelling.
#pragma once

#include <cstdint>
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

// What is wrong with them as they were typed; reads nothing. Errors are wrong usage.
Status check_scene_options(const SceneOptions& options);

// The document that they mean. Requires check_scene_options; errors are a project file's.
Result<Document> document_from(const SceneOptions& options);

// A file's name that has to be given. Error: it is empty.
Status check_file_name(const std::string& file, const std::string& option);

// Numbers; `option` names the option for the error.
Result<double> parse_number(const std::string& text, const std::string& option);
Result<double> parse_length(const std::string& text, const std::string& option);  // not negative
// A whole number that 64 bits hold.
Result<std::uint64_t> parse_seed(const std::string& text);

// O.glb@JOINT[,X,Y,Z[,QX,QY,QZ,QW]]
Result<AttachedFile> parse_attachment(const std::string& text);
// X,Y,Z[,QX,QY,QZ,QW], world; the time is left at 0.
Result<HandTarget> parse_target(const std::string& text);
// A:B in seconds, or "auto" (none).
Result<std::optional<Interval>> parse_window(const std::string& text);
// T1,T2,... in seconds.
Result<std::vector<double>> parse_times(const std::string& text);

}  // namespace elbowroom
