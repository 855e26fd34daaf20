// WebAssembly is loaded from no file that it could see. What came with it lies where the page puts it into the module's own file system,
// as if the module lay in /lib: scenes in /share/rainref/scenes.
#include "simulation/own_file.h"

namespace rainref::simulation {

std::filesystem::path own_file() { return "/lib/rainref.wasm"; }

}  // namespace rainref::simulation
