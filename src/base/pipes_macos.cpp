// Written from Apple's documents and never compiled.
#include <fcntl.h>
#include <unistd.h>

#include "base/pipes.h"

namespace rainref {

int make_pipe(int (&ends)[2]) {
  if (::pipe(ends) != 0) return -1;
  for (const int end : ends) ::fcntl(end, F_SETFD, FD_CLOEXEC);
  return 0;
}

}  // namespace rainref
