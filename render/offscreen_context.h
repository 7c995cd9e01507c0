// SPDX-License-Identifier: MIT
// A GL 4.5 core context without window, display or GPU: EGL on Mesa's surfaceless platform, drawn
// by llvmpipe where there is no hardware.
//
// The context is current on the thread that made it, for as long as the object lives; what was
// current before is made current again at the end. Make, use and destroy it on one thread.
#pragma once

#include <memory>
#include <string>

#include "core/base/result.h"

namespace elbowroom {

class OffscreenContext {
 public:
  // Error: no EGL library, no surfaceless platform or no GL 4.5; the remedy names the package.
  static Result<OffscreenContext> create();

  OffscreenContext(OffscreenContext&&) noexcept;
  OffscreenContext& operator=(OffscreenContext&&) noexcept;
  ~OffscreenContext();

  // What draws, for a report: "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5 ...".
  std::string description() const;

 private:
  struct Data;
  explicit OffscreenContext(std::unique_ptr<Data> data);
  std::unique_ptr<Data> data_;
};

}  // namespace elbowroom
