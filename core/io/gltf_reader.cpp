// SPDX-License-Identifier: MIT
#include "core/io/gltf_reader.h"

#include <exception>
#include <new>
#include <utility>

#include "core/io/gltf_check.h"
#include "core/io/gltf_parse.h"
#include "core/io/gltf_read_parts.h"
#include "core/io/gltf_source.h"
#include "core/scene/grouping.h"

namespace elbowroom {
namespace {

// A broken exporter makes the same mistake in every channel; nobody reads the thousandth remark.
constexpr std::size_t kMostWarnings = 100;

void shorten(std::vector<std::string>& warnings) {
  if (warnings.size() <= kMostWarnings) return;
  const std::size_t more = warnings.size() - kMostWarnings;
  warnings.resize(kMostWarnings);
  warnings.push_back("and " + std::to_string(more) + " more");
}

std::shared_ptr<const Model> read(const std::filesystem::path& path, const ReadOptions& options) {
  using namespace gltf;
  Folder folder(path, options);
  Checked checked;
  {
    const Bytes bytes = folder.read_main();
    checked = check_document(split_container(bytes, folder.file_name()), folder);
  }
  const tinygltf::Model source = parse_document(checked, folder.file_name());

  auto model = std::make_shared<Model>();
  model->path = path;
  model->warnings = checked.warnings;
  Conversion to{source, checked, folder.file_name(), *model};
  convert_nodes(to);
  convert_skins(to);
  for (const NamedBone& bone : checked.human_bones) {
    model->human_bones.push_back({bone.bone, bone.node});
  }
  convert_materials(to);
  convert_meshes(to);
  convert_clips(to);
  convert_images(to, folder, options.images);
  group_characters_and_objects(*model);
  if (model->skeleton.joints.empty()) model->warnings.push_back("the file holds no nodes");
  shorten(model->warnings);
  return model;
}

}  // namespace

Result<std::shared_ptr<const Model>> read_gltf(const std::filesystem::path& file,
                                               const ReadOptions& options) {
  try {
    return read(file, options);
  } catch (gltf::Refusal& refusal) {
    return std::move(refusal.error);
  } catch (const std::bad_alloc&) {
    return Error{"there is not enough memory to read it", file.string(), "close other programs"};
  } catch (const std::exception& failure) {
    return Error{std::string("it can't be read: ") + failure.what(), file.string(),
                 "export it again"};
  }
}

}  // namespace elbowroom
