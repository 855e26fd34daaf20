// Golden hashes that `rainref selftest` carries with it. Written by scripts/accept_golden.
#pragma once

namespace rainref::cli {

struct SelftestGolden {
  const char* variant;
  const char* hash;
};
inline constexpr SelftestGolden selftest_goldens[] = {
    {"as-published", "00000000000000000000000000000000"},
    {"corrected", "00000000000000000000000000000000"},
};

}  // namespace rainref::cli
