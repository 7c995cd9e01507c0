// SPDX-License-Identifier: MIT
#include "core/editing/document.h"

namespace elbowroom {

const char* task_kind_id(TaskKind kind) { return kind == TaskKind::reach ? "reach" : "correct"; }

}  // namespace elbowroom
