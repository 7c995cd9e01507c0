// SPDX-License-Identifier: MIT
#include "tests/gui/driver/snapshot.h"

#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>

#include <vector>

#include "render/offscreen_context.h"

namespace elbowroom {

Result<Picture> snapshot(UiDriver& driver) {
  auto context = OffscreenContext::create();
  if (!context) return context.error();
  driver.frame();
  ImDrawData* data = driver.draw_data();
  const int width = static_cast<int>(data->DisplaySize.x);
  const int height = static_cast<int>(data->DisplaySize.y);
  if (!ImGui_ImplOpenGL3_Init("#version 450")) {
    return Error{"Dear ImGui cannot draw with this OpenGL", "offscreen rendering", {}};
  }
  ImGui_ImplOpenGL3_NewFrame();  // makes its buffers and the font's texture

  GLuint framebuffer = 0, colour = 0;
  glGenFramebuffers(1, &framebuffer);
  glGenRenderbuffers(1, &colour);
  glBindRenderbuffer(GL_RENDERBUFFER, colour);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour);
  const ImVec4 ground = ImGui::ColorConvertU32ToFloat4(driver.ui().palette().ground);
  glViewport(0, 0, width, height);
  glClearColor(ground.x, ground.y, ground.z, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  // The texture was made just now: the commands recorded before name none.
  driver.frame();
  ImGui_ImplOpenGL3_RenderDrawData(driver.draw_data());
  std::vector<unsigned char> pixels(static_cast<std::size_t>(width) *
                                    static_cast<std::size_t>(height) * 3);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
  Picture picture(width, height, Rgb{});
  const std::size_t row = static_cast<std::size_t>(width) * 3;
  for (int y = 0; y < height; ++y) {
    const auto from = pixels.begin() + static_cast<std::ptrdiff_t>(row) * (height - 1 - y);
    std::copy(from, from + static_cast<std::ptrdiff_t>(row),
              picture.rgb.begin() + static_cast<std::ptrdiff_t>(row) * y);
  }
  glDeleteFramebuffers(1, &framebuffer);
  glDeleteRenderbuffers(1, &colour);
  ImGui_ImplOpenGL3_Shutdown();
  return picture;
}

}  // namespace elbowroom
