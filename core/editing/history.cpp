// SPDX-License-Identifier: MIT
#include "core/editing/history.h"

#include <utility>

namespace elbowroom {

History::History(Document document) {
  steps_.push_back({"", std::make_shared<const Document>(std::move(document))});
  saved_ = steps_.front().document;
}

void History::apply(const std::string& name, const Edit& edit) {
  commit();
  Document changed = *steps_[at_].document;
  edit(changed);
  if (changed == *steps_[at_].document) return;
  steps_.resize(at_ + 1);
  steps_.push_back({name, std::make_shared<const Document>(std::move(changed))});
  if (steps_.size() > kMostSteps + 1) steps_.erase(steps_.begin());
  at_ = steps_.size() - 1;
  ++revision_;
  find_dirty();
}

void History::preview(const std::string& name, const Edit& edit) {
  preview_ = *steps_[at_].document;
  edit(*preview_);
  preview_name_ = name;
  ++revision_;
}

void History::commit() {
  if (!preview_) return;
  Document shown = std::move(*preview_);
  preview_.reset();
  ++revision_;  // document() is another object, even where it holds the same
  apply(preview_name_, [&shown](Document& document) { document = std::move(shown); });
}

void History::cancel() {
  if (!preview_) return;
  preview_.reset();
  ++revision_;
}

std::string History::undo_name() const {
  if (previewing()) return preview_name_;
  return at_ > 0 ? steps_[at_].name : "";
}

std::string History::redo_name() const { return can_redo() ? steps_[at_ + 1].name : ""; }

void History::undo() {
  if (previewing()) {
    cancel();
  } else if (at_ > 0) {
    --at_;
    ++revision_;
    find_dirty();
  }
}

void History::redo() {
  if (!can_redo()) return;
  ++at_;
  ++revision_;
  find_dirty();
}

void History::mark_saved() {
  commit();
  saved_ = steps_[at_].document;
  dirty_ = false;
}

void History::find_dirty() {
  if (steps_[at_].document == saved_) {
    dirty_ = false;
    return;
  }
  Document shown = *steps_[at_].document;
  shown.draft.limb = saved_->draft.limb;
  dirty_ = !(shown == *saved_);
}

}  // namespace elbowroom
