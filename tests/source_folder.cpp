#include "source_folder.h"

namespace rainref::test {

std::string source_folder() { return RAINREF_SOURCE_DIR; }

}  // namespace rainref::test
