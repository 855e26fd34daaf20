#include "base/interruption.h"

#include <signal.h>
#include <unistd.h>

#include <list>
#include <system_error>
#include <thread>

namespace rainref {
namespace {

struct Registry {
  std::recursive_mutex mutex;
  std::list<const std::function<void()>*> actions;  // newest first
};
// Never destroyed: the thread that waits for signals outlives static objects.
Registry& registry() {
  static Registry& only = *new Registry;
  return only;
}

sigset_t mask_before;
bool has_mask = false;

[[noreturn]] void die_of(int signal) {
  ::signal(signal, SIG_DFL);
  sigset_t one;
  ::sigemptyset(&one);
  ::sigaddset(&one, signal);
  ::pthread_sigmask(SIG_UNBLOCK, &one, nullptr);
  ::raise(signal);
  ::_exit(128 + signal);  // the first process of a container survives its own signals
}

// The lock is never given back: nothing new may be made after what was made is gone. The signals stay blocked meanwhile,
// because `timeout` and others send theirs twice.
[[noreturn]] void undo_all_and_die(int signal) {
  registry().mutex.lock();
  for (const std::function<void()>* action : registry().actions) {
    try {
      (*action)();
    } catch (...) {
      // The others are still to be done.
    }
  }
  die_of(signal);
}

}  // namespace

Undo::Undo(std::function<void()> action) : action_(std::move(action)) {
  const Uninterrupted scope;
  registry().actions.push_front(&action_);
}
Undo::~Undo() {
  const Uninterrupted scope;
  registry().actions.remove(&action_);
}

Uninterrupted::Uninterrupted() : lock_(registry().mutex) {}

void undo_when_interrupted() {
  sigset_t waited_for;
  ::sigemptyset(&waited_for);
  bool any = false;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    if (::sigaction(signal, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) continue;
    ::sigaddset(&waited_for, signal);
    any = true;
  }
  if (!any || has_mask) return;
  registry();
  has_mask = ::pthread_sigmask(SIG_BLOCK, &waited_for, &mask_before) == 0;
  try {
    std::thread([waited_for] {
      int signal = 0;
      while (::sigwait(&waited_for, &signal) != 0) {
      }
      undo_all_and_die(signal);
    }).detach();
  } catch (const std::system_error&) {
    take_signals_again();  // without a thread they do as they always did
    has_mask = false;
  }
}

void take_signals_again() noexcept {
  if (has_mask) ::pthread_sigmask(SIG_SETMASK, &mask_before, nullptr);
}

}  // namespace rainref
