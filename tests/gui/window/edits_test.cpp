// SPDX-License-Identifier: MIT
// Every edit by mouse or key is one step of undo, and going back and forth brings back what was
// seen.
#include "tests/gui/window/driver/window_test.h"

namespace elbowroom::test {
namespace {

const char* const kHigh = "Clip time.window.high";
const char* const kElbow = "Elbow, flexion";

class Edits : public WindowTest {
 protected:
  // What the document shows as: limb, window, intervals, target, corrections; nothing that time,
  // the mouse or the work in the background changes.
  std::string seen() {
    std::string text;
    for (const auto& widget : editor().widgets()) {
      const bool document =
          (widget.path.rfind("Inspector/", 0) == 0 && widget.kind != "tab" &&
           widget.kind != "error" && widget.path.find('.') == std::string::npos) ||
          widget.path.find("Clip time.window") != std::string::npos ||
          widget.path.find("Clip time.mark") != std::string::npos;
      if (document && widget.kind != "item") text += widget.path + " " + widget.value + "\n";
    }
    return text;
  }
  // After an edit: what is seen has changed, and is one step more.
  void expect_step(const std::string& what) {
    const std::string before = steps_.back();
    ASSERT_TRUE(editor().wait([&] { return seen() != before; })) << what << " changed nothing";
    steps_.push_back(seen());
  }
  std::vector<std::string> steps_;
};

TEST_F(Edits, EachIsAStepOfUndo) {
  ASSERT_TRUE(editor().start()) << editor().said();
  ASSERT_TRUE(editor().wait_for("Outliner/Left arm"));
  editor().picture("opened");
  steps_.push_back(seen());
  ASSERT_TRUE(editor().click("Outliner/Left arm"));
  expect_step("choosing a limb");

  const auto row = editor().find("Clip time.row.Left arm");
  ASSERT_TRUE(row);
  const int y = row->middle().y, wide = row->max.x - row->min.x;
  editor().drag({row->min.x + 3 * wide / 10, y}, {row->min.x + 5 * wide / 10, y});
  expect_step("drawing a window");
  ASSERT_TRUE(editor().find(kHigh));
  const Pixel high = editor().find(kHigh)->middle();
  editor().drag(high, {high.x + wide / 10, y});
  expect_step("dragging the window's end");
  EXPECT_NEAR(editor().find(kHigh)->middle().x, high.x + wide / 10, 6);
  editor().picture("window");

  const auto bar = editor().find(std::string(kElbow) + ".bar");
  const auto low = editor().find(std::string(kElbow) + ".low");
  ASSERT_TRUE(bar && low);
  const std::string interval = editor().value(kElbow);
  editor().drag(low->middle(), {low->middle().x + 80, low->middle().y});
  expect_step("dragging an interval's end");
  EXPECT_NE(editor().value(kElbow), interval);
  ASSERT_TRUE(editor().click("Inspector/Preset"));
  ASSERT_TRUE(editor().click("Preset/High arm"));
  ASSERT_TRUE(editor().wait([&] { return editor().value("Inspector/Preset") == "High arm"; }));
  expect_step("a preset");
  editor().picture("preset");

  // Back to the beginning, one by one, and forth again.
  const std::string last = steps_.back();
  for (std::size_t i = steps_.size() - 1; i-- > 0;) {
    editor().key("ctrl+z");
    ASSERT_TRUE(editor().wait([&] { return seen() == steps_[i]; }, 5))
        << "undo to step " << i << " shows\n"
        << seen() << "instead of\n"
        << steps_[i];
  }
  EXPECT_FALSE(editor().find("Menu/Undo")->enabled);
  for (std::size_t i = 1; i < steps_.size(); ++i) {
    editor().key(i % 2 ? "ctrl+shift+z" : "ctrl+y");
    ASSERT_TRUE(editor().wait([&] { return seen() == steps_[i]; }, 5))
        << "redo to step " << i << " shows\n"
        << seen() << "instead of\n"
        << steps_[i];
  }
  EXPECT_FALSE(editor().find("Menu/Redo")->enabled);
  EXPECT_EQ(seen(), last);
}

}  // namespace
}  // namespace elbowroom::test
