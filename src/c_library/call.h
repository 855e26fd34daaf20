// What every function of rainref.h does around its work: pins the floating-point state, and turns what is thrown into a code and a text.
#pragma once

#include <cstddef>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/floating_point.h"
#include "rainref.h"
#include "rainref/error.h"

namespace rainref::c_library {

/// Keeps the text for this thread's rr_error() and returns the code. Takes no memory: the error may be that there is none.
int keep_error(int code, std::string_view text) noexcept;

/// Runs the body of a public function in the pinned state; what it throws ends here.
template <class Body>
int call(const Body& body) noexcept {
  const FloatingPointGuard guard;
  try {
    body();
    return RR_OK;
  } catch (const Error& e) {
    return keep_error(static_cast<int>(e.code()), e.what());
  } catch (const std::bad_alloc&) {
    return keep_error(RR_USAGE, "not enough memory");
  } catch (const std::exception& e) {
    return keep_error(RR_INTERNAL, e.what());
  } catch (...) {
    return keep_error(RR_INTERNAL, "an exception of an unknown kind");
  }
}

/// Error(usage) where an argument is NULL.
template <class T>
T& required(T* argument, const char* name) {
  if (!argument) throw Error(ExitCode::usage, fmt::format("{}: expected an address, found NULL", name));
  return *argument;
}

/// A struct that the caller provides; Error(usage) where it is NULL or its size is another than this library's.
template <class T>
T& sized(T* from, const char* type) {
  T& s = required(from, type);
  if (s.struct_bytes != sizeof(T))
    throw Error(ExitCode::usage,
                fmt::format("{0}.struct_bytes: expected sizeof({0}), which is {1}, found {2}", type, sizeof(T), s.struct_bytes));
  return s;
}

/// A list of texts of the caller's, none of them NULL.
std::vector<std::string> texts(const char* const* first, std::size_t count, const char* name);

}  // namespace rainref::c_library
