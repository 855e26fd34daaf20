// Saving a simulation through a callback, loading it, and changing a key while it runs.
#include "c_library/call.h"
#include "c_library/handles.h"

using namespace rainref;
using c_library::call;
using c_library::required;

namespace {

/// Result of the caller's callback. A C++ callback may throw; the exception is discarded.
template <class Callback>
auto returned(const Callback& callback, const char* what) {
  try {
    return callback();
  } catch (...) {
    throw Error(ExitCode::io, fmt::format("state: the callback that {} it threw an exception", what));
  }
}

/// All data of the callback, which may come in pieces.
std::vector<std::byte> read_all(rr_read read, void* user) {
  std::vector<std::byte> bytes, piece(std::size_t{1} << 20);
  for (;;) {
    const std::int64_t got = returned([&] { return read(user, piece.data(), piece.size()); }, "reads");
    if (got < 0) throw Error(ExitCode::io, fmt::format("state: the callback that reads it failed after {} bytes: {}", bytes.size(), got));
    if (got > static_cast<std::int64_t>(piece.size())) {
      throw Error(ExitCode::io, fmt::format("state: the callback that reads it was asked for at most {} bytes and says that it gave {}",
                                            piece.size(), got));
    }
    if (got == 0) return bytes;
    bytes.insert(bytes.end(), piece.begin(), piece.begin() + got);
  }
}

}  // namespace

// Callbacks run before anything changes, with the state in memory, because they may fail or call the library.
int rr_save(rr_simulation* simulation, rr_write write, void* user) {
  return call([&] {
    const rr_simulation& s = required(simulation, "simulation");
    required(write, "write");
    const std::vector<std::byte> bytes = s.running.save();
    const int result = returned([&] { return write(user, bytes.data(), bytes.size()); }, "writes");
    if (result != 0) throw Error(ExitCode::io, fmt::format("state: the callback that writes it failed: {}", result));
  });
}
int rr_load(rr_simulation* simulation, rr_read read, void* user) {
  return call([&] {
    rr_simulation& s = required(simulation, "simulation");
    required(read, "read");
    const std::vector<std::byte> bytes = read_all(read, user);
    s.running.load(bytes);
  });
}
int rr_set(rr_simulation* simulation, const char* key, const char* value) {
  return call([&] {
    rr_simulation& s = required(simulation, "simulation");
    s.running.set(&required(key, "key"), &required(value, "value"));
    s.buffers = s.running.buffers();  // a key may add buffers
  });
}
