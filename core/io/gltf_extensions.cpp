// SPDX-License-Identifier: MIT
#include "core/io/gltf_extensions.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "core/io/gltf_source.h"

namespace elbowroom::gltf {
namespace {

bool starts_with(const std::string& text, std::string_view prefix) {
  return text.compare(0, prefix.size(), prefix) == 0;
}

// Geometry and motion are the same with and without these.
bool leaves_geometry_alone(const std::string& name) {
  static constexpr std::array<std::string_view, 13> kPrefixes{
      "KHR_materials_",   "KHR_texture_", "KHR_lights_",   "KHR_xmp",       "KHR_environment_map",
      "EXT_texture_",     "EXT_lights_",  "MSFT_texture_", "MSFT_packing_", "ADOBE_materials_",
      "AGI_stk_metadata", "VRMC_",        "MSFT_lod"};
  return name == "VRM" || name == "KHR_techniques_webgl" ||
         std::any_of(kPrefixes.begin(), kPrefixes.end(),
                     [&](std::string_view prefix) { return starts_with(name, prefix); });
}

}  // namespace

std::optional<Error> required_extension(const std::string& name) {
  if (name == "KHR_mesh_quantization" || leaves_geometry_alone(name)) return std::nullopt;
  Error error;
  error.what = "it requires the extension " + excerpt(name, 60) + ", which is not supported";
  error.remedy = "export it again without " + excerpt(name, 60);
  if (name == "KHR_draco_mesh_compression") {
    error.remedy =
        "export it again without Draco compression, or unpack it with "
        "\"gltf-transform copy in.glb out.glb\"";
  } else if (name == "EXT_meshopt_compression" || name == "KHR_meshopt_compression") {
    error.remedy =
        "export it again without meshopt compression (gltfpack without -c), or unpack it "
        "with \"gltf-transform copy in.glb out.glb\"";
  } else if (name == "EXT_mesh_gpu_instancing") {
    error.remedy = "export it again with its instances as nodes";
  }
  return error;
}

std::optional<std::string> used_extension(const std::string& name) {
  if (name == "EXT_mesh_gpu_instancing") {
    return name + " is ignored: instanced meshes appear once";
  }
  if (name == "KHR_animation_pointer") {
    return name + " is ignored: animations of other things than nodes don't play";
  }
  if (name == "VRMC_node_constraint") {
    return name + " is ignored: constrained nodes move only where a clip moves them";
  }
  return std::nullopt;
}

}  // namespace elbowroom::gltf
