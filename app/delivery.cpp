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
  const auto exported = deliver_clip(source, *outcome.clip, places.out);
  if (!exported) return refuse(exported.error(), places.report);
  print_warnings(exported->warnings);
  if (!exported->animations.empty())
    std::printf("wrote %s with the animation \"%s\"\n", places.out.c_str(),
                exported->animations.front().name.c_str());
  else
    std::printf("nothing to correct; %s is a copy\n", places.out.c_str());
  return report(exported->animations.empty() ? "nothing_to_correct" : "corrected") ? kExitDone
                                                                                   : kExitBadInput;
}

}  // namespace elbowroom
