// SPDX-License-Identifier: MIT
// The values that a project file is made of, from JSON and to it: for project_file.cpp. What is
// read may hold anything anywhere. `where` is the place in the file, for people
// ("/tasks/0/window").
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "core/editing/document.h"

namespace elbowroom::project_json {

using Json = nlohmann::ordered_json;

// What the readers below throw, to be caught in project_file.cpp: the place and what is wrong
// there.
struct Damage {
  std::string where, what;
  std::string remedy = "correct it by hand or take an older copy";
};

const Json& member(const Json& object, const char* key, const std::string& where);
std::string text_of(const Json& value, const std::string& where);
double number_of(const Json& value, const std::string& where);
// A number that float32 can hold.
float float_of(double value, const std::string& where);
const Json& array_of(const Json& value, const std::string& where);
const Json& object_of(const Json& value, const std::string& where);
bool flag_of(const Json& value, const std::string& where);
template <int N>
std::array<double, N> numbers_of(const Json& value, const std::string& where) {
  if (!value.is_array() || value.size() != N)
    throw Damage{where, "this should be a list of " + std::to_string(N) + " numbers"};
  std::array<double, N> numbers;
  for (std::size_t i = 0; i < N; ++i) numbers[i] = number_of(value[i], where);
  return numbers;
}

Quat quat_of(const Json& value, const std::string& where);
PlanningWishes wishes_of(const Json& object, const std::string& where);
// The member "window": absent or "auto" is none.
std::optional<Interval> window_of(const Json& object, const std::string& where);
HandTarget target_of(const Json& object, const std::string& where);
Draft draft_of(const Json& object, const std::string& where);
LimbOverrides limbs_of(const Json& object, const std::string& where);
SwingLimits swing_limits_of(const Json& object, const std::string& where);

Json json_of(const Quat& q);
Json json_of(const Vec3& v);
void put_wishes(Json& object, const PlanningWishes& wishes);
Json json_of(const std::optional<Interval>& window);
Json json_of(const HandTarget& target);
Json json_of(const Draft& draft);
Json json_of(const LimbOverrides& limbs);
Json json_of(const SwingLimits& limits);
// Carries over what is not known of a limb's swing limits; what is known stays away if it has been
// taken away.
void keep_unknown_of_swings(Json& fresh, const Json& old);

}  // namespace elbowroom::project_json
