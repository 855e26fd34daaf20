#include "image_io/codec.h"

#include <dlfcn.h>
#include <link.h>

#include <algorithm>
#include <filesystem>
#include <future>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/floating_point.h"
#include "image_io/codec_folder.h"
#include "rainref/error.h"

namespace rainref::image_io {

namespace {

constexpr const char* library = RAINREF_OPENIMAGEIO;

[[noreturn]] void refuse(const std::string& why) {
  throw Error(ExitCode::io, fmt::format("cannot load '{}', which reads pictures and writes EXR: {}", library, why));
}

/// Folders in which the loader searches libraries for the object that holds this code: LD_LIBRARY_PATH, its run path, the system's folders.
/// They are queried instead of left to dlopen, which under a sanitizer sees the sanitizer as its caller, and whose message names only one
/// folder.
std::vector<std::string> folders() {
  static const char here = 0;
  Dl_info info;
  void* object = nullptr;
  Dl_serinfo size;
  if (!::dladdr1(&here, &info, &object, RTLD_DL_LINKMAP) || ::dlinfo(object, RTLD_DI_SERINFOSIZE, &size) != 0) return {};
  std::vector<std::max_align_t> memory(size.dls_size / sizeof(std::max_align_t) + 1);
  auto* const list = reinterpret_cast<Dl_serinfo*>(memory.data());
  *list = size;
  if (::dlinfo(object, RTLD_DI_SERINFO, list) != 0) return {};
  std::vector<std::string> out;
  for (unsigned i = 0; i < list->dls_cnt; ++i) {
    const std::string_view folder = list->dls_serpath[i].dls_name;
    if (folder.starts_with('/')) out.emplace_back(folder);  // not the current folder: anyone may have put a library there
  }
  return out;
}

bool has_library(const std::string& folder) {
  std::error_code ignored;
  return std::filesystem::exists(std::filesystem::path(folder) / library, ignored);
}

const Codec* load() {
  // Libraries built with -ffast-math set flush to zero when they are loaded; this restores the caller's state.
  const FloatingPointGuard guard;
  const std::vector<std::string> places = folders();
  for (const std::string& folder : places) {
    if (!has_library(folder)) continue;
    const std::filesystem::path file = std::filesystem::path(folder) / library;
    void* const handle = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!handle) refuse(::dlerror());
    auto* const table = reinterpret_cast<const Codec* (*)()>(::dlsym(handle, "rainref_openimageio"));
    if (!table) refuse(::dlerror());
    return table();
  }
  refuse(fmt::format("found in none of {}", fmt::join(places, ", ")));
}

}  // namespace

const Codec& codec() {
  static const Codec* const table = load();  // once for all threads; again after a failure
  return *table;
}

std::function<void()> codec_ahead() {
  return [opened = std::async(std::launch::async, [] { codec(); }).share()] { opened.get(); };
}
std::string codec_folder() {
  const std::vector<std::string> places = folders();
  const auto found = std::find_if(places.begin(), places.end(), has_library);
  return found == places.end() ? "" : *found;
}
std::size_t codec_bytes() { return std::size_t{119} << 20; }

}  // namespace rainref::image_io
