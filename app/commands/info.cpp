// SPDX-License-Identifier: MIT
#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "app/exit_codes.h"
#include "app/terminal.h"
#include "core/anatomy/limb_model.h"
#include "core/io/gltf_reader.h"
#include "core/io/project_file.h"

namespace elbowroom {
namespace {

using Json = nlohmann::ordered_json;

Json limb_json(const Model& model, const Limb& limb) {
  const auto name = [&](int joint) {
    return model.skeleton.joints[static_cast<std::size_t>(joint)].name;
  };
  // From root to end, those that hang elsewhere after the ones they serve: the last is the end.
  Json joints = Json::array(), following = Json::array();
  const auto put_following = [&](int served) {
    for (const FollowingJoint& other : limb.following)
      if (other.serves == served) joints.push_back(name(other.joint));
  };
  for (const int joint : limb.joints) {
    if (joint == limb.end) put_following(joint);
    joints.push_back(name(joint));
    if (joint != limb.end) put_following(joint);
  }
  for (const FollowingJoint& other : limb.following)
    following.push_back({{"joint", name(other.joint)}, {"serves", name(other.serves)}});
  Json beside = Json::array();
  for (const int joint : limb.beside) beside.push_back(name(joint));
  return {{"joints", joints},      {"root", name(limb.root)}, {"middle", name(limb.middle)},
          {"end", name(limb.end)}, {"beside", beside},        {"following", following},
          {"why", limb.why}};
}

void print_text(const Model& model, const Json& info) {
  std::printf("%s\n", model.path.string().c_str());
  for (const auto& character : info["characters"]) {
    std::printf("\ncharacter  %s\n  %d joints, %d triangles, height %.4g\n",
                character["name"].get<std::string>().c_str(), character["joints"].get<int>(),
                character["triangles"].get<int>(), character["height"].get<double>());
    for (const auto& [name, limb] : character["limbs"].items()) {
      std::string joints;
      for (const auto& joint : limb["joints"])
        joints += (joints.empty() ? "" : " > ") + joint.get<std::string>();
      std::printf("  %-10s %s\n             %s\n", name.c_str(), joints.c_str(),
                  limb["why"].get<std::string>().c_str());
      if (limb.contains("flexion_axis"))
        std::printf("             bends by %s; %d DOFs\n",
                    limb["flexion_axis"].get<std::string>().c_str(), limb["dofs"].get<int>());
      if (limb.contains("notes"))
        for (const auto& note : limb["notes"])
          std::printf("             %s\n", note.get<std::string>().c_str());
    }
  }
  for (const auto& object : info["objects"])
    std::printf("\nobject     %s\n  %d triangles%s\n", object["name"].get<std::string>().c_str(),
                object["triangles"].get<int>(), object["animated"].get<bool>() ? ", animated" : "");
  if (!info["clips"].empty()) std::printf("\nclips\n");
  int index = 0;
  for (const auto& clip : info["clips"])
    std::printf("  %3d  %-32s %7.3f s  %4d channels\n", index++,
                clip["name"].get<std::string>().c_str(), clip["duration"].get<double>(),
                clip["channels"].get<int>());
  if (!info["warnings"].empty()) std::printf("\nwarnings\n");
  for (const auto& warning : info["warnings"])
    std::printf("  %s\n", warning.get<std::string>().c_str());
}

}  // namespace

int run_info(const InfoOptions& options) {
  if (Status named = check_file_name(options.file, "FILE"); !named) {
    print_error(named.error());
    return kExitUsage;
  }
  ReadOptions read;
  read.images = false;
  // Of a project its character's file, with the limbs that it sets by hand.
  std::filesystem::path file = options.file;
  LimbOverrides overrides;
  if (file.extension() == ".elbow") {
    const auto project = read_project(file);
    if (!project) {
      print_error(project.error());
      return kExitBadInput;
    }
    file = project->scene.character;
    overrides = project->limbs;
  }
  const auto opened = read_gltf(file, read);
  if (!opened) {
    print_error(opened.error());
    return kExitBadInput;
  }
  const Model& model = **opened;
  Json info;
  info["file"] = options.file;
  info["characters"] = Json::array();
  std::vector<std::string> warnings = model.warnings;
  for (const Character& character : model.characters) {
    const LimbFindings findings = find_limbs(model, character, overrides);
    Json limbs = Json::object();
    for (const Limb& limb : findings.limbs) {
      limbs[limb.name] = limb_json(model, limb);
      const auto fitted = fit_limb_model(model, character, limb, findings);
      if (!fitted) {
        warnings.push_back(fitted.error().message());
        continue;
      }
      limbs[limb.name]["flexion_axis"] = fitted->flexion_axis_from;
      limbs[limb.name]["dofs"] = fitted->dof_count();
      limbs[limb.name]["notes"] = fitted->notes;
      limbs[limb.name]["grasp"] = fitted->grasp ? fitted->grasp->from : fitted->grasp.error().what;
    }
    for (const auto& warning : findings.warnings)
      warnings.push_back(character.name + ": " + warning);
    info["characters"].push_back({{"name", character.name},
                                  {"joints", character.joints.size()},
                                  {"triangles", character.triangles},
                                  {"height", character.height},
                                  {"limbs", limbs}});
  }
  info["objects"] = Json::array();
  for (const Object& object : model.objects)
    info["objects"].push_back(
        {{"name", object.name}, {"triangles", object.triangles}, {"animated", object.animated}});
  info["clips"] = Json::array();
  for (const Clip& clip : model.clips)
    info["clips"].push_back(
        {{"name", clip.name}, {"duration", clip.duration()}, {"channels", clip.channels.size()}});
  info["warnings"] = warnings;
  if (options.json)
    std::printf("%s\n", info.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
  else
    print_text(model, info);
  return kExitDone;
}

}  // namespace elbowroom
