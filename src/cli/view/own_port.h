// A server's port belongs to it alone.
#pragma once

#include <cstdint>

namespace rainref::cli {

/// Sets up a socket that is not bound yet, so that no other program of this user can share its port while it listens.
void own_port(std::uintptr_t socket);

}  // namespace rainref::cli
