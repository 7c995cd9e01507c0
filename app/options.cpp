// SPDX-License-Identifier: MIT
#include "app/options.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>

#include "core/io/project_file.h"
#include "core/scene/placeable.h"

namespace elbowroom {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

std::optional<double> number_of(const std::string& text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace

void add_scene_options(CLI::App& command, SceneOptions& options) {
  command
      .add_option("project", options.project,
                  "a project file, PROJECT.elbow, instead of the options below")
      ->type_name("PROJECT.elbow");
  command.add_option("--character", options.character, "the character's file (.glb, .gltf, .vrm)")
      ->type_name("C.glb");
  command
      .add_option("--clip", options.clip, "its clip, by name or index; the first one if not given")
      ->type_name("NAME");
  command
      .add_option("--obstacles", options.obstacles,
                  "a file with obstacles; may be given more than once")
      ->type_name("O.glb")
      ->allow_extra_args(false);
  command
      .add_option("--attach", options.attachments,
                  "a file that follows a joint: O.glb@JOINT[,X,Y,Z[,QX,QY,QZ,QW]], placed in the "
                  "joint's own axes; may be given more than once")
      ->type_name("O.glb@JOINT,...")
      ->allow_extra_args(false);
}

Result<AttachedFile> parse_attachment(const std::string& text) {
  const std::string form = "the form is FILE@JOINT[,X,Y,Z[,QX,QY,QZ,QW]]";
  const auto at = text.rfind('@');
  if (at == std::string::npos || at == 0 || at + 1 == text.size())
    return Error{"no joint is named in \"" + text + "\"", "--attach", form};
  AttachedFile attached;
  attached.file = text.substr(0, at);
  // A joint's name may hold commas: only as many trailing fields as are numbers are taken.
  const auto fields = split(text.substr(at + 1), ',');
  std::size_t numbers = 0;
  while (numbers + 1 < fields.size() && numbers < 7 &&
         number_of(fields[fields.size() - 1 - numbers]))
    ++numbers;
  if (numbers != 0 && numbers != 3 && numbers != 7)
    return Error{std::to_string(numbers) + " numbers in \"" + text + "\"", "--attach", form};
  std::vector<double> value;
  for (std::size_t i = fields.size() - numbers; i < fields.size(); ++i)
    value.push_back(*number_of(fields[i]));
  for (std::size_t i = 0; i + numbers < fields.size(); ++i)
    attached.joint += (i ? "," : "") + fields[i];
  if (numbers >= 3) attached.joint_from_object.translation = {value[0], value[1], value[2]};
  if (!is_placeable(attached.joint_from_object.translation))
    return Error{"the place in \"" + text + "\" is too far away", "--attach",
                 "give it in scene units, near the joint"};
  if (numbers == 7) {
    const Quat rotation(value[6], value[3], value[4], value[5]);
    if (glm::length(rotation) < 1e-6)
      return Error{"the rotation in \"" + text + "\" is zero", "--attach", form};
    attached.joint_from_object.rotation = glm::normalize(rotation);
  }
  return attached;
}

Result<HandTarget> parse_target(const std::string& text) {
  const std::string form = "the form is X,Y,Z[,QX,QY,QZ,QW]";
  std::vector<double> value;
  for (const auto& part : split(text, ',')) {
    const auto number = number_of(part);
    if (!number) return Error{"\"" + part + "\" is no number", "--target", form};
    value.push_back(*number);
  }
  if (value.size() != 3 && value.size() != 7)
    return Error{std::to_string(value.size()) + " numbers in \"" + text + "\"", "--target", form};
  HandTarget target;
  target.position = {value[0], value[1], value[2]};
  if (!is_placeable(target.position))
    return Error{"the place in \"" + text + "\" is too far away", "--target",
                 "give it in scene units, near the character"};
  if (value.size() == 7) {
    const Quat rotation(value[6], value[3], value[4], value[5]);
    if (glm::length(rotation) < 1e-6)
      return Error{"the rotation in \"" + text + "\" is zero", "--target", form};
    target.orientation = glm::normalize(rotation);
  }
  return target;
}

Result<std::optional<Interval>> parse_window(const std::string& text) {
  if (text == "auto") return std::optional<Interval>();
  const auto parts = split(text, ':');
  const auto begin = parts.size() == 2 ? number_of(parts[0]) : std::nullopt;
  const auto end = parts.size() == 2 ? number_of(parts[1]) : std::nullopt;
  if (!begin || !end || !(*begin < *end))
    return Error{"\"" + text + "\" is no window", "--window",
                 "the form is BEGIN:END in seconds, BEGIN before END, or auto"};
  return std::optional<Interval>(Interval{*begin, *end});
}

Result<std::vector<double>> parse_times(const std::string& text) {
  std::vector<double> times;
  for (const auto& part : split(text, ',')) {
    const auto time = number_of(part);
    if (!time)
      return Error{"\"" + part + "\" is no time", "--times", "the form is T1,T2,... in seconds"};
    times.push_back(*time);
  }
  return times;
}

Status check_file_name(const std::string& file, const std::string& option) {
  if (!file.empty()) return Done{};
  return Error{"the name of the file is empty", option, "name a file"};
}

Result<double> parse_number(const std::string& text, const std::string& option) {
  const auto number = number_of(text);
  if (!number) return Error{"\"" + text + "\" is no number", option, "give one such as 0.5"};
  return *number;
}

Result<double> parse_length(const std::string& text, const std::string& option) {
  const auto number = number_of(text);
  if (!number || *number < 0)
    return Error{"\"" + text + "\" is no length", option,
                 "give a number of scene units, 0 or more"};
  return *number;
}

Result<std::uint64_t> parse_seed(const std::string& text) {
  std::uint64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end)
    return Error{"\"" + text + "\" is no seed", "--seed",
                 "give a whole number from 0 to 18446744073709551615"};
  return value;
}

Status check_scene_options(const SceneOptions& options) {
  if (!options.project.empty()) {
    if (!options.character.empty() || !options.obstacles.empty() || !options.attachments.empty())
      return Error{"a project file and scene options are given together", options.project,
                   "give one or the other"};
    return Done{};
  }
  if (options.character.empty())
    return Error{"there is no scene", "", "give PROJECT.elbow or --character FILE"};
  for (const auto& file : options.obstacles)
    if (Status named = check_file_name(file, "--obstacles"); !named) return named;
  for (const auto& text : options.attachments)
    if (const auto attached = parse_attachment(text); !attached) return attached.error();
  return Done{};
}

Result<Document> document_from(const SceneOptions& options) {
  if (!options.project.empty()) {
    auto document = read_project(options.project);
    if (document && !options.clip.empty()) document->scene.clip = options.clip;
    return document;
  }
  Document document;
  document.scene.character = options.character;
  document.scene.clip = options.clip;
  for (const auto& file : options.obstacles) document.scene.obstacles.emplace_back(file);
  for (const auto& text : options.attachments) {
    auto attached = parse_attachment(text);
    if (!attached) return attached.error();
    document.scene.attachments.push_back(*attached);
  }
  return document;
}

}  // namespace elbowroom
