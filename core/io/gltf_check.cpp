// SPDX-License-Identifier: MIT
#include "core/io/gltf_check.h"

#include <utility>

#include "core/io/gltf_check_parts.h"
#include "core/io/gltf_extensions.h"

namespace elbowroom::gltf {
namespace {

void check_asset(CheckState& state) {
  const Json* asset = member(state.document, "asset");
  const Json* version = asset ? member(*asset, "version") : nullptr;
  if (!version || !version->is_string()) {
    refuse(state.access.file(), "it is no glTF 2.0 document: asset.version is missing",
           "choose a glTF 2.0 file, or export it again");
  }
  const std::string text = version->get<std::string>();
  if (text.rfind("2.", 0) != 0) {
    refuse(state.access.file(), "it is glTF " + excerpt(text, 20) + "; only 2.x is read",
           "convert it to glTF 2.0");
  }
  // Later minor versions keep to this one's structure, so what they need beyond it is at most lost.
  const Json* least = member(*asset, "minVersion");
  if (!least || !least->is_string()) return;
  const std::string needed = least->get<std::string>();
  if (needed.rfind("2.", 0) != 0) {
    refuse(state.access.file(),
           "it needs a reader of glTF " + excerpt(needed, 20) + "; only 2.x is read",
           "convert it to glTF 2.0");
  }
  if (needed != "2.0") {
    state.out.warnings.push_back("it asks for a reader of glTF " + excerpt(needed, 20) +
                                 "; it is read as 2.0");
  }
}

void check_extensions(CheckState& state) {
  const auto names = [&](const char* key) {
    std::vector<std::string> out;
    const Json* list = member(state.document, key);
    if (!list) return out;
    if (!list->is_array()) state.access.refuse_part(key, "it is no array");
    for (const Json& name : *list) {
      if (!name.is_string()) state.access.refuse_part(key, "it holds what is no name");
      out.push_back(name.get<std::string>());
    }
    return out;
  };
  for (const std::string& name : names("extensionsRequired")) {
    if (const auto refusal = required_extension(name)) {
      refuse(state.access.file(), refusal->what, refusal->remedy);
    }
    if (name == "KHR_mesh_quantization") state.out.quantized = true;
  }
  for (const std::string& name : names("extensionsUsed")) {
    if (name == "KHR_mesh_quantization") state.out.quantized = true;
    if (const auto warning = used_extension(name)) state.out.warnings.push_back(*warning);
  }
}

}  // namespace

std::string part_name(const char* kind, std::size_t index, const std::string& name) {
  std::string part = std::string(kind) + " " + std::to_string(index);
  if (!name.empty()) part += " \"" + excerpt(name, 60) + "\"";
  return part;
}

Checked check_document(const Container& container, Folder& folder) {
  const Json document = parse_json(container.json, folder.file_name());
  CheckState state{container, folder, document, JsonAccess(folder.file_name(), document), {}, {}};
  state.out.warnings = container.warnings;
  check_asset(state);
  check_extensions(state);
  state.reduced["asset"] = {{"version", "2.0"}};
  check_data(state);
  check_looks(state);
  check_scene(state);
  check_animations(state);
  check_human_bones(state);
  state.out.json = state.reduced.dump();
  return std::move(state.out);
}

}  // namespace elbowroom::gltf
