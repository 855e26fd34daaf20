// Texels that a port reads elsewhere than it should: of a surface whose slopes are known.
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "faults/generators.h"
#include "judge/evaluations.h"
#include "judge/support.h"
#include "math/half.h"

namespace rainref::faults {
namespace {

// Of a height x^2 a central difference is 4 x, and twice the difference to the neighbour on one side 4 x + 2 or 4 x - 2: the slope of the
// normal is so many times as steep, whatever scales it. Stored halves are off by 2^-11 each.
TEST(TapFaults, DifferencesOnOneSideAreThoseOfAParabola) {
  const capture::Pack pack(judge::test::pack_folder("windshield-corrected"));
  int tried = 0;
  for (const capture::PackCase& entry : pack.cases) {
    if (entry.pass != "normals" || tried > 0) continue;
    capture::PassCase c = pack.read(entry);
    for (capture::CaseInput& input : c.inputs)
      for (int y = 0; y < input.array.height; ++y)
        for (int x = 0; x < input.array.width; ++x) {
          const Half h = to_half(input.name == "height" ? 0x1p-9f * static_cast<float>(x * x) : 0.0f);
          std::memcpy(input.array.levels[0].edit().data() + static_cast<std::size_t>(y * input.array.width + x) * sizeof h, &h, sizeof h);
        }
    const judge::Bind bind = judge::evaluations_of(c.effect, c.pass)->bind;
    const std::unique_ptr<capture::PassModel> model = bind(c);
    std::vector<Fault> all;
    add_tap_faults(all, {pack.pass(c.pass), c, bind, *model});
    const int x = 12, y = 5;
    const auto slope = [&](const Fault& d) {
      std::vector<capture::Array> out;
      for (const capture::CaseOutput& o : c.outputs) out.push_back(o.array);
      StoredTexel stored;
      FaultyPass(d, c, bind, *model, judge::HalfMode::rne, out).store({x, y}, stored);
      const auto component = [&](std::size_t v) { return static_cast<double>(to_float(std::bit_cast<std::array<Half, 2>>(stored[v])[0])); };
      return component(0) / component(2);
    };
    for (const auto& [name, added] : {std::pair("height differences on one side, twice, to the right and above", 2.0),
                                      std::pair("height differences on one side, twice, to the left and below", -2.0)})
      for (const Fault& d : all)
        if (name_of(d) == name) {
          EXPECT_NEAR(slope(d) / slope(Fault{}), (4 * x + added) / (4.0 * x), 4 * 0x1p-11) << name;
          ++tried;
        }
  }
  EXPECT_EQ(tried, 2);
}

}  // namespace
}  // namespace rainref::faults
