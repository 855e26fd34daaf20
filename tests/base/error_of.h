// What a call throws, as text.
#pragma once

#include <functional>
#include <string>

#include "rainref/error.h"

namespace rainref {

/// The error that `body` throws, its exit code first: "2 x.toml:1:1: …"; "none" when it throws nothing.
inline std::string error_of(const std::function<void()>& body) {
  try {
    body();
  } catch (const Error& e) {
    return std::to_string(static_cast<int>(e.code())) + " " + e.what();
  }
  return "none";
}

}  // namespace rainref
