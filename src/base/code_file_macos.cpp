// Written from Apple's documents and never compiled.
#include <dlfcn.h>

#include <system_error>

#include "base/code_file.h"

namespace rainref {

std::filesystem::path code_file() {
  Dl_info symbol;
  if (::dladdr(reinterpret_cast<const void*>(&code_file), &symbol) == 0 || !symbol.dli_fname) return {};
  std::error_code error;
  return std::filesystem::canonical(symbol.dli_fname, error);
}

}  // namespace rainref
