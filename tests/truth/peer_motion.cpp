// SPDX-License-Identifier: MIT
#include "tests/truth/peer_motion.h"

#include <algorithm>
#include <stdexcept>

#ifdef ELBOWROOM_PEER
#include "core/anatomy/limb.h"
#include "core/editing/correct.h"
#include "core/editing/limb_keys.h"
#include "core/editing/window_problem.h"
#include "core/io/gltf_writer.h"
#include "core/io/open_scene.h"
#include "core/planning/planner.h"
#include "core/planning/smoothing.h"
#include "tests/bench/peer/peer.h"
#endif

namespace elbowroom::test {

#ifdef ELBOWROOM_PEER
namespace {

constexpr double kKeyRate = 480;  // Hz

template <typename T>
T value_of(Result<T>&& result) {
  if (!result) throw std::runtime_error(result.error().message());
  return std::move(*result);
}

// A path of the peer's through one window, as keys; false if it finds none in its time.
bool plan_window_as_peer(SceneCollision& scene, const std::shared_ptr<const Clip>& clip, int limb,
                         const PeerQuestion::Window& window, std::uint64_t seed,
                         Correction& correction) {
  const WindowProblem p = window_problem(scene, clip, limb, window.begin, window.end, {});
  const LimbState& from = p.postures.front().state;
  const LimbState& to = p.postures.back().state;
  LimbPlanningSpace space(scene, limb, p.begin, p.end, from, to, {});
  const auto world =
      test::make_fcl_world(space, test::BoxKind::obb_float, test::AllowedPairs::without_concerned);
  bench::PeerSettings settings;
  settings.resolution = PlannerSettings{}.resolution;
  settings.max_seconds = window.most_seconds;
  settings.seed = seed;
  const bench::PeerRun run = bench::run_peer(
      {&p.space, {from.q, p.begin}, {to.q, p.end}, space.step_times()}, *world, settings);
  if (!run.solved) return false;
  correction.limb = p.limb->limb.name;
  correction.begin = static_cast<float>(p.begin);
  correction.end = static_cast<float>(p.end);
  const auto& skeleton =
      scene.world().actors[static_cast<std::size_t>(scene.actor())].model->skeleton;
  std::vector<double> stops;
  for (const Configuration& c : run.smooth)
    stops.push_back(static_cast<double>(static_cast<float>(c.t)));
  stops.front() = p.begin;
  stops.back() = p.end;
  stops.erase(std::unique(stops.begin(), stops.end()), stops.end());
  correction.joints = make_limb_keys(
      skeleton, *p.limb, [&](double t) { return path_at(run.smooth, t).q; }, from, to, stops,
      kKeyRate);
  return true;
}

}  // namespace

bool peer_is_built() { return true; }

bool peer_motion(const PeerQuestion& question, const std::filesystem::path& out) {
  SceneDescription description;
  description.character = question.character;
  description.clip = std::to_string(question.clip);
  description.obstacles = {question.thing};
  const OpenedScene opened = value_of(open_scene(description));
  const Model& model = opened.model();
  const Character& character = model.characters[static_cast<std::size_t>(opened.character)];
  const LimbFindings findings = find_limbs(model, character);
  std::vector<LimbModel> limbs;
  int index = -1;
  for (const Limb& limb : findings.limbs) {
    if (limb.name == question.limb) index = static_cast<int>(limbs.size());
    limbs.push_back(value_of(fit_limb_model(model, character, limb, findings)));
  }
  if (index < 0) throw std::runtime_error("there is no limb " + question.limb);
  const std::shared_ptr<const Clip> clip = opened.world.actors.front().clip;
  SceneCollision scene = value_of(SceneCollision::build(
      opened.world, 0, opened.character, limbs, clip->begin, clip->end, CollisionSettings{}));
  std::vector<Correction> corrections;
  for (const PeerQuestion::Window& window : question.windows)
    if (!plan_window_as_peer(scene, clip, index, window, question.seed, corrections.emplace_back()))
      return false;
  const Clip laid = value_of(lay_over(model.skeleton, *clip, corrections));
  const Status written = export_corrected(question.character, out, {corrected_clip(laid)});
  if (!written) throw std::runtime_error(written.error().message());
  return true;
}

#else

bool peer_is_built() { return false; }
bool peer_motion(const PeerQuestion&, const std::filesystem::path&) { return false; }

#endif

}  // namespace elbowroom::test
