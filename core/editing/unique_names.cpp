// SPDX-License-Identifier: MIT
#include "core/editing/unique_names.h"

#include <algorithm>

namespace elbowroom {
namespace {

// `wanted`, or with the first number that makes it none of those taken.
template <typename IsTaken>
std::string unique_name(const std::string& wanted, const IsTaken& is_taken) {
  std::string name = wanted;
  for (int n = 2; is_taken(name); ++n) name = wanted + " (" + std::to_string(n) + ")";
  return name;
}

}  // namespace

std::string unique_task_name(const Document& document, const std::string& wanted) {
  return unique_name(wanted, [&](const std::string& name) {
    return std::any_of(document.tasks.begin(), document.tasks.end(),
                       [&](const Task& task) { return task.name == name; }) ||
           // What is left of a task that was deleted is not the new one's.
           std::any_of(document.corrections.begin(), document.corrections.end(),
                       [&](const Correction& correction) { return correction.task == name; });
  });
}

std::string unique_correction_name(const Document& document, const std::string& wanted) {
  return unique_name(wanted, [&](const std::string& name) {
    return std::any_of(document.corrections.begin(), document.corrections.end(),
                       [&](const Correction& correction) { return correction.name == name; });
  });
}

}  // namespace elbowroom
