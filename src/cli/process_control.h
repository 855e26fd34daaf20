// prctl, where there are processes: WebAssembly has neither, and a program there fails before it starts another.
#pragma once

#if __has_include(<sys/prctl.h>)
#include <sys/prctl.h>
#else
enum { PR_SET_PDEATHSIG, PR_SET_CHILD_SUBREAPER, PR_GET_CHILD_SUBREAPER };
inline int prctl(int, ...) { return -1; }
#endif
