// SPDX-License-Identifier: MIT
#include "app/delivery.h"

#include <cstdio>

#include "app/exit_codes.h"
#include "app/report.h"
#include "app/terminal.h"
#include "core/editing/deliver_clip.h"
#include "core/io/project_file.h"

namespace elbowroom {
namespace {

void print_windows(const Session& session, const CorrectionOutcome& outcome) {
  for (const WindowReport& window : outcome.windows) {
    const auto& name = session.limbs[static_cast<std::size_t>(window.limb)].limb.name;
    std::printf("  %-10s %.3f - %.3f s  ", name.c_str(), window.begin, window.end);
    if (window.status == CorrectionStatus::corrected)
      std::printf(
          "%s in %.0f ms, clearance %.4g from the scene, %.4g from anything, at most %.0f° from "
          "the "
          "clip, peak speed %.1f rad/s\n",
          window.accepted ? "as accepted, verified" : "corrected", window.total_ms,
          window.scene_clearance, window.min_clearance, window.deviation_from_clip * 180 / kPi,
          window.peak_speed);
    else
      std::printf("%s: %s%s%s\n",
                  window.status == CorrectionStatus::cancelled ? "interrupted" : "not corrected",
                  window.reason.c_str(), window.blocked_by.empty() ? "" : "; blocked by ",
                  window.blocked_by.c_str());
    if (window.status == CorrectionStatus::corrected && !window.limits_widened.empty()) {
      std::printf("             beyond the usual limits:");
      for (const std::string& name : window.limits_widened)
        std::printf("%s %s", &name == &window.limits_widened.front() ? "" : ";", name.c_str());
      std::printf("\n");
    }
    for (const Suggestion& suggestion : window.suggestions)
      std::printf("             tried: %s\n", suggestion.text().c_str());
  }
}

// What is printed once the files are there.
using Notes = std::vector<std::string>;

// One file for each other way around, beside the best one's. Ways of several windows are not
// combined: that they go together nobody has looked at.
Status stage_other_ways(const Delivery& d, RunFiles& files, Notes& notes) {
  if (d.outcome.windows.size() != 1) return Done{};
  std::size_t rank = 1;
  for (const auto& other : d.outcome.other_ways) {
    const auto clip = lay_over(d.session.scene.model().skeleton, *d.start, {other.correction});
    if (!clip) return clip.error();
    const auto file = other_way_file(d.outputs.out, ++rank);
    if (const auto staged = stage_clip(d.session.document.scene.character, *clip, file, files);
        !staged)
      return staged.error();
    char cost[64];
    std::snprintf(cost, sizeof cost, "%.3f against %.3f", other.report.cost,
                  d.outcome.windows.front().cost);
    notes.push_back("wrote " + file.string() + ", another way around: cost " + cost);
  }
  return Done{};
}

// All files but the report.
Status stage_outputs(const Delivery& d, RunFiles& files, Notes& notes) {
  const auto& source = d.session.document.scene.character;
  const auto exported = stage_clip(source, *d.outcome.clip, d.outputs.out, files);
  if (!exported) return exported.error();
  print_warnings(exported->warnings);
  if (exported->animations.empty())
    notes.push_back("nothing to correct; " + d.outputs.out.string() + " is a copy");
  else
    notes.push_back("wrote " + d.outputs.out.string() + " with the animation \"" +
                    exported->animations.front().name + "\"");
  if (Status others = stage_other_ways(d, files, notes); !others) return others;
  if (const auto patched = per_file_target(d.outputs, source); !patched.empty()) {
    if (const auto staged = stage_clip(source, *d.outcome.clip, patched, files); !staged)
      return staged.error();
    notes.push_back("wrote " + patched.string());
  }
  if (!d.outputs.save_project.empty()) {
    const auto text = project_text(d.outputs.save_project, d.document, d.opened_from);
    if (!text) return text.error();
    if (Status staged = files.stage(d.outputs.save_project, *text); !staged) return staged;
    notes.push_back("wrote " + d.outputs.save_project.string());
  }
  return Done{};
}

// A report that is all that is written. What can't be written is told of, once.
void write_alone(const std::filesystem::path& report, const std::string& text,
                 const std::string& told_of = {}) {
  if (Status written = write_report(report, text); !written && written.error().where != told_of)
    print_error(written.error());
}

}  // namespace

int leave_interrupted(const std::filesystem::path& report, const std::string& text) {
  clear_progress();
  std::fprintf(stderr, "elbowroom: interrupted; nothing written%s\n",
               report.empty() ? "" : " but the report");
  write_alone(report, text);
  return kExitInterrupted;
}

int refuse(const Error& error, const std::filesystem::path& report, Interruption& interruption) {
  if (!interruption.settle()) return leave_interrupted(report, empty_report("interrupted"));
  print_error(error);
  write_alone(report, error_report(error), error.where);
  return kExitBadInput;
}

int deliver(const Delivery& d, RunFiles& files, Interruption& interruption) {
  clear_progress();
  print_windows(d.session, d.outcome);
  const auto report = [&](const std::string& status) {
    return correction_report(status, d.session, d.scene, d.outcome, d.outputs);
  };
  if (!interruption.settle() || d.outcome.cancelled())
    return leave_interrupted(d.outputs.report, report("interrupted"));
  if (!d.outcome.all_corrected()) {
    write_alone(d.outputs.report, report("failed"));
    std::fprintf(stderr,
                 "elbowroom: no valid motion was found for every window; nothing written\n");
    return kExitNoMotion;
  }

  Notes notes;
  Status written = stage_outputs(d, files, notes);
  if (written && !d.outputs.report.empty())
    written =
        files.stage(d.outputs.report,
                    report(d.outcome.corrections.empty() ? "nothing_to_correct" : "corrected"));
  if (written) written = files.commit();
  if (!written) return refuse(written.error(), d.outputs.report, interruption);
  for (const std::string& note : notes) std::printf("%s\n", note.c_str());
  return kExitDone;
}

}  // namespace elbowroom
