// SPDX-License-Identifier: MIT
// A context and a renderer for the tests of one program; tests are skipped where there is no EGL.
#pragma once

#include <gtest/gtest.h>

#include "render/offscreen_context.h"
#include "render/scene_renderer.h"

namespace elbowroom::test {

class GlTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite();
  static void TearDownTestSuite();
  void SetUp() override;

  SceneRenderer& renderer();
  // The picture of a world at t; fails the test on an error.
  Picture draw(const World& world, double t, const Camera& camera, const Style& style = {},
               int width = 160, int height = 120);
  Picture draw(const Frame& frame, const Camera& camera, const Style& style = {}, int width = 160,
               int height = 120);
};

// Mean absolute difference of two pictures of one size, in levels of 255.
double difference(const Picture& a, const Picture& b);
// How far a colour leans from blue-grey towards the problem colour: red minus blue, in levels.
int warmth(Rgb colour);
Picture flipped(const Picture& picture);

}  // namespace elbowroom::test
