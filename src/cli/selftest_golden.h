// Golden hashes built into `rainref selftest`. Written by scripts/accept_golden.
#pragma once

namespace rainref::cli {

struct SelftestGolden {
  const char* effect;
  const char* variant;
  const char* hash;
};
inline constexpr SelftestGolden selftest_goldens[] = {
    {"puddle", "as-published", "85cc26fed5d8e7a819785fe29c319907"},       {"puddle", "corrected", "cfa8d07ec5b6d44a426320d29fa0f30b"},
    {"windshield", "as-published", "d1924a5089b2118fa29b96c7a132f61c"},   {"windshield", "corrected", "df4ec1ba6b52cddffee59bb6c7328ad0"},
    {"edge_splash", "as-published", "489e98dff58b34e3b5e364ac3a427365"},  {"edge_splash", "corrected", "4212a5e8125bedacb031a03b8b669312"},
    {"screen_drops", "as-published", "1cf00eb568d5b0cb4574fd4b94857ef6"}, {"screen_drops", "corrected", "e3060c5e4716a4c7db8615a13ffa0cb0"},
    {"rainy_glass", "as-published", "068de46c50d014ba9d3f3d37985169b0"},  {"rainy_glass", "corrected", "c7916a60982b9d835a41994fee204980"},
};

}  // namespace rainref::cli
