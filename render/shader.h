// SPDX-License-Identifier: MIT
// GLSL programs from the files in shaders/, which are compiled into the library.
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "render/gl_objects.h"

namespace elbowroom {

struct EmbeddedShader {
  const char* name;  // file name below shaders/
  const char* source;
};

// All of shaders/*.glsl; the build writes the table.
const std::vector<EmbeddedShader>& embedded_shaders();

// Links a program of a vertex and a fragment shader. `#include "name.glsl"` on a line of its own
// pulls in another embedded file, once each. `prelude` goes before both (a #define). Error: the
// compiler's log, with the file's name.
Result<GlProgram> make_program(const std::string& vertex, const std::string& fragment,
                               const std::string& prelude = "");
Result<GlProgram> make_compute_program(const std::string& compute);

}  // namespace elbowroom
