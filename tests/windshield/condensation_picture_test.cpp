// What is seen through the mist of condensed water on the glass.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "math/half.h"
#include "windshield/golden_scenes.h"

namespace rainref::windshield {
namespace {

const std::string rain = std::string(wet_drive) + "[rain]\nrate = 120\nsmallest_drop = 0.8\n";
/// Neither rain nor blades.
const std::string dry = "[run]\nsize = [97, 61]\nfps = 60\n[wipers]\ncount = 0\n[rain]\nrate = 0\n[windshield]\nheight_size = [89, 53]\n";

Windshield running(const std::string& toml, int frames, const parallel::Executor& executor) {
  Windshield w(config_of("corrected", toml), small_surroundings(), executor);
  for (int n = 0; n < frames; ++n) {
    w.simulate();
    w.render();
  }
  return w;
}
bool same(const Image& a, const Image& b) {
  const BufferView x(a), y(b);
  std::vector<std::byte> one(x.row_bytes()), other(y.row_bytes());
  for (int row = 0; row < a.height(); ++row) {
    x.copy_row(row, one.data());
    y.copy_row(row, other.data());
    if (one != other) return false;
  }
  return true;
}

TEST(Condensation, OfNoneThePictureIsWhatItWas) {
  const parallel::Executor executor(2);
  const Windshield without = running(rain, 20, executor), none = running(rain + "[condensation]\non = true\nmost = 0\n", 20, executor),
                   some = running(rain + "[condensation]\non = true\n", 20, executor);
  EXPECT_TRUE(same(without.colour(), none.colour()));
  EXPECT_FALSE(same(without.colour(), some.colour()));
  EXPECT_TRUE(same(without.height(), some.height())) << "mist is no water of the drops";
}

// All of the light scattered, and all of that from the scene as a whole: one colour over the glass, the coarsest level's, whatever is
// behind.
TEST(Condensation, AFullVeilIsTheMeanOfTheScene) {
  const parallel::Executor executor(2);
  const Windshield w =
      running(dry + "[condensation]\non = true\nmost = 1\nveil = 1\n[blur]\nblur_levels = 6\nfog_density = 0\n", 1, executor);
  const Windshield clear = running(dry + "[blur]\nblur_levels = 6\nfog_density = 0\n", 1, executor);
  double mean[3]{}, least[3]{1e9, 1e9, 1e9}, most[3]{};
  for (int y = 0; y < 23; ++y)
    for (int x = 0; x < 37; ++x)
      for (int c = 0; c < 3; ++c) mean[c] += to_float(w.scene_colour().row<Half>(y)[4 * x + c]) / (37 * 23);
  int on_glass = 0;
  for (int y = 0; y < 61; ++y) {
    for (int x = 0; x < 97; ++x) {
      const Half *seen = w.colour().row<Half>(y) + 4 * x, *before = clear.colour().row<Half>(y) + 4 * x;
      if (std::memcmp(seen, before, 8) == 0) continue;  // beside the glass
      ++on_glass;
      for (int c = 0; c < 3; ++c) {
        least[c] = std::min<double>(least[c], to_float(seen[c]));
        most[c] = std::max<double>(most[c], to_float(seen[c]));
      }
    }
  }
  EXPECT_GT(on_glass, 2000);
  for (int c = 0; c < 3; ++c) {
    // The last level is one texel, a mean of means in halves.
    EXPECT_NEAR(least[c], mean[c], 0.01 * mean[c]);
    EXPECT_NEAR(most[c], mean[c], 0.01 * mean[c]);
  }
}

}  // namespace
}  // namespace rainref::windshield
