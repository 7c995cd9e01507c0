// SPDX-License-Identifier: MIT
#include "app/delivery.h"

#include <cstdio>
#include <cstring>
#include <filesystem>

#include "app/exit_codes.h"
#include "app/report.h"
#include "app/terminal.h"
#include "core/io/gltf_reader.h"
#include "core/io/gltf_writer.h"
#include "core/io/safe_file.h"

namespace elbowroom {
namespace {

// The file's new animation must be, bit for bit, the clip that was verified.
Status compare_with_file(const Clip& verified, const std::filesystem::path& file, int animation) {
  ReadOptions read;
  read.images = false;
  const auto model = read_gltf(file, read);
  if (!model) return model.error();
  const Clip* written = nullptr;
  for (const Clip& clip : (*model)->clips)
    if (clip.source_animation == animation) written = &clip;
  const Error wrong{"what was read back is not what was verified", file.string(),
                    "this is a defect of Elbowroom; the file has been removed"};
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

void print_windows(const Session& session, const CorrectionOutcome& outcome) {
  for (const WindowReport& window : outcome.windows) {
    const auto& name = session.limbs[static_cast<std::size_t>(window.limb)].limb.name;
    std::printf("  %-10s %.3f - %.3f s  ", name.c_str(), window.begin, window.end);
    if (window.status == CorrectionStatus::corrected)
      std::printf(
          "corrected in %.0f ms, clearance %.4g, at most %.0f° from the clip, "
          "peak speed %.1f rad/s\n",
          window.total_ms, window.min_clearance, window.deviation_from_clip * 180 / kPi,
          window.peak_speed);
    else
      std::printf("%s: %s%s%s\n",
                  window.status == CorrectionStatus::cancelled ? "interrupted" : "not corrected",
                  window.reason.c_str(), window.blocked_by.empty() ? "" : "; blocked by ",
                  window.blocked_by.c_str());
  }
}

}  // namespace

int refuse(const Error& error, const std::string& report) {
  print_error(error);
  if (Status written = write_report(report, error_report(error)); !written)
    print_error(written.error());
  return kExitBadInput;
}

int deliver(const Session& session, const SceneCollision& scene, const CorrectionOutcome& outcome,
            const DeliveryPlaces& places) {
  clear_progress();
  const auto report = [&](const std::string& status) {
    Status written =
        write_report(places.report, correction_report(status, session, scene, outcome));
    if (!written) print_error(written.error());
    return written.ok();
  };
  print_windows(session, outcome);
  if (outcome.cancelled()) {
    report("interrupted");
    return kExitInterrupted;
  }
  if (!outcome.all_corrected()) {
    report("failed");
    std::fprintf(stderr,
                 "elbowroom: no valid motion was found for every window; nothing written\n");
    return kExitNoMotion;
  }

  const auto& source = session.document.scene.character;
  std::vector<CorrectedClip> clips;
  if (!outcome.corrections.empty()) clips.push_back(corrected_clip(*outcome.clip));
  ExportReport exported;
  if (Status written = export_corrected(source, places.out, clips, &exported); !written)
    return refuse(written.error(), places.report);
  print_warnings(exported.warnings);
  if (!clips.empty()) {
    const int animation = exported.animations.empty() ? -1 : exported.animations.front().index;
    if (Status same = compare_with_file(*outcome.clip, places.out, animation); !same) {
      std::error_code ignored;
      std::filesystem::remove(places.out, ignored);
      for (const auto& file : exported.side_files) std::filesystem::remove(file, ignored);
      return refuse(same.error(), places.report);
    }
    std::printf("wrote %s with the animation \"%s\"\n", places.out.c_str(),
                exported.animations.front().name.c_str());
  } else {
    std::printf("nothing to correct; %s is a copy\n", places.out.c_str());
  }
  return report(clips.empty() ? "nothing_to_correct" : "corrected") ? kExitDone : kExitBadInput;
}

}  // namespace elbowroom
