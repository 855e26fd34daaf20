// sync_file_range exists only on Linux.
#include <fcntl.h>

#include "capture/write_back.h"

namespace rainref::capture {

void begin_write_back(int descriptor) { ::sync_file_range(descriptor, 0, 0, SYNC_FILE_RANGE_WRITE); }

}  // namespace rainref::capture
