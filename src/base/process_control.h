// prctl, or a stub if the system lacks it. WebAssembly has no processes either; a program fails there before it starts one.
#pragma once

#if __has_include(<sys/prctl.h>)
#include <sys/prctl.h>
#else
enum { PR_SET_PDEATHSIG, PR_SET_CHILD_SUBREAPER, PR_GET_CHILD_SUBREAPER };
inline int prctl(int, ...) { return -1; }
#endif
