/// Files on their way to the disk before anyone waits for them.
#pragma once

namespace rainref::capture {

/// Has the system begin to write the file's bytes and returns at once, so that waiting for many files later is one wait and not one for
/// each. A hint: where the system knows no such call, or refuses it, nothing happens, and the later wait takes longer.
void begin_write_back(int descriptor);

}  // namespace rainref::capture
