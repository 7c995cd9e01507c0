// SPDX-License-Identifier: MIT
#include "tests/unit/render/gl_fixture.h"

#include <cmath>
#include <cstdlib>
#include <optional>

namespace elbowroom::test {
namespace {

struct Shared {
  std::optional<OffscreenContext> context;
  std::optional<SceneRenderer> renderer;
  std::string missing;
};

Shared& shared() {
  static Shared instance;
  return instance;
}

}  // namespace

void GlTest::SetUpTestSuite() {
  // No picture may need a display.
  unsetenv("DISPLAY");
  unsetenv("WAYLAND_DISPLAY");
  Shared& s = shared();
  auto context = OffscreenContext::create();
  if (!context) {
    s.missing = context.error().message();
    return;
  }
  s.context.emplace(std::move(*context));
  auto made = SceneRenderer::create();
  ASSERT_TRUE(made.ok()) << made.error().message();
  s.renderer.emplace(std::move(*made));
}

void GlTest::TearDownTestSuite() {
  shared().renderer.reset();
  shared().context.reset();
}

void GlTest::SetUp() {
  if (!shared().context) GTEST_SKIP() << "no OpenGL to draw with: " << shared().missing;
  ASSERT_TRUE(shared().renderer.has_value());
}

SceneRenderer& GlTest::renderer() { return *shared().renderer; }

Picture GlTest::draw(const World& world, double t, const Camera& camera, const Style& style,
                     int width, int height) {
  const auto done = renderer().draw(world, t, camera, style, {width, height});
  EXPECT_TRUE(done.ok()) << done.error().message();
  return renderer().read();
}

Picture GlTest::draw(const Frame& frame, const Camera& camera, const Style& style, int width,
                     int height) {
  const auto done = renderer().draw(frame, camera, style, {width, height});
  EXPECT_TRUE(done.ok()) << done.error().message();
  return renderer().read();
}

double difference(const Picture& a, const Picture& b) {
  if (a.width != b.width || a.height != b.height || a.empty()) return 255;
  double sum = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) sum += std::abs(int{a.rgb[i]} - int{b.rgb[i]});
  return sum / static_cast<double>(a.rgb.size());
}

int warmth(Rgb colour) {
  return static_cast<int>(colour >> 16 & 0xffu) - static_cast<int>(colour & 0xffu);
}

Picture flipped(const Picture& picture) {
  Picture out = picture;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      out.set(x, y, picture.pixel(picture.width - 1 - x, y));
    }
  }
  return out;
}

}  // namespace elbowroom::test
