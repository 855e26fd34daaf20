// What an interruption leaves behind: nothing.
#pragma once

#include <functional>
#include <mutex>

namespace rainref {

/// What to do, while this object lives, should the process be interrupted. Its end does nothing: who would otherwise
/// clean up does so itself. An action runs inside an Uninterrupted scope, in another thread.
class Undo {
 public:
  explicit Undo(std::function<void()> action);
  ~Undo();
  Undo(const Undo&) = delete;
  Undo& operator=(const Undo&) = delete;

 private:
  std::function<void()> action_;
};

/// A scope that an interruption does not cut in two: making a file and registering its removal, say. Nests. It must not
/// wait for anybody for long.
class Uninterrupted {
 public:
  Uninterrupted();

 private:
  std::unique_lock<std::recursive_mutex> lock_;
};

/// Runs all actions, the newest first. Every Uninterrupted scope but the caller's waits for ever after: nothing new may be made
/// when what was made is gone.
void undo_all() noexcept;

}  // namespace rainref
