// SPDX-License-Identifier: MIT
#include "core/io/project_file.h"

#include <algorithm>
#include <cmath>

#include "core/io/project_values.h"
#include "core/io/safe_file.h"
#include "core/scene/placeable.h"

namespace elbowroom {
namespace {

using namespace project_json;
constexpr int kVersion = 1;

std::filesystem::path resolved(const std::filesystem::path& folder, const Json& value,
                               const std::string& where) {
  const std::filesystem::path path = text_of(value, where);
  return path.is_absolute() || folder.empty() ? path : folder / path;
}

std::string relative_to(const std::filesystem::path& folder, const std::filesystem::path& file) {
  std::error_code error;
  const auto absolute_folder = std::filesystem::absolute(folder.empty() ? "." : folder, error);
  const auto absolute_file = std::filesystem::absolute(file, error);
  const auto relative =
      absolute_file.lexically_normal().lexically_relative(absolute_folder.lexically_normal());
  return (relative.empty() ? absolute_file : relative).generic_string();
}

Document document_of(const Json& root, const std::filesystem::path& folder) {
  Document document;
  if (root.contains("limbs")) document.limbs = limbs_of(root["limbs"], "/limbs");
  if (root.contains("swing_limits"))
    document.swing_limits = swing_limits_of(root["swing_limits"], "/swing_limits");
  const Json& scene = object_of(member(root, "scene", "/"), "/scene");
  document.scene.character =
      resolved(folder, member(scene, "character", "/scene"), "/scene/character");
  if (scene.contains("clip")) document.scene.clip = text_of(scene["clip"], "/scene/clip");
  if (scene.contains("obstacles"))
    for (const auto& file : array_of(scene["obstacles"], "/scene/obstacles"))
      document.scene.obstacles.push_back(resolved(folder, file, "/scene/obstacles"));
  if (scene.contains("attachments"))
    for (const auto& item : array_of(scene["attachments"], "/scene/attachments")) {
      const std::string where =
          "/scene/attachments/" + std::to_string(document.scene.attachments.size());
      object_of(item, where);
      AttachedFile attached;
      attached.file = resolved(folder, member(item, "file", where), where + "/file");
      attached.joint = text_of(member(item, "joint", where), where + "/joint");
      if (item.contains("translation")) {
        const auto v = numbers_of<3>(item["translation"], where + "/translation");
        attached.joint_from_object.translation = {v[0], v[1], v[2]};
        if (!is_placeable(attached.joint_from_object.translation))
          throw Damage{where + "/translation", "it is too far away"};
      }
      if (item.contains("rotation")) {
        const Quat rotation = quat_of(item["rotation"], where + "/rotation");
        if (glm::length(rotation) < 1e-6) throw Damage{where + "/rotation", "it is zero"};
        attached.joint_from_object.rotation = glm::normalize(rotation);
      }
      document.scene.attachments.push_back(attached);
    }

  if (root.contains("draft")) document.draft = draft_of(root["draft"], "/draft");
  if (root.contains("tasks"))
    for (const auto& item : array_of(root["tasks"], "/tasks")) {
      const std::string where = "/tasks/" + std::to_string(document.tasks.size());
      object_of(item, where);
      const std::string kind = text_of(member(item, "kind", where), where + "/kind");
      Task task;
      if (kind == task_kind_id(TaskKind::reach))
        task.kind = TaskKind::reach;
      else if (kind != task_kind_id(TaskKind::correct))
        throw Damage{where + "/kind", "this version knows no task \"" + kind + "\""};
      if (item.contains("name")) task.name = text_of(item["name"], where + "/name");
      if (item.contains("clip")) task.clip = text_of(item["clip"], where + "/clip");
      if (item.contains("limb")) task.limb = text_of(item["limb"], where + "/limb");
      task.window = window_of(item, where);
      if (task.kind == TaskKind::reach)
        task.target = target_of(member(item, "target", where), where + "/target");
      if (item.contains("even_if_free"))
        task.even_if_free = flag_of(item["even_if_free"], where + "/even_if_free");
      task.wishes = wishes_of(item, where);
      document.tasks.push_back(task);
    }

  if (root.contains("corrections"))
    for (const auto& item : array_of(root["corrections"], "/corrections")) {
      const std::string where = "/corrections/" + std::to_string(document.corrections.size());
      object_of(item, where);
      Correction correction;
      if (item.contains("name")) correction.name = text_of(item["name"], where + "/name");
      correction.limb = text_of(member(item, "limb", where), where + "/limb");
      const auto window = numbers_of<2>(member(item, "window", where), where + "/window");
      correction.begin = float_of(window[0], where + "/window");
      correction.end = float_of(window[1], where + "/window");
      if (item.contains("task")) correction.task = text_of(item["task"], where + "/task");
      // Projects from before corrections had a clip hold those of the one that is chosen.
      correction.clip =
          item.contains("clip") ? text_of(item["clip"], where + "/clip") : document.scene.clip;
      if (item.contains("muted")) correction.muted = flag_of(item["muted"], where + "/muted");
      if (item.contains("made_with"))
        correction.made_with =
            wishes_of(object_of(item["made_with"], where + "/made_with"), where + "/made_with");
      for (const auto& entry : array_of(member(item, "joints", where), where + "/joints")) {
        const std::string place = where + "/joints/" + std::to_string(correction.joints.size());
        object_of(entry, place);
        JointKeys keys;
        keys.joint = text_of(member(entry, "joint", place), place + "/joint");
        keys.node = static_cast<int>(
            std::clamp(number_of(member(entry, "node", place), place + "/node"), -1.0, 1e9));
        for (const auto& time : array_of(member(entry, "times", place), place + "/times"))
          keys.keys.times.push_back(float_of(number_of(time, place + "/times"), place + "/times"));
        for (const auto& value : array_of(member(entry, "rotations", place), place + "/rotations"))
          keys.keys.values.push_back(quat_of(value, place + "/rotations"));
        if (entry.contains("derivatives"))
          for (const auto& value : array_of(entry["derivatives"], place + "/derivatives"))
            keys.keys.derivatives.push_back(quat_of(value, place + "/derivatives"));
        // Of joints that follow a limb from elsewhere in the tree.
        if (entry.contains("translations"))
          for (const auto& value : array_of(entry["translations"], place + "/translations")) {
            const auto v = numbers_of<3>(value, place + "/translations");
            for (const double number : v) float_of(number, place + "/translations");
            keys.translations.emplace_back(v[0], v[1], v[2]);
          }
        if (!keys.translations.empty() && keys.translations.size() != keys.keys.times.size())
          throw Damage{place, "times and translations differ in number"};
        if (keys.keys.values.size() != keys.keys.times.size() ||
            (!keys.keys.derivatives.empty() &&
             keys.keys.derivatives.size() != keys.keys.times.size()))
          throw Damage{place, "times, rotations and derivatives differ in number"};
        correction.joints.push_back(std::move(keys));
      }
      document.corrections.push_back(std::move(correction));
    }
  return document;
}

// Members of `old` that `fresh` doesn't have, carried over.
void keep_unknown(Json& fresh, const Json& old) {
  if (!fresh.is_object() || !old.is_object()) return;
  for (const auto& [key, value] : old.items())
    if (!fresh.contains(key)) fresh[key] = value;
}

// Entries of two lists that have the same kind and name are the same entry.
void keep_unknown_in_list(Json& fresh, const Json& old) {
  if (!old.is_array()) return;
  for (Json& entry : fresh)
    for (const Json& other : old)
      if (other.is_object() && other.value("name", Json()) == entry.value("name", Json())) {
        keep_unknown(entry, other);
        break;
      }
}

Result<Json> parse_project(const std::filesystem::path& file) {
  const auto text = read_whole_file(file);
  if (!text) return text.error();
  Json root;
  std::string where = "it is no JSON";
  try {
    root = Json::parse(*text);
    where.clear();
  } catch (const Json::parse_error& problem) {
    const auto read = static_cast<std::ptrdiff_t>(std::min(problem.byte, text->size()));
    where += " from line " +
             std::to_string(1 + std::count(text->begin(), text->begin() + read, '\n')) + " on";
  } catch (const Json::exception&) {
    where += ": a number in it is too large";
  }
  if (!where.empty())
    return Error{"this is no project file: " + where, file.string(),
                 "if it was edited by hand or merged, look there for a missing or stray comma or "
                 "bracket"};
  if (!root.is_object())
    return Error{"this is no project file: it is no JSON object", file.string(), ""};
  const auto version = root.find("version");
  if (version == root.end() || !version->is_number_integer() || version->get<std::int64_t>() < 1)
    return Error{"this is no project file: it has no version", file.string(), ""};
  if (version->get<std::int64_t>() > kVersion)
    return Error{"the project is of version " + version->dump() +
                     ", and this program knows up to " + std::to_string(kVersion),
                 file.string(), "open it with a newer Elbowroom"};
  return root;
}

}  // namespace

Result<Document> read_project(const std::filesystem::path& file) {
  auto root = parse_project(file);
  if (!root) return root.error();
  try {
    return document_of(*root, file.parent_path());
  } catch (const Damage& damage) {
    return Error{damage.what, file.string() + " at " + damage.where, damage.remedy};
  } catch (const nlohmann::json::exception& problem) {
    return Error{problem.what(), file.string(), "correct it by hand or take an older copy"};
  }
}

Result<std::string> project_text(const std::filesystem::path& file, const Document& document,
                                 const std::filesystem::path& opened_from) {
  const auto folder = file.parent_path();
  Json root;
  root["version"] = kVersion;
  Json& scene = root["scene"];
  scene["character"] = relative_to(folder, document.scene.character);
  scene["clip"] = document.scene.clip;
  scene["obstacles"] = Json::array();
  for (const auto& obstacle : document.scene.obstacles)
    scene["obstacles"].push_back(relative_to(folder, obstacle));
  scene["attachments"] = Json::array();
  for (const auto& attached : document.scene.attachments)
    scene["attachments"].push_back(
        {{"file", relative_to(folder, attached.file)},
         {"joint", attached.joint},
         {"translation", json_of(attached.joint_from_object.translation)},
         {"rotation", json_of(attached.joint_from_object.rotation)}});
  root["limbs"] = json_of(document.limbs);
  root["swing_limits"] = json_of(document.swing_limits);
  root["draft"] = json_of(document.draft);
  root["tasks"] = Json::array();
  for (const auto& task : document.tasks) {
    Json item;
    item["kind"] = task_kind_id(task.kind);
    item["name"] = task.name;
    item["clip"] = task.clip;
    item["limb"] = task.limb;
    item["window"] = json_of(task.window);
    if (task.target) item["target"] = json_of(*task.target);
    if (task.even_if_free) item["even_if_free"] = true;
    put_wishes(item, task.wishes);
    root["tasks"].push_back(item);
  }
  root["corrections"] = Json::array();
  for (const auto& correction : document.corrections) {
    Json item;
    item["name"] = correction.name;
    item["task"] = correction.task;
    item["clip"] = correction.clip;
    item["limb"] = correction.limb;
    item["window"] = Json::array({correction.begin, correction.end});
    item["muted"] = correction.muted;
    put_wishes(item["made_with"], correction.made_with);
    item["joints"] = Json::array();
    for (const auto& joint : correction.joints) {
      Json entry;
      entry["joint"] = joint.joint;
      entry["node"] = joint.node;
      entry["times"] = joint.keys.times;
      entry["rotations"] = Json::array();
      for (const auto& value : joint.keys.values) entry["rotations"].push_back(json_of(value));
      entry["derivatives"] = Json::array();
      for (const auto& value : joint.keys.derivatives)
        entry["derivatives"].push_back(json_of(value));
      for (const auto& value : joint.translations) entry["translations"].push_back(json_of(value));
      item["joints"].push_back(entry);
    }
    root["corrections"].push_back(item);
  }

  std::error_code error;
  if (std::filesystem::exists(file, error)) {
    if (auto old = parse_project(file); !old)
      return Error{"something else stands there: " + old.error().what, file.string(),
                   "save under another name"};
  }
  const auto& carry = opened_from.empty() ? file : opened_from;
  if (std::filesystem::exists(carry, error)) {
    if (auto old = parse_project(carry)) {
      keep_unknown(root, *old);
      for (const char* part : {"scene", "draft"})
        if (old->contains(part)) keep_unknown(root[part], (*old)[part]);
      if (old->contains("swing_limits"))
        keep_unknown_of_swings(root["swing_limits"], (*old)["swing_limits"]);
      if (old->contains("tasks")) keep_unknown_in_list(root["tasks"], (*old)["tasks"]);
      if (old->contains("corrections"))
        keep_unknown_in_list(root["corrections"], (*old)["corrections"]);
    }
  }
  // Non-UTF-8 bytes of a name are replaced rather than thrown over.
  return root.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Status write_project(const std::filesystem::path& file, const Document& document,
                     const std::filesystem::path& opened_from) {
  const auto text = project_text(file, document, opened_from);
  if (!text) return text.error();
  return write_file_safely(file, *text);
}

}  // namespace elbowroom
