// SPDX-License-Identifier: MIT
// What a SceneCollision holds. Private to the collision folder.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/collision/allowed_patches.h"
#include "core/collision/body_parts.h"
#include "core/collision/collision_body.h"
#include "core/collision/scene_collision.h"

namespace elbowroom {

// What a body is, apart from what it is attached to at some time.
struct BodyRole {
  bool own = false;       // of the character in view
  LimbSide side;          // own: whose side
  int entity = -1;        // bodies of one file's character or object; no pair within one is tested,
                          // but for the limbs of the character in view
  bool animated = false;  // may move by itself
};

// Two bodies that are tested against each other. While attachments stay as they are, so do pairs.
struct TestPair {
  int a = -1, b = -1;                 // bodies, a < b
  int limb_a = -1, limb_b = -1;       // whose limb's side each is (carried things too)
  bool clip_may_allow = false;        // body against body, or a carried thing and its holder
  AllowedPatches* allowed = nullptr;  // null: nothing is
  PairCache cache;
  std::vector<TriangleContact> touched;  // that the clip allows, when last looked at
};

// The segment of an actor that follows nothing of the character in view.
inline constexpr int kNotCarried = -2;

struct PairList {
  std::vector<LimbSide> side_of_actor;  // for the carried; limb -1 and kNotCarried: not carried
  std::vector<TestPair> pairs;
};

struct SceneCollision::Data {
  World world;
  int actor = 0, character = 0;
  std::vector<LimbModel> limbs;
  CollisionSettings settings;
  double height = 1, begin = 0, end = 0;
  std::shared_ptr<const Clip> source_clip;
  AllowedContacts allowed;
  // What the clip touches it may touch a little earlier or later too, seconds: a limb that is
  // replanned passes the same place in its own time.
  double clip_memory = 0.15;
  bool beside_clip_contacts = true;  // allow_beside_clip_contacts()

  std::vector<std::string> parts;  // names by part number
  std::vector<CollisionBody> bodies;
  std::vector<BodyRole> roles;
  // All of the character's skin in one: what lies inside it across the cuts between bodies.
  std::unique_ptr<CollisionBody> whole_skin;
  std::uint64_t whole_stamp = 0;
  std::vector<LimbSide> side_of_node;          // of the actor in view
  std::vector<std::vector<bool>> limb_within;  // [x][y]: limb x is y or hangs below it
  std::map<std::pair<int, int>, AllowedPatches> allowed_pairs;  // by bodies, lower first
  std::map<std::vector<int>, PairList> pair_lists;              // by what is attached

  // The state the bodies are brought to when they are looked at.
  std::vector<ActorState> states;
  std::vector<Mat4> globals_scratch;
  std::vector<std::optional<LimbState>> posed_limbs;
  double posed_at = 0;
  bool posed = false;         // states are those of posed_at
  bool posed_source = false;  // and of the source clip, whatever is played
  Vec3 origin{0.0};
  std::size_t hit_last = 0;               // place among the pairs of the one found in contact last
  std::vector<std::uint64_t> body_stamp;  // the pose each body was brought to last
  std::uint64_t stamp = 0;

  // Distances in scene units.
  double touching() const { return settings.epsilon * height; }
  double weld_tolerance() const { return 1e-6 * height; }

  // Brings the world to time t. With `source` the actor in view plays the source clip, limbs as it
  // has them.
  void pose(double t, bool source = false);
  // The same for a state given (the bind pose), at which only bodies of the actor in view are
  // asked.
  void pose_actor(const ActorState& state);
  const CollisionBody& placed(int body);
  RigidTransform a_from_b(const TestPair& pair);
  PairList& pairs_now();

  bool knows(int limb) const { return limb < static_cast<int>(limbs.size()); }
  bool concerns(const TestPair& pair, int only_limb) const {
    return only_limb < 0 || in_limb(pair.limb_a, only_limb) || in_limb(pair.limb_b, only_limb);
  }
  bool in_limb(int limb, int of) const {
    return limb >= 0 && limb_within[static_cast<std::size_t>(limb)][static_cast<std::size_t>(of)];
  }
  // The source clip is what is played, over the time for which it decides what is allowed.
  bool playing_source() const;

  // True if something of the pair is in contact that is not allowed.
  bool pair_in_contact(TestPair& pair, double distance);
  void pair_contacts(TestPair& pair, int only_limb, bool list_allowed,
                     std::vector<ContactSample>& out);
  double pair_clearance(TestPair& pair, double at_most);
};

// An object that lies wholly inside the character's skin, and the part it is nearest to.
struct EnclosedObject {
  int body = -1;
  int part = -1, limb = -1;  // limb -1: the trunk
  int object_part = -1;
  Vec3 place{0.0};   // query space
  double depth = 0;  // of that place
};
// Objects that no cut-out body encloses alone, as the world is posed; with only_limb ≥ 0 those
// inside that limb. What the character carries is not looked at (scene_enclosed.cpp).
std::vector<EnclosedObject> enclosed_objects(SceneCollision::Data& data, int only_limb);
ContactSample enclosed_sample(const SceneCollision::Data& data, const EnclosedObject& object,
                              int only_limb);

// The character in view in its bind pose, where the world places its file.
ActorState bind_state(const World& world, int actor, int character);

// Building steps, in their order (scene_bodies.cpp, scene_allowed.cpp).
Status build_bodies(SceneCollision::Data& data);
// False if stopped.
bool find_allowed_contacts(SceneCollision::Data& data, const std::stop_token& stop);

// Contacts of a pair as groups of equal parts and verdict (scene_contacts.cpp).
struct ContactGroup {
  int part_a = -1, part_b = -1;
  std::uint8_t reason = 0;  // one bit of AllowedPatches; 0: not allowed
  Vec3 place{0.0};          // query space
  bool contained = false;
  std::vector<std::uint16_t> patches_a, patches_b;                   // ascending, unique
  std::vector<std::pair<std::uint16_t, std::uint16_t>> patch_pairs;  // ascending, unique
  std::vector<std::uint32_t> triangles_a, triangles_b;               // of the bodies; as found
  double depth = 0;                                                  // negative: not measured
};
// With the bodies as they are posed. `skip`: allowed pairs of patches to pass over. With depth
// measured, for groups that are not allowed or allowed by the clip, those deeper than the clip has
// them lose their reason; of_the_clips, only those are measured and the others' depth is -1;
// without, patches alone decide.
enum class Skip { none, lasting, touched, all };  // AllowedPatches::Reasons
enum class Depth { measured, of_the_clips, left_out };
std::vector<ContactGroup> contact_groups(SceneCollision::Data& data, const TestPair& pair,
                                         double distance, Skip skip, Depth depth = Depth::measured);

}  // namespace elbowroom
