// SPDX-License-Identifier: MIT
// Contacts of a whole world on the deformed skin, with one character in view: its limbs (and what
// they carry) against everything, and everything else against everything. This is the truth that
// `check`, windows and the final verification rest on.
#pragma once

#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "core/anatomy/limb_model.h"
#include "core/collision/mesh_pair.h"
#include "core/scene/world.h"

namespace elbowroom {

// Lengths are for a character 1.75 m tall and scale with height (DESIGN.md, "Contact").
struct CollisionSettings {
  double height = 0;                // scene units before the actor's placement; 0: the character's
  double epsilon = 1e-5;            // × height: in contact at or below
  double clearance = 0.005 / 1.75;  // × height: kept while planning
  double joint_radius = 0.06;  // × height: geodesic radius of allowed contact about a joint that
                               // two parts share
  double patch_size = 0.03;    // × height: diameter of an allowed-contact patch
  double touch_reach = 0.02;   // × height: while the clip has two parts in contact, patches this
                               // near to each other belong to the touching; a limb that moves a
                               // little slides over them, no deeper than the clip has it
};

enum class AllowedReason { shared_joint, bind_pose, clip, support };
const char* allowed_reason_id(AllowedReason reason);

// One pair of parts in contact at one time.
struct ContactSample {
  int limb = -1;               // index of the limb involved (the first, if both are), -1: none
  std::string part_a, part_b;  // "Ada/RightForeArm", "umbrella.glb/Canopy"; the limb's side first
  Vec3 place{0.0};             // world
  double depth = 0;            // scene units; 0 for surfaces that only touch or cross openly
  bool allowed = false;
  AllowedReason reason = AllowedReason::shared_joint;
};

// Contacts of one pair over a stretch of time.
struct ContactInterval {
  ContactSample deepest;
  double begin = 0, end = 0, time_of_deepest = 0;  // seconds
};

struct AllowedContacts {
  struct Entry {
    std::string part_a, part_b;
    AllowedReason reason;
    int patches = 0;   // pairs of patches
    double depth = 0;  // deepest the clip has it, scene units
  };
  std::vector<Entry> entries;
};

class SceneCollision {
 public:
  // `limbs` of world.actors[actor]'s character `character`, in the order of their indices below.
  // Rests on the world's clips for clip-contact patches, over [begin, end]. Cost: a scan of the
  // clip. Error besides those of the input: stopped, answered at the next moment of the clip.
  static Result<SceneCollision> build(World world, int actor, int character,
                                      std::vector<LimbModel> limbs, double begin, double end,
                                      const CollisionSettings& settings,
                                      const std::stop_token& stop = {});
  SceneCollision(SceneCollision&&) noexcept;
  SceneCollision& operator=(SceneCollision&&) noexcept;
  ~SceneCollision();

  const World& world() const;
  int actor() const;
  const std::vector<LimbModel>& limbs() const;
  double height() const;  // the character's, the unit of tolerances
  const CollisionSettings& settings() const;
  const AllowedContacts& allowed_contacts() const;

  // The actor plays another clip from now on (a correction under test). What is allowed stays as
  // it was built from the source clip. Limbs that were posed follow the clip again.
  void set_clip(std::shared_ptr<const Clip> clip);

  // Whether patches that come near each other where the clip has their parts in contact are allowed
  // (CollisionSettings::touch_reach); else only those that the clip itself has in contact. True
  // when built: what is planned needs room to slide. Final verdicts say false.
  void allow_beside_clip_contacts(bool allowed);

  // That limb's joints take this state at every time instead of the clip's, until called with null
  // or another clip is set: for planning on the deformed skin.
  void pose_limb(int limb, const LimbState* state);

  // Contacts at time t, on the deformed skin: of the limbs, of the rest of the character, and of
  // whatever else moves against something else (limb -1; nothing within one character or object but
  // the limbs of the one in view, and nothing that the rest of it carries). With only_limb ≥ 0 only
  // that limb (and what it carries) against everything is looked at. Allowed ones are listed as
  // such if asked for.
  void contacts_at(double t, int only_limb, bool list_allowed, std::vector<ContactSample>& out);

  // True as soon as one contact of the limb that is not allowed is found at t, at ≤ `distance` (at
  // least ε); with its own body, or a carried thing with its holder, at ≤ `from_body` if that is
  // not negative. Of a limb or a time that is none nothing good is said: true.
  bool limb_in_contact(double t, int limb, double distance, double from_body = -1);

  // Distance of limb (and carried objects) from everything it is not allowed to touch, at most
  // `at_most`, scene units.
  double limb_clearance(double t, int limb, double at_most);
  // The same from everything that is neither the character nor carried by it: an arm always hangs
  // near its own chest, and what is asked for here is the room in the scene.
  double limb_clearance_from_scene(double t, int limb, double at_most);

  // Contacts over [begin, end] sampled at `rate` Hz (and at the clip's keys and both sides of its
  // steps), merged into intervals whose ends are bisected to 1e-4 s. Stopped, it gives what it has
  // within some milliseconds: ask the token before using it.
  std::vector<ContactInterval> scan(double begin, double end, double rate, int only_limb,
                                    bool list_allowed, const std::stop_token& stop = {});

  struct Data;
  Data& data() { return *data_; }
  const Data& data() const { return *data_; }

 private:
  explicit SceneCollision(std::unique_ptr<Data> data);
  std::unique_ptr<Data> data_;
};

}  // namespace elbowroom
