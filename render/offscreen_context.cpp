// SPDX-License-Identifier: MIT
#include "render/offscreen_context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

namespace elbowroom {

struct OffscreenContext::Data {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
  EGLDisplay previous_display = EGL_NO_DISPLAY;
  EGLContext previous_context = EGL_NO_CONTEXT;
  EGLSurface previous_draw = EGL_NO_SURFACE, previous_read = EGL_NO_SURFACE;

  ~Data() {
    if (context == EGL_NO_CONTEXT) return;
    if (previous_context != EGL_NO_CONTEXT) {
      eglMakeCurrent(previous_display, previous_draw, previous_read, previous_context);
    } else {
      eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    eglDestroyContext(display, context);
    // The display is shared by all contexts of the process on this platform, so it stays.
  }
};

namespace {

const char* kWhere = "offscreen rendering";
const char* kPackages = "install the Debian packages libegl1, libegl-mesa0 and libgl1-mesa-dri";

}  // namespace

Result<OffscreenContext> OffscreenContext::create() {
  if (!epoxy_has_egl()) return Error{"the EGL library is missing", kWhere, kPackages};
  if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless") ||
      !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base")) {
    return Error{"this EGL has no surfaceless platform", kWhere, kPackages};
  }
  auto data = std::make_unique<Data>();
  data->previous_display = eglGetCurrentDisplay();
  data->previous_context = eglGetCurrentContext();
  data->previous_draw = eglGetCurrentSurface(EGL_DRAW);
  data->previous_read = eglGetCurrentSurface(EGL_READ);

  data->display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA,
                                           reinterpret_cast<void*>(EGL_DEFAULT_DISPLAY), nullptr);
  if (data->display == EGL_NO_DISPLAY ||
      eglInitialize(data->display, nullptr, nullptr) == EGL_FALSE) {
    return Error{"EGL cannot open its surfaceless display", kWhere, kPackages};
  }
  if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) {
    return Error{"this EGL has no desktop OpenGL", kWhere, kPackages};
  }
  const EGLint config_attributes[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE,
                                      EGL_PBUFFER_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (eglChooseConfig(data->display, config_attributes, &config, 1, &count) == EGL_FALSE ||
      count == 0) {
    return Error{"EGL offers no configuration for OpenGL", kWhere, kPackages};
  }
  const EGLint context_attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                       4,
                                       EGL_CONTEXT_MINOR_VERSION,
                                       5,
                                       EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                       EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                       EGL_NONE};
  data->context = eglCreateContext(data->display, config, EGL_NO_CONTEXT, context_attributes);
  if (data->context == EGL_NO_CONTEXT) {
    return Error{"no OpenGL 4.5 core context can be made", kWhere,
                 std::string(kPackages) + "; Mesa 20 or newer draws OpenGL 4.5 without a GPU"};
  }
  if (eglMakeCurrent(data->display, EGL_NO_SURFACE, EGL_NO_SURFACE, data->context) == EGL_FALSE) {
    return Error{"the OpenGL context cannot be used without a surface", kWhere, kPackages};
  }
  return OffscreenContext(std::move(data));
}

OffscreenContext::OffscreenContext(std::unique_ptr<Data> data) : data_(std::move(data)) {}
OffscreenContext::OffscreenContext(OffscreenContext&&) noexcept = default;
OffscreenContext& OffscreenContext::operator=(OffscreenContext&&) noexcept = default;
OffscreenContext::~OffscreenContext() = default;

std::string OffscreenContext::description() const {
  const auto text = [](GLenum name) {
    const auto* value = reinterpret_cast<const char*>(glGetString(name));
    return std::string(value != nullptr ? value : "?");
  };
  return text(GL_RENDERER) + ", OpenGL " + text(GL_VERSION);
}

}  // namespace elbowroom
