// SPDX-License-Identifier: MIT
// Motion correction [SKF07 6.1]: finds where a limb collides, plans it a way around in sync with
// the rest of the clip and the scene, and verifies the keys that a player will show.
//
// What comes out has been looked at on the deformed skin: at 240 Hz, at every key and at 1,000
// random times of the window. A motion that fails is replanned, with a larger margin and at last on
// the deformed skin itself, or reported as failed; it is never returned as good. What lies between
// these times is proven where it can be (certificate.h); a motion that is verified but not proven
// is taken only if a few more tries bring no proven one, and says so.
//
// Deterministic for a seed and an iteration budget. Runs on the calling thread; stop tokens are
// answered within 50 ms.
#pragma once

#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/collision/scene_collision.h"
#include "core/editing/document.h"

namespace elbowroom {

enum class CorrectionStatus { corrected, failed, cancelled };

// What would do instead, where a window failed: tried, not guessed.
struct Suggestion {
  enum class Kind { wider_window, wider_intervals, another_limb } kind = Kind::wider_window;
  bool works = false;
  Interval window;           // seconds, that it was tried in
  std::string limb;          // that it was tried with
  std::string text() const;  // for people
};
const char* suggestion_id(Suggestion::Kind kind);

// What one window came to; the fields of a report's `corrections`.
struct WindowReport {
  CorrectionStatus status = CorrectionStatus::failed;
  bool accepted = false;  // nothing was planned: keys that were there already have been verified
  int limb = -1;
  double begin = 0, end = 0;               // seconds, float32 values
  std::uint64_t seed = 0;                  // of the attempt that was taken
  bool certified = false;                  // true only with a proof for all times of the window
                                           // (certificate.h says what of)
  std::string not_certified;               // why not: pair, time and reason
  std::vector<std::string> depth_sampled;  // pairs that may touch as deep as in the clip and come
                                           // near: their depth is known at the samples only
  double min_clearance = 0;      // scene units, over the verified samples, from anything, its own
                                 // body and what it carries too
  double scene_clearance = 0;    // the same from all that is not the character nor carried by it
  double planned_clearance = 0;  // that was kept from the scene in planning: less than asked for
                                 // where no way with that was found; 0 where nothing was planned
  double plan_ms = 0, smooth_ms = 0, verify_ms = 0, certify_ms = 0, total_ms = 0;
  long validity_checks = 0, edge_checks = 0, iterations = 0;
  int landmarks = 0;
  double peak_speed = 0;           // rad/s, any DOF
  double peak_acceleration = 0;    // rad/s², any DOF
  double deviation_from_clip = 0;  // rad, the largest angle of any limb joint from the clip
  double cost = 0;  // motion_cost.h; what ways around are ranked by; 0 where nothing was planned
  bool out_of_reach = false;  // failed since the limb is too short for the place of its target,
                              // however the hand is turned
  bool ends_touch = false;    // failed since the limb is in contact at one of the window's ends
  std::string blocked_by;     // what stood in the way, when it failed: pair and time
  std::string reason;         // for people, when it failed
  std::vector<std::string> limits_widened;  // DOF names
  // What each attempt looked at and came to, in order, for people.
  std::vector<std::string> attempts;
  std::vector<Suggestion> suggestions;  // when it failed
};

struct CorrectionOutcome {
  std::vector<WindowReport> windows;  // in the order they were worked on
  // Of each window, other ways around (WindowPlan::alternatives): as many as were asked for and
  // found.
  struct OtherWay {
    std::size_t window = 0;  // index in `windows`
    WindowReport report;
    Correction correction;
  };
  std::vector<OtherWay> other_ways;
  std::vector<Correction> corrections;  // those that succeeded
  std::shared_ptr<const Clip> clip;     // the source with the corrections laid over it
  std::vector<ContactInterval> before;  // the limbs' contacts in the source clip, not allowed ones
  std::vector<ContactInterval> after;   // and in `clip`
  std::vector<ContactInterval> other;   // contacts that involve no limb: they fail nothing
  bool interrupted = false;             // a stop request came before all was done
  std::vector<std::string> notes;       // for people: what was not kept as it was, and why

  bool all_corrected() const;
  bool cancelled() const;  // interrupted, or a window was
};

// The contacts of what the scene plays, its whole clip: these limbs' in `own`; those of no limb in
// `other`, unless that is null. Stopped, some of them. Cost: a scan.
void look_at_contacts(SceneCollision& scene, const std::vector<int>& limbs,
                      std::vector<ContactInterval>& own, std::vector<ContactInterval>* other,
                      const std::stop_token& stop = {});

// Windows for the contacts of one limb: each stretch with a lead-in and lead-out, widened until the
// limb is free at both ends; stretches that meet become one. A window whose end can't be freed
// because the clip begins or ends in contact says so in `blocked`.
struct ProposedWindow {
  double begin = 0, end = 0;
  std::vector<ContactInterval> contacts;
  std::string blocked;  // for people; empty: both ends are free
};
std::vector<ProposedWindow> propose_windows(SceneCollision& scene, int limb,
                                            const std::vector<ContactInterval>& contacts,
                                            double clearance);
// The same window with that much more time on each side, as far as the clip goes and with free
// ends; none if it grows on neither side.
std::optional<Interval> widened_window(SceneCollision& scene, int limb, const Interval& window,
                                       double by, double clearance);

// Does the task on the world that `scene` holds: limbs is the list of limb indices to correct in
// this order (each later one in sync with the earlier ones' new motion [SKF07 7]). The scene plays
// the outcome's clip afterwards.
// Errors: no clip; a sampling interval for a DOF that no limb has.
Result<CorrectionOutcome> correct(SceneCollision& scene, const std::vector<int>& limbs,
                                  const Task& task, std::stop_token stop = {},
                                  const ProgressSink& progress = {});

// The clip with corrections laid over it, in order; muted ones are passed over. Error: keys that
// don't fit the clip (a correction made for another one), with the joint's name.
Result<Clip> lay_over(const Skeleton& skeleton, const Clip& source,
                      const std::vector<Correction>& corrections);

}  // namespace elbowroom
