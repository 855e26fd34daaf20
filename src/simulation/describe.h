// The description of an effect as JSON, for `rainref describe EFFECT --json` and the C library.
#pragma once

#include <string>

namespace rainref::simulation {

/// Parameters with units, ranges and defaults; passes; buffers; layouts. Indented. Throws Error(usage) with the nearest effect.
std::string describe_json(const std::string& effect);

}  // namespace rainref::simulation
