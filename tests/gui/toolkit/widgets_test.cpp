// SPDX-License-Identifier: MIT
// Each widget's contract, used by mouse and keyboard.
#include <gtest/gtest.h>

#include <limits>

#include "tests/gui/driver/ui_driver.h"
#include "ui/toolkit/toolkit.h"

namespace elbowroom {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

class Widgets : public testing::Test {
 protected:
  Widgets() : driver(500, 500) {}
  void show(std::function<void(Ui&)> draw) {
    driver.show([draw = std::move(draw)](Ui& ui) {
      const Panel panel(ui, "Panel", {{0, 0}, {400, 500}});
      draw(ui);
    });
  }
  UiDriver driver;
  int clicks = 0;
};

TEST_F(Widgets, AButtonIsClickedOnceByItsName) {
  show([this](Ui& ui) { clicks += button(ui, "Plan 1.2 s###plan", {.shortcut = "P"}); });
  driver.click("plan");
  driver.click("Plan 1.2 s");
  driver.click("Panel/plan");
  EXPECT_EQ(clicks, 3);
}

TEST_F(Widgets, ADisabledButtonSaysWhyNot) {
  show([this](Ui& ui) {
    clicks += button(ui, "Export", {.enabled = false, .why_not = "Nothing is accepted yet"});
  });
  driver.click("Export");
  EXPECT_EQ(clicks, 0);
  EXPECT_EQ(driver.hint(), "Nothing is accepted yet");
  EXPECT_FALSE(driver.widget("Export")->enabled);
}

TEST_F(Widgets, APressThatLeavesTheButtonIsNoClick) {
  show([this](Ui& ui) { clicks += button(ui, "Plan"); });
  driver.drag(driver.centre("Plan"), {450, 450});
  EXPECT_EQ(clicks, 0);
}

TEST_F(Widgets, IconsAreRecordedByName) {
  show([this](Ui& ui) { clicks += icon_button(ui, "Play", Icon::play, {.shortcut = "Space"}); });
  driver.click("Play");
  EXPECT_EQ(clicks, 1);
  EXPECT_EQ(driver.hint(), "Play");
}

TEST_F(Widgets, AToggleAndTabsKeepTheirState) {
  bool on = false;
  int tab = 99;
  show([&](Ui& ui) {
    clicks += toggle(ui, "Live", on);
    clicks += tabs(ui, "Pages", {"Limb", "Target", "Planner"}, tab);
  });
  EXPECT_EQ(tab, 2);  // put right
  clicks = 0;
  driver.click("Live");
  driver.click("Pages/Target");
  EXPECT_TRUE(on);
  EXPECT_EQ(driver.value("Live"), "on");
  EXPECT_EQ(tab, 1);
  EXPECT_EQ(clicks, 2);
  EXPECT_TRUE(driver.widget("Target")->selected);
}

TEST_F(Widgets, ARowTellsItsPartsApart) {
  RowResult sum;
  int action = -1, rows = 0;
  bool open = true;
  show([&](Ui& ui) {
    const RowResult r =
        list_row(ui, "Past post A",
                 {.actions = {{Icon::mute, "Mute"}, {Icon::trash, "Delete"}}, .expanded = open});
    rows += r.clicked;
    sum.double_clicked |= r.double_clicked;
    sum.context |= r.context;
    if (r.toggled) open = !open;
    if (r.action >= 0) action = r.action;
  });
  driver.click("Past post A");
  EXPECT_EQ(rows, 1);
  EXPECT_EQ(action, -1);
  driver.click("Past post A.Delete");
  EXPECT_EQ(action, 1);
  EXPECT_EQ(rows, 1);
  driver.click({16, driver.centre("Past post A").y});  // the chevron
  EXPECT_FALSE(open);
  EXPECT_EQ(rows, 1);
  driver.click("Past post A", 1);
  EXPECT_TRUE(sum.context);
  driver.double_click("Past post A");
  EXPECT_TRUE(sum.double_clicked);
}

TEST_F(Widgets, RowsReachFromEdgeToEdge) {
  show([](Ui& ui) { list_row(ui, "Ada", {.selected = true}); });
  // The record is cut at the padding's half, the row itself is not.
  EXPECT_LE(driver.widget("Ada")->min.x, 6);
  EXPECT_GE(driver.widget("Ada")->max.x, 394);
}

TEST_F(Widgets, SectionsFoldAndCardsAreChosen) {
  bool open = true;
  int cards = 0;
  show([&](Ui& ui) {
    if (section(ui, "More", open)) button(ui, "Inside");
    cards +=
        card(ui, "Over the post", {{"clearance", "3.1 cm"}, {"certified", "", Tone::good, true}})
            .clicked;
  });
  EXPECT_TRUE(driver.has("Inside"));
  driver.click("More");
  EXPECT_FALSE(driver.has("Inside"));
  driver.click("Over the post");
  EXPECT_EQ(cards, 1);
  EXPECT_EQ(driver.value("Over the post"), "clearance 3.1 cm, certified ✓");
}

TEST_F(Widgets, AComboChooses) {
  int chosen = 7;
  show([&](Ui& ui) { clicks += combo(ui, "Preset", chosen, {"Paper", "High arm", "Low arm"}); });
  EXPECT_EQ(driver.value("Preset"), "–");
  driver.click("Preset");
  driver.frame(2);
  driver.click("Low arm");
  EXPECT_EQ(chosen, 2);
  EXPECT_EQ(clicks, 1);
  EXPECT_EQ(driver.value("Preset"), "Low arm");
  driver.click("Preset");
  driver.frame(2);
  driver.key(keys::kEscape);
  driver.frame(2);
  EXPECT_FALSE(driver.has("High arm"));
}

class Number : public Widgets {
 protected:
  void show_number(NumberOptions options) {
    show([this, options](Ui& ui) {
      const Edit edit = number_input(ui, "Clearance", value, options);
      began += edit.began;
      committed += edit.committed;
      cancelled += edit.cancelled;
    });
  }
  double value = 0.02;
  int began = 0, committed = 0, cancelled = 0;
};

TEST_F(Number, IsDraggedInOneEdit) {
  show_number({.unit = "cm", .minimum = 0, .maximum = 1, .decimals = 1, .shown_per_value = 100});
  EXPECT_EQ(driver.value("Clearance"), "2.0 cm");
  driver.drag("Clearance", {40, 0});
  EXPECT_NEAR(value, 0.06, 0.01);
  EXPECT_EQ(began, 1);
  EXPECT_EQ(committed, 1);
  driver.drag("Clearance", {-2000, 0});
  EXPECT_EQ(value, 0);
}

TEST_F(Number, IsTyped) {
  show_number({.unit = "cm", .decimals = 1, .shown_per_value = 100});
  driver.double_click("Clearance");
  driver.frame(2);
  driver.type("12,5 cm");
  driver.key(keys::kEnter);
  EXPECT_NEAR(value, 0.125, 1e-12);
  EXPECT_EQ(committed, 1);
}

TEST_F(Number, IsTypedAndLeftByAClickElsewhere) {
  show_number({});
  driver.double_click("Clearance");
  driver.frame(2);
  driver.type("5");
  driver.click(ImVec2(200, 400));
  driver.frame(2);
  EXPECT_NEAR(value, 5, 1e-12);
  EXPECT_EQ(committed, 1);
}

TEST_F(Number, EscapeAndNonsenseChangeNothing) {
  show_number({});
  for (const char* text : {"nan", "inf", "", "1 2"}) {
    driver.double_click("Clearance");
    driver.frame(2);
    driver.type(text);
    driver.key(*text == '\0' ? keys::kEscape : keys::kEnter);
    EXPECT_EQ(value, 0.02) << text;
  }
  driver.move_to("Clearance");
  driver.press();
  const ImVec2 at = driver.centre("Clearance");
  driver.move_to({at.x + 50, at.y});
  EXPECT_NE(value, 0.02);
  driver.key(keys::kEscape);
  driver.release();
  EXPECT_EQ(value, 0.02);
  EXPECT_EQ(cancelled, 1);
  EXPECT_EQ(committed, 0);
}

TEST_F(Number, HostileValuesArePutRight) {
  value = kNone;
  show_number({.minimum = 1, .maximum = kNone, .decimals = 99, .shown_per_value = 0});
  EXPECT_EQ(value, 1);
}

TEST(TypedNumbers, AreReadAsPeopleWriteThem) {
  using Numbers = std::vector<double>;
  EXPECT_EQ(typed_numbers("85° – 140°"), (Numbers{85, 140}));
  EXPECT_EQ(typed_numbers("85-140"), (Numbers{85, 140}));
  EXPECT_EQ(typed_numbers("−20 20"), (Numbers{-20, 20}));
  EXPECT_EQ(typed_numbers("-20 - -10"), (Numbers{-20, -10}));
  EXPECT_EQ(typed_number("12,5 cm"), 12.5);
  EXPECT_EQ(typed_number("1e-3"), 1e-3);
  EXPECT_EQ(typed_number("1e999"), std::nullopt);
  EXPECT_EQ(typed_number("nan"), std::nullopt);
  EXPECT_EQ(typed_number("--"), std::nullopt);
  EXPECT_EQ(number_text(-0.001, 1, "cm"), "0.0 cm");
  EXPECT_EQ(number_text(-3, 0, "°"), "−3°");
  EXPECT_EQ(number_text(kNone, 1, "cm"), "–");
}

TEST_F(Widgets, TextIsTypedAndCommittedOnce) {
  std::string name = "Past post A";
  int committed = 0, entered = 0;
  show([&](Ui& ui) {
    const TextEdit edit = text_input(ui, "Name", name);
    committed += edit.committed;
    entered += edit.entered;
  });
  driver.click("Name");
  driver.key('A', {.control = true});
  driver.type("Über");
  driver.key(keys::kEnter);
  EXPECT_EQ(name, "Über");
  EXPECT_EQ(entered, 1);
  EXPECT_EQ(committed, 1);
  driver.click("Name");
  driver.type("xyz");
  driver.key(keys::kEscape);
  EXPECT_EQ(name, "Über");
  EXPECT_EQ(committed, 1);
}

TEST_F(Widgets, ProgressIsCancelled) {
  show([&](Ui& ui) { clicks += progress(ui, "Planning", 0.345, {.right = "4 s left"}); });
  EXPECT_EQ(driver.value("Planning"), "34 % · 4 s left");
  driver.click("Planning/Cancel");
  EXPECT_EQ(clicks, 1);
}

TEST_F(Widgets, HostileProgressIsDrawn) {
  show([&](Ui& ui) {
    progress(ui, "a", kNone);
    progress(ui, "b", 1e300);
    progress(ui, "c", std::nullopt);
  });
  EXPECT_EQ(driver.value("a"), "0 %");
  EXPECT_EQ(driver.value("b"), "100 %");
}

TEST_F(Widgets, ErrorsSayWhatWhereAndWhatToDo) {
  show([&](Ui& ui) {
    clicks += inline_error(ui, {"No way past Post A", "right arm, 1.62 s", "Widen the intervals"});
  });
  EXPECT_EQ(driver.value("No way past Post A"), "right arm, 1.62 s\nWiden the intervals");
  driver.click("Dismiss");
  EXPECT_EQ(clicks, 1);
}

TEST_F(Widgets, ToastsGoByThemselvesAndProblemsStay) {
  show([](Ui&) {});
  driver.ui().toast(Tone::good, "Exported");
  driver.ui().toast(Error{"Cannot write", "/full/disk", "Free some space"});
  driver.frame(2);
  EXPECT_TRUE(driver.has("Exported"));
  EXPECT_TRUE(driver.ui().animating());
  driver.wait(6);
  driver.frame(2);
  EXPECT_FALSE(driver.has("Exported"));
  EXPECT_TRUE(driver.has("Cannot write"));
  EXPECT_FALSE(driver.ui().animating());
  driver.click("Cannot write");
  EXPECT_FALSE(driver.has("Cannot write"));
}

class Ask : public Widgets {
 protected:
  void SetUp() override {
    show([this](Ui& ui) {
      clicks += button(ui, "Behind");
      const auto given = ask(
          ui, open,
          {"Save changes?", "One correction is not saved.", {"Save", "Discard", "Cancel"}, -1, 1});
      if (given) answers.push_back(*given);
    });
    driver.frame(3);
  }
  bool open = true;
  std::vector<int> answers;
};

TEST_F(Ask, IsAnsweredByAClick) {
  driver.click("Discard");
  EXPECT_EQ(answers, std::vector<int>{1});
  EXPECT_FALSE(open);
  driver.click("Behind");
  EXPECT_EQ(clicks, 1);
}

TEST_F(Ask, EnterIsTheFirstAnswerAndEscapeTheLast) {
  driver.key(keys::kEnter);
  EXPECT_EQ(answers, std::vector<int>{0});
  open = true;
  driver.frame(3);
  driver.key(keys::kEscape);
  EXPECT_EQ(answers, (std::vector<int>{0, 2}));
  EXPECT_FALSE(open);
}

TEST_F(Ask, NothingBehindItIsClicked) {
  driver.click("Behind");
  EXPECT_EQ(clicks, 0);
}

TEST(Splitters, KeepTheirRatioWithinBounds) {
  UiDriver driver(1000, 600);
  double ratio = kNone;
  int committed = 0;
  driver.show([&](Ui& ui) {
    { const Panel left(ui, "Left", {{0, 0}, {500, 600}}); }
    committed += splitter_between_columns(ui, "split",
                                          1000 * static_cast<float>(ratio == ratio ? ratio : 0.5),
                                          0, 600, ratio, 1000, 0.2, 0.8, 0.3)
                     .committed;
  });
  EXPECT_EQ(ratio, 0.5);
  driver.drag("split", {-100, 0});
  EXPECT_NEAR(ratio, 0.4, 0.01);
  EXPECT_EQ(committed, 1);
  driver.drag("split", {-900, 0});
  EXPECT_EQ(ratio, 0.2);
  driver.double_click("split");
  EXPECT_NEAR(ratio, 0.3, 1e-12);
  EXPECT_EQ(committed, 3);
}

TEST(Keys, AreParsedAndMatchedExactly) {
  UiDriver driver(300, 200);
  int plan = 0, redo = 0, help = 0, f1 = 0, typed = 0;
  std::string text;
  driver.show([&](Ui& ui) {
    const Panel panel(ui, "P", {{0, 0}, {300, 200}});
    plan += keys_pressed("P");
    redo += keys_pressed("Ctrl+Shift+Z");
    help += keys_pressed("?");
    f1 += keys_pressed("F1");
    typed += keys_pressed("nonsense") + keys_pressed("") + keys_pressed("F99");
    text_input(ui, "Name", text);
  });
  driver.key('P');
  driver.key('P', {.control = true});
  driver.key('Z', {.control = true, .shift = true});
  driver.key('Z', {.control = true});
  driver.key('/', {.shift = true});
  driver.key(290);
  EXPECT_EQ(plan, 1);
  EXPECT_EQ(redo, 1);
  EXPECT_EQ(help, 1);
  EXPECT_EQ(f1, 1);
  EXPECT_EQ(typed, 0);
  driver.click("Name");
  driver.key('P');  // typed into the field, no command
  EXPECT_EQ(plan, 1);
}

TEST(Menus, AreClickedByName) {
  UiDriver driver(600, 400);
  int opened = 0;
  driver.show([&](Ui& ui) {
    if (ImGui::BeginMainMenuBar()) {
      if (begin_menu(ui, "File")) {
        opened += menu_item(ui, "Open…", {.shortcut = "Ctrl+O", .hint = "Open a file"});
        menu_item(ui, "Export", {.enabled = false});
        end_menu(ui);
      }
      ImGui::EndMainMenuBar();
    }
  });
  driver.click("File");
  driver.frame(2);
  EXPECT_FALSE(driver.widget("File/Export")->enabled);
  driver.click("File/Open…");
  EXPECT_EQ(opened, 1);
}

TEST(ProbeTest, NamesAreFoundByPathAndEnd) {
  EXPECT_EQ(name_part("Plan 1.2 s###plan"), "plan");
  EXPECT_EQ(shown_part("Plan 1.2 s###plan"), "Plan 1.2 s");
  EXPECT_EQ(name_part("Delete##3"), "Delete");
  EXPECT_EQ(name_part("##speed"), "speed");
  EXPECT_EQ(name_part(""), "");
  EXPECT_EQ(name_part("#"), "#");
}

TEST_F(Widgets, WhatIsOutOfSightIsMarked) {
  show([&](Ui& ui) {
    for (int i = 0; i < 60; ++i) {
      const auto row = ui.scope(i);
      list_row(ui, "row " + std::to_string(i));
    }
  });
  EXPECT_TRUE(driver.widget("row 3")->visible);
  EXPECT_FALSE(driver.widget("row 59")->visible);
  EXPECT_NE(driver.dump().find("row \"row 59\" (out of sight)"), std::string::npos);
}

TEST_F(Widgets, EmptyAndHugeTextsAreDrawn) {
  const std::string huge(100000, 'W');
  show([&](Ui& ui) {
    label(ui, "", "");
    label(ui, huge, huge);
    title(ui, huge);
    note(ui, "");
    button(ui, huge, {.width = 100});
    button(ui, "");
    list_row(ui, huge, {.right = huge, .badge = huge, .indent = -3});
    card(ui, huge, {{huge, huge}});
    tabs(ui, "t", {huge, "", huge}, clicks);
    tabs(ui, "none", {}, clicks);
    combo(ui, "c", clicks, {});
    label(ui, "\xff\xfe broken \xc3");
  });
  driver.frame(3);
  EXPECT_LT(driver.draw_data()->TotalVtxCount, 60000);
}

TEST_F(Widgets, TextIsWrappedBetweenWords) {
  ImFont* font = driver.ui().fonts().small;
  const std::string text =
      "Most in the way: umbrella.glb/Umbrella with posts.glb/RightPost at 1.725 s.\n"
      "A wider window, 1.425 to 2.223 s, would do.";
  for (float width = 1; width < 700; width += 7) {
    const std::string lines = wrapped(font, text, width);
    std::string joined = lines;
    std::size_t begin = 0;
    while (begin < lines.size()) {
      const std::size_t end = std::min(lines.find('\n', begin), lines.size());
      const std::string line = lines.substr(begin, end - begin);
      if (width > 20) {
        EXPECT_LE(size_of(font, line).x, width) << line;
      }
      if (width > 150 && end < lines.size()) {
        // A line begins and ends with a whole word.
        EXPECT_TRUE(text.find(line + " ") != std::string::npos ||
                    text.find(line + "\n") != std::string::npos)
            << line;
      }
      begin = end + 1;
    }
    // Nothing is lost.
    const auto bare = [](std::string s) {
      std::erase_if(s, [](char c) { return c == ' ' || c == '\n'; });
      return s;
    };
    EXPECT_EQ(bare(joined), bare(text));
  }
  EXPECT_EQ(wrapped(font, "", 100), "");
  EXPECT_EQ(wrapped(font, "a\n\nb", 100), "a\n\nb");
}

}  // namespace
}  // namespace elbowroom
