#include <dlfcn.h>
#include <link.h>

#include <system_error>

#include "base/code_file.h"

namespace rainref {

namespace fs = std::filesystem;

fs::path code_file() {
  std::error_code error;
  Dl_info symbol;
  void* map = nullptr;
  if (::dladdr1(reinterpret_cast<const void*>(&code_file), &symbol, &map, RTLD_DL_LINKMAP) != 0 && map) {
    const char* const library = static_cast<const link_map*>(map)->l_name;  // "" for the program itself
    if (library && *library) return fs::canonical(library, error);
  }
  return fs::read_symlink("/proc/self/exe", error);
}

}  // namespace rainref
