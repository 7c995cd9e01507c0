// SPDX-License-Identifier: MIT
#include "core/collision/scene_collision.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/collision/scene_collision_data.h"

namespace elbowroom {

const char* allowed_reason_id(AllowedReason reason) {
  switch (reason) {
    case AllowedReason::shared_joint:
      return "shared_joint";
    case AllowedReason::bind_pose:
      return "bind_pose";
    case AllowedReason::clip:
      return "clip";
    case AllowedReason::support:
      return "support";
  }
  return "unknown";
}

namespace {

bool sound(double x, double low, double high) { return x >= low && x <= high; }

// What is wrong with the question itself.
Status check_query(const World& world, int actor, int character,
                   const std::vector<LimbModel>& limbs, double begin, double end,
                   const CollisionSettings& settings) {
  if (actor < 0 || actor >= static_cast<int>(world.actors.size()) ||
      !world.actors[static_cast<std::size_t>(actor)].model)
    return Error{"the scene has no file " + std::to_string(actor) + " with a character in it", "",
                 "name a file of the scene"};
  const Model& model = *world.actors[static_cast<std::size_t>(actor)].model;
  const std::string file = model.path.string();
  if (character < 0 || character >= static_cast<int>(model.characters.size()))
    return Error{"there is no character " + std::to_string(character), file,
                 "it has " + std::to_string(model.characters.size())};
  const Character& figure = model.characters[static_cast<std::size_t>(character)];
  if (!(figure.height > 0 && std::isfinite(figure.height)))
    return Error{"the character \"" + figure.name + "\" has no height", file,
                 "tolerances are shares of the height; check the bind pose and the scale"};
  for (const LimbModel& limb : limbs)
    for (const int joint : {limb.limb.root, limb.limb.middle, limb.limb.end})
      if (joint < 0 || joint >= model.skeleton.size())
        return Error{"the limb " + limb.limb.name + " names a joint that is not there", file, ""};
  for (const LimbModel& limb : limbs)
    for (const FollowingJoint& own : limb.limb.following)
      if (own.joint < 0 || own.joint >= model.skeleton.size() || own.serves < 0 ||
          own.serves >= model.skeleton.size() ||
          !model.skeleton.is_within(own.serves, limb.limb.root) ||
          model.skeleton.is_within(own.joint, limb.limb.root) ||
          model.skeleton.is_within(limb.limb.root, own.joint))
        return Error{"the limb " + limb.limb.name + " is followed by a joint that is no such", file,
                     "find the limb anew"};
  if (!(std::isfinite(begin) && std::isfinite(end) && begin <= end))
    return Error{"the time interval is empty or not finite", file, "give begin ≤ end in seconds"};
  if (!(settings.height >= 0 && std::isfinite(settings.height)))
    return Error{"the height given is negative or no number", "settings", "give scene units"};
  if (!(sound(settings.epsilon, 0, 0.1) && sound(settings.clearance, 0, 0.5) &&
        sound(settings.joint_radius, 0, 1) && sound(settings.patch_size, 1e-3, 1)))
    return Error{"a collision setting is out of range", "settings",
                 "shares of the height: epsilon 0 to 0.1, clearance 0 to 0.5, joint_radius 0 to 1, "
                 "patch_size 0.001 to 1"};
  return Done{};
}

}  // namespace

SceneCollision::SceneCollision(std::unique_ptr<Data> data) : data_(std::move(data)) {}
SceneCollision::SceneCollision(SceneCollision&&) noexcept = default;
SceneCollision& SceneCollision::operator=(SceneCollision&&) noexcept = default;
SceneCollision::~SceneCollision() = default;

Result<SceneCollision> SceneCollision::build(World world, int actor, int character,
                                             std::vector<LimbModel> limbs, double begin, double end,
                                             const CollisionSettings& settings,
                                             const std::stop_token& stop) {
  if (const Status checked = check_query(world, actor, character, limbs, begin, end, settings);
      !checked)
    return checked.error();
  auto data = std::make_unique<Data>();
  data->world = std::move(world);
  data->actor = actor;
  data->character = character;
  data->posed_limbs.resize(limbs.size());
  data->limbs = std::move(limbs);
  data->settings = settings;
  data->begin = begin;
  data->end = end;
  const Actor& view = data->world.actors[static_cast<std::size_t>(actor)];
  const Character& figure = view.model->characters[static_cast<std::size_t>(character)];
  // Heights are the file's; how large it stands in the world is the placement's matter.
  const double scale = std::cbrt(std::abs(glm::determinant(Mat3(view.world_from_file))));
  data->height = (settings.height > 0 ? settings.height : figure.height) *
                 (scale > 0 && std::isfinite(scale) ? scale : 1.0);
  data->source_clip = view.clip;
  if (const Status built = build_bodies(*data); !built) return built.error();
  if (!find_allowed_contacts(*data, stop))
    return Error{"stopped before the scene's contacts were known", "", ""};
  return SceneCollision(std::move(data));
}

const World& SceneCollision::world() const { return data_->world; }
int SceneCollision::actor() const { return data_->actor; }
const std::vector<LimbModel>& SceneCollision::limbs() const { return data_->limbs; }
double SceneCollision::height() const { return data_->height; }
const CollisionSettings& SceneCollision::settings() const { return data_->settings; }
const AllowedContacts& SceneCollision::allowed_contacts() const { return data_->allowed; }

void SceneCollision::allow_beside_clip_contacts(bool allowed) {
  data_->beside_clip_contacts = allowed;
}

void SceneCollision::set_clip(std::shared_ptr<const Clip> clip) {
  data_->world.actors[static_cast<std::size_t>(data_->actor)].clip = std::move(clip);
  for (auto& limb : data_->posed_limbs) limb.reset();
  data_->posed = false;
}

void SceneCollision::pose_limb(int limb, const LimbState* state) {
  if (limb < 0 || limb >= static_cast<int>(data_->limbs.size())) return;
  auto& posed = data_->posed_limbs[static_cast<std::size_t>(limb)];
  if (!state && !posed) return;
  if (state)
    posed = *state;
  else
    posed.reset();
  data_->posed = false;
}

void SceneCollision::contacts_at(double t, int only_limb, bool list_allowed,
                                 std::vector<ContactSample>& out) {
  out.clear();
  if (!std::isfinite(t) || !data_->knows(only_limb)) return;
  data_->pose(t);
  for (TestPair& pair : data_->pairs_now().pairs)
    if (data_->concerns(pair, only_limb)) data_->pair_contacts(pair, only_limb, list_allowed, out);
  for (const EnclosedObject& object : enclosed_objects(*data_, only_limb)) {
    ContactSample sample = enclosed_sample(*data_, object, only_limb);
    // What a single body encloses is told of already.
    const bool known = std::any_of(out.begin(), out.end(), [&](const ContactSample& other) {
      return other.part_b == sample.part_b && !other.allowed;
    });
    if (!known) out.push_back(std::move(sample));
  }
}

bool SceneCollision::limb_in_contact(double t, int limb, double distance, double from_body) {
  if (limb < 0 || !data_->knows(limb) || !std::isfinite(t) || !std::isfinite(distance)) return true;
  data_->pose(t);
  const double at = std::max(distance, data_->touching());
  const double at_body = from_body >= 0 ? std::max(from_body, data_->touching()) : at;
  auto& pairs = data_->pairs_now().pairs;
  const auto hit = [&](std::size_t k) {
    return data_->concerns(pairs[k], limb) &&
           data_->pair_in_contact(pairs[k], pairs[k].clip_may_allow ? at_body : at);
  };
  // What hit last is asked first; only the time to an answer depends on it.
  const std::size_t last = data_->hit_last;
  if (last < pairs.size() && hit(last)) return true;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (k == last || !hit(k)) continue;
    data_->hit_last = k;
    return true;
  }
  return !enclosed_objects(*data_, limb).empty();
}

namespace {

double clearance_at(SceneCollision::Data& data, double t, int limb, double at_most, bool own_too) {
  if (limb < 0 || !data.knows(limb) || !std::isfinite(t) || !(at_most > 0)) return 0;
  data.pose(t);
  double clearance = at_most;
  for (TestPair& pair : data.pairs_now().pairs) {
    if (!data.concerns(pair, limb) || (!own_too && pair.clip_may_allow)) continue;
    clearance = std::min(clearance, data.pair_clearance(pair, clearance));
    if (!(clearance > 0)) return 0;
  }
  if (!enclosed_objects(data, limb).empty()) return 0;
  return clearance;
}

}  // namespace

double SceneCollision::limb_clearance(double t, int limb, double at_most) {
  return clearance_at(*data_, t, limb, at_most, true);
}

double SceneCollision::limb_clearance_from_scene(double t, int limb, double at_most) {
  return clearance_at(*data_, t, limb, at_most, false);
}

}  // namespace elbowroom
