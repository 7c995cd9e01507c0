// SPDX-License-Identifier: MIT
// What a hand (a foot) consists of in the bind pose: where its fingers begin, and its skin. Shared
// by what asks for the palm. World space, scene units. Pure, any thread.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/anatomy/bound_figure.h"

namespace elbowroom {

struct HandSkin {
  std::vector<std::array<Vec3, 3>> triangles;  // all three corners follow the hand most
};

struct HandParts {
  std::vector<Vec3> finger_roots;  // knuckles; of a foot the toes' roots; thumb apart
  std::vector<Vec3> thumb_roots;
  // With fingers and thumb. Pieces of surface that are not connected with the rest of the body and
  // go farther than a lower bone's length (a weapon skinned to the hand) count only where there is
  // nothing else.
  HandSkin all;
  HandSkin palm;  // of the joints that are no finger beyond its root and no thumb
};

// Of the joint `end` and what is below it. `with_siblings`: joints beside it that stand near it are
// the hand's too: for rigs that have no wrist of their own.
// Cost: O(joints), and O(vertices) of the meshes that follow the hand.
HandParts hand_parts(const BoundFigure& figure, int end, bool foot, bool with_siblings);

struct WeightedPoint {
  Vec3 place{0.0};
  double weight = 1;
};
// Centres of the triangles by their areas.
std::vector<WeightedPoint> weighted_points(const HandSkin& skin);
// Middle of the surface; nothing without area.
std::optional<Vec3> middle_of(const HandSkin& skin);

}  // namespace elbowroom
