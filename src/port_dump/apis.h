// The graphics and compute APIs that a port may use.
#pragma once

#include <span>
#include <string_view>

namespace rainref::port_dump {

struct Api {
  std::string_view name;     ///< as port.json names it, without a version
  std::string_view profile;  ///< of its ports; "" for the CPU, which has none of its own
};

/// All, in the order in which errors list them.
std::span<const Api> apis();

/// The API whose name the text begins with, in capitals or not, or one of its other names ("D3D12", "GLES 3.2", "webgl2"); null if there is
/// none. A version and anything else may follow.
const Api* api_of(std::string_view text);

}  // namespace rainref::port_dump
