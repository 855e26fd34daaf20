#include "base/child_process_windows.h"
#include "cli/view/browser.h"

#include <shellapi.h>

namespace rainref::cli {

bool open_browser(const std::string& address) {
  // More than 32 is success.
  return reinterpret_cast<INT_PTR>(::ShellExecuteW(nullptr, L"open", wide(address).c_str(), nullptr, nullptr, SW_SHOWNORMAL)) > 32;
}

}  // namespace rainref::cli
