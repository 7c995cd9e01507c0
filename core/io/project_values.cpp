// SPDX-License-Identifier: MIT
#include "core/io/project_values.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/scene/placeable.h"

namespace elbowroom::project_json {
namespace {

constexpr const char* kNoLimb = "none";
constexpr std::array<const char*, 3> kLimbJoints = {"root", "middle", "end"};

SwingPolygon polygon_of(const Json& value, const std::string& where) {
  SwingPolygon corners;
  for (const Json& corner : array_of(value, where))
    corners.push_back(numbers_of<2>(corner, where + "/" + std::to_string(corners.size())));
  if (const auto limit = make_swing_polygon(0, 1, corners); !limit)
    throw Damage{where, "this is no swing limit: " + limit.error().what,
                 limit.error().remedy + ", or remove it to have the joint's own limit"};
  return counter_clockwise(std::move(corners));
}

}  // namespace

const Json& member(const Json& object, const char* key, const std::string& where) {
  const auto found = object.find(key);
  if (found == object.end()) throw Damage{where, std::string("\"") + key + "\" is missing"};
  return *found;
}

std::string text_of(const Json& value, const std::string& where) {
  if (!value.is_string()) throw Damage{where, "this should be a text"};
  return value.get<std::string>();
}

double number_of(const Json& value, const std::string& where) {
  if (!value.is_number() || !std::isfinite(value.get<double>()))
    throw Damage{where, "this should be a number"};
  return value.get<double>();
}

float float_of(double value, const std::string& where) {
  if (std::abs(value) > 1e30) throw Damage{where, "this number is too large"};
  return static_cast<float>(value);
}

const Json& array_of(const Json& value, const std::string& where) {
  if (!value.is_array()) throw Damage{where, "this should be a list"};
  return value;
}

const Json& object_of(const Json& value, const std::string& where) {
  if (!value.is_object()) throw Damage{where, "this should be an object"};
  return value;
}

bool flag_of(const Json& value, const std::string& where) {
  if (!value.is_boolean()) throw Damage{where, "this should be true or false"};
  return value.get<bool>();
}

Quat quat_of(const Json& value, const std::string& where) {
  const auto v = numbers_of<4>(value, where);
  return Quat(v[3], v[0], v[1], v[2]);
}

Json json_of(const Quat& q) { return Json::array({q.x, q.y, q.z, q.w}); }
Json json_of(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }

PlanningWishes wishes_of(const Json& object, const std::string& where) {
  PlanningWishes wishes;
  const auto at = [&](const char* key) { return where + "/" + key; };
  if (object.contains("seed")) {
    // A negative one would wrap, and one with a fraction is none.
    if (!object["seed"].is_number_unsigned())
      throw Damage{at("seed"), "this should be a whole number from 0 to 18446744073709551615"};
    wishes.seed = object["seed"].get<std::uint64_t>();
  }
  if (object.contains("alternatives"))
    wishes.alternatives = static_cast<int>(
        std::clamp(number_of(object["alternatives"], at("alternatives")), 1.0, 64.0));
  if (object.contains("clearance"))
    wishes.clearance = std::max(0.0, number_of(object["clearance"], at("clearance")));
  if (object.contains("max_iterations"))
    wishes.max_iterations = static_cast<int>(
        std::clamp(number_of(object["max_iterations"], at("max_iterations")), 1.0, 1e9));
  if (object.contains("max_seconds"))
    wishes.max_seconds = std::max(0.0, number_of(object["max_seconds"], at("max_seconds")));
  if (object.contains("sampling"))
    for (const auto& [name, interval] : object_of(object["sampling"], at("sampling")).items()) {
      const auto bounds = numbers_of<2>(interval, at("sampling") + "/" + name);
      wishes.sampling[name] = {bounds[0], bounds[1]};
    }
  return wishes;
}

void put_wishes(Json& object, const PlanningWishes& wishes) {
  object["seed"] = wishes.seed;
  object["alternatives"] = wishes.alternatives;
  object["clearance"] = wishes.clearance;
  object["max_iterations"] = wishes.max_iterations;
  object["max_seconds"] = wishes.max_seconds;
  Json sampling = Json::object();
  for (const auto& [name, interval] : wishes.sampling)
    sampling[name] = Json::array({interval.lower, interval.upper});
  object["sampling"] = sampling;
}

std::optional<Interval> window_of(const Json& object, const std::string& where) {
  if (!object.contains("window") || object["window"] == "auto") return std::nullopt;
  const auto window = numbers_of<2>(object["window"], where + "/window");
  if (!(window[0] < window[1])) throw Damage{where + "/window", "it ends before it begins"};
  return Interval{window[0], window[1]};
}

Json json_of(const std::optional<Interval>& window) {
  return window ? Json::array({window->lower, window->upper}) : Json("auto");
}

HandTarget target_of(const Json& object, const std::string& where) {
  object_of(object, where);
  HandTarget target;
  target.time = number_of(member(object, "time", where), where + "/time");
  const auto p = numbers_of<3>(member(object, "position", where), where + "/position");
  target.position = {p[0], p[1], p[2]};
  if (!is_placeable(target.position)) throw Damage{where + "/position", "it is too far away"};
  if (object.contains("orientation")) {
    const Quat rotation = quat_of(object["orientation"], where + "/orientation");
    if (glm::length(rotation) < 1e-6) throw Damage{where + "/orientation", "it is zero"};
    target.orientation = glm::normalize(rotation);
  }
  if (object.contains("grasp")) target.grasp = flag_of(object["grasp"], where + "/grasp");
  return target;
}

Json json_of(const HandTarget& target) {
  Json object;
  object["time"] = target.time;
  object["position"] = json_of(target.position);
  if (target.orientation) object["orientation"] = json_of(*target.orientation);
  object["grasp"] = target.grasp;
  return object;
}

Draft draft_of(const Json& object, const std::string& where) {
  object_of(object, where);
  Draft draft;
  if (object.contains("limb")) draft.limb = text_of(object["limb"], where + "/limb");
  draft.window = window_of(object, where);
  if (object.contains("target")) draft.target = target_of(object["target"], where + "/target");
  if (object.contains("wishes"))
    for (const auto& [limb, wishes] : object_of(object["wishes"], where + "/wishes").items()) {
      const std::string place = where + "/wishes/" + limb;
      draft.wishes[limb] = wishes_of(object_of(wishes, place), place);
    }
  return draft;
}

Json json_of(const Draft& draft) {
  Json object;
  object["limb"] = draft.limb;
  object["window"] = json_of(draft.window);
  if (draft.target) object["target"] = json_of(*draft.target);
  object["wishes"] = Json::object();
  for (const auto& [limb, wishes] : draft.wishes) put_wishes(object["wishes"][limb], wishes);
  return object;
}

LimbOverrides limbs_of(const Json& object, const std::string& where) {
  LimbOverrides limbs;
  for (const auto& [name, value] : object_of(object, where).items()) {
    const std::string place = where + "/" + name;
    if (!name.empty() && value == kNoLimb) {
      limbs[name] = {};
      continue;
    }
    const Json& list = array_of(value, place);
    if (name.empty() || (list.size() != 2 && list.size() != 3))
      throw Damage{place,
                   "this should be a limb's name with its first and last joint, or with a "
                   "middle between them"};
    LimbJoints& joints = limbs[name];
    joints.from = text_of(list.front(), place);
    joints.to = text_of(list.back(), place);
    if (list.size() == 3) joints.middle = text_of(list[1], place);
  }
  return limbs;
}

Json json_of(const LimbOverrides& limbs) {
  Json object = Json::object();
  for (const auto& [name, joints] : limbs) {
    if (joints.none()) {
      object[name] = kNoLimb;
      continue;
    }
    Json& list = object[name] = Json::array({joints.from});
    if (!joints.middle.empty()) list.push_back(joints.middle);
    list.push_back(joints.to);
  }
  return object;
}

SwingLimits swing_limits_of(const Json& object, const std::string& where) {
  SwingLimits limits;
  for (const auto& [limb, joints] : object_of(object, where).items()) {
    const std::string place = where + "/" + limb;
    object_of(joints, place);
    for (std::size_t i = 0; i < kLimbJoints.size(); ++i)
      if (joints.contains(kLimbJoints[i]))
        limits[limb][i] = polygon_of(joints[kLimbJoints[i]], place + "/" + kLimbJoints[i]);
  }
  return limits;
}

Json json_of(const SwingLimits& limits) {
  Json object = Json::object();
  for (const auto& [limb, polygons] : limits)
    for (std::size_t i = 0; i < polygons.size(); ++i)
      for (const auto& corner : polygons[i])
        object[limb][kLimbJoints[i]].push_back(Json::array({corner[0], corner[1]}));
  return object;
}

void keep_unknown_of_swings(Json& fresh, const Json& old) {
  if (!old.is_object()) return;
  for (const auto& [limb, joints] : old.items()) {
    if (!joints.is_object()) continue;
    for (const auto& [key, value] : joints.items())
      if (std::none_of(kLimbJoints.begin(), kLimbJoints.end(),
                       [&key](const char* joint) { return key == joint; }))
        fresh[limb][key] = value;
  }
}

}  // namespace elbowroom::project_json
