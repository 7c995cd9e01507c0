// SPDX-License-Identifier: MIT
#include "app/editor/window.h"

#include <epoxy/gl.h>
// epoxy first: GLFW then brings no GL header of its own.
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <optional>

#include "app/editor/editor.h"
#include "app/editor/key_names.h"
#include "app/editor/settings.h"
#include "app/editor/window_input.h"
#include "render/quality.h"
#include "render/scene_renderer.h"
#include "ui/actions.h"
#include "ui/editor_ui.h"

namespace elbowroom {
namespace {

constexpr int kFramesAfterAnEvent = 3;       // Dear ImGui settles its layout within these
constexpr double kWorkingWait = 0.1;         // s, between frames that only show a job's progress
constexpr double kStillWhileWorking = 0.06;  // s, that a picture at rest may take meanwhile
constexpr double kFrame = 0.032;             // s, that a frame may take while something moves
constexpr double kLeastPicture = 0.008;      // s, of that for the picture, however slow the panels
constexpr float kAlways = 1e6f;              // s
constexpr int kLeastWidth = 800, kLeastHeight = 560;

std::string last_glfw_error;

void remember_error(int, const char* text) { last_glfw_error = text ? text : ""; }

// GLFW and its one window, for as long as this lives.
class Glfw {
 public:
  Glfw() {
    glfwSetErrorCallback(remember_error);
    ready_ = glfwInit() == GLFW_TRUE;
  }
  ~Glfw() {
    if (window) glfwDestroyWindow(window);
    if (ready_) glfwTerminate();
  }
  Glfw(const Glfw&) = delete;
  Glfw& operator=(const Glfw&) = delete;
  bool ready() const { return ready_; }

  GLFWwindow* window = nullptr;

 private:
  bool ready_ = false;
};

Style viewport_style(bool light) {
  Style style;
  if (light) {
    style.backdrop_centre = 0xf2f3f5;
    style.backdrop_edge = 0xc9cdd4;
    style.grid = 0x8a909b;
    style.ground_shadow_opacity = 0.35f;
  }
  return style;
}

// Dear ImGui with its two backends.
class Gui {
 public:
  explicit Gui(GLFWwindow* window) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // what is kept stands in our own settings
    ImGui::GetIO().ConfigWindowsMoveFromTitleBarOnly = true;
    ImGui_ImplGlfw_InitForOpenGL(window, true);  // chains to the callbacks set before
    ImGui_ImplOpenGL3_Init("#version 450 core");
  }
  ~Gui() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
  }
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;
};

double content_scale(GLFWwindow* window) {
  float x = 1, y = 1;
  glfwGetWindowContentScale(window, &x, &y);
  return std::max(1.0, static_cast<double>(std::max(x, y)));
}

std::string title_of(const EditorState& state) {
  if (state.name.empty()) return "Elbowroom";
  return state.name + (state.dirty ? " • — " : " — ") + "Elbowroom";
}

// What a picture of the viewport rests on.
struct PictureKey {
  std::uint64_t version = 0;
  Camera camera;
  Compare compare = Compare::both;
  bool trails = false, limb = false, light = false;
  int cone = -1;  // the swing whose limit is shown
  int width = 0, height = 0;
  bool operator==(const PictureKey&) const = default;
};

class EditorWindow {
 public:
  EditorWindow(GLFWwindow* window, SceneRenderer renderer, const Settings& settings)
      : window_(window),
        gui_(window),
        renderer_(std::move(renderer)),
        editor_([] { glfwPostEmptyEvent(); }, recovery_folder()) {
    editor_.view() = settings.view;
    editor_.recent_files() = settings.recent_files;
    restyle();
  }

  Editor& editor() { return editor_; }

  void run(WindowInput& input, std::ofstream* log, const std::filesystem::path& widget_log) {
    int frames = kFramesAfterAnEvent;
    std::string title;
    while (true) {
      if (frames > 0 || editor_.moving() || input.mouse.waiting())
        glfwPollEvents();
      else if (editor_.working() || ui_->animating())
        glfwWaitEventsTimeout(kWorkingWait);
      else if (const auto finer = quality_.redraw_at())
        glfwWaitEventsTimeout(std::max(1e-3, *finer - glfwGetTime()));
      else if (const auto wake = editor_.wakes_at())
        glfwWaitEventsTimeout(std::max(1e-3, *wake - glfwGetTime()));
      else
        glfwWaitEvents();
      const double start = glfwGetTime();
      if (glfwWindowShouldClose(window_)) {
        glfwSetWindowShouldClose(window_, GLFW_FALSE);
        editor_.handle(command::Quit{});
      }
      if (!input.dropped.empty())
        editor_.handle(command::OpenFiles{std::exchange(input.dropped, {})});
      const bool changed = editor_.update(start);
      if (input.events > 0 || changed) frames = kFramesAfterAnEvent;
      const auto finer = quality_.redraw_at();
      const bool alive = input.mouse.waiting() || editor_.moving() || editor_.working() ||
                         ui_->animating() || (finer && start >= *finer);
      if (frames == 0 && !alive) continue;
      const double asked = input.first_event;
      const int events = std::exchange(input.events, 0);
      input.first_event = -1;
      if (frames > 0) --frames;
      picture_seconds_ = 0;
      frame(input, events > 0);
      const double end = glfwGetTime();
      panel_seconds_ += 0.2 * (end - start - picture_seconds_ - panel_seconds_);
      if (log)
        *log << start << ' ' << (asked >= 0 ? (end - asked) * 1e3 : -1.0) << ' '
             << (end - start) * 1e3 << ' ' << events << ' '
             << (editor_.state().planning.active   ? "planning"
                 : editor_.state().scanning.active ? "scanning"
                 : editor_.state().playing         ? "playing"
                                                   : "still")
             << '\n'
             << std::flush;
      if (!widget_log.empty()) write_widgets(widget_log);
      if (editor_.quitting()) return;
      const std::string wanted = title_of(editor_.state());
      if (wanted != title) {
        title = wanted;
        glfwSetWindowTitle(window_, title.c_str());
      }
      if (editor_.view().scale != scale_ || editor_.view().light_theme != light_ ||
          content_scale(window_) != content_) {
        restyle();
        frames = kFramesAfterAnEvent;
      }
    }
  }

 private:
  void restyle() {
    scale_ = editor_.view().scale;
    light_ = editor_.view().light_theme;
    content_ = content_scale(window_);
    const Theme theme = light_ ? light_theme() : dark_theme();
    const double scale = scale_ * content_;
    apply(theme, scale);
    const Fonts fonts = load_fonts(*ImGui::GetIO().Fonts, theme, scale);
    // Made anew here: the backend does so only when it makes everything, in its first frame.
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    if (ui_) ImGui_ImplOpenGL3_CreateFontsTexture();
    if (ui_)
      ui_->restyle(theme, fonts, scale);
    else
      ui_ = std::make_unique<Ui>(theme, fonts, scale);
  }

  // `asked`: somebody has done something since the last one.
  void frame(WindowInput& input, bool asked) {
    ImGuiIO& io = ImGui::GetIO();
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    // Dear ImGui sees the state of keys and mouse once a frame. A key that is up again already is
    // shown to it all the same; of the mouse, see mouse_queue.h.
    const std::vector<WindowInput::Key> pressed = std::exchange(input.keys, {});
    std::vector<int> held;
    for (const WindowInput::Key& key : pressed)
      if (key.key < static_cast<int>(std::size(io.KeysDown)) && !io.KeysDown[key.key]) {
        io.KeysDown[key.key] = true;
        held.push_back(key.key);
      }
    const bool control = io.KeyCtrl, shift = io.KeyShift, alt = io.KeyAlt;
    for (const WindowInput::Key& key : pressed) {
      io.KeyCtrl |= (key.modifiers & GLFW_MOD_CONTROL) != 0;
      io.KeyShift |= (key.modifiers & GLFW_MOD_SHIFT) != 0;
      io.KeyAlt |= (key.modifiers & GLFW_MOD_ALT) != 0;
    }
    const MouseQueue::Shown& mouse = input.mouse.next();
    // Dear ImGui would go by when frames show the presses; what they are is known better here.
    io.MouseDoubleClickTime = mouse.doubled ? kAlways : 0.0f;
    for (int i = 0; i < MouseQueue::kButtons; ++i)
      io.MouseDown[i] = mouse.down[static_cast<std::size_t>(i)];
    // Where the mouse is elsewhere the backend says so, and knows best.
    if (ImGui::IsMousePosValid(&io.MousePos))
      io.MousePos = ImVec2(static_cast<float>(mouse.x), static_cast<float>(mouse.y));
    io.KeyCtrl |= (mouse.modifiers & GLFW_MOD_CONTROL) != 0;
    io.KeyShift |= (mouse.modifiers & GLFW_MOD_SHIFT) != 0;
    io.KeyAlt |= (mouse.modifiers & GLFW_MOD_ALT) != 0;
    ImGui::NewFrame();
    for (const int key : held) io.KeysDown[key] = false;
    ui_->begin_frame();
    Commands commands;
    press_keys(*ui_, editor_.state(), editor_.view(), commands);
    editor_ui_.draw(*ui_, editor_.state(), editor_.view(), commands);
    ui_->end_frame(editor_ui_.viewport().max.y);
    ImGui::Render();
    io.KeyCtrl = control;
    io.KeyShift = shift;
    io.KeyAlt = alt;
    editor_.handle(commands);
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, width, height);
    const ImVec4 ground = ImGui::ColorConvertU32ToFloat4(ui_->palette().ground);
    glClearColor(ground.x, ground.y, ground.z, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    paint_viewport(height, asked);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    glfwSwapBuffers(window_);
  }

  // The picture is drawn only when something in it has changed, or when the last one was coarser
  // than it may be at rest; else the last one is shown again.
  void paint_viewport(int window_height, bool asked) {
    const Rect rect = editor_ui_.viewport();
    const int width = static_cast<int>(rect.width()), height = static_cast<int>(rect.height());
    if (width < 1 || height < 1) return;
    ViewState& view = editor_.view();
    const EditorState& state = editor_.state();
    const Frame* frame = &editor_ui_.frame(state, view, static_cast<double>(ui_->scale()));
    PictureKey key{editor_.picture_version(),
                   view.camera,
                   view.compare,
                   view.show_trails,
                   view.show_limb,
                   light_,
                   view.swing_in_picture ? view.swing_joint : -1,
                   width,
                   height};
    const double now = glfwGetTime();
    const auto finer = quality_.redraw_at();
    if (!(key == painted_) || (finer && now >= *finer)) {
      // Whoever does something wants to see it at once, and more may follow; news from the
      // background change the picture once.
      const bool moving = asked || state.playing || editor_ui_.dragging() || scrubbing() ||
                          !(key.camera == painted_.camera);
      // A picture at rest must not hold up what is being computed and watched.
      QualityBudget budget;
      budget.moving = std::max(kLeastPicture, kFrame - panel_seconds_);
      if (editor_.working()) budget.still = kStillWhileWorking;
      quality_.set_budget(budget);
      const DrawQuality& quality =
          kQualities[static_cast<std::size_t>(quality_.choose(moving, now))];
      if (quality.scale != 1)
        frame = &editor_ui_.frame(
            state, view, pixel_scale_with_quality(static_cast<double>(ui_->scale()), quality));
      const Status drawn =
          renderer_.draw(*frame, view.camera, with_quality(viewport_style(light_), quality),
                         with_quality(PictureSize{width, height}, quality));
      if (!drawn) {
        editor_.tell(Notice::Kind::error, drawn.error());
        return;
      }
      glFinish();
      picture_seconds_ = glfwGetTime() - now;
      quality_.measured(picture_seconds_);
      painted_ = key;
    }
    renderer_.present(0, static_cast<int>(rect.min.x),
                      window_height - static_cast<int>(rect.min.y) - height, width, height);
  }

  // The playhead, the window or a slider is being dragged.
  bool scrubbing() const { return ImGui::IsMouseDown(ImGuiMouseButton_Left); }

  // First the mouse as this frame saw it: events come in order, so whoever moved it there and sees
  // it there knows that whatever was done before has been taken in.
  void write_widgets(const std::filesystem::path& file) {
    const ImGuiIO& io = ImGui::GetIO();
    char mouse[96];
    std::snprintf(mouse, sizeof mouse, "Pointer\tpointer\t%.0f\t%.0f\t%.0f\t%.0f\t1\t1\t%s%s%s\n",
                  static_cast<double>(io.MousePos.x), static_cast<double>(io.MousePos.y),
                  static_cast<double>(io.MousePos.x), static_cast<double>(io.MousePos.y),
                  io.MouseDown[0] ? "1" : "", io.MouseDown[1] ? "3" : "",
                  io.MouseDown[2] ? "2" : "");
    std::string text = mouse;
    for (const ProbedWidget& widget : ui_->probe().widgets()) {
      char numbers[96];
      std::snprintf(numbers, sizeof numbers, "\t%s\t%.0f\t%.0f\t%.0f\t%.0f\t%d\t%d\t",
                    name_of(widget.kind), static_cast<double>(widget.min.x),
                    static_cast<double>(widget.min.y), static_cast<double>(widget.max.x),
                    static_cast<double>(widget.max.y), widget.enabled, widget.visible);
      text += widget.path + numbers + widget.value + "\n";
    }
    if (text == widgets_) return;
    widgets_ = text;
    // Whoever reads sees the old ones or the new ones, never half of them.
    const auto fresh = file.string() + ".new";
    std::ofstream(fresh) << text;
    std::error_code ignored;
    std::filesystem::rename(fresh, file, ignored);
  }

  GLFWwindow* window_;
  Gui gui_;
  SceneRenderer renderer_;
  Editor editor_;
  EditorUi editor_ui_;
  std::unique_ptr<Ui> ui_;
  double scale_ = 0, content_ = 1;
  bool light_ = false;
  PictureKey painted_;
  QualityController quality_;
  double picture_seconds_ = 0;    // of this frame
  double panel_seconds_ = 0.008;  // what the rest of a frame takes, smoothed
  std::string widgets_;
};

}  // namespace

Status run_editor(const WindowOptions& options) {
  Glfw glfw;
  if (!glfw.ready())
    return Error{"there is no display to open a window on (" + last_glfw_error + ")", "",
                 "set DISPLAY, or use the commands that need none: elbowroom --help"};
  const auto settings_path = settings_file();
  Settings settings = read_settings(settings_path);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  // No larger than the screen.
  if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) {
    int x = 0, y = 0, width = 0, height = 0;
    glfwGetMonitorWorkarea(monitor, &x, &y, &width, &height);
    if (width > 0) settings.window_width = std::min(settings.window_width, width);
    if (height > 0) settings.window_height = std::min(settings.window_height, height);
  }
  glfw.window = glfwCreateWindow(settings.window_width, settings.window_height, "Elbowroom",
                                 nullptr, nullptr);
  if (!glfw.window)
    return Error{"the window could not be opened (" + last_glfw_error + ")", "",
                 "Elbowroom needs OpenGL 4.5; on a machine without it, Mesa's software driver "
                 "(package libgl1-mesa-dri) will do"};
  glfwSetWindowSizeLimits(glfw.window, kLeastWidth, kLeastHeight, GLFW_DONT_CARE, GLFW_DONT_CARE);
  glfwMakeContextCurrent(glfw.window);
  glfwSwapInterval(1);
  auto renderer = SceneRenderer::create();
  if (!renderer) return renderer.error();

  std::ofstream log;
  if (!options.frame_log.empty()) log.open(options.frame_log);
  WindowInput input;
  watch_events(glfw.window, input);
  EditorWindow window(glfw.window, std::move(*renderer), settings);
  if (options.files.empty())
    window.editor().handle(command::OpenDemo{});
  else
    window.editor().handle(command::OpenFiles{options.files});
  window.editor().offer_lost_work();
  window.run(input, log.is_open() ? &log : nullptr, options.widget_log);

  settings.view = window.editor().view();
  settings.recent_files = window.editor().recent_files();
  glfwGetWindowSize(glfw.window, &settings.window_width, &settings.window_height);
  // Settings that can't be kept are no reason for a session to have failed.
  if (Status kept = write_settings(settings_path, settings); !kept)
    std::fprintf(stderr, "elbowroom: %s\n", kept.error().message().c_str());
  return Done{};
}

}  // namespace elbowroom
