// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <utility>

#include "core/io/gltf_read_parts.h"

namespace elbowroom::gltf {
namespace {

// Channels may share accessors, so their sum is bounded as that of the meshes is.
std::uint64_t most_values(const Checked& checked) { return (1u << 22) + 16 * checked.total_bytes; }

std::optional<Path> path_of(const std::string& name) {
  if (name == "translation") return Path::translation;
  if (name == "rotation") return Path::rotation;
  if (name == "scale") return Path::scale;
  if (name == "weights") return Path::weights;
  return std::nullopt;
}

std::optional<Interpolation> interpolation_of(const std::string& name) {
  if (name == "LINEAR") return Interpolation::linear;
  if (name == "STEP") return Interpolation::step;
  if (name == "CUBICSPLINE") return Interpolation::cubic_spline;
  return std::nullopt;
}

// Morph targets of the mesh at a node; 0 if it has none.
int target_count(const tinygltf::Model& source, std::size_t node) {
  const int mesh = source.nodes[node].mesh;
  if (mesh < 0) return 0;
  std::size_t targets = 0;
  for (const auto& primitive : source.meshes[static_cast<std::size_t>(mesh)].primitives) {
    targets = std::max(targets, primitive.targets.size());
  }
  return static_cast<int>(targets);
}

// Keys whose time does not exceed the one before are skipped, with their values. Returns how many.
std::size_t keep_increasing(Channel& channel, std::size_t stride) {
  std::size_t kept = 0;
  for (std::size_t key = 0; key < channel.times.size(); ++key) {
    if (kept > 0 && !(channel.times[key] > channel.times[kept - 1])) continue;
    if (kept != key) {
      channel.times[kept] = channel.times[key];
      std::copy_n(channel.values.begin() + static_cast<std::ptrdiff_t>(key * stride), stride,
                  channel.values.begin() + static_cast<std::ptrdiff_t>(kept * stride));
    }
    ++kept;
  }
  const std::size_t skipped = channel.times.size() - kept;
  channel.times.resize(kept);
  channel.values.resize(kept * stride);
  return skipped;
}

bool all_modest(const std::vector<float>& values) {
  return std::all_of(values.begin(), values.end(),
                     [](float v) { return std::abs(static_cast<double>(v)) <= kLargestNumber; });
}

// Nothing, with a warning, if the channel can't be played.
std::optional<Channel> convert_channel(Conversion& to, const tinygltf::Animation& animation,
                                       const std::string& part, std::size_t index,
                                       std::uint64_t& values_read) {
  const tinygltf::AnimationChannel& source = animation.channels[index];
  if (source.target_node < 0) return std::nullopt;  // the file keeps it, nothing plays it
  const auto node = static_cast<std::size_t>(source.target_node);
  const std::string target =
      part + ", channel of " + part_name("node", node, to.source.nodes[node].name);
  const auto ignore = [&](const std::string& why) {
    to.model.warnings.push_back(target + ": " + why + "; the channel is ignored");
    return std::nullopt;
  };
  const tinygltf::AnimationSampler& sampler =
      animation.samplers[static_cast<std::size_t>(source.sampler)];
  const auto path = path_of(source.target_path);
  const auto interpolation = interpolation_of(sampler.interpolation);
  if (!path) return ignore("its path \"" + excerpt(source.target_path, 40) + "\" is unknown");
  if (!interpolation) {
    return ignore("its interpolation \"" + excerpt(sampler.interpolation, 40) + "\" is unknown");
  }
  if (*path != Path::weights && to.model.skeleton.joints[node].rest_matrix) {
    return ignore("a node placed by a matrix can't be animated");
  }

  Channel channel;
  channel.joint = source.target_node;
  channel.path = *path;
  channel.interpolation = *interpolation;
  channel.source_channel = static_cast<int>(index);
  channel.components = *path == Path::rotation ? 4 : 3;
  if (*path == Path::weights) channel.components = target_count(to.source, node);
  if (channel.components == 0) return ignore("the node's mesh has no morph targets");

  const tinygltf::Accessor& input = to.source.accessors[static_cast<std::size_t>(sampler.input)];
  const tinygltf::Accessor& output = to.source.accessors[static_cast<std::size_t>(sampler.output)];
  values_read += input.count + 4 * static_cast<std::uint64_t>(output.count);
  if (values_read > most_values(to.checked)) {
    refuse(to.in_file(part),
           "its channels share so few keys so often that they come to more than " +
               std::to_string(most_values(to.checked)) + " values",
           "export fewer animations");
  }
  channel.times = read_floats(to.source, to.checked, sampler.input, 1, false, "its key times",
                              to.in_file(target));
  channel.values = read_floats(
      to.source, to.checked, sampler.output, *path == Path::weights ? 1 : channel.components,
      *path == Path::rotation || *path == Path::weights, "its values", to.in_file(target));
  if (channel.times.empty()) return ignore("it has no keys");
  const std::size_t stride = static_cast<std::size_t>(channel.components) *
                             (*interpolation == Interpolation::cubic_spline ? 3 : 1);
  if (channel.values.size() < stride * channel.times.size()) {
    refuse(to.in_file(target),
           "it has " + std::to_string(channel.times.size()) + " key times but values for " +
               std::to_string(channel.values.size() / stride),
           kExportAgain);
  }
  channel.values.resize(stride * channel.times.size());
  if (!all_modest(channel.times) || !all_modest(channel.values)) {
    return ignore("its keys are not finite");
  }
  if (const std::size_t skipped = keep_increasing(channel, stride); skipped > 0) {
    to.model.warnings.push_back(target + ": " + std::to_string(skipped) +
                                " keys don't come later than the one before; they are skipped");
  }
  return channel;
}

}  // namespace

void convert_clips(Conversion& to) {
  std::uint64_t values_read = 0;
  for (std::size_t a = 0; a < to.source.animations.size(); ++a) {
    const tinygltf::Animation& animation = to.source.animations[a];
    const std::string part = part_name("animation", a, animation.name);
    Clip clip;
    clip.name = animation.name;
    clip.source_animation = static_cast<int>(a);
    std::set<std::pair<int, Path>> taken;
    for (std::size_t c = 0; c < animation.channels.size(); ++c) {
      std::optional<Channel> channel = convert_channel(to, animation, part, c, values_read);
      if (!channel) continue;
      if (!taken.insert({channel->joint, channel->path}).second) {
        to.model.warnings.push_back(
            part + " animates the same property of " +
            part_name("node", static_cast<std::size_t>(channel->joint),
                      to.source.nodes[static_cast<std::size_t>(channel->joint)].name) +
            " twice; the second channel is ignored");
        continue;
      }
      const double first = channel->times.front(), last = channel->times.back();
      clip.begin = clip.channels.empty() ? first : std::min(clip.begin, first);
      clip.end = clip.channels.empty() ? last : std::max(clip.end, last);
      clip.channels.push_back(std::move(*channel));
    }
    to.model.clips.push_back(std::move(clip));
  }
}

}  // namespace elbowroom::gltf
