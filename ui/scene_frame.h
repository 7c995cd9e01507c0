// SPDX-License-Identifier: MIT
// From the editor's state to what the viewport's picture shows: the motion at the current time,
// the ghost of a plan or of the source, trails of the hand, contacts, the posture at the hand
// target.
//
// What is costly (trails, the scene's size, who belongs to a limb) is kept between frames and made
// anew when what it rests on changes. One thread.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "render/frame.h"
#include "ui/editor_state.h"

namespace elbowroom {

class SceneFrame {
 public:
  // What to draw. Good until the next call; `state` must live as long.
  const Frame& make(const EditorState& state, const ViewState& view, double pixel_scale);

  // The states of the motion shown in the last frame made, by actor; empty without a scene.
  const std::vector<ActorState>& states() const { return states_; }
  const World& world() const { return world_; }
  double size() const { return size_; }

  // Nodes of the limb (its root and all below), not 0, by node of the character's file.
  static std::vector<std::uint8_t> limb_nodes(const Skeleton& skeleton, const Limb& limb);

  // Where the figure is in the last frame made, the mean of its limbs' roots; none: no figure.
  std::optional<Vec3> figure_place() const;
  // Points to frame the view on: the figure and its props, now or over the whole clip; the selected
  // limb now.
  std::vector<Vec3> points_of_figure(const EditorState& state, bool whole_clip) const;
  std::vector<Vec3> points_of_selection(const EditorState& state) const;

 private:
  void begin_session(const EditorState& state);
  void add_limb_look(const EditorState& state, const ViewState& view);
  void add_ghost(const World& world, const std::vector<ActorState>& states, const Limb& limb,
                 Rgb colour, float opacity);
  void add_candidate(const EditorState& state);
  void add_source_ghost(const EditorState& state);
  void add_target(const EditorState& state);
  void add_contacts(const EditorState& state, const ViewState& view);
  void add_trails(const EditorState& state);
  void add_swing_cone(const EditorState& state, const ViewState& view);

  struct TrailKey {
    std::shared_ptr<const Clip> clip;  // kept, so that no other one gets its address
    std::shared_ptr<const CollisionStrip> strip;
    int limb = -1;
    double begin = 0, end = 0;
    bool operator==(const TrailKey&) const = default;
  };
  struct KeptTrail {
    TrailKey key;
    Trail trail;
  };
  const Trail& trail_of(KeptTrail& kept, const std::shared_ptr<const Clip>& clip,
                        const std::shared_ptr<const CollisionStrip>& strip, int limb, double begin,
                        double end, Rgb colour, bool dashed);

  // What a frame is made from, besides its size.
  struct FrameKey {
    const Session* session = nullptr;
    std::uint64_t version = 0;
    Compare compare = Compare::both;
    bool trails = false, limb = false;
    int cone = -1;
    bool operator==(const FrameKey&) const = default;
  };

  FrameKey made_from_;
  const Session* session_ = nullptr;
  World world_, ghost_world_, target_world_;
  std::vector<ActorState> states_, ghost_states_, source_states_, target_states_;
  std::vector<float> limb_parts_;
  double size_ = 0;
  KeptTrail source_trail_, shown_trail_;
  Frame frame_;
};

}  // namespace elbowroom
