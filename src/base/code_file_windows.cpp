#include <windows.h>

#include <string>

#include "base/code_file.h"

namespace rainref {

std::filesystem::path code_file() {
  HMODULE module = nullptr;
  constexpr DWORD by_address = GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS | GET_MODULE_HANDLE_EX_FLAG_UNCHANGED_REFCOUNT;
  if (!::GetModuleHandleExW(by_address, reinterpret_cast<const wchar_t*>(&code_file), &module)) return {};
  std::wstring name(32768, L'\0');  // the longest path of the system
  name.resize(::GetModuleFileNameW(module, name.data(), static_cast<DWORD>(name.size())));
  return name;
}

}  // namespace rainref
