// SPDX-License-Identifier: MIT
// The dialog that says which joints a limb has: the four usual ones and chains by name, each with
// why it was taken (or why it was not found), its three joints to be chosen from a list that can be
// searched, "not a limb", and back to what is found. What is chosen is tried at once: where it is
// no chain, the dialog says why and does not take it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "ui/panels/panel.h"

namespace elbowroom {

class LimbJointsDialog {
 public:
  // Begins with view.joints_of, else with the selected limb.
  void open(const PanelContext& context);
  // In every frame while it is open; closes it by view.dialog.
  void draw(const PanelContext& context);

 private:
  void choose(const PanelContext& context, const std::string& limb);
  void set_joint(const PanelContext& context, int joint);
  void try_it(const PanelContext& context);
  void list_limbs(const PanelContext& context);
  void describe(const PanelContext& context);
  void list_slots(const PanelContext& context);
  void list_joints(const PanelContext& context, float height);
  void verdict(const PanelContext& context);
  void answers(const PanelContext& context);
  LimbJoints wanted(const PanelContext& context) const;

  std::string limb_;                       // by limb_id, or a chain's name; empty: a new chain
  std::string new_name_;                   // of the new chain
  std::array<int, 3> joints_{-1, -1, -1};  // root, middle, end: node indices; no middle: by itself
  std::size_t slot_ = 0;                   // which of them a click in the list sets
  std::string search_;
  bool scroll_ = false;   // the list goes to the joint that is chosen
  bool touched_ = false;  // a joint has been chosen here

  // What the joints come to.
  std::optional<Limb> tried_;
  std::optional<Error> error_;
  std::vector<std::string> gives_way_;  // limbs that share joints with it
};

}  // namespace elbowroom
