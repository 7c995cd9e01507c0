// SPDX-License-Identifier: MIT
#include "core/editing/planning_views.h"

#include <cstdio>

namespace elbowroom {
namespace {

// A check on the skin costs a hundred times more. And where parts are near each other all along, as
// in a figure in armour, checks are dear and a search in vain is long: they are counted too.
constexpr double kSkinEffort = 0.1;
constexpr std::int64_t kFirstChecks = 120000, kFurtherChecks = 40000, kSkinChecks = 20000;
constexpr double kLittle = 0.1;       // × the clearance asked for
constexpr double kSkinMargin = 0.01;  // × height
constexpr int kFirstSeedsInVain = 2;
constexpr int kSkinLessons = 2;

PlanningView parts(double clearance, double from_body, double near_share) {
  PlanningView view;
  view.clearance = clearance;
  view.body_clearance = from_body;
  view.near_share = near_share;
  view.most_checks = kFurtherChecks;
  return view;
}

PlanningView skin(double clearance, double near_share) {
  PlanningView view = parts(clearance, clearance, near_share);
  view.on_skin = true;
  view.ways = 1;
  view.effort = kSkinEffort;
  view.most_checks = kSkinChecks;
  view.lessons = kSkinLessons;
  return view;
}

}  // namespace

std::string PlanningView::text() const {
  char text[160];
  std::snprintf(text, sizeof text,
                "%s, clearance %.3g, from the body %.3g, margin %.3g, %.0f %% near the clip",
                !on_skin      ? "rigid parts"
                : as_verified ? "deformed skin as verified"
                              : "deformed skin",
                clearance, body_clearance, margin, 100 * near_share);
  std::string all = text;
  for (const auto& pair : pair_margins) {
    std::snprintf(text, sizeof text, ", %.3g more", pair.margin);
    all += text + (" between " + pair.part_a + " and " + pair.part_b);
  }
  if (!moments.empty()) all += ", looked at where it touched";
  return all;
}

std::vector<PlanningView> planning_views(double clearance, double touching, double height,
                                         bool intervals_set) {
  const double little = kLittle * clearance, least = 2 * touching;
  PlanningView first = parts(clearance, clearance, intervals_set ? 0.0 : 0.25);
  first.most_checks = kFirstChecks;
  first.seeds_in_vain = kFirstSeedsInVain;
  PlanningView nearer = parts(clearance, little, 0.9);
  first.lessons = nearer.lessons = 1;
  PlanningView wider = nearer;
  wider.margin = kSkinMargin * height;
  wider.lessons = 0;
  PlanningView strict = skin(little, 0.9), last = skin(least, 0.9);
  strict.as_verified = last.as_verified = true;
  return {first, nearer, skin(clearance, 0.8), wider, strict, parts(least, least, 0.9), last};
}

}  // namespace elbowroom
