// A WebAssembly module cannot see the file that it was loaded from. The bundled files are in the module's own file system, as if the module
// were at its root, the only folder that always exists: scenes in /share/rainref/scenes.
#include "base/code_file.h"

namespace rainref {

std::filesystem::path code_file() { return "/rainref.wasm"; }

}  // namespace rainref
