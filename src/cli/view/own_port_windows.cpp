#include "cli/view/own_port.h"

#include <winsock2.h>

namespace rainref::cli {

// Windows gives a port to several programs unless this is set; its SO_REUSEADDR would share it.
void own_port(std::uintptr_t socket) {
  const BOOL yes = TRUE;
  ::setsockopt(static_cast<SOCKET>(socket), SOL_SOCKET, SO_EXCLUSIVEADDRUSE, reinterpret_cast<const char*>(&yes), sizeof yes);
}

}  // namespace rainref::cli
