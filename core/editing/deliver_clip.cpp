// SPDX-License-Identifier: MIT
#include "core/editing/deliver_clip.h"

#include <cstring>

#include "core/io/gltf_reader.h"

namespace elbowroom {
namespace {

// The file's new animation must be, bit for bit, the clip that was verified.
Status compare_with_file(const Clip& verified, const std::filesystem::path& file, int animation,
                         const RunFiles& run) {
  ReadOptions read;
  read.images = false;
  read.staged_at = [&run](const std::filesystem::path& path) { return run.staged_at(path); };
  const auto model = read_gltf(file, read);
  if (!model) return model.error();
  const Clip* written = nullptr;
  for (const Clip& clip : (*model)->clips)
    if (clip.source_animation == animation) written = &clip;
  const Error wrong{"what was read back is not what was verified", file.string(),
                    "this is a defect of Elbowroom; nothing has been written"};
  if (!written || written->channels.size() != verified.channels.size()) return wrong;
  for (const Channel& channel : verified.channels) {
    const int found = written->find_channel(channel.joint, channel.path);
    if (found < 0) return wrong;
    const Channel& other = written->channels[static_cast<std::size_t>(found)];
    if (other.interpolation != channel.interpolation || other.times != channel.times ||
        other.values.size() != channel.values.size() ||
        std::memcmp(other.values.data(), channel.values.data(),
                    channel.values.size() * sizeof(float)) != 0)
      return wrong;
  }
  return Done{};
}

}  // namespace

Result<ExportReport> stage_clip(const std::filesystem::path& source, const Clip& clip,
                                const std::filesystem::path& out, RunFiles& run) {
  std::vector<CorrectedClip> clips;
  CorrectedClip changed = corrected_clip(clip);
  if (!changed.changed.empty()) clips.push_back(std::move(changed));
  ExportReport report;
  if (Status staged = stage_corrected(source, out, clips, run, &report); !staged)
    return staged.error();
  if (clips.empty()) return report;
  const int animation = report.animations.empty() ? -1 : report.animations.front().index;
  if (Status same = compare_with_file(clip, out, animation, run); !same) return same.error();
  return report;
}

Result<ExportReport> deliver_clip(const std::filesystem::path& source, const Clip& clip,
                                  const std::filesystem::path& out) {
  RunFiles run;
  auto report = stage_clip(source, clip, out, run);
  if (!report) return report;
  if (Status written = run.commit(); !written) return written.error();
  return report;
}

}  // namespace elbowroom
