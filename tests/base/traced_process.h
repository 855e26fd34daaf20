// A copy of the test's process whose system calls the test sees, one by one, and which it may kill before any of them.
#pragma once

#include <signal.h>
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

namespace rainref {

struct SystemCall {
  std::uint64_t number = 0;
  std::filesystem::path file;  ///< what the first argument, a descriptor, is open at; "" when it is none
};

/// Runs f in a copy, from where it calls begin(). Before each system call `allows` says whether the copy may live on. Gives
/// 1 when f came to its end, 0 when it was killed, -1 where processes cannot be traced, -2 when f failed.
inline int traced(const std::function<void(const std::function<void()>& begin)>& f, const std::function<bool(const SystemCall&)>& allows) {
  const pid_t child = ::fork();
  if (child == 0) {
    try {
      f([] {
        if (::ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) ::_exit(77);
        ::raise(SIGSTOP);
      });
    } catch (...) {
      ::_exit(99);
    }
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  if (WIFEXITED(status)) return WEXITSTATUS(status) == 77 ? -1 : -2;
  ::ptrace(PTRACE_SETOPTIONS, child, nullptr, PTRACE_O_TRACESYSGOOD | PTRACE_O_EXITKILL);
  bool lives = true;
  for (;;) {
    ::ptrace(PTRACE_SYSCALL, child, nullptr, nullptr);
    ::waitpid(child, &status, 0);
    if (WIFEXITED(status)) return WEXITSTATUS(status) == 0 ? 1 : -2;
    if (WIFSIGNALED(status)) return lives ? -2 : 0;
    __ptrace_syscall_info info{};
    if (::ptrace(PTRACE_GET_SYSCALL_INFO, child, sizeof info, &info) <= 0) lives = false;
    if (lives && info.op == PTRACE_SYSCALL_INFO_ENTRY) {
      SystemCall call{info.entry.nr, {}};
      std::error_code error;
      call.file = std::filesystem::read_symlink(
          "/proc/" + std::to_string(child) + "/fd/" + std::to_string(static_cast<int>(info.entry.args[0])), error);
      lives = allows(call);
    }
    if (!lives) ::kill(child, SIGKILL);
  }
}

/// From now on this process cannot exchange two names, as on NFS. False where the kernel does not let a test do that.
inline bool forbid_exchange() {
  sock_filter code[] = {BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
                        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_renameat2, 0, 3),
                        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, args[4])),
                        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, 0, 1, 0),
                        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EINVAL),
                        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)};
  const sock_fprog program{sizeof code / sizeof *code, code};
  return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

}  // namespace rainref
