// SPDX-License-Identifier: MIT
#include "render/shader.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <sstream>

namespace elbowroom {
namespace {

const char* find_source(const std::string& name) {
  for (const auto& shader : embedded_shaders()) {
    if (name == shader.name) return shader.source;
  }
  return nullptr;
}

void append_source(const std::string& name, std::vector<std::string>& included, std::string& out) {
  if (std::find(included.begin(), included.end(), name) != included.end()) return;
  included.push_back(name);
  const char* source = find_source(name);
  if (source == nullptr) {
    out += "#error no embedded shader " + name + "\n";
    return;
  }
  std::istringstream lines(source);
  const std::string directive = "#include \"";
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind(directive, 0) == 0) {
      const auto end = line.find('"', directive.size());
      append_source(line.substr(directive.size(), end - directive.size()), included, out);
    } else {
      out += line + "\n";
    }
  }
}

const char* kRemedy = "update the graphics driver (OpenGL 4.5 is needed) or report this as a bug";

Result<unsigned> compile(GLenum stage, const std::string& name, const std::string& prelude = "") {
  std::string text = "#version 450 core\n" + prelude;
  std::vector<std::string> included;
  append_source(name, included, text);
  const GLuint shader = glCreateShader(stage);
  const char* source = text.c_str();
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  GLint ok = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
  if (ok == GL_TRUE) return static_cast<unsigned>(shader);
  char log[4096] = "";
  glGetShaderInfoLog(shader, sizeof log, nullptr, log);
  glDeleteShader(shader);
  return Error{std::string("shader does not compile: ") + log, "shaders/" + name, kRemedy};
}

Result<GlProgram> link(const std::vector<unsigned>& shaders, const std::string& name) {
  GlProgram program(glCreateProgram());
  for (const unsigned shader : shaders) glAttachShader(program.name(), shader);
  glLinkProgram(program.name());
  for (const unsigned shader : shaders) {
    glDetachShader(program.name(), shader);
    glDeleteShader(shader);
  }
  GLint ok = GL_FALSE;
  glGetProgramiv(program.name(), GL_LINK_STATUS, &ok);
  if (ok == GL_TRUE) return program;
  char log[4096] = "";
  glGetProgramInfoLog(program.name(), sizeof log, nullptr, log);
  return Error{std::string("shaders do not link: ") + log, "shaders/" + name, kRemedy};
}

}  // namespace

Result<GlProgram> make_program(const std::string& vertex, const std::string& fragment,
                               const std::string& prelude) {
  auto first = compile(GL_VERTEX_SHADER, vertex, prelude);
  if (!first) return first.error();
  auto second = compile(GL_FRAGMENT_SHADER, fragment, prelude);
  if (!second) {
    glDeleteShader(*first);
    return second.error();
  }
  return link({*first, *second}, vertex + " + " + fragment);
}

Result<GlProgram> make_compute_program(const std::string& compute) {
  auto shader = compile(GL_COMPUTE_SHADER, compute);
  if (!shader) return shader.error();
  return link({*shader}, compute);
}

}  // namespace elbowroom
