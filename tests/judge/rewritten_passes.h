// Which passes rewritten_passes_test.cpp rewrites.
#pragma once

#include "capture/pass_case.h"

namespace rainref::judge {

/// Whether the pass of a case is recorded and rewritten.
bool is_rewritten(const capture::PassCase& c);

}  // namespace rainref::judge
