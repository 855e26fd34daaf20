// OpenImageIO's handler of libpng's errors returns, and then libpng prints. So this module has its own png_set_error_fn, which gives libpng
// handlers that print nothing. The loader binds OpenImageIO to it, because it is in the opened object, which comes before the object's
// libraries. If the host program has loaded a libpng globally, that libpng's function is used, and prints.
#include "image_io/openimageio/quiet_png.h"

#include <dlfcn.h>
#include <png.h>

#include <utility>

namespace rainref::image_io {

namespace {

using SetErrorFunctions = void (*)(png_structrp, png_voidp, png_error_ptr, png_error_ptr);

thread_local std::string refusal;

[[noreturn]] void refuse(png_structp png, png_const_charp what) {
  refusal = what;
  png_longjmp(png, 1);  // as libpng itself does after printing
}
void warn(png_structp, png_const_charp) {}

/// libpng's own function, hidden by the one below; null only if libpng is not found, which cannot happen because it has called us.
SetErrorFunctions original() {
  Dl_info libpng;
  if (!::dladdr(reinterpret_cast<void*>(&png_longjmp), &libpng)) return nullptr;
  void* const handle = ::dlopen(libpng.dli_fname, RTLD_LAZY | RTLD_NOLOAD);
  return handle ? reinterpret_cast<SetErrorFunctions>(::dlsym(handle, "png_set_error_fn")) : nullptr;
}

}  // namespace

std::string take_png_refusal() { return std::exchange(refusal, {}); }

}  // namespace rainref::image_io

extern "C" __attribute__((visibility("default"))) void png_set_error_fn(png_structrp png, png_voidp data, png_error_ptr, png_error_ptr) {
  using namespace rainref::image_io;
  static const SetErrorFunctions set = original();
  if (set) set(png, data, refuse, warn);
}
