// SPDX-License-Identifier: MIT
// Reads a glTF 2.0 file (.gltf, .glb, .vrm, .vrma: told apart by content, not by name) into a
// Model.
//
// The file is hostile until proven otherwise. Every index, range, count, stride, size and number is
// checked before it is used; nothing is allocated that the file's own size does not justify;
// nothing outside the file's folder is opened, whatever its URIs say; node loops, non-finite
// transforms and vertices, and required extensions that are not understood are refused by name.
// What concerns looks only (materials, textures, images) never refuses a file: it is left out and a
// warning says so.
//
// What is taken from the file:
//  * every node, under its own index; the meshes of the default scene (of the first one if none is
//    named, of all roots if there are none);
//  * triangles, strips and fans; points and lines are left out;
//  * any number of JOINTS_n/WEIGHTS_n sets. Weights are normalized; negative ones count as 0. A
//    vertex without any weight follows the first joint its JOINTS_0 names, wholly, as in common
//    players: that is a fixed rule where the specification has none;
//  * images that some material uses as its base colour;
//  * animation channels with a node that can be animated. A channel that cannot be played (a
//    non-finite value, a node with `matrix`, an unknown path) is left out and a warning says so;
//    keys whose time does not increase are skipped likewise.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>

#include "core/base/result.h"
#include "core/scene/model.h"

namespace elbowroom {

struct ReadOptions {
  bool images = true;  // decode base-colour images; without, Model::images have no pixels
  std::uint64_t max_bytes = std::uint64_t{2} << 30;  // of the file and all it refers to, together
  // Told the path of each file just before it is opened. May be empty.
  std::function<void(const std::filesystem::path&)> on_open;
  // Where the bytes of a file stand that has not got its name yet (run_files.h); an empty path: in
  // the file itself. May be empty.
  std::function<std::filesystem::path(const std::filesystem::path&)> staged_at;
};

// Blocking; safe on any thread. The error names the file, the part of it (a node, mesh or animation
// by index and name) and a remedy.
Result<std::shared_ptr<const Model>> read_gltf(const std::filesystem::path& file,
                                               const ReadOptions& options = {});

}  // namespace elbowroom
