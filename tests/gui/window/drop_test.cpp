// SPDX-License-Identifier: MIT
// Files dropped on the window. xdotool has nothing to drop, so what GLFW calls on a drop is called
// here, on a real window; what comes of it goes to the editor as the window's loop hands it over.
#include <chrono>
#include <cstdlib>
#include <thread>
#include <utility>

#include "app/editor/editor.h"
#include "app/editor/window_input.h"
#include "tests/gui/window/driver/window_test.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace elbowroom::test {
namespace {

class Drop : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    if (IsSkipped()) return;
    screen_ = std::make_unique<Screen>(640, 480);
    ASSERT_FALSE(screen_->display().empty());
    setenv("DISPLAY", screen_->display().c_str(), 1);
    ASSERT_TRUE(glfwInit());
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    window_ = glfwCreateWindow(320, 240, "drop", nullptr, nullptr);
    ASSERT_NE(window_, nullptr);
    watch_events(window_, input_);
  }
  void TearDown() override {
    if (window_) glfwDestroyWindow(window_);
    if (screen_) glfwTerminate();
    WindowTest::TearDown();
  }
  void drop(const std::vector<std::string>& files) {
    std::vector<const char*> paths;
    for (const auto& file : files) paths.push_back(file.c_str());
    const GLFWdropfun dropped = glfwSetDropCallback(window_, nullptr);
    ASSERT_NE(dropped, nullptr);
    glfwSetDropCallback(window_, dropped);
    dropped(window_, static_cast<int>(paths.size()), paths.data());
  }
  // As the window's loop does.
  void hand_over(Editor& editor) {
    editor.handle(command::OpenFiles{std::exchange(input_.dropped, {})});
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    do {
      editor.update(
          std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
              .count());
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    } while (editor.state().opening.active && std::chrono::steady_clock::now() < end);
    ASSERT_FALSE(editor.state().opening.active);
  }

  std::unique_ptr<Screen> screen_;
  GLFWwindow* window_ = nullptr;
  WindowInput input_;
};

TEST_F(Drop, ACharacterThenAnObjectThenBothAtOnce) {
  const std::string character = (kDemo / demo::kMannequinFile).string();
  const std::string posts = (kDemo / demo::kPostsFile).string();
  Editor editor;
  drop({character});
  EXPECT_EQ(input_.dropped, std::vector<std::filesystem::path>{character});
  EXPECT_EQ(input_.events, 1) << "the window wakes up for it";
  hand_over(editor);
  ASSERT_TRUE(editor.state().open());
  EXPECT_EQ(editor.state().document->scene.character, character);
  // An object goes into the scene that is open, as a step of undo.
  drop({posts});
  hand_over(editor);
  EXPECT_EQ(editor.state().document->scene.obstacles, std::vector<std::filesystem::path>{posts});
  EXPECT_FALSE(editor.state().undo_name.empty());
  editor.handle(command::Undo{});
  // Two in one drop, in any order.
  Editor another;
  drop({posts, character});
  EXPECT_EQ(input_.dropped.size(), 2u);
  hand_over(another);
  ASSERT_TRUE(another.state().open());
  EXPECT_EQ(another.state().document->scene.character, character);
  EXPECT_EQ(another.state().document->scene.obstacles, std::vector<std::filesystem::path>{posts});
  // Two drops between two frames lose none; what is no scene is told and changes nothing.
  drop({posts});
  drop({"/nowhere/at all.glb"});
  EXPECT_EQ(input_.dropped.size(), 2u);
  hand_over(another);
  EXPECT_EQ(another.state().document->scene.obstacles.size(), 1u);
  EXPECT_EQ(another.state().notices.back().kind, Notice::Kind::error);
}

}  // namespace
}  // namespace elbowroom::test
