// SPDX-License-Identifier: MIT
// tinygltf behind a wall: it is given a document that has been checked (gltf_check.h) and buffers
// that are in memory already; it has no way to the disk. Private to the gltf_*.cpp files.
#pragma once

// Without its own images, writers and file access; see gltf_parse.cpp, which compiles it.
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_INCLUDE_JSON
#include <tiny_gltf.h>

#include <cstdint>
#include <string>
#include <vector>

#include "core/io/gltf_check.h"

namespace elbowroom::gltf {

// Moves the buffers out of `checked`.
tinygltf::Model parse_document(Checked& checked, const std::string& file);

// Elements of an accessor as floats, `components` each (which must be the accessor's own).
// Normalized integers are scaled; `always_normalized` scales all integers, for rotations and
// weights, where the specification allows no others. Refuses accessors that have no data or another
// type; `what` and `where` are for that error ("its rotations", "file, animation 0").
std::vector<float> read_floats(const tinygltf::Model& model, const Checked& checked, int accessor,
                               int components, bool always_normalized, const std::string& what,
                               const std::string& where);
// Likewise unsigned integers.
std::vector<std::uint32_t> read_integers(const tinygltf::Model& model, const Checked& checked,
                                         int accessor, int components, const std::string& what,
                                         const std::string& where);

}  // namespace elbowroom::gltf
