/// Starts to write files to disk before the program must wait for them.
#pragma once

namespace rainref::capture {

/// Starts writing the file's bytes and returns at once, so that a later wait for many files is one wait, not one for each. This is a hint:
/// if the system has no such call, or the call fails, only the later wait takes longer.
void begin_write_back(int descriptor);

}  // namespace rainref::capture
