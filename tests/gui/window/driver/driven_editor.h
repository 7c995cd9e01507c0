// SPDX-License-Identifier: MIT
// A person at the editor's window: the real program on a screen of its own, with a mouse and a
// keyboard (xdotool) and eyes (the program's log of widgets, and pictures of the screen).
//
// Whatever is done waits until the program has drawn it, and whatever is looked for is waited for,
// so that nothing rests on how fast the machine is. A widget is clicked where it is once the
// program has seen the mouse above it: what was done before may still have moved it. Places are
// pixels of the screen, from its top left. Settings and home folder are the folder's own.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tests/gui/window/driver/screen.h"

namespace elbowroom::test {

struct Pixel {
  int x = 0, y = 0;
  bool operator==(const Pixel&) const = default;
};

struct SeenWidget {
  std::string path, kind, value;
  Pixel min, max;
  bool enabled = true, visible = true;
  Pixel middle() const { return {(min.x + max.x) / 2, (min.y + max.y) / 2}; }
};

// A line of the log of frames.
struct DrawnFrame {
  double start = 0;        // s
  double from_event = -1;  // ms from the oldest event shown in it to its submission; -1: none
  double cost = 0;         // ms
  int events = 0;
  std::string doing;  // planning, scanning, playing, still
};

class DrivenEditor {
 public:
  // `folder` holds the settings, the logs and what the test writes.
  explicit DrivenEditor(std::filesystem::path folder, int width = 1600, int height = 1000);
  ~DrivenEditor();
  DrivenEditor(const DrivenEditor&) = delete;
  DrivenEditor& operator=(const DrivenEditor&) = delete;

  // Starts the program, again if it has ended before. False if no window came up.
  bool start(const std::vector<std::string>& files = {});
  bool running();
  // Its exit code (128 + signal) once it has ended by itself.
  std::optional<int> ended(double seconds = 20);
  void end_by(int signal);   // kill(2)
  std::string said() const;  // on its outputs

  // Eyes.
  std::vector<SeenWidget> widgets() const;
  // By path or the end of one ("Plan/Plan"); those in sight first.
  std::optional<SeenWidget> find(const std::string& name) const;
  // Some widget's path, beginning or within.
  bool shows(const std::string& words) const;
  std::string value(const std::string& name) const;  // empty if it is not there
  std::vector<DrawnFrame> frames() const;
  std::size_t frame_count() const;
  bool wait(const std::function<bool()>& happened, double seconds = 20);
  bool wait_for(const std::string& name, double seconds = 20);
  bool wait_for_words(const std::string& words, double seconds = 20);
  // No frame for a second.
  bool settle(double seconds = 60, double quiet = 1);
  double cpu_seconds() const;  // that the program has used so far
  void picture(const std::string& name) const;

  // Hands. Each of the first five is one action.
  bool click(const std::string& widget);
  void click(Pixel place, int button = 1);
  void drag(Pixel from, Pixel to, int button = 1);
  void key(const std::string& keys);  // "ctrl+shift+z"
  void type(const std::string& text);
  void scroll(Pixel place, int notches);  // up is positive
  // Parts of a drag.
  void move_to(Pixel place);
  void press(int button = 1);
  void release(int button = 1);
  void hold(const std::string& key);  // a modifier, until it is let go
  void let_go(const std::string& key);
  void glide(Pixel from, Pixel to, int steps, double seconds_between);
  int actions() const { return actions_; }

  const std::filesystem::path& folder() const { return folder_; }

 private:
  int tool(std::vector<std::string> arguments) const;
  bool drawn(std::size_t before, double seconds = 3);
  bool pointer_at(Pixel place) const;
  bool pointer_holds(int button) const;

  std::filesystem::path folder_;
  int width_, height_;
  Screen screen_;
  pid_t program_ = -1;
  std::optional<int> exit_code_;
  int actions_ = 0;
};

}  // namespace elbowroom::test
