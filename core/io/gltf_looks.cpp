// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>
#include <limits>

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_FAILURE_USERMSG
#include <stb/stb_image.h>

#include "core/io/gltf_read_parts.h"

namespace elbowroom::gltf {
namespace {

// One picture of 8192 by 8192, as large as graphics cards are sure to take.
constexpr std::uint64_t kMostPixels = std::uint64_t{8192} * 8192;
// Deflate, the best of the codings, packs at most 1032 bytes into one, and a PNG's byte holds up to
// 8 pixels: a header that promises more is lying.
constexpr std::uint64_t kMostPixelsPerByte = 8 * 1032;

// Why it failed; empty if it did not.
std::string decode(const Bytes& bytes, Image& image) {
  if (bytes.empty() || bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    return "there is no data";
  }
  const auto size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_memory(bytes.data(), size, &width, &height, &channels) || width <= 0 ||
      height <= 0) {
    return std::string("it can't be decoded: ") + stbi_failure_reason();
  }
  const std::uint64_t pixels =
      static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  if (pixels > kMostPixels || pixels > kMostPixelsPerByte * bytes.size()) {
    return "it claims " + std::to_string(width) + " by " + std::to_string(height) + " pixels";
  }
  stbi_uc* decoded = stbi_load_from_memory(bytes.data(), size, &width, &height, &channels, 4);
  if (!decoded) return std::string("it can't be decoded: ") + stbi_failure_reason();
  image.width = width;
  image.height = height;
  image.rgba.assign(
      decoded, decoded + 4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  stbi_image_free(decoded);
  return {};
}

Bytes encoded_bytes(const Conversion& to, Folder& folder, const ImageSource& source,
                    const std::string& where) {
  constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 28;
  if (is_data_uri(source.uri)) return decode_data_uri(source.uri, kMostBytes, where);
  if (!source.uri.empty()) return folder.read_uri(source.uri, kMostBytes, where);
  if (source.buffer_view < 0) return {};
  const auto& view = to.source.bufferViews[static_cast<std::size_t>(source.buffer_view)];
  const auto& data = to.source.buffers[static_cast<std::size_t>(view.buffer)].data;
  // A view of a buffer that has no data of its own in the file.
  if (view.byteOffset + view.byteLength > data.size()) return {};
  return {data.begin() + static_cast<std::ptrdiff_t>(view.byteOffset),
          data.begin() + static_cast<std::ptrdiff_t>(view.byteOffset + view.byteLength)};
}

}  // namespace

void convert_materials(Conversion& to) {
  for (std::size_t i = 0; i < to.source.materials.size(); ++i) {
    const tinygltf::Material& source = to.source.materials[i];
    const auto& pbr = source.pbrMetallicRoughness;
    Material material;
    material.name = source.name;
    for (int c = 0; c < 4; ++c) {
      material.base_color[c] = static_cast<float>(pbr.baseColorFactor[static_cast<std::size_t>(c)]);
    }
    material.base_color_image = to.checked.base_textures[i].image;
    material.metallic = static_cast<float>(pbr.metallicFactor);
    material.roughness = static_cast<float>(pbr.roughnessFactor);
    material.double_sided = source.doubleSided;
    material.unlit = source.extensions.count("KHR_materials_unlit") > 0;
    to.model.materials.push_back(std::move(material));
  }
}

void convert_images(Conversion& to, Folder& folder, bool decode_them) {
  to.model.images.resize(to.checked.images.size());
  if (!decode_them) return;
  std::vector<bool> used(to.model.images.size(), false);
  for (const Material& material : to.model.materials) {
    if (material.base_color_image >= 0) {
      used[static_cast<std::size_t>(material.base_color_image)] = true;
    }
  }
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i]) continue;
    const std::string part = part_name("image", i, "");
    std::string failure;
    try {
      failure = decode(encoded_bytes(to, folder, to.checked.images[i], part), to.model.images[i]);
    } catch (const Refusal& refusal) {
      failure = refusal.error.what;
    }
    if (!failure.empty()) {
      to.model.warnings.push_back(part + " can't be shown: " + failure);
    }
  }
}

}  // namespace elbowroom::gltf
