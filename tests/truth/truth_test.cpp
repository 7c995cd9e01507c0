// SPDX-License-Identifier: MIT
// What is delivered is free: posts, plates, wires, frames and flying balls in the way of arms and
// legs of every figure there is. Each delivered file is judged at 240 Hz, at every key and at 1,000
// random times; one in eight of each figure's at every 0.1 ms. What the program declines is
// counted, not failed.
#include <cstdlib>
#include <map>

#include "tests/support/cli_scene.h"
#include "tests/truth/peer_motion.h"
#include "tests/truth/problems.h"

namespace elbowroom::test {
namespace {

// Another build of the program may be asked for, to compare the two.
std::string program() {
  const char* other = std::getenv("ELBOWROOM_TRUTH_PROGRAM");
  return other != nullptr ? other : ELBOWROOM_PROGRAM;
}
// The peer takes as long as ours: one problem in so many of each figure may be asked of it, too.
int peer_every() {
  const char* asked = std::getenv("ELBOWROOM_TRUTH_PEER_EVERY");
  return asked != nullptr ? std::max(1, std::atoi(asked)) : 1;
}
const std::filesystem::path kDemo = ELBOWROOM_DEMO_DIR;
constexpr double kFineStep = 1e-4;  // s
constexpr int kFineEvery = 8;

struct Tally {
  int number = 0, tried = 0, nothing = 0, solved = 0, certified = 0, declined = 0, errors = 0;
  int colliding = 0, judged_finely = 0;
  int peer_tried = 0, peer_solved = 0, peer_free = 0;
  std::vector<double> seconds, deviation, clearance;
};

double share(std::vector<double> values, double s) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(s * static_cast<double>(values.size() - 1))];
}

void print(const std::string& name, const Tally& t) {
  std::printf(
      "  %-24s tried %4d  free already %3d  solved %4d (certified %4d)  declined %3d  errors %d  "
      "colliding %d  finely %3d  seconds %.2f / %.2f  deviation %.2f / %.2f rad\n",
      name.c_str(), t.tried, t.nothing, t.solved, t.certified, t.declined, t.errors, t.colliding,
      t.judged_finely, share(t.seconds, 0.5), share(t.seconds, 0.95), share(t.deviation, 0.5),
      share(t.deviation, 0.95));
  if (t.peer_tried > 0)
    std::printf("  %-24s the peer, in the same windows and time: tried %4d  solved %4d  free %4d\n",
                "", t.peer_tried, t.peer_solved, t.peer_free);
  std::fflush(stdout);
}

struct Figure {
  std::filesystem::path file;
  std::shared_ptr<const Model> model;
  std::vector<TruthStage> stages;
};

std::vector<Figure> figures() {
  std::vector<std::filesystem::path> files = {kDemo / "mannequin.glb"};
  if (const auto samples = samples_dir(); !samples.empty())
    for (const auto& entry : std::filesystem::recursive_directory_iterator(samples / "humanoids")) {
      const auto extension = entry.path().extension();
      if (extension == ".glb" || extension == ".gltf" || extension == ".vrm")
        files.push_back(entry.path());
    }
  std::sort(files.begin(), files.end());
  std::vector<Figure> all;
  for (const auto& file : files) {
    ReadOptions options;
    options.images = false;
    const auto model = read_gltf(file, options);
    if (!model.ok() || (*model)->characters.empty()) continue;
    Figure figure{file, *model, {}};
    const Character& character = (*model)->characters.front();
    for (const Limb& limb : find_limbs(**model, character).limbs) {
      int used = 0;
      for (int clip = 0; clip < static_cast<int>((*model)->clips.size()); ++clip) {
        if (used == (limb.is_arm() ? 3 : 1)) break;
        if (auto stage = TruthStage::make(*model, character, limb, clip)) {
          figure.stages.push_back(std::move(*stage));
          ++used;
        }
      }
    }
    if (!figure.stages.empty()) all.push_back(std::move(figure));
  }
  return all;
}

class Judged {
 public:
  Judged(const Folder& folder) : folder_(folder) {}

  void solve(const Figure& figure, const TruthStage& stage, const TruthProblem& problem, int number,
             Tally& tally) {
    const auto thing = folder_ / "thing.glb", out = folder_ / "out.glb";
    const auto report_file = folder_ / "report.json";
    std::filesystem::remove(out);
    std::filesystem::remove(report_file);
    if (!write_thing(problem, thing)) throw std::runtime_error("the thing can't be written");
    ++tally.tried;
    const ProgramRun run =
        run_program(program(), {"correct", "--character", figure.file, "--clip",
                                std::to_string(stage.clip()), "--limb", stage.limb().name,
                                "--obstacles", thing, "-o", out, "--report", report_file});
    const auto report = read_json(report_file);
    if ((run.exit_code == 0 || run.exit_code == 3) && turn_of_[figure.file]++ % peer_every() == 0)
      ask_peer(figure, stage, report, thing, number, tally);
    if (run.exit_code == 3) {
      ++tally.declined;
      for (const auto& correction : report["corrections"])
        std::printf("    declined %d: %s %s clip %d, %s: %s; %s\n", number,
                    figure.file.filename().c_str(), stage.limb().name.c_str(), stage.clip(),
                    name_of(problem.thing), correction.value("reason", "").c_str(),
                    correction.value("blocked_by", nlohmann::json()).dump().c_str());
      EXPECT_FALSE(std::filesystem::exists(out));
      keep(number, {thing, report_file});
      return;
    }
    if (run.exit_code != 0) {
      keep(number, {thing});
      ++tally.errors;
      ADD_FAILURE() << number << ": " << run.err;
      return;
    }
    if (report["status"] == "nothing_to_correct") {
      ++tally.nothing;
      return;
    }
    ++tally.solved;
    bool certified = true;
    double seconds = 0;
    for (const auto& correction : report["corrections"]) {
      certified = certified && correction["certified"].get<bool>();
      seconds += 1e-3 * correction["total_ms"].get<double>();
      tally.deviation.push_back(correction["deviation_from_clip"]);
      tally.clearance.push_back(correction["min_clearance"]);
    }
    tally.seconds.push_back(seconds);
    tally.certified += certified;
    const bool finely = delivered_[figure.file]++ % kFineEvery == 0;
    tally.judged_finely += finely;
    const int before = tally.colliding;
    judge_file(figure, stage, report, out, thing, finely, tally);
    if (tally.colliding > before) keep(number, {thing, out, report_file});
  }

 private:
  // What went wrong is worth a look: into the folder that the environment names.
  static void keep(int number, const std::vector<std::filesystem::path>& files) {
    const char* folder = std::getenv("ELBOWROOM_TRUTH_KEEP");
    if (folder == nullptr) return;
    std::filesystem::create_directories(folder);
    for (const auto& file : files)
      if (std::filesystem::exists(file))
        std::filesystem::copy_file(file,
                                   std::filesystem::path(folder) /
                                       (std::to_string(number) + "_" + file.filename().string()),
                                   std::filesystem::copy_options::overwrite_existing);
  }

  // The same windows and, for each, the time that ours took. Where the clip is in contact at its
  // own end there is no window to ask about.
  void ask_peer(const Figure& figure, const TruthStage& stage, const nlohmann::json& report,
                const std::filesystem::path& thing, int number, Tally& tally) {
    if (!peer_is_built() || report["corrections"].empty()) return;
    PeerQuestion question{figure.file, thing, stage.clip(), stage.limb().name, {}, 1};
    question.seed = static_cast<std::uint64_t>(number) + 1;
    for (const auto& correction : report["corrections"]) {
      const double begin = correction["window"][0], end = correction["window"][1];
      if (!(begin < end)) return;
      question.windows.push_back({begin, end, 1e-3 * correction["total_ms"].get<double>()});
    }
    ++tally.peer_tried;
    const auto out = folder_ / "peer.glb";
    if (!peer_motion(question, out)) return;
    ++tally.peer_solved;
    tally.peer_free += judged(figure, stage, report, out, thing, false).bad() == 0;
  }

  struct Verdict {
    judge::CollisionReport report;
    int bad() const {
      return report.obstacle_samples + report.contained_samples + report.body_samples;
    }
  };

  void judge_file(const Figure& figure, const TruthStage& stage, const nlohmann::json& report,
                  const std::filesystem::path& out, const std::filesystem::path& thing, bool finely,
                  Tally& tally) {
    const Verdict verdict = judged(figure, stage, report, out, thing, finely);
    tally.colliding += verdict.bad() > 0;
    const auto& hits = verdict.report.hits;
    EXPECT_EQ(verdict.bad(), 0) << tally.number << ": " << figure.file.filename() << " "
                                << stage.limb().name << " clip " << stage.clip() << ": "
                                << (hits.empty()
                                        ? std::string()
                                        : hits.front().mover + " meets " + hits.front().other +
                                              " at " + std::to_string(hits.front().time));
  }

  Verdict judged(const Figure& figure, const TruthStage& stage, const nlohmann::json& report,
                 const std::filesystem::path& out, const std::filesystem::path& thing,
                 bool finely) {
    const auto file = judge::load(out);
    judge::CollisionQuery query;
    query.character = out;
    query.animation = std::to_string(figure.model->clips.size());
    query.limb_roots = {
        figure.model->skeleton.joints[static_cast<std::size_t>(stage.limb().root)].name};
    query.obstacles = {thing};
    query.source_animation = std::to_string(stage.clip());
    query.with_fcl = false;
    for (const auto& correction : report["corrections"]) {
      const double begin = correction["window"][0], end = correction["window"][1];
      for (const double t : judge::verification_times(file, query.animation, query.limb_roots,
                                                      begin, end, 240, 1000))
        query.times.push_back(t);
      if (finely)
        for (double t = begin; t < end; t += kFineStep) query.times.push_back(t);
    }
    return {judge::count_intersecting_samples(query)};
  }

  const Folder& folder_;
  std::map<std::filesystem::path, int> turn_of_, delivered_;  // problems so far, by figure
};

TEST(Truth, NothingDeliveredCollides) {
  const char* asked = std::getenv("ELBOWROOM_TRUTH_PROBLEMS");
  const int wanted = asked != nullptr ? std::atoi(asked) : 2000;
  const auto all = figures();
  ASSERT_FALSE(all.empty());
  const Folder folder;
  Judged judged(folder);
  std::map<std::string, Tally> by_figure, by_thing;
  Tally whole;
  int made = 0;
  // Figures, things, limbs and clips in turn; a seed of its own for each.
  const char* from = std::getenv("ELBOWROOM_TRUTH_FROM");
  const int first = from != nullptr ? std::atoi(from) : 0;
  for (int round = first; made < wanted && round < first + 4 * wanted; ++round) {
    const std::size_t f = static_cast<std::size_t>(round) % all.size();
    const Figure& figure = all[f];
    const std::size_t turn = static_cast<std::size_t>(round) / all.size();
    const Thing thing = kThings[(turn + f) % std::size(kThings)];
    const TruthStage& stage = figure.stages[(turn * 7 + f) % figure.stages.size()];
    const auto problem = stage.problem(thing, static_cast<std::uint64_t>(round) + 1);
    if (!problem) continue;
    ++made;
    Tally one;
    one.number = round;
    judged.solve(figure, stage, *problem, round, one);
    for (Tally* tally : {&by_figure[figure.file.filename()], &by_thing[name_of(thing)], &whole}) {
      tally->tried += one.tried;
      tally->nothing += one.nothing;
      tally->solved += one.solved;
      tally->certified += one.certified;
      tally->declined += one.declined;
      tally->errors += one.errors;
      tally->colliding += one.colliding;
      tally->judged_finely += one.judged_finely;
      tally->peer_tried += one.peer_tried;
      tally->peer_solved += one.peer_solved;
      tally->peer_free += one.peer_free;
      const auto append = [](std::vector<double>& to, const std::vector<double>& from) {
        to.insert(to.end(), from.begin(), from.end());
      };
      append(tally->seconds, one.seconds);
      append(tally->deviation, one.deviation);
    }
    if (made % 25 == 0) print(std::to_string(made), whole);
  }
  for (const auto& [name, tally] : by_figure) print(name, tally);
  for (const auto& [name, tally] : by_thing) print(name, tally);
  print("all", whole);
  EXPECT_GT(whole.solved, 0);
  EXPECT_EQ(whole.colliding, 0);
}

}  // namespace
}  // namespace elbowroom::test
