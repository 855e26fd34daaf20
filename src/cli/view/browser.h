// Opening an address in the user's browser.
#pragma once

#include <string>

namespace rainref::cli {

/// Asks the desktop to open an address, with xdg-open or macOS's open. Returns false if there is no such program. Does not wait: the
/// browser outlives this process and does not get its Ctrl-C.
bool open_browser(const std::string& address);

}  // namespace rainref::cli
