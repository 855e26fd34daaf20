// The SIMD targets of this processor, and the target that the kernels use.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rainref {

/// Names of the targets in this build that this processor supports, best first, from
/// avx3 avx2 sse4 ssse3 scalar neon.
std::vector<std::string> simd_targets();

/// Makes every kernel use this target from now on; "": the best one. Process-wide; do not call it while a kernel runs. Throws Error(usage)
/// for a name that is unknown or unavailable here.
void select_simd_target(std::string_view name);

/// The target in use.
std::string selected_simd_target();

}  // namespace rainref
