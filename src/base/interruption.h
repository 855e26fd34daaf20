// Cleaning up after an interruption.
#pragma once

#include <functional>
#include <mutex>

namespace rainref {

/// An action to run if the process is interrupted while this object lives. The destructor does not run it, because the owner then cleans up
/// itself. Actions run inside an Uninterrupted scope, in another thread.
class Undo {
 public:
  explicit Undo(std::function<void()> action);
  ~Undo();
  Undo(const Undo&) = delete;
  Undo& operator=(const Undo&) = delete;

 private:
  std::function<void()> action_;
};

/// A scope that an interruption does not divide, for example making a file and registering its removal. Scopes may nest. Do not wait long
/// inside one.
class Uninterrupted {
 public:
  Uninterrupted();

 private:
  std::unique_lock<std::recursive_mutex> lock_;
};

/// Runs all actions, newest first. From then on every other Uninterrupted scope waits forever, so that nothing new is made after the
/// removal.
void undo_all() noexcept;

}  // namespace rainref
