// SPDX-License-Identifier: MIT
#include "core/collision/world_steps.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace elbowroom {

std::vector<double> world_steps(const World& world, double begin, double end) {
  std::vector<double> steps;
  for (const Actor& actor : world.actors) {
    if (actor.clip) {
      const std::vector<double> own = step_times(*actor.clip);
      steps.insert(steps.end(), own.begin(), own.end());
    }
    if (actor.attachment) {
      steps.push_back(actor.attachment->begin);
      if (std::isfinite(actor.attachment->end)) steps.push_back(just_after(actor.attachment->end));
    }
  }
  std::erase_if(steps, [&](double t) { return !(t >= begin && t <= end); });
  std::sort(steps.begin(), steps.end());
  steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
  return steps;
}

double just_before(double t) { return std::nextafter(t, -std::numeric_limits<double>::infinity()); }
double just_after(double t) { return std::nextafter(t, std::numeric_limits<double>::infinity()); }

}  // namespace elbowroom
