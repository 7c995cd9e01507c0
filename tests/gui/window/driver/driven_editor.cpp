// SPDX-License-Identifier: MIT
#include "tests/gui/window/driver/driven_editor.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

#include "tests/support/run_program.h"

namespace elbowroom::test {
namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void pause(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<std::string> parts(const std::string& text, char separator) {
  std::vector<std::string> list;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, separator);) list.push_back(part);
  return list;
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

DrivenEditor::DrivenEditor(std::filesystem::path folder, int width, int height)
    : folder_(std::move(folder)), width_(width), height_(height), screen_(width, height) {
  const auto settings = folder_ / "config" / "elbowroom";
  std::filesystem::create_directories(settings);
  std::ofstream(settings / "settings.json")
      << "{\"window_width\": " << width_ << ", \"window_height\": " << height_ << "}\n";
}

DrivenEditor::~DrivenEditor() {
  if (!running()) return;
  kill(program_, SIGKILL);
  waitpid(program_, nullptr, 0);
}

bool DrivenEditor::start(const std::vector<std::string>& files) {
  if (screen_.display().empty() || running()) return false;
  std::error_code ignored;
  std::filesystem::remove(folder_ / "widgets", ignored);
  std::filesystem::remove(folder_ / "frames", ignored);
  exit_code_.reset();
  program_ = fork();
  if (program_ == 0) {
    const int out = open((folder_ / "said").c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
    dup2(out, STDOUT_FILENO);
    dup2(out, STDERR_FILENO);
    setenv("DISPLAY", screen_.display().c_str(), 1);
    setenv("HOME", folder_.c_str(), 1);
    setenv("XDG_CONFIG_HOME", (folder_ / "config").c_str(), 1);
    setenv("XDG_STATE_HOME", (folder_ / "state").c_str(), 1);
    unsetenv("WAYLAND_DISPLAY");
    std::vector<std::string> words = {ELBOWROOM_PROGRAM, "--frame-log", folder_ / "frames",
                                      "--widget-log", folder_ / "widgets"};
    words.insert(words.end(), files.begin(), files.end());
    std::vector<char*> arguments;
    for (auto& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    execv(arguments.front(), arguments.data());
    _exit(127);
  }
  return wait_for("Menu");
}

bool DrivenEditor::running() {
  if (program_ <= 0 || exit_code_) return false;
  int status = 0;
  if (waitpid(program_, &status, WNOHANG) != program_) return true;
  exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return false;
}

std::optional<int> DrivenEditor::ended(double seconds) {
  for (const double end = now() + seconds; running() && now() < end;) pause(0.02);
  return exit_code_;
}

void DrivenEditor::end_by(int signal) {
  if (!running()) return;
  kill(program_, signal);
  ended();
}

std::string DrivenEditor::said() const { return text_of(folder_ / "said"); }

std::vector<SeenWidget> DrivenEditor::widgets() const {
  std::vector<SeenWidget> list;
  for (const auto& line : parts(text_of(folder_ / "widgets"), '\n')) {
    const auto cells = parts(line, '\t');
    if (cells.size() < 8) {  // a value of more than one line
      if (!list.empty()) list.back().value += "\n" + line;
      continue;
    }
    SeenWidget widget;
    widget.path = cells[0];
    widget.kind = cells[1];
    widget.min = {std::atoi(cells[2].c_str()), std::atoi(cells[3].c_str())};
    widget.max = {std::atoi(cells[4].c_str()), std::atoi(cells[5].c_str())};
    widget.enabled = cells[6] == "1";
    widget.visible = cells[7] == "1";
    if (cells.size() > 8) widget.value = cells[8];
    list.push_back(std::move(widget));
  }
  return list;
}

std::optional<SeenWidget> DrivenEditor::find(const std::string& name) const {
  std::optional<SeenWidget> found;
  for (const auto& widget : widgets()) {
    if (widget.path != name && !ends_with(widget.path, "/" + name)) continue;
    if (!found || (widget.visible && !found->visible)) found = widget;
  }
  return found;
}

bool DrivenEditor::shows(const std::string& words) const {
  for (const auto& widget : widgets())
    if (widget.path.find(words) != std::string::npos) return true;
  return false;
}

std::string DrivenEditor::value(const std::string& name) const {
  const auto widget = find(name);
  return widget ? widget->value : "";
}

std::vector<DrawnFrame> DrivenEditor::frames() const {
  std::vector<DrawnFrame> list;
  for (const auto& line : parts(text_of(folder_ / "frames"), '\n')) {
    std::istringstream in(line);
    DrawnFrame frame;
    if (in >> frame.start >> frame.from_event >> frame.cost >> frame.events >> frame.doing)
      list.push_back(frame);
  }
  return list;
}

std::size_t DrivenEditor::frame_count() const {
  const std::string text = text_of(folder_ / "frames");
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

bool DrivenEditor::wait(const std::function<bool()>& happened, double seconds) {
  for (const double end = now() + seconds; now() < end; pause(0.02)) {
    if (happened()) return true;
    if (!running()) return happened();
  }
  return happened();
}

bool DrivenEditor::wait_for(const std::string& name, double seconds) {
  return wait([&] { return find(name).has_value(); }, seconds);
}

bool DrivenEditor::wait_for_words(const std::string& words, double seconds) {
  return wait([&] { return shows(words); }, seconds);
}

bool DrivenEditor::settle(double seconds, double quiet) {
  std::size_t count = frame_count();
  double since = now();
  return wait(
      [&] {
        const std::size_t now_drawn = frame_count();
        if (now_drawn != count) {
          count = now_drawn;
          since = now();
        }
        return count > 0 && now() - since > quiet;
      },
      seconds);
}

double DrivenEditor::cpu_seconds() const {
  const std::string text = text_of("/proc/" + std::to_string(program_) + "/stat");
  // The name before may hold blanks; user and system time are the 14th and 15th of all.
  std::istringstream in(text.substr(std::min(text.size(), text.rfind(')') + 1)));
  std::string skipped;
  for (int i = 0; i < 11; ++i) in >> skipped;
  double user = 0, system = 0;
  in >> user >> system;
  return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

void DrivenEditor::picture(const std::string& name) const {
  screen_.picture(std::filesystem::path(ELBOWROOM_PICTURES) / (name + ".png"));
}

int DrivenEditor::tool(std::vector<std::string> arguments) const {
  arguments.insert(arguments.begin(), {"DISPLAY=" + screen_.display(), "xdotool"});
  return run_program("/usr/bin/env", arguments).exit_code;
}

// A frame that took in events, and the one after it. The one being drawn while something is done is
// too early for it, and the screen's server may pass it on late.
bool DrivenEditor::drawn(std::size_t before, double seconds) {
  return wait(
      [&] {
        const auto list = frames();
        if (list.size() < before + 2) return false;
        return std::any_of(list.begin() + static_cast<std::ptrdiff_t>(before), list.end() - 1,
                           [](const DrawnFrame& frame) { return frame.events > 0; });
      },
      seconds);
}

bool DrivenEditor::pointer_at(Pixel place) const {
  const auto pointer = find("Pointer");
  return pointer && pointer->min == place;
}

bool DrivenEditor::pointer_holds(int button) const {
  return value("Pointer").find(std::to_string(button)) != std::string::npos;
}

void DrivenEditor::move_to(Pixel place) {
  const std::size_t before = frame_count();
  if (pointer_at(place)) return;
  tool({"mousemove", std::to_string(place.x), std::to_string(place.y)});
  wait([&] { return pointer_at(place); }, 10);
  drawn(before);
}

void DrivenEditor::press(int button) {
  const std::size_t before = frame_count();
  tool({"mousedown", std::to_string(button)});
  wait([&] { return pointer_holds(button); }, 10);
  drawn(before);
}

void DrivenEditor::release(int button) {
  const std::size_t before = frame_count();
  tool({"mouseup", std::to_string(button)});
  wait([&] { return !pointer_holds(button); }, 10);
  drawn(before);
}

void DrivenEditor::hold(const std::string& key) { tool({"keydown", key}); }

void DrivenEditor::let_go(const std::string& key) { tool({"keyup", key}); }

bool DrivenEditor::click(const std::string& name) {
  std::optional<SeenWidget> widget;
  const auto can_be_clicked = [&] {
    widget = find(name);
    return widget && widget->enabled && widget->visible;
  };
  for (int i = 0; i < 20; ++i) {
    if (!wait(can_be_clicked)) return false;
    const Pixel place = widget->middle();
    move_to(place);
    // Whatever moved it before is drawn by now.
    if (!can_be_clicked() || !(widget->middle() == place)) continue;
    click(place);
    return true;
  }
  return false;
}

void DrivenEditor::click(Pixel place, int button) {
  move_to(place);
  press(button);
  release(button);
  ++actions_;
}

void DrivenEditor::glide(Pixel from, Pixel to, int steps, double seconds_between) {
  std::vector<std::string> words;
  for (int i = 1; i <= steps; ++i) {
    words.insert(words.end(), {"mousemove", std::to_string(from.x + (to.x - from.x) * i / steps),
                               std::to_string(from.y + (to.y - from.y) * i / steps), "sleep",
                               std::to_string(seconds_between)});
  }
  tool(words);
}

void DrivenEditor::drag(Pixel from, Pixel to, int button) {
  move_to(from);
  press(button);
  glide(from, to, 8, 0.02);
  // Without a rest before it lets go; then it looks at what it has done.
  release(button);
  settle(10, 0.5);
  ++actions_;
}

void DrivenEditor::key(const std::string& keys) {
  const auto names = parts(keys, '+');
  const std::size_t before = frame_count();
  std::vector<std::string> down, up;
  for (const auto& name : names) {
    down.insert(down.end(), {"keydown", name});
    up.insert(up.begin(), {"keyup", name});
  }
  tool(down);
  drawn(before);
  const std::size_t between = frame_count();
  tool(up);
  drawn(between);
  ++actions_;
}

void DrivenEditor::type(const std::string& text) {
  const std::size_t before = frame_count();
  tool({"type", "--delay", "15", text});
  drawn(before);
  ++actions_;
}

void DrivenEditor::scroll(Pixel place, int notches) {
  move_to(place);
  tool({"click", "--repeat", std::to_string(std::abs(notches)), "--delay", "30",
        notches > 0 ? "4" : "5"});
  move_to({place.x + 1, place.y});  // seen there, the wheel is seen too
}

}  // namespace elbowroom::test
