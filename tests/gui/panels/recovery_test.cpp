// SPDX-License-Identifier: MIT
// Unsaved work survives a session that ends badly, and nothing of the user's is written over.
#include "app/editor/recovery.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <memory>

#include "core/io/project_file.h"
#include "tests/gui/panels/demo_stretch.h"
#include "tests/gui/panels/editor_driver.h"

namespace elbowroom {
namespace {

namespace fs = std::filesystem;
using namespace command;
using Answer = AnswerRecovery::Answer;

class RecoveryTest : public testing::Test {
 protected:
  void begin() {
    driver = std::make_unique<EditorDriver>(1600.0f, 1000.0f, folder / "state");
    driver->editor.offer_lost_work();
    driver->ui.frame(3);
  }
  // As a crash does: without a question, and nothing is forgotten.
  void crash() { driver.reset(); }
  bool open() { return driver->open(demo_stretch(folder.path(), 0, 0.25, Props::none)); }
  void edit(double share = 0.5) {
    const double begin = driver->state().begin, length = driver->state().end - begin;
    driver->handle(SetWindow{Interval{begin, begin + share * length}, Phase::committed, 0});
    ASSERT_TRUE(driver->state().dirty);
  }
  void let_it_be_kept() {
    driver->ui.wait(Recovery::kDelay + 0.1);
    driver->ui.wait(0.1);
  }
  std::vector<fs::path> kept() const {
    std::vector<fs::path> files;
    for (const fs::path& place : {folder.path(), folder / "state"}) {
      if (!fs::exists(place)) continue;
      for (const auto& entry : fs::directory_iterator(place))
        if (entry.path().extension() == ".recovery") files.push_back(entry.path());
    }
    return files;
  }
  bool wait_for_kept(std::size_t count) {
    return driver->wait_until([&] { return kept().size() == count; }, 20);
  }
  static std::string bytes(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  ScratchFolder folder;
  std::unique_ptr<EditorDriver> driver;
};

TEST_F(RecoveryTest, WithoutAProject) {
  begin();
  EXPECT_EQ(driver->view().dialog, Dialog::none);
  ASSERT_TRUE(open());
  let_it_be_kept();
  EXPECT_TRUE(kept().empty()) << "nothing is unsaved";
  edit();
  driver->ui.frame(3);
  EXPECT_TRUE(kept().empty()) << "not at every edit";
  let_it_be_kept();
  ASSERT_TRUE(wait_for_kept(1));
  const Document lost = driver->document();
  crash();
  ASSERT_EQ(kept().size(), 1u);

  begin();
  ASSERT_EQ(driver->view().dialog, Dialog::recover);
  EXPECT_EQ(driver->state().lost->name, "mannequin");
  driver->ui.click("Recover/Recover");
  EXPECT_EQ(driver->view().dialog, Dialog::none);
  ASSERT_TRUE(driver->wait_until([&] { return driver->state().open() && driver->state().dirty; }));
  EXPECT_EQ(driver->draft(), lost.draft);
  EXPECT_TRUE(fs::equivalent(driver->document().scene.character, lost.scene.character));
  EXPECT_EQ(driver->document().scene.character, lost.scene.character) << "a path to be read";
  EXPECT_EQ(driver->state().undo_name, "Recover unsaved work");
  // It is kept again, in one file, and lost only when it is given up on purpose.
  const fs::path before = kept().front();
  let_it_be_kept();
  driver->wait_until([&] { return kept().size() == 1 && kept().front() != before; }, 20);
  crash();
  ASSERT_EQ(kept().size(), 1u);
  begin();
  ASSERT_EQ(driver->view().dialog, Dialog::recover);
  driver->ui.click("Recover/Later");
  EXPECT_EQ(kept().size(), 1u);
  crash();
  begin();
  driver->ui.click("Recover/Discard");
  ASSERT_TRUE(wait_for_kept(0));
  EXPECT_FALSE(driver->state().open());
  crash();
  begin();
  EXPECT_EQ(driver->view().dialog, Dialog::none);
}

TEST_F(RecoveryTest, GoesWithASaveAnUndoAndACleanEnd) {
  begin();
  ASSERT_TRUE(open());
  edit();
  let_it_be_kept();
  ASSERT_TRUE(wait_for_kept(1));
  driver->handle(Undo{});
  ASSERT_TRUE(wait_for_kept(0)) << "nothing is unsaved any more";
  edit();
  let_it_be_kept();
  ASSERT_TRUE(wait_for_kept(1));
  driver->handle(SaveProject{folder / "take.elbow"});
  ASSERT_TRUE(wait_for_kept(0));
  edit(0.8);
  let_it_be_kept();
  ASSERT_TRUE(wait_for_kept(1));
  driver->handle(Quit{true});
  driver.reset();
  EXPECT_TRUE(kept().empty());
  EXPECT_TRUE(fs::is_empty(folder / "state")) << "no lock is left either";
}

TEST_F(RecoveryTest, BesideAProject) {
  begin();
  ASSERT_TRUE(open());
  edit();
  const fs::path project = folder / "take.elbow";
  driver->handle(SaveProject{project});
  const std::string saved = bytes(project);
  const Document saved_document = driver->document();
  edit(0.9);
  let_it_be_kept();
  ASSERT_TRUE(wait_for_kept(1));
  EXPECT_EQ(kept().front(), recovery_of(project));
  const Document lost = driver->document();
  crash();
  EXPECT_EQ(bytes(project), saved) << "the project itself is not touched";

  begin();
  EXPECT_EQ(driver->view().dialog, Dialog::none) << "it is offered with its project";
  driver->handle(OpenFiles{{project}});
  ASSERT_TRUE(driver->wait_until([&] { return driver->view().dialog == Dialog::recover; }));
  EXPECT_EQ(driver->document().draft, saved_document.draft) << "the project is open meanwhile";
  driver->ui.frame(3);
  driver->ui.click("Recover/Recover");
  EXPECT_EQ(driver->draft(), lost.draft);
  EXPECT_TRUE(driver->state().dirty);
  EXPECT_EQ(driver->state().name, "take.elbow");
  driver->handle(Undo{});
  EXPECT_EQ(driver->draft(), saved_document.draft);
  EXPECT_FALSE(driver->state().dirty);
  EXPECT_TRUE(wait_for_kept(0));
}

TEST_F(RecoveryTest, OlderThanItsProjectOrTheSameIsNoneToOffer) {
  begin();
  ASSERT_TRUE(open());
  const fs::path project = folder / "take.elbow";
  driver->handle(SaveProject{project});
  const Document saved = driver->document();
  Document other = saved;
  other.draft.limb = "left_leg";
  ASSERT_TRUE(write_project(recovery_of(project), other).ok());
  const auto now = fs::last_write_time(project);
  const auto read = read_project(project);
  ASSERT_TRUE(read.ok());
  fs::last_write_time(recovery_of(project), now + std::chrono::seconds(10));
  EXPECT_TRUE(lost_beside(project, *read).has_value());
  fs::last_write_time(recovery_of(project), now);
  EXPECT_TRUE(lost_beside(project, *read).has_value()) << "within one tick of the clock";
  fs::last_write_time(recovery_of(project), now - std::chrono::seconds(10));
  EXPECT_FALSE(lost_beside(project, *read).has_value());
  fs::copy_file(project, recovery_of(project), fs::copy_options::overwrite_existing);
  fs::last_write_time(recovery_of(project), now + std::chrono::seconds(10));
  EXPECT_FALSE(lost_beside(project, *read).has_value()) << "it says the same";
  std::ofstream(recovery_of(project)) << "{ broken";
  fs::last_write_time(recovery_of(project), now + std::chrono::seconds(10));
  EXPECT_FALSE(lost_beside(project, *read).has_value());
  EXPECT_FALSE(lost_beside(folder / "none.elbow", *read).has_value());
}

// What stands at the place beside the project already belongs to somebody.
TEST_F(RecoveryTest, WritesOverNothingThatIsNotItsOwn) {
  begin();
  ASSERT_TRUE(open());
  const fs::path project = folder / "take.elbow";
  driver->handle(SaveProject{project});
  std::ofstream(recovery_of(project)) << "a letter to my aunt";
  edit();
  let_it_be_kept();
  ASSERT_TRUE(wait_for_kept(2));
  EXPECT_EQ(bytes(recovery_of(project)), "a letter to my aunt");
  driver->handle(Quit{true});
  driver.reset();
  EXPECT_EQ(bytes(recovery_of(project)), "a letter to my aunt");
  EXPECT_EQ(kept().size(), 1u);
}

TEST_F(RecoveryTest, OfALivingSessionIsNotLost) {
  begin();
  ASSERT_TRUE(open());
  edit();
  let_it_be_kept();
  ASSERT_TRUE(wait_for_kept(1));
  EXPECT_FALSE(lost_in(folder / "state").has_value());
  crash();
  EXPECT_TRUE(lost_in(folder / "state").has_value());
  std::ofstream(folder / "state" / "x.1-2.recovery") << "broken";
  EXPECT_TRUE(lost_in(folder / "state").has_value()) << "a broken one hides no other";
  EXPECT_FALSE(lost_in({}).has_value());
  EXPECT_FALSE(lost_in(folder / "nowhere").has_value());
}

// A drag is not interrupted, and a hand that never rests loses no more than the delay.
TEST_F(RecoveryTest, ManyEditsAreKeptInTime) {
  begin();
  ASSERT_TRUE(open());
  for (int i = 0; i < 20 && kept().empty(); ++i) {
    edit(0.3 + 0.02 * i);
    driver->ui.wait(1);
  }
  EXPECT_TRUE(wait_for_kept(1));
  // And a window that is left alone afterwards is left alone.
  let_it_be_kept();
  EXPECT_TRUE(driver->state().dirty);
  EXPECT_FALSE(driver->editor.wakes_at().has_value());
}

}  // namespace
}  // namespace elbowroom
