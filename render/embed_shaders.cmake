# SPDX-License-Identifier: MIT
# cmake -DFILES=a.glsl,b.glsl -DOUT=out.cpp -P embed_shaders.cmake
# Writes a C++ file that holds each GLSL file as a raw string, in the table of render/shader.h.
string(REPLACE "," ";" files "${FILES}")
set(text "// SPDX-License-Identifier: MIT\n// Made by render/embed_shaders.cmake from shaders/*.glsl.\n")
string(APPEND text "#include \"render/shader.h\"\n\nnamespace elbowroom {\n\n")
string(APPEND text "const std::vector<EmbeddedShader>& embedded_shaders() {\n")
string(APPEND text "  static const std::vector<EmbeddedShader> table = {\n")
foreach(file ${files})
  get_filename_component(name "${file}" NAME)
  file(READ "${file}" source)
  string(APPEND text "      {\"${name}\", R\"__glsl__(${source})__glsl__\"},\n")
endforeach()
string(APPEND text "  };\n  return table;\n}\n\n}  // namespace elbowroom\n")
file(WRITE "${OUT}" "${text}")
