// Signals that interrupt the program.
#pragma once

namespace rainref {

/// From now on SIGINT, SIGTERM and SIGHUP undo all (base/interruption.h) before the process dies of them; those that are ignored
/// stay ignored (nohup). Call first: threads that are already running would die of a signal as before.
void undo_when_interrupted();

/// After fork(), before exec(): the child takes these signals as if undo_when_interrupted() had never been called.
/// Async-signal-safe.
void take_signals_again() noexcept;

}  // namespace rainref
