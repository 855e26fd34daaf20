// Golden hashes that `rainref selftest` carries with it. Written by scripts/accept_golden.
#pragma once

namespace rainref::cli {

struct SelftestGolden {
  const char* effect;
  const char* variant;
  const char* hash;
};
inline constexpr SelftestGolden selftest_goldens[] = {
    {"puddle", "as-published", "cc73ada3956fba55e3d0c36575f5695f"},       {"puddle", "corrected", "56801830ce3410f803ae29f54849cc83"},
    {"windshield", "as-published", "13ef0585709029ea4eaee19740f38bc7"},   {"windshield", "corrected", "518d9815e773f0afc584c1f14223cb1b"},
    {"edge_splash", "as-published", "489e98dff58b34e3b5e364ac3a427365"},  {"edge_splash", "corrected", "4212a5e8125bedacb031a03b8b669312"},
    {"screen_drops", "as-published", "8bf946ed90ef4d28674e656848220fd7"}, {"screen_drops", "corrected", "1932f33a0ba8572435933eead5589dc0"},
    {"rainy_glass", "as-published", "345bc80e3dff694c232366aba00d032c"},  {"rainy_glass", "corrected", "652988213dae0f73430591ed94b1afaf"},
};

}  // namespace rainref::cli
