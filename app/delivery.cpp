// SPDX-License-Identifier: MIT
#include "app/delivery.h"

#include <cstdio>

#include "app/exit_codes.h"
#include "app/report.h"
#include "app/terminal.h"
#include "core/editing/deliver_clip.h"

namespace elbowroom {
namespace {

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
    for (const Suggestion& suggestion : window.suggestions)
      std::printf("             tried: %s\n", suggestion.text().c_str());
  }
}

// One file for each other way around, beside the best one's. Ways of several windows are not
// combined: that they go together nobody has looked at.
Status deliver_other_ways(const Session& session, const CorrectionOutcome& outcome,
                          const std::filesystem::path& out) {
  if (outcome.windows.size() != 1) return Done{};
  std::size_t rank = 1;
  for (const auto& other : outcome.other_ways) {
    const auto clip = lay_over(session.scene.model().skeleton, *session.clip(), {other.correction});
    if (!clip) return clip.error();
    const auto file = other_way_file(out, ++rank);
    if (const auto written = deliver_clip(session.document.scene.character, *clip, file); !written)
      return written.error();
    std::printf("wrote %s, another way around: cost %.3f against %.3f\n", file.c_str(),
                other.report.cost, outcome.windows.front().cost);
  }
  return Done{};
}

}  // namespace

std::filesystem::path other_way_file(const std::filesystem::path& out, std::size_t rank) {
  std::filesystem::path file = out;
  file.replace_filename(out.stem().string() + "-" + std::to_string(rank) +
                        out.extension().string());
  return file;
}

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
        write_report(places.report, correction_report(status, session, scene, outcome, places));
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
  const auto exported = deliver_clip(source, *outcome.clip, places.out);
  if (!exported) return refuse(exported.error(), places.report);
  print_warnings(exported->warnings);
  if (!exported->animations.empty())
    std::printf("wrote %s with the animation \"%s\"\n", places.out.c_str(),
                exported->animations.front().name.c_str());
  else
    std::printf("nothing to correct; %s is a copy\n", places.out.c_str());
  if (Status others = deliver_other_ways(session, outcome, places.out); !others)
    return refuse(others.error(), places.report);
  if (!places.per_file.empty()) {
    const auto patched = places.per_file / source.filename();
    std::error_code failed;
    std::filesystem::create_directories(places.per_file, failed);
    if (failed)
      return refuse({"the folder can't be made: " + failed.message(), places.per_file.string(),
                     "choose another one"},
                    places.report);
    if (std::filesystem::equivalent(patched, source, failed))
      return refuse({"that would write over the source", patched.string(),
                     "choose another folder for --per-file"},
                    places.report);
    if (const auto written = deliver_clip(source, *outcome.clip, patched); !written)
      return refuse(written.error(), places.report);
    std::printf("wrote %s\n", patched.c_str());
  }
  return report(exported->animations.empty() ? "nothing_to_correct" : "corrected") ? kExitDone
                                                                                   : kExitBadInput;
}

}  // namespace elbowroom
