// SPDX-License-Identifier: MIT
// Undo: every step back and forth, one step for one drag, nothing for nothing.
#include "core/editing/history.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/base/random.h"

namespace elbowroom {
namespace {

Document named(const std::string& limb) {
  Document document;
  document.draft.limb = limb;
  return document;
}

History::Edit set_limb(const std::string& limb) {
  return [limb](Document& document) { document.draft.limb = limb; };
}

TEST(History, BeginsWithTheDocumentOpened) {
  const History history(named("left_arm"));
  EXPECT_EQ(history.document().draft.limb, "left_arm");
  EXPECT_FALSE(history.can_undo());
  EXPECT_FALSE(history.can_redo());
  EXPECT_FALSE(history.dirty());
  EXPECT_EQ(history.undo_name(), "");
}

TEST(History, StepsAreTakenBackAndMadeAgain) {
  History history;
  history.apply("one", set_limb("a"));
  history.apply("two", set_limb("b"));
  EXPECT_EQ(history.undo_name(), "two");
  history.undo();
  EXPECT_EQ(history.document().draft.limb, "a");
  EXPECT_EQ(history.undo_name(), "one");
  EXPECT_EQ(history.redo_name(), "two");
  history.redo();
  EXPECT_EQ(history.document().draft.limb, "b");
  history.undo();
  history.undo();
  EXPECT_EQ(history.document().draft.limb, "");
  history.undo();  // there is no more
  EXPECT_EQ(history.document().draft.limb, "");
}

TEST(History, AStepAfterAnUndoForgetsWhatWasUndone) {
  History history;
  history.apply("one", set_limb("a"));
  history.apply("two", set_limb("b"));
  history.undo();
  history.apply("three", set_limb("c"));
  EXPECT_FALSE(history.can_redo());
  history.undo();
  EXPECT_EQ(history.document().draft.limb, "a");
}

TEST(History, AStepThatChangesNothingIsNone) {
  History history(named("a"));
  history.apply("nothing", set_limb("a"));
  EXPECT_FALSE(history.can_undo());
  EXPECT_FALSE(history.dirty());
}

TEST(History, ADragIsOneStep) {
  History history(named("a"));
  for (int i = 0; i < 100; ++i) history.preview("drag", set_limb("at " + std::to_string(i)));
  EXPECT_EQ(history.document().draft.limb, "at 99");
  EXPECT_TRUE(history.can_undo());
  history.commit();
  EXPECT_EQ(history.document().draft.limb, "at 99");
  EXPECT_EQ(history.undo_name(), "drag");
  history.undo();
  EXPECT_EQ(history.document().draft.limb, "a");
  EXPECT_FALSE(history.can_undo());
}

TEST(History, ADragThatIsCancelledLeavesNothing) {
  History history(named("a"));
  history.preview("drag", set_limb("b"));
  history.cancel();
  EXPECT_EQ(history.document().draft.limb, "a");
  EXPECT_FALSE(history.can_undo());
  history.preview("drag", set_limb("b"));
  history.undo();  // in the middle of a drag: the drag alone
  EXPECT_EQ(history.document().draft.limb, "a");
}

TEST(History, ADragBackToItsBeginningIsNoStep) {
  History history(named("a"));
  history.preview("drag", set_limb("b"));
  history.preview("drag", set_limb("a"));
  history.commit();
  EXPECT_FALSE(history.can_undo());
}

TEST(History, EachPreviewStartsFromTheDocumentBeforeTheDrag) {
  History history;
  const auto grow = [](Document& document) { document.draft.limb += "x"; };
  history.preview("grow", grow);
  history.preview("grow", grow);
  EXPECT_EQ(history.document().draft.limb, "x");
}

TEST(History, ChoosingALimbIsNothingToSave) {
  History history;
  history.apply("choose", set_limb("a"));
  EXPECT_TRUE(history.can_undo());
  EXPECT_FALSE(history.dirty());
}

TEST(History, KnowsWhatIsSaved) {
  History history;
  history.apply("one", [](Document& document) { document.draft.window = Interval{1, 2}; });
  EXPECT_TRUE(history.dirty());
  history.mark_saved();
  EXPECT_FALSE(history.dirty());
  history.undo();
  EXPECT_TRUE(history.dirty());
  history.redo();
  EXPECT_FALSE(history.dirty());
}

TEST(History, RevisionsChangeWithEachChange) {
  History history;
  auto last = history.revision();
  const auto changed = [&] {
    const bool other = history.revision() != last;
    last = history.revision();
    return other;
  };
  history.apply("one", set_limb("a"));
  EXPECT_TRUE(changed());
  history.apply("one", set_limb("a"));
  EXPECT_FALSE(changed());
  history.preview("two", set_limb("b"));
  EXPECT_TRUE(changed());
  history.cancel();
  EXPECT_TRUE(changed());
  history.undo();
  EXPECT_TRUE(changed());
  history.redo();
  EXPECT_TRUE(changed());
}

TEST(History, OldStepsAreForgottenNotTheNewest) {
  History history;
  const int steps = static_cast<int>(History::kMostSteps) + 20;
  for (int i = 0; i < steps; ++i) history.apply("s", set_limb(std::to_string(i)));
  EXPECT_EQ(history.document().draft.limb, std::to_string(steps - 1));
  int back = 0;
  while (history.can_undo()) history.undo(), ++back;
  EXPECT_EQ(back, static_cast<int>(History::kMostSteps));
  while (history.can_redo()) history.redo();
  EXPECT_EQ(history.document().draft.limb, std::to_string(steps - 1));
}

// A thousand random calls against a plain list of what should be there.
TEST(History, RandomWalksAgreeWithAList) {
  Random random(7);
  History history;
  std::vector<std::string> list{""};
  std::size_t at = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto choice = random.below(4);
    if (choice < 2 && at < 300) {
      const std::string limb = std::to_string(i);
      history.apply(limb, set_limb(limb));
      list.resize(at + 1);
      list.push_back(limb);
      ++at;
    } else if (choice == 2) {
      history.undo();
      if (at > 0) --at;
    } else {
      history.redo();
      if (at + 1 < list.size()) ++at;
    }
    ASSERT_EQ(history.document().draft.limb, list[at]) << "after call " << i;
  }
}

}  // namespace
}  // namespace elbowroom
