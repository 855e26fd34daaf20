#include <windows.h>

#include "base/interruption.h"
#include "base/signals.h"

namespace rainref {
namespace {

constexpr unsigned control_c_exit = 0xC000013A;  // what a process ends with that Ctrl-C ended

// The system calls it on a thread of its own.
BOOL WINAPI interrupted(DWORD) {
  undo_all();
  ::ExitProcess(control_c_exit);
}

}  // namespace

void undo_when_interrupted() { ::SetConsoleCtrlHandler(&interrupted, TRUE); }
void take_signals_again() noexcept {}  // no process is copied here

// What run_own_program() makes of control_c_exit.
bool is_interruption(int signal) { return signal == static_cast<int>(control_c_exit & 0xffff); }

bool ignore_closed_pipes() { return false; }  // there is no such signal
void die_of_closed_pipe() {}

}  // namespace rainref
