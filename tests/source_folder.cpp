// Where the sources and the built packs lie, for every test program.
#include "source_folder.h"

namespace rainref::test {

std::string source_folder() { return RAINREF_SOURCE_DIR; }
std::string packs_folder() { return RAINREF_PACKS; }

}  // namespace rainref::test
