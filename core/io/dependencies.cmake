# SPDX-License-Identifier: MIT
# tinygltf and stb_image are header-only; both are compiled in exactly one file of this folder.
find_path(TINYGLTF_INCLUDE_DIR tiny_gltf.h REQUIRED)
find_path(STB_INCLUDE_DIR stb/stb_image.h REQUIRED)
get_target_property(elbowroom_io_type elbowroom_io TYPE)
if(NOT elbowroom_io_type STREQUAL INTERFACE_LIBRARY)
  target_include_directories(elbowroom_io SYSTEM PRIVATE ${TINYGLTF_INCLUDE_DIR}
                                                         ${STB_INCLUDE_DIR})
endif()
# Which macros stand before its headers matters.
set_source_files_properties(${CMAKE_CURRENT_SOURCE_DIR}/io/gltf_parse.cpp PROPERTIES
  SKIP_UNITY_BUILD_INCLUSION ON)
