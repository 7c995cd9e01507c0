// SPDX-License-Identifier: MIT
// Undo and redo: the document's versions, each with the name of the step that led to it.
//
// A document is a value, so a step is just the document after it; nothing has to know how to take
// itself back. Steps of one drag are previews: the document shows them at once, and all of them
// become one step when the drag ends. A step that changes nothing is none.
//
// One thread. Cost of a step: a copy of the document.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/editing/document.h"

namespace elbowroom {

class History {
 public:
  using Edit = std::function<void(Document&)>;

  static constexpr std::size_t kMostSteps = 500;  // older ones are forgotten

  explicit History(Document document = {});

  // What is shown now, a preview included.
  const Document& document() const { return preview_ ? *preview_ : *steps_[at_].document; }

  // One step. Ends a preview first, as commit() does.
  void apply(const std::string& name, const Edit& edit);

  // Shows the document with the edit, made on the document as it was before the preview; again and
  // again while a drag lasts.
  void preview(const std::string& name, const Edit& edit);
  bool previewing() const { return preview_.has_value(); }
  void commit();  // the preview becomes a step
  void cancel();  // the preview is forgotten

  bool can_undo() const { return previewing() || at_ > 0; }
  bool can_redo() const { return !previewing() && at_ + 1 < steps_.size(); }
  // Names of the steps that undo() and redo() would take; empty if there is none.
  std::string undo_name() const;
  std::string redo_name() const;
  void undo();  // a preview is cancelled instead
  void redo();

  // Another number after each change of document(); for what is computed from it.
  std::uint64_t revision() const { return revision_; }

  // Whether the document differs from the one saved last (or begun with) by more than the limb that
  // is chosen.
  bool dirty() const { return dirty_; }
  void mark_saved();

 private:
  struct Step {
    std::string name;
    std::shared_ptr<const Document> document;
  };
  std::vector<Step> steps_;  // the first has no name: the document that was opened
  std::size_t at_ = 0;
  std::shared_ptr<const Document> saved_;
  std::optional<Document> preview_;
  std::string preview_name_;
  std::uint64_t revision_ = 1;
  bool dirty_ = false;

  void find_dirty();
};

}  // namespace elbowroom
