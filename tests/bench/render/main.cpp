// SPDX-License-Identifier: MIT
// How long a picture of the demo takes: elbowroom_bench_render [WIDTH HEIGHT [FRAMES
// [PICTURE-DIR]]].
#include <epoxy/gl.h>

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>

#include "assets/demo.h"
#include "core/collision/surface_picker.h"
#include "core/io/open_scene.h"
#include "render/offscreen_context.h"
#include "render/quality.h"
#include "render/scene_renderer.h"

namespace elbowroom {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Of all threads: what a picture costs however busy the machine is.
double cpu_milliseconds() {
  rusage used;
  getrusage(RUSAGE_SELF, &used);
  const auto of = [](const timeval& t) {
    return 1e3 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_usec);
  };
  return of(used.ru_utime) + of(used.ru_stime);
}

void report(const char* name, std::vector<double> times, double cpu) {
  std::sort(times.begin(), times.end());
  std::printf("%-34s median %6.1f ms   90 %% %6.1f ms   best %6.1f ms   cpu %6.1f ms\n", name,
              times[times.size() / 2], times[times.size() * 9 / 10], times.front(),
              cpu / static_cast<double>(times.size()));
  std::fflush(stdout);
}

World demo_world() {
  const std::filesystem::path folder(ELBOWROOM_DEMO_DIR);
  SceneDescription description;
  description.character = folder / demo::kMannequinFile;
  description.clip = demo::kDemoClip;
  description.obstacles = {folder / demo::kPostsFile};
  AttachedFile umbrella;
  umbrella.file = folder / demo::kUmbrellaFile;
  umbrella.joint = demo::kAttachJoint;
  umbrella.joint_from_object.translation = Vec3(demo::kGripX, demo::kGripY, demo::kGripZ);
  description.attachments = {umbrella};
  auto scene = open_scene(description);
  if (!scene) {
    std::fprintf(stderr, "%s\n", scene.error().message().c_str());
    std::exit(1);
  }
  return scene->world;
}

int run(int width, int height, int frames, const std::string& only, const char* pictures) {
  auto context = OffscreenContext::create();
  if (!context) {
    std::fprintf(stderr, "%s\n", context.error().message().c_str());
    return 1;
  }
  auto made = SceneRenderer::create();
  if (!made) {
    std::fprintf(stderr, "%s\n", made.error().message().c_str());
    return 1;
  }
  SceneRenderer renderer = std::move(*made);
  std::printf("%s, %d x %d\n", context->description().c_str(), width, height);
  const World world = demo_world();
  Style style;
  Camera camera = framed(with_preset({}, ViewPreset::three_quarter), bounds_over(world, {1.5}, 1u),
                         static_cast<double>(width) / height, 0.25);
  std::vector<ActorState> states;
  world_state_at(world, 1.5, states);
  Frame frame;
  frame.world = &world;
  frame.states = &states;
  frame.size = scene_size(world);
  const PictureSize size{width, height};

  const auto measure = [&](const char* name, const Style& with, const PictureSize& at,
                           const std::function<void(int)>& change) {
    if (std::string(name).find(only) == std::string::npos) return;
    std::vector<double> times;
    double cpu = 0;
    for (int i = 0; i < frames + 2; ++i) {
      if (i == 2) cpu = cpu_milliseconds();
      const auto start = Clock::now();
      change(i);
      const auto drawn = renderer.draw(frame, camera, with, at);
      glFinish();
      if (!drawn) {
        std::fprintf(stderr, "%s\n", drawn.error().message().c_str());
        std::exit(1);
      }
      if (i >= 2) times.push_back(milliseconds_since(start));
    }
    report(name, times, cpu_milliseconds() - cpu);
  };
  const auto nothing = [](int) {};
  const auto play = [&](int i) { world_state_at(world, 0.5 + 0.033 * i, states); };
  const auto orbit = [&](int) { camera = orbited(camera, 0.01, 0); };
  const Camera home = camera;

  if (pictures != nullptr) {
    for (int i = 0; i < 4; ++i) {
      camera = orbited(home, 1.3 * i, 0.1 * i);
      camera.orthographic = i == 3;
      world_state_at(world, 0.7 + 0.6 * i, states);
      (void)renderer.draw(frame, camera, style, size);
      const auto path = std::string(pictures) + "/full" + std::to_string(i) + ".png";
      (void)write_png(renderer.read(), path);
    }
    camera = home;
    world_state_at(world, 1.5, states);
  }
  measure("full, nothing changed", style, size, nothing);
  Style other = style;
  other.occlusion = 0;
  measure("without occlusion", other, size, nothing);
  other = style;
  other.ground = false;
  measure("without ground", other, size, nothing);
  other = style;
  other.shadow_map_size = 16;
  measure("shadow map of 16", other, size, nothing);
  other = style;
  other.samples = 1;
  measure("1 sample", other, size, nothing);
  for (const DrawQuality& quality : kQualities) {
    const Style with = with_quality(style, quality);
    const PictureSize at = with_quality(size, quality);
    const std::string name = std::string("level: ") + quality.name;
    measure((name + ", playing").c_str(), with, at, play);
    world_state_at(world, 1.5, states);
    measure((name + ", orbiting").c_str(), with, at, orbit);
    camera = home;
    if (pictures != nullptr) {
      (void)renderer.draw(frame, camera, with, at);
      (void)write_png(renderer.read(), std::string(pictures) + "/" + quality.name + ".png");
    }
  }
  std::vector<ActorState> ghost_states = states;
  frame.ghosts.push_back({&world.actors[0], &ghost_states[0]});
  const auto haunt = [&](int i) { world_state_at(world, 0.5 + 0.033 * i, ghost_states); };
  measure("level: full, a ghost plays", style, size, haunt);
  frame.keep_scene = true;
  measure("level: full, a ghost over the kept", style, size, haunt);
  frame.keep_scene = false;
  frame.ghosts.clear();
  frame.world = nullptr;
  measure("empty scene", style, size, nothing);
  other = style;
  other.ground = false;
  other.occlusion = 0;
  measure("backdrop only", other, size, nothing);
  other.samples = 1;
  measure("backdrop only, 1 sample", other, size, nothing);
  frame.world = &world;

  SurfacePicker picker;
  std::vector<double> same, changed;
  for (int i = 0; i < frames; ++i) {
    world_state_at(world, 0.5 + 0.03 * i, states);
    for (auto* times : {&changed, &same}) {
      const auto start = Clock::now();
      (void)picker.nearest(world, states,
                           pick_ray(camera, static_cast<double>(width) / height, 0.5, 0.5));
      times->push_back(milliseconds_since(start));
    }
  }
  report("pick, states changed", changed, 0);
  report("pick, nothing changed", same, 0);
  return 0;
}

}  // namespace
}  // namespace elbowroom

int main(int count, char** arguments) {
  const int width = count > 2 ? std::atoi(arguments[1]) : 1000;
  const int height = count > 2 ? std::atoi(arguments[2]) : 700;
  const int frames = count > 3 ? std::max(1, std::atoi(arguments[3])) : 30;
  return elbowroom::run(width, height, frames, count > 4 ? arguments[4] : "",
                        count > 5 ? arguments[5] : nullptr);
}
