// SPDX-License-Identifier: MIT
#include "tests/gui/panels/editor_driver.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "app/editor/key_names.h"
#include "assets/demo.h"

namespace elbowroom {

namespace fs = std::filesystem;

Document demo_scene() {
  const fs::path folder = ELBOWROOM_DEMO_DIR;
  Document document;
  document.scene.character = folder / demo::kMannequinFile;
  document.scene.clip = demo::kDemoClip;
  document.scene.obstacles = {folder / demo::kPostsFile};
  AttachedFile umbrella{folder / demo::kUmbrellaFile, demo::kAttachJoint, {}};
  umbrella.joint_from_object.translation = {demo::kGripX, demo::kGripY, demo::kGripZ};
  document.scene.attachments = {umbrella};
  return document;
}

ScratchFolder::ScratchFolder() {
  std::string name = (fs::temp_directory_path() / "elbowroom-panels-XXXXXX").string();
  path_ = mkdtemp(name.data()) ? name : std::string();
  EXPECT_FALSE(path_.empty());
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
}

EditorDriver::EditorDriver(float width, float height, const fs::path& recovery)
    : editor({}, recovery), ui(width, height) {
  // As in the real window: keys are shortcuts, Dear ImGui does not navigate by them.
  ImGui::GetIO().ConfigFlags &= ~ImGuiConfigFlags_NavEnableKeyboard;
  ui.show([this](Ui& toolkit) { draw(toolkit); });
}

void EditorDriver::draw(Ui& toolkit) {
  clock_ += static_cast<double>(ImGui::GetIO().DeltaTime);
  editor.update(clock_);
  Commands commands;
  press_keys(toolkit, editor.state(), editor.view(), commands);
  panels.draw(toolkit, editor.state(), editor.view(), commands);
  ui.keep_messages_above(panels.viewport().max.y);
  said.insert(said.end(), commands.begin(), commands.end());
  if (carry_out) editor.handle(commands);
  panels.frame(editor.state(), editor.view(), static_cast<double>(toolkit.scale()));
}

bool EditorDriver::wait_until(const std::function<bool()>& holds, double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  while (true) {
    ui.frame();
    if (holds()) return true;
    if (Clock::now() > end) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(3));
  }
  ADD_FAILURE() << "not within " << seconds << " s; the window shows\n" << ui.dump();
  return false;
}

bool EditorDriver::settle(double seconds) {
  return wait_until(
      [this] { return !editor.working() && state().target.status != TargetView::Status::solving; },
      seconds);
}

bool EditorDriver::open(const Document& document) {
  editor.open(document);
  // Whoever opens something here means it, whatever is not saved.
  if (editor.view().dialog == Dialog::discard_for_opening) {
    editor.view().dialog = Dialog::none;
    editor.handle(command::AnswerOpening{true});
  }
  return wait_until([this] { return !state().opening.active; }) && state().open();
}

bool EditorDriver::open_demo() {
  return open(demo_scene()) &&
         wait_until([this] { return state().strip && state().strip->complete(); }) && settle();
}

bool EditorDriver::plan(int limb, int window) {
  handle(command::SelectProblem{limb, window});
  handle(command::Plan{});
  return wait_until([this] { return !state().planning.active; }) && state().candidate.has_value();
}

int EditorDriver::limb(const std::string& name) const {
  if (!state().session) return -1;
  for (std::size_t i = 0; i < state().session->limbs.size(); ++i)
    if (state().session->limbs[i].limb.name == name) return static_cast<int>(i);
  return -1;
}

int EditorDriver::colliding_limb() const {
  if (!state().strip) return -1;
  for (std::size_t i = 0; i < state().strip->limbs.size(); ++i)
    if (!state().strip->limbs[i].windows.empty()) return static_cast<int>(i);
  return -1;
}

void EditorDriver::choose_menu(const std::string& menu, const std::string& item) {
  ui.click(menu);
  ui.frame(2);
  ui.click(menu + "/" + item);
  ui.frame(2);
}

std::string EditorDriver::row_name(int limb) const {
  return "Clip time.row." +
         limb_title(state().session->limbs[static_cast<std::size_t>(limb)].limb.name);
}

float EditorDriver::x_of(double t) const {
  const ProbedWidget* ruler = nullptr;
  for (const ProbedWidget& widget : const_cast<UiDriver&>(ui).ui().probe().widgets())
    if (widget.name == "Clip time.ruler") ruler = &widget;
  if (!ruler) return -1000;
  const TimelineView& seen = editor.view().timeline;
  const TimeRange range =
      usable_view(seen.from, seen.to, usable_clip(state().begin, state().end, state().frame_rate),
                  state().frame_rate);
  return TimeScale{range, ruler->min.x, ruler->max.x - ruler->min.x}.x_of(t);
}

ImVec2 EditorDriver::on_row(int limb, double t) { return {x_of(t), ui.centre(row_name(limb)).y}; }

}  // namespace elbowroom
