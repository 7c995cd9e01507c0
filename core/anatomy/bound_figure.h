// SPDX-License-Identifier: MIT
// A character as it was bound: where its joints stand, which of them carry skin, and the digits of
// its hands. What the joints are called plays no part here, so a rig whose joints are renamed is
// the same figure. World space is the file's. Immutable once made; any thread.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/scene/model.h"

namespace elbowroom {

struct BoundFigure {
  const Model& model;
  const Character& character;
  std::vector<Mat4> globals;  // bind_globals
  std::vector<double> skin;   // by node: weights of the vertices that follow it or a joint below it
  std::vector<double> rigid;  // by node: vertices of rigid meshes at it or below it
  std::vector<char> jointed;  // by node: a skin uses it or a joint below it
  bool shown = false;         // there is a vertex at all
  // Axes of the space in which the figure was modelled (that of its bind matrices), world, unit:
  // they turn with the figure.
  std::array<Vec3, 3> axes{Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};

  // Whether turning the joint moves part of the figure, or what it holds. In a file without a
  // figure (a clip with its skeleton alone) every joint of a skin does.
  bool carries(int joint) const {
    const auto j = static_cast<std::size_t>(joint);
    return jointed[j] != 0 && (!shown || skin[j] > 0 || rigid[j] > 0);
  }
  // Of joints side by side those that move skin, if there are any, else those that move anything,
  // else those that a skin uses: a figure's own parts rather than what hangs from it.
  std::vector<int> own_parts(const std::vector<int>& joints) const;
  const std::vector<int>& children(int joint) const {
    return model.skeleton.children[static_cast<std::size_t>(joint)];
  }
  int parent(int joint) const {
    return model.skeleton.joints[static_cast<std::size_t>(joint)].parent;
  }
  Vec3 place(int joint) const { return Vec3(globals[static_cast<std::size_t>(joint)][3]); }
};

// Cost: O(nodes + influences of the character's meshes).
BoundFigure bound_figure(const Model& model, const Character& character);

// Of joints side by side that carry skin, as seen from a wrist: which are fingers and which is the
// thumb, the one that clearly stands off from the others (of two the one that stands off from the
// forearm). -1 if none does. `lower`: along the forearm, any length.
struct Digits {
  std::vector<int> fingers;
  int thumb = -1;
};
Digits digits_of(const BoundFigure& figure, const std::vector<int>& branches, const Vec3& wrist,
                 const Vec3& lower);

// The joints that branch off at a wrist, or below it where a single joint follows (a palm's own);
// empty where nothing branches. Of a foot what is directly below it. Those with skin, if there are
// any, in the file's order.
std::vector<int> branches_below(const BoundFigure& figure, int end, bool foot);

// Origin of the joint farthest from `from` at or below `joint`, of those that skins use.
Vec3 tip_below(const BoundFigure& figure, int joint, const Vec3& from);

// Whether a joint and all below it lie on the line from one joint to another, as twist joints do.
bool lies_along(const BoundFigure& figure, int joint, int from, int to);
// The same of a place.
bool lies_along(const Vec3& place, const Vec3& from, const Vec3& to);

// Centre of what lies beyond a limb's end as seen from it: of the origins of its children that
// carry skin (a hand's thumb apart), else of the vertices that follow it for more than half, else
// of its children; relative to the joint. Nothing if there is none of these.
std::optional<Vec3> extremity(const BoundFigure& figure, int joint, bool hand);

}  // namespace elbowroom
