// SPDX-License-Identifier: MIT
// Export of corrected clips: the source file, and appended to it an animation for each corrected
// clip (DESIGN.md, "Byte-honest"; GLTF.md).
//
// The source's text and bytes are patched, never written anew:
// * Every JSON value stays, down to the digits of its numbers, but for `buffers[].byteLength` of
//   the buffer that grows; entries are appended to `accessors`, `bufferViews`, `buffers` and
//   `animations`.
// * The BIN chunk of the source is a byte prefix of the new one; further chunks are kept.
// * Untouched channels copy their sampler and share its accessors, bit for bit. Channels without a
//   node, extras and extensions of the animation are copied as they stand.
// * Where the new bytes go: into the BIN chunk of a GLB; else into a new buffer, in a file beside
//   the output, or as a data URI where the source's buffers are that (or a meshopt fallback, which
//   has no bytes to add to). Buffers that are not the BIN chunk stay as they are.
//
// The output's container follows its extension: .gltf is text, .glb, .vrm and .vrma are binary, any
// other the source's own. What a change of container needs, and only then, is changed too:
// * .gltf to GLB: buffers and images move into the BIN chunk, so that the file stands alone:
//   `buffers`, `bufferViews[].buffer/byteOffset` and `images[].uri` change. With meshopt buffers
//   only the first buffer moves; the rest stays external.
// * GLB to .gltf: the BIN chunk becomes a file beside the output and the first buffer gets its
//   `uri`; chunks that are neither JSON nor BIN are dropped, with a warning.
//
// If the output lies in another folder, the files that relative URIs name are copied along, under
// the same relative names, so that the JSON stays; where a different file of that name is in the
// way the copy gets a free name and its `uri` is changed. Nothing outside the source's folder is
// read.
//
// Files appear whole or not at all (safe_file.h). Deterministic: same input, same bytes. May be
// called on any thread; not for one output from two threads.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/animation/clip.h"
#include "core/base/result.h"

namespace elbowroom {

class RunFiles;

// What is appended for one clip.
struct CorrectedClip {
  int source_animation = -1;     // index in the source file
  std::string name;              // of the new one; empty: "NAME (corrected)". Made unique
  std::vector<Channel> changed;  // replace the source's channels of the same joint and path, or are
                                 // added. Empty: nothing is appended for this clip
};

// The changed channels of a clip that apply_splices has made: those without a source_channel.
CorrectedClip corrected_clip(const Clip& clip);

struct ExportedAnimation {
  std::string name;
  int index = -1;  // in the output file's animations
};

struct ExportReport {
  std::vector<ExportedAnimation> animations;      // one for each clip that changed something
  std::vector<std::filesystem::path> side_files;  // written besides the output
  std::vector<std::string> warnings;              // files that URIs name and that are not there
};

// Writes `out_file`: the source and its corrected clips. With nothing to correct it is a copy of
// the source. Errors: a source that cannot be read or is no valid glTF, an animation, joint or
// channel that does not fit it, a joint with a `matrix` (it can't be animated), bytes a URI names
// that are not there, a disk that is full. On an error nothing is written.
Status export_corrected(const std::filesystem::path& source_file,
                        const std::filesystem::path& out_file,
                        const std::vector<CorrectedClip>& clips, ExportReport* report = nullptr);
// The same, staged only: nothing has its name until `run` is committed. Buffers and images that go
// along take no name that the run reads or writes otherwise.
Status stage_corrected(const std::filesystem::path& source_file,
                       const std::filesystem::path& out_file,
                       const std::vector<CorrectedClip>& clips, RunFiles& run,
                       ExportReport* report = nullptr);
Status export_corrected(const std::filesystem::path& source_file,
                        const std::filesystem::path& out_file, const CorrectedClip& clip,
                        ExportReport* report = nullptr);

}  // namespace elbowroom
