// Golden hashes that `rainref selftest` carries with it. Written by scripts/accept_golden.
#pragma once

namespace rainref::cli {

struct SelftestGolden {
  const char* effect;
  const char* variant;
  const char* hash;
};
inline constexpr SelftestGolden selftest_goldens[] = {
    {"puddle", "as-published", "8ad7bfe1f7282bb65ea03ea2a6a6bde4"},       {"puddle", "corrected", "ddfa8cd3a32b5146de7d969d28776af6"},
    {"windshield", "as-published", "89e50b34a8414ba9571c6a0e51feebc7"},   {"windshield", "corrected", "91a20872711a143b74df6308f082e214"},
    {"edge_splash", "as-published", "e6ef4a11f8b8bd41160ce95c013ac411"},  {"edge_splash", "corrected", "c2b905e62723573b9213f4214a66997f"},
    {"screen_drops", "as-published", "e3e4bba3deb25fb089f3bd74476e9f4e"}, {"screen_drops", "corrected", "efb1b8a49c914bf08c5e83d6235aa70b"},
    {"rainy_glass", "as-published", "3bb777326773f3c69cd6775f3fa00731"},  {"rainy_glass", "corrected", "33e2e112009562ac094582f544137651"},
};

}  // namespace rainref::cli
