#include "base/signals.h"

#include <signal.h>
#include <unistd.h>

#include <system_error>
#include <thread>

#include "base/interruption.h"

namespace rainref {
namespace {

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

}  // namespace

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
  has_mask = ::pthread_sigmask(SIG_BLOCK, &waited_for, &mask_before) == 0;
  try {
    std::thread([waited_for] {
      int signal = 0;
      while (::sigwait(&waited_for, &signal) != 0) {
      }
      // The signals stay blocked meanwhile, because `timeout` and others send theirs twice.
      undo_all();
      die_of(signal);
    }).detach();
  } catch (const std::system_error&) {
    take_signals_again();  // without the thread the signals keep their default effect
    has_mask = false;
  }
}

void take_signals_again() noexcept {
  if (has_mask) ::pthread_sigmask(SIG_SETMASK, &mask_before, nullptr);
}

bool is_interruption(int signal) { return signal == SIGINT || signal == SIGTERM || signal == SIGHUP; }

bool ignore_closed_pipes() { return ::signal(SIGPIPE, SIG_IGN) == SIG_DFL; }
void die_of_closed_pipe() {
  ::signal(SIGPIPE, SIG_DFL);
  ::raise(SIGPIPE);
}

}  // namespace rainref
