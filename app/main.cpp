// SPDX-License-Identifier: MIT
// The program: reads the command line and hands over to a command.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "app/commands.h"
#include "app/editor/window.h"
#include "app/exit_codes.h"
#include "app/interruption.h"
#include "app/terminal.h"

namespace {

using namespace elbowroom;

int run_window(const std::vector<std::string>& files, const std::string& frame_log,
               const std::string& widget_log) {
  WindowOptions window;
  for (const auto& file : files) window.files.emplace_back(file);
  window.frame_log = frame_log;
  window.widget_log = widget_log;
  const Status shown = run_editor(window);
  if (!shown) {
    print_error(shown.error());
    return kExitUsage;
  }
  return kExitDone;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program("Elbowroom: corrects motion clips where limbs collide.");
  program.set_version_flag("--version", "elbowroom 0.1.0");
  program.footer(
      "LIMB is left_arm, right_arm, left_leg, right_leg, auto (every limb that collides), or\n"
      "FROM..TO, the names of two joints. Times are seconds of the clip's own clock.\n"
      "Exit codes: 0 done, 1 wrong usage, 2 bad input, 3 no valid motion found, 4 contacts found\n"
      "(check), 130 interrupted.");
  program.require_subcommand(0, 1);

  InfoOptions info;
  CLI::App* info_command = program.add_subcommand("info", "what is in a file");
  info_command->add_option("FILE", info.file, "a glTF file")->required();
  info_command->add_flag("--json", info.json, "as JSON");

  CheckOptions check;
  CLI::App* check_command = program.add_subcommand("check", "where the clip collides");
  add_scene_options(*check_command, check.scene);
  check_command->add_option("--report", check.report, "write a report")->type_name("R.json");

  CorrectOptions correct;
  CLI::App* correct_command =
      program.add_subcommand("correct", "plan limbs around what they collide with");
  add_plan_options(*correct_command, correct, "which limb (default auto)");

  ReachOptions reach;
  CLI::App* reach_command =
      program.add_subcommand("reach", "lead a wrist or ankle to a target and back to the clip");
  add_plan_options(*reach_command, reach.plan, "which limb; has to be named");
  reach_command
      ->add_option("--target", reach.target,
                   "where the wrist (ankle) joint shall be, in the world, and its rotation there")
      ->type_name("X,Y,Z[,QX,QY,QZ,QW]")
      ->required();
  reach_command->add_flag("--grasp", reach.grasp,
                          "the target is the palm's (the sole's) instead of the wrist's: x along "
                          "the hand, y the way the palm faces");
  reach_command->add_option("--at", reach.at, "when, seconds")->type_name("T")->required();

  SolveOptions solve;
  CLI::App* solve_command = program.add_subcommand(
      "solve", "all tasks of a project, in order; accepted corrections that hold are kept");
  solve_command->add_option("PROJECT", solve.project, "a project file")->required();
  solve_command->add_option("-o,--out", solve.out, "the corrected file")
      ->type_name("OUT.glb")
      ->required();
  solve_command
      ->add_option("--per-file", solve.per_file,
                   "write each source file that was changed into this folder too, under its name")
      ->type_name("DIR");
  solve_command->add_flag("--anew", solve.anew,
                          "plan all tasks, also those whose corrections have been accepted");
  solve_command->add_option("--report", solve.report, "write a report")->type_name("R.json");

  RenderOptions render;
  CLI::App* render_command =
      program.add_subcommand("render", "a filmstrip of the clip; needs no display");
  add_scene_options(*render_command, render.scene);
  render_command->add_option("--times", render.times, "seconds")
      ->type_name("T1,T2,...")
      ->required();
  render_command->add_option("-o,--out", render.out, "the picture")
      ->type_name("STRIP.png")
      ->required();
  render_command->add_option("--columns", render.columns, "frames in a row (default: all, up to 6)")
      ->check(CLI::Range(1, 64));
  render_command
      ->add_option("--width", render.width, "of a frame, pixels (default: to suit the motion)")
      ->check(CLI::Range(32, 4096));
  render_command
      ->add_option("--height", render.height, "of a frame, pixels (default: to suit the motion)")
      ->check(CLI::Range(32, 4096));
  render_command
      ->add_option("--compare", render.compare_clip,
                   "a second row with another clip of the character, by name or index")
      ->type_name("NAME");

  std::vector<std::string> files;
  std::string frame_log, widget_log;
  program.add_option("FILES", files, "for the editor: a project, or a character and objects");
  program
      .add_option("--frame-log", frame_log,
                  "of the editor: a file that gets a line for each frame drawn")
      ->type_name("LOG")
      ->group("");
  program
      .add_option("--widget-log", widget_log,
                  "of the editor: a file that holds the mouse and the widgets of the last frame")
      ->type_name("LOG")
      ->group("");

  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int code = program.exit(error);
    return code == 0 ? kExitDone : kExitUsage;
  }
  if (info_command->parsed()) return run_info(info);
  const bool editor = program.get_subcommands().empty();
  if (editor) return run_window(files, frame_log, widget_log);
  if (render_command->parsed()) {
    Interruption interruption(1);
    return run_render(render, interruption);
  }
  Interruption interruption;
  if (check_command->parsed()) return run_check(check, interruption);
  if (correct_command->parsed()) return run_correct(correct, interruption);
  if (reach_command->parsed()) return run_reach(reach, interruption);
  if (solve_command->parsed()) return run_solve(solve, interruption);
  return kExitUsage;
}
