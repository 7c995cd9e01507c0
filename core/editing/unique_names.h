// SPDX-License-Identifier: MIT
// Names in a document: a correction is linked to its task by the task's name, so no two tasks may
// have the same.
#pragma once

#include "core/editing/document.h"

namespace elbowroom {

// The name itself where the document has no such task (correction), else with the first number from
// 2 on that makes it one: "correct left_arm (2)".
std::string unique_task_name(const Document& document, const std::string& wanted);
std::string unique_correction_name(const Document& document, const std::string& wanted);

}  // namespace elbowroom
