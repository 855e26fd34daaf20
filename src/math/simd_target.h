// The SIMD targets of this processor, and which of them the kernels use.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rainref {

/// Names of the targets that this build has and this processor can run, best first: of
/// avx3 avx2 sse4 ssse3 scalar neon.
std::vector<std::string> simd_targets();

/// Makes every kernel use this target from now on, or the best one for "". Process-wide; not to be called while a
/// kernel runs. Throws Error(usage) for a name that is unknown or not available here.
void select_simd_target(std::string_view name);

/// The target in use.
std::string selected_simd_target();

}  // namespace rainref
