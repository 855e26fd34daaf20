// Signals that interrupt the program.
#pragma once

namespace rainref {

/// Makes SIGINT, SIGTERM and SIGHUP run undo_all (base/interruption.h) before they end the process; ignored signals stay ignored (nohup).
/// Call it first: threads that already run would die of a signal as before.
void undo_when_interrupted();

/// Call after fork() and before exec(): the child handles these signals as if undo_when_interrupted() had not been called.
/// Async-signal-safe.
void take_signals_again() noexcept;

}  // namespace rainref
