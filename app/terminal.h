// SPDX-License-Identifier: MIT
// What the program says to a person at a terminal: errors, warnings, progress.
#pragma once

#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"

namespace elbowroom {

// "elbowroom: FILE: what is wrong. (remedy)" on standard error.
void print_error(const Error& error);
void print_warnings(const std::vector<std::string>& warnings);

// A line on standard error that is rewritten in place; says nothing if that is no terminal.
ProgressSink terminal_progress();
void clear_progress();

}  // namespace elbowroom
