// Signals that interrupt the program. CMake compiles one of signals_<system>.cpp.
#pragma once

namespace rainref {

/// Makes SIGINT, SIGTERM and SIGHUP run undo_all (base/interruption.h) before they end the process; ignored signals stay ignored (nohup).
/// Call it first: threads that already run would die of a signal as before. On Windows: Ctrl-C, Ctrl-Break, and the end of the console or
/// session.
void undo_when_interrupted();

/// Call after fork() and before exec(): the child handles these signals as if undo_when_interrupted() had not been called.
/// Async-signal-safe.
void take_signals_again() noexcept;

/// Whether a child process that died of this signal was interrupted.
bool is_interruption(int signal);

/// Makes writing to a pipe that nobody reads an error of that call. Returns true if it would have ended the process without a word.
bool ignore_closed_pipes();
/// Ends the process as such a pipe would have without ignore_closed_pipes().
void die_of_closed_pipe();

}  // namespace rainref
