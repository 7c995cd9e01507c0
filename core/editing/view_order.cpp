// SPDX-License-Identifier: MIT
#include "core/editing/view_order.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace elbowroom {
namespace {

constexpr int kMostSkinLessons = 4;  // in all views of the skin
constexpr double kNearItself = 0.1;  // × the view's clearance

}  // namespace

ViewOrder::ViewOrder(std::vector<PlanningView> views)
    : views_(std::move(views)), left_(views_.size()), skin_lessons_(kMostSkinLessons) {
  std::iota(left_.begin(), left_.end(), std::size_t{0});
}

std::optional<ViewOrder::Look> ViewOrder::next() {
  if (looking_) {
    if (look_again()) return look();
    skin_decides_ = skin_decides_ || (!view_.on_skin && lesson().size() > 0);
    looking_ = false;
  }
  if (left_.empty()) return std::nullopt;
  auto at = left_.begin();
  if (skin_decides_) {
    at = std::find_if(left_.begin(), left_.end(),
                      [this](std::size_t k) { return views_[k].on_skin; });
    if (at == left_.end()) at = left_.begin();
  }
  index_ = *at;
  left_.erase(at);
  looking_ = true;
  looks_ = 0;
  of_parts_ = {};
  view_ = views_[index_];
  if (view_.on_skin) view_.moments = of_skin_.moments();
  return look();
}

ViewOrder::Look ViewOrder::look() {
  known_ = lesson().size();
  const bool learns = looks_ < views_[index_].lessons && (!view_.on_skin || skin_lessons_ > 0);
  ++looks_;
  return {view_, index_, learns ? &lesson() : nullptr};
}

bool ViewOrder::look_again() {
  const PlanningView& plain = views_[index_];
  if (lesson().size() > known_) {
    if (plain.on_skin) --skin_lessons_;
    view_ = lesson().taught(plain);
    return true;
  }
  const double near_itself = kNearItself * plain.clearance;
  if (!plain.on_skin || looks_ < 2 || view_.body_clearance <= near_itself) return false;
  view_.body_clearance = near_itself;
  return true;
}

}  // namespace elbowroom
