#include <fcntl.h>
#include <unistd.h>

#include "base/pipes.h"

namespace rainref {

int make_pipe(int (&ends)[2]) { return ::pipe2(ends, O_CLOEXEC); }

}  // namespace rainref
