// SPDX-License-Identifier: MIT
// The demo scene as a document (assets/demo.h): what the editor opens when it is given no file.
#pragma once

#include "core/base/result.h"
#include "core/editing/document.h"

namespace elbowroom {

// Error: the demo's files are not found beside the program; with where they were looked for.
Result<Document> demo_document();

}  // namespace elbowroom
