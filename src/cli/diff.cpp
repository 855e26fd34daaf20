// `rainref diff`.
#include "cli/commands.h"
#include "rainref/error.h"

namespace rainref::cli {

int diff(const std::filesystem::path&, const std::filesystem::path&) { throw Error(ExitCode::internal, "under construction"); }

}  // namespace rainref::cli
