// SPDX-License-Identifier: MIT
// What this reader makes of the glTF extensions a file names.
#pragma once

#include <optional>
#include <string>

#include "core/base/result.h"

namespace elbowroom::gltf {

// Why a file whose `extensionsRequired` has `name` can't be read (what and remedy); nothing if it
// can: the extension is understood, or concerns only how things look or what they are called.
std::optional<Error> required_extension(const std::string& name);

// What is lost by not understanding an extension a file merely uses; nothing for most.
std::optional<std::string> used_extension(const std::string& name);

}  // namespace elbowroom::gltf
