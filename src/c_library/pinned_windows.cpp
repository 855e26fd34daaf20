// The library stays in memory when it is closed: threads that it started may still run.
#include <windows.h>

namespace {

const struct Pinned {
  Pinned() {
    HMODULE module = nullptr;
    ::GetModuleHandleExW(GET_MODULE_HANDLE_EX_FLAG_PIN | GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS, reinterpret_cast<const wchar_t*>(this),
                         &module);
  }
} pinned;

}  // namespace
