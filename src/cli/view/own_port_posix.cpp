#include "cli/view/own_port.h"

#include <sys/socket.h>

namespace rainref::cli {

// Without SO_REUSEPORT none can share it. This lets a new server have the port at once after an old one.
void own_port(std::uintptr_t socket) {
  const int yes = 1;
  ::setsockopt(static_cast<int>(socket), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
}

}  // namespace rainref::cli
