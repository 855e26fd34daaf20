// The frame around every function of rainref.h: it sets the floating-point state, and turns exceptions into a code and a text.
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
#include "rainref/simulation.h"

namespace rainref::c_library {

/// Keeps the text for this thread's rr_error() and returns the code. Allocates no memory, because the error may be that none is left.
int keep_error(int code, std::string_view text) noexcept;

/// Runs the body of a public function in the fixed floating-point state and catches every exception.
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

/// Throws Error(usage) if an argument is NULL.
template <class T>
T& required(T* argument, const char* name) {
  if (!argument) throw Error(ExitCode::usage, fmt::format("{}: expected an address, found NULL", name));
  return *argument;
}

/// Checks a struct that the caller provides. Throws Error(usage) if it is NULL or its size differs from this library's.
template <class T>
T& sized(T* from, const char* type) {
  T& s = required(from, type);
  if (s.struct_bytes != sizeof(T))
    throw Error(ExitCode::usage,
                fmt::format("{0}.struct_bytes: expected sizeof({0}), which is {1}, found {2}", type, sizeof(T), s.struct_bytes));
  return s;
}

/// Converts the caller's list of texts. None may be NULL.
std::vector<std::string> texts(const char* const* first, std::size_t count, const char* name);

/// Puts the lines into `text`, each ended by a newline, and returns it for C.
const char* joined(const std::vector<std::string>& lines, std::string& text);

/// A caller's progress callback; null if it is NULL. If it returns another value than 0, Error(usage) "stopped by NAME after 2 of 9 runs"
/// ends the work. A C++ callback may throw; its exception becomes an Error.
Progress progress_of(rr_progress callback, void* user, const char* name, const char* unit);

}  // namespace rainref::c_library
