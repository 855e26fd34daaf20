// WebAssembly starts no programs.
#include "base/program_path.h"

namespace rainref {

bool starts_programs() { return false; }
std::filesystem::path program_in_path(const std::string&) { return {}; }

}  // namespace rainref
