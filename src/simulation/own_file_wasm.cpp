// WebAssembly is loaded from no file that it could see. What came with it lies where it was put into the module's own file system, as if
// the module lay at its root, the one folder that is always there: scenes in /share/rainref/scenes.
#include "simulation/own_file.h"

namespace rainref::simulation {

std::filesystem::path own_file() { return "/rainref.wasm"; }

}  // namespace rainref::simulation
