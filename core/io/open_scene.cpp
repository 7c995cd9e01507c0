// SPDX-License-Identifier: MIT
#include "core/io/open_scene.h"

#include <map>

#include "core/io/gltf_reader.h"
#include "core/scene/joint_name.h"
#include "core/scene/placeable.h"

namespace elbowroom {
namespace {

// At most a dozen names, for an error message.
std::string list_of(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i == 12) return text + ", ... (" + std::to_string(names.size()) + " in all)";
    text += (i ? ", " : "") + (names[i].empty() ? "\"\"" : names[i]);
  }
  return text;
}

std::shared_ptr<const Clip> first_clip(const std::shared_ptr<const Model>& model) {
  if (model->clips.empty()) return nullptr;
  return {model, &model->clips.front()};  // shares the model's life
}

}  // namespace

Result<OpenedScene> open_scene(const SceneDescription& description) {
  OpenedScene scene;
  std::map<std::filesystem::path, std::shared_ptr<const Model>> read;
  auto open = [&](const std::filesystem::path& file) -> Result<std::shared_ptr<const Model>> {
    const auto known = read.find(file);
    if (known != read.end()) return known->second;
    auto model = read_gltf(file);
    if (!model) return model.error();
    for (const auto& warning : (*model)->warnings)
      scene.warnings.push_back(file.filename().string() + ": " + warning);
    read.emplace(file, *model);
    return *model;
  };

  auto character = open(description.character);
  if (!character) return character.error();
  const std::shared_ptr<const Model> model = *character;
  if (model->characters.empty())
    return Error{"there is no character in it: no mesh is bound to a skeleton (no skin)",
                 description.character.string(),
                 "give a file with a skinned figure as the character, and others as obstacles"};
  // Of several characters the one with most triangles is meant; the others are part of the scene.
  for (std::size_t i = 1; i < model->characters.size(); ++i)
    if (model->characters[i].triangles >
        model->characters[static_cast<std::size_t>(scene.character)].triangles)
      scene.character = static_cast<int>(i);

  Actor actor;
  actor.name = description.character.filename().string();
  actor.model = model;
  if (!description.clip.empty()) {
    scene.clip = model->find_clip(description.clip);
    if (scene.clip < 0) {
      std::vector<std::string> names;
      for (const auto& clip : model->clips) names.push_back(clip.name);
      return Error{"there is no clip \"" + description.clip + "\"", description.character.string(),
                   names.empty() ? "the file has no clips"
                                 : "its clips, by name or index from 0: " + list_of(names)};
    }
  } else if (!model->clips.empty()) {
    scene.clip = 0;
  }
  if (scene.clip >= 0) actor.clip = {model, &model->clips[static_cast<std::size_t>(scene.clip)]};
  scene.world.actors.push_back(actor);

  for (const auto& file : description.obstacles) {
    auto obstacle = open(file);
    if (!obstacle) return obstacle.error();
    Actor placed;
    placed.name = file.filename().string();
    placed.model = *obstacle;
    placed.clip = first_clip(*obstacle);
    scene.world.actors.push_back(placed);
  }
  for (const auto& attached : description.attachments) {
    auto prop = open(attached.file);
    if (!prop) return prop.error();
    const Character& figure = model->characters[static_cast<std::size_t>(scene.character)];
    const NamedJoint named = joint_of_name(*model, figure, attached.joint);
    const int joint = named.node;
    if (!is_placeable(attached.joint_from_object.translation))
      return Error{"it would be attached too far away", attached.file.string(),
                   "give a place near the joint, in scene units"};
    if (named.namesakes > 0)
      scene.warnings.push_back(description.character.filename().string() + ": " +
                               std::to_string(named.namesakes + 1) + " joints are named " +
                               attached.joint + "; " + attached.file.filename().string() +
                               " follows node " + std::to_string(joint) +
                               " (name another one by its index in the file's nodes)");
    if (joint < 0) {
      const auto& joints = figure.joints;
      std::vector<std::string> names;
      for (int j : joints)
        names.push_back(model->skeleton.joints[static_cast<std::size_t>(j)].name);
      return Error{"there is no joint \"" + attached.joint + "\" to attach " +
                       attached.file.filename().string() + " to",
                   description.character.string(), "its joints: " + list_of(names)};
    }
    Actor placed;
    placed.name = attached.file.filename().string();
    placed.model = *prop;
    placed.clip = first_clip(*prop);
    Attachment attachment;
    attachment.actor = 0;
    attachment.joint = joint;
    attachment.joint_from_object = attached.joint_from_object;
    placed.attachment = attachment;
    scene.world.actors.push_back(placed);
  }
  return scene;
}

}  // namespace elbowroom
