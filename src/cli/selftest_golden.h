// Golden hashes that `rainref selftest` carries with it. Written by scripts/accept_golden.
#pragma once

namespace rainref::cli {

struct SelftestGolden {
  const char* variant;
  const char* hash;
};
inline constexpr SelftestGolden selftest_goldens[] = {
    {"as-published", "8ad7bfe1f7282bb65ea03ea2a6a6bde4"},
    {"corrected", "ddfa8cd3a32b5146de7d969d28776af6"},
};

}  // namespace rainref::cli
