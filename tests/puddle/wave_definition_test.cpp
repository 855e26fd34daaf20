// The lanes of wave_step, written by hand over planes in place, against its definition.
#include <string>
#include <vector>

#include "math/simd_target.h"
#include "pass/same_as_definition.h"
#include "puddle/info.h"
#include "puddle/support.h"

namespace rainref::puddle {
namespace {

TEST(WaveDefinition, GivesTheBitsOfTheLanes) {
  const std::vector<std::string> targets = simd_targets();
  std::vector<int> widths{4133};  // longer than the strips that rows are decoded in
  for (int width = 2; width <= 33; ++width) widths.push_back(width);
  for (const int width : widths) {
    for (const Variant variant : variants) {
      for (const Boundary boundary : boundaries) {
        for (const Format storage : {Format::rg16f, Format::rg32f, Format::rgba8}) {
          if (width > 33 && boundary != Boundary::periodic) continue;
          Settings s = no_rain(variant, width, width > 33 ? 2 : 9);
          s.boundary = boundary;
          s.storage = storage;
          s.rounding = width % 2 ? Rounding::rne : Rounding::rtz;
          s.step = 1 + 1.75 * (width % 5);  // as published whole and fractional, and longer than narrow water
          s.drop_count = 10;
          s.drop_intensity = 1;
          s.rain_speed = 7;
          s.rain_rate = 100;
          s.cell_size = 0.05;
          s.step_rate = 120;
          s.smallest_drop = 1;
          s.shape = variant == Variant::corrected && width > 20 ? Shape::natural : Shape::basin;
          s.rim_width = width % 2 ? 0.2 : 0;  // 4 cells
          s.bed_columns = 64;
          select_simd_target(targets[static_cast<std::size_t>(width) % targets.size()]);
          Puddle puddle = puddle_of(s);
          const auto cases = rainref::test::captured(effect_info(), variant == Variant::corrected, "wave_step", [&](Recorder& recorder) {
            for (int frame = 0; frame < 4; ++frame) puddle.simulate(&recorder);
          });
          ASSERT_TRUE(rainref::test::are_as_defined(cases, evaluations())) << text(s) << ", " << width << " columns";
          ASSERT_GE(cases.size(), 4u);
        }
      }
    }
  }
  select_simd_target("");
}

}  // namespace
}  // namespace rainref::puddle
