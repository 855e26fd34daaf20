// What an interruption leaves behind: nothing.
#pragma once

#include <functional>
#include <mutex>

namespace rainref {

/// What to do, while this object lives, should the process be interrupted. Its end does nothing: who would otherwise
/// clean up does so itself. An action runs inside an Uninterrupted scope, in a thread of its own.
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

/// From now on SIGINT, SIGTERM and SIGHUP run all actions, the newest first, before the process dies of them; those that
/// are ignored stay ignored (nohup). Call first: threads that are already running would die of a signal as before.
void undo_when_interrupted();

/// After fork(), before exec(): the child takes these signals as if undo_when_interrupted() had never been called.
/// Async-signal-safe.
void take_signals_again() noexcept;

}  // namespace rainref
