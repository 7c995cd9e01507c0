// SPDX-License-Identifier: MIT
// Materials, textures and images. Nothing here refuses a file: what can't be used is left out.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/io/gltf_check_parts.h"

namespace elbowroom::gltf {
namespace {

const Json& lenient_section(const Json& document, const char* key) {
  static const Json kNone = Json::array();
  const Json* found = member(document, key);
  return found && found->is_array() ? *found : kNone;
}

double number_or(const Json& object, const char* key, double fallback) {
  const Json* value = member(object, key);
  const double number = value && value->is_number() ? value->get<double>() : fallback;
  return std::abs(number) <= kLargestNumber ? number : fallback;
}

std::vector<double> numbers_or(const Json& object, const char* key, std::vector<double> fallback) {
  const Json* values = member(object, key);
  if (!values || !values->is_array() || values->size() != fallback.size()) return fallback;
  for (std::size_t i = 0; i < fallback.size(); ++i) {
    const double number = (*values)[i].is_number() ? (*values)[i].get<double>() : fallback[i];
    if (std::abs(number) <= kLargestNumber) fallback[i] = number;
  }
  return fallback;
}

// An index below `count`, -1 if it is anything else.
int lenient_index(const Json& object, const char* key, std::size_t count) {
  const double index = number_or(object, key, -1);
  const bool good = index >= 0 && index < static_cast<double>(count) && std::floor(index) == index;
  return good ? static_cast<int>(index) : -1;
}

std::vector<double> clamped(std::vector<double> values) {
  for (double& v : values) v = std::clamp(v, 0.0, 1.0);
  return values;
}

// Of a textureInfo object: which image, through the texture's own source or, failing that, that of
// an extension for another image format.
BaseTexture base_texture(const Json& document, const Json* info) {
  BaseTexture out;
  if (!info) return out;
  const Json& textures = lenient_section(document, "textures");
  const int texture = lenient_index(*info, "index", textures.size());
  if (texture < 0) return out;
  const Json& entry = textures[static_cast<std::size_t>(texture)];
  out.image = lenient_index(entry, "source", lenient_section(document, "images").size());
  out.texcoord = std::max(0, lenient_index(*info, "texCoord", 64));
  const Json* extensions = member(*info, "extensions");
  const Json* transform = extensions ? member(*extensions, "KHR_texture_transform") : nullptr;
  if (!transform) return out;
  const std::vector<double> offset = numbers_or(*transform, "offset", {0, 0});
  const std::vector<double> scale = numbers_or(*transform, "scale", {1, 1});
  out.offset = {offset[0], offset[1]};
  out.scale = {scale[0], scale[1]};
  out.rotation = number_or(*transform, "rotation", 0);
  const int texcoord = lenient_index(*transform, "texCoord", 64);
  if (texcoord >= 0) out.texcoord = texcoord;
  return out;
}

}  // namespace

void check_looks(CheckState& state) {
  const Json& images = lenient_section(state.document, "images");
  const std::size_t views = state.reduced["bufferViews"].size();
  for (const Json& image : images) {
    ImageSource source;
    const Json* uri = member(image, "uri");
    if (uri && uri->is_string()) {
      source.uri = uri->get<std::string>();
    } else {
      source.buffer_view = lenient_index(image, "bufferView", views);
    }
    state.out.images.push_back(std::move(source));
  }

  const Json& materials = lenient_section(state.document, "materials");
  Json& reduced = state.reduced["materials"] = Json::array();
  for (const Json& material : materials) {
    const Json* pbr = member(material, "pbrMetallicRoughness");
    const Json* extensions = member(material, "extensions");
    const Json* gloss =
        extensions ? member(*extensions, "KHR_materials_pbrSpecularGlossiness") : nullptr;
    Json factors = {{"metallicFactor", 1}, {"roughnessFactor", 1}};
    BaseTexture texture;
    if (pbr) {
      factors["baseColorFactor"] = clamped(numbers_or(*pbr, "baseColorFactor", {1, 1, 1, 1}));
      factors["metallicFactor"] = std::clamp(number_or(*pbr, "metallicFactor", 1), 0.0, 1.0);
      factors["roughnessFactor"] = std::clamp(number_or(*pbr, "roughnessFactor", 1), 0.0, 1.0);
      texture = base_texture(state.document, member(*pbr, "baseColorTexture"));
    } else if (gloss) {
      factors["baseColorFactor"] = clamped(numbers_or(*gloss, "diffuseFactor", {1, 1, 1, 1}));
      factors["metallicFactor"] = 0;
      factors["roughnessFactor"] =
          1 - std::clamp(number_or(*gloss, "glossinessFactor", 1), 0.0, 1.0);
      texture = base_texture(state.document, member(*gloss, "diffuseTexture"));
    }
    const Json* double_sided = member(material, "doubleSided");
    Json entry = {
        {"name", name_of(material)},
        {"pbrMetallicRoughness", std::move(factors)},
        {"doubleSided", double_sided && double_sided->is_boolean() && double_sided->get<bool>()}};
    if (extensions && member(*extensions, "KHR_materials_unlit")) {
      entry["extensions"]["KHR_materials_unlit"] = Json::object();
    }
    reduced.push_back(std::move(entry));
    state.out.base_textures.push_back(texture);
  }
}

}  // namespace elbowroom::gltf
