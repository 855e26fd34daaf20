// Pipes to child processes on POSIX systems. CMake compiles one of pipes_<system>.cpp.
#pragma once

namespace rainref {

/// Makes a pipe whose ends no child inherits. Returns 0 or -1, with errno.
int make_pipe(int (&ends)[2]);

}  // namespace rainref
