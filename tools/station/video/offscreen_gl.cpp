#include "tools/station/video/offscreen_gl.h"

#include <dlfcn.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace sprung::station {

namespace {

class Library {
 public:
  /// @throws std::runtime_error
  explicit Library(const char* name) : handle_(dlopen(name, RTLD_NOW | RTLD_GLOBAL)) {
    if (handle_ == nullptr) throw std::runtime_error(std::string(name) + " is not installed");
  }
  template <class Function>
  Function function(const char* name) const {
    void* const found = dlsym(handle_, name);
    if (found == nullptr) throw std::runtime_error(std::string("the library has no ") + name);
    return reinterpret_cast<Function>(found);
  }

 private:
  void* handle_;  ///< stays loaded: drivers do not bear to be unloaded
};

void require(bool works, const char* what) {
  if (!works) throw std::runtime_error(std::string(what) + " failed");
}

/// Names and numbers: Khronos' EGL 1.5, and its extension EGL_MESA_platform_surfaceless, which asks no
/// display.
class EglContext : public OffscreenGl {
 public:
  EglContext(int width, int height) : library_("libEGL.so.1") {
    const auto platform_display = library_.function<void* (*)(unsigned, void*, const long*)>(
        "eglGetPlatformDisplay");
    constexpr unsigned kSurfaceless = 0x31DD;
    display_ = platform_display(kSurfaceless, nullptr, nullptr);
    require(display_ != nullptr, "eglGetPlatformDisplay");
    require(library_.function<Bool (*)(void*, int*, int*)>("eglInitialize")(display_, nullptr, nullptr) != 0,
            "eglInitialize");
    constexpr Bool kOpenGl = 0x30A2;
    require(library_.function<Bool (*)(Bool)>("eglBindAPI")(kOpenGl) != 0, "eglBindAPI");
    void* const config = choose();
    const std::vector<int> size{kWidth, width, kHeight, height, kNone};
    surface_ = library_.function<void* (*)(void*, void*, const int*)>("eglCreatePbufferSurface")(
        display_, config, size.data());
    context_ = library_.function<void* (*)(void*, void*, void*, const int*)>("eglCreateContext")(
        display_, config, nullptr, nullptr);
    require(context_ != nullptr, "eglCreateContext");
    make_current(surface_, context_);
  }
  ~EglContext() override {
    try {
      make_current(nullptr, nullptr);
      library_.function<Bool (*)(void*, void*)>("eglDestroyContext")(display_, context_);
      library_.function<Bool (*)(void*)>("eglTerminate")(display_);
    } catch (const std::runtime_error&) {  // the process ends with it
    }
  }
  const char* by() const noexcept override { return "EGL"; }

 private:
  using Bool = unsigned;
  static constexpr int kNone = 0x3038, kWidth = 0x3057, kHeight = 0x3056;

  void* choose() const {
    const std::vector<int> wanted{0x3033, 0x0001,                        // surface type: pbuffer
                                  0x3040, 0x0008,                        // renders OpenGL
                                  0x3024, 8,      0x3023, 8, 0x3022, 8,  // red, green, blue
                                  0x3025, 24,     kNone};                // depth
    void* config = nullptr;
    int count = 0;
    library_.function<Bool (*)(void*, const int*, void**, int, int*)>("eglChooseConfig")(
        display_, wanted.data(), &config, 1, &count);
    require(count > 0, "eglChooseConfig");
    return config;
  }
  void make_current(void* surface, void* context) const {
    const auto current = library_.function<Bool (*)(void*, void*, void*, void*)>("eglMakeCurrent");
    require(current(display_, surface, surface, context) != 0, "eglMakeCurrent");
  }

  Library library_;
  void* display_ = nullptr;
  void* surface_ = nullptr;
  void* context_ = nullptr;
};

/// Mesa's GL/osmesa.h.
class OsMesaContext : public OffscreenGl {
 public:
  OsMesaContext(int width, int height)
      : library_("libOSMesa.so.8"), pixels_(static_cast<std::size_t>(width) * height * 4) {
    constexpr unsigned kRgba = 0x1908, kUnsignedByte = 0x1401;
    constexpr int kDepthBits = 24;
    context_ = library_.function<void* (*)(unsigned, int, int, int, void*)>("OSMesaCreateContextExt")(
        kRgba, kDepthBits, 0, 0, nullptr);
    require(context_ != nullptr, "OSMesaCreateContextExt");
    const auto current = library_.function<unsigned char (*)(void*, void*, unsigned, int, int)>(
        "OSMesaMakeCurrent");
    require(current(context_, pixels_.data(), kUnsignedByte, width, height) != 0, "OSMesaMakeCurrent");
  }
  ~OsMesaContext() override {
    try {
      library_.function<void (*)(void*)>("OSMesaDestroyContext")(context_);
    } catch (const std::runtime_error&) {  // the process ends with it
    }
  }
  const char* by() const noexcept override { return "OSMesa"; }

 private:
  Library library_;
  std::vector<unsigned char> pixels_;
  void* context_ = nullptr;
};

}  // namespace

std::unique_ptr<OffscreenGl> make_offscreen_gl(int width, int height) {
  std::string why;
  try {
    return std::make_unique<EglContext>(width, height);
  } catch (const std::runtime_error& error) {
    why = std::string("EGL: ") + error.what();
  }
  try {
    return std::make_unique<OsMesaContext>(width, height);
  } catch (const std::runtime_error& error) {
    why += std::string("; OSMesa: ") + error.what();
  }
  throw std::runtime_error("a video needs OpenGL without a screen (" + why +
                           "): apt-get install libegl1 libgl1 libgl1-mesa-dri, or libosmesa6");
}

}  // namespace sprung::station
