#include "capture/write_back.h"

namespace rainref::capture {

void begin_write_back(int) {}

}  // namespace rainref::capture
