// A copy of the test's process that runs a function, for what kills processes.
#pragma once

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <utility>

#include <gtest/gtest.h>

namespace rainref {

class ChildProcess {
 public:
  /// The copy runs f and ends with what it returns; 99 where it throws.
  template <class F>
  explicit ChildProcess(F&& f) : id_(::fork()) {
    if (id_ != 0) return;
    try {
      ::_exit(f());
    } catch (...) {
      ::_exit(99);
    }
  }
  ~ChildProcess() {
    if (id_ > 0) end(SIGKILL);
  }
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  pid_t id() const { return id_; }
  /// Waits for its end: the exit code, or minus the signal.
  int wait() {
    int status = 0;
    ::waitpid(std::exchange(id_, -1), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
  int end(int signal) {
    ::kill(id_, signal);
    return wait();
  }

 private:
  pid_t id_;
};

/// Lets a child say that it has come to a place, and the test wait for it.
class Signpost {
 public:
  Signpost() { EXPECT_EQ(::pipe(ends_), 0); }
  ~Signpost() {
    ::close(ends_[0]);
    ::close(ends_[1]);
  }
  Signpost(const Signpost&) = delete;
  Signpost& operator=(const Signpost&) = delete;
  void reach() const { EXPECT_EQ(::write(ends_[1], "x", 1), 1); }
  void await() const {
    char c = 0;
    EXPECT_EQ(::read(ends_[0], &c, 1), 1);
  }

 private:
  int ends_[2];
};

/// Until a signal ends the process.
inline int sleep_for_ever() {
  for (;;) ::pause();
}

}  // namespace rainref
