// Golden hashes that `rainref selftest` carries with it. Written by scripts/accept_golden.
#pragma once

namespace rainref::cli {

struct SelftestGolden {
  const char* effect;
  const char* variant;
  const char* hash;
};
inline constexpr SelftestGolden selftest_goldens[] = {
    {"puddle", "as-published", "30add08e3949d255eda7b36a9a8dff3c"},       {"puddle", "corrected", "e54981c703c3e99e4f09933eaa4da249"},
    {"windshield", "as-published", "c71e1194f001b4e650fa8d3c86f49741"},   {"windshield", "corrected", "178b2b3316f22c4206762130741c60a4"},
    {"edge_splash", "as-published", "489e98dff58b34e3b5e364ac3a427365"},  {"edge_splash", "corrected", "4212a5e8125bedacb031a03b8b669312"},
    {"screen_drops", "as-published", "2d0a5ec7a5978dd2b9367e7b327c116f"}, {"screen_drops", "corrected", "24b32f3fe0b199b08ad31716f5a0ebcd"},
    {"rainy_glass", "as-published", "b0f495e7beed9fa7794e8d51b70f394e"},  {"rainy_glass", "corrected", "83c1ffa8a7e3c6fda85b563b52a6b157"},
};

}  // namespace rainref::cli
