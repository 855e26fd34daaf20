#include "puddle/info.h"

#include "pass/info.h"
#include "puddle/display.pass.h"
#include "puddle/raindrops.pass.h"
#include "puddle/shade.pass.h"
#include "puddle/surface_hit.pass.h"
#include "puddle/wave_step.pass.h"
#include "scene/parameter.h"

namespace rainref::puddle {
namespace {

using namespace rainref::scene;
using namespace rainref::capture;

EffectInfo make() {
  const UniformBlock drop =
      record<Drop>({member<&Drop::x>("texel", "Centre; texel centres lie at k + 1/2."), member<&Drop::y>("texel", "Centre."),
                    member<&Drop::amplitude>("1", "as-published: strength times activation; corrected: stored height at the centre."),
                    member<&Drop::radius>("texel", "Nothing is added from this distance on.")});
  const UniformBlock threshold =
      record<CountThreshold>({member<&CountThreshold::threshold>("1", "A word not below k thresholds draws first_count + k drops.")});

  const UniformBlock cell = record<ShelterCell>({member<&ShelterCell::open>("1", "Of 65536 drops over this cell so many fall.")});

  EffectInfo info;
  info.name = "puddle";
  info.passes = {
      pass::info_of<PublishedRaindropsPass, RaindropsPass>(),
      pass::info_of<WaveStepPass>(),
      pass::info_of<SurfaceHitPass>(),
      pass::info_of<GroundNoisePass>(),
      pass::info_of<ShadePass>(),
      pass::info_of<DisplayPass>(),
  };
  const std::array<double, 2> signed_one{-1, 1};
  const std::string around =
      "latitude/longitude, width not height / 6: u = 1/2 + atan2(z, x) / (2 pi), v = 1/2 + atan2(y, sqrt(x^2 + z^2)) / pi, row 0 looks "
      "straight down; "
      "cube, height = 6 width: faces +x -x +y -y +z -z below each other, each from its first row as graphics APIs orient it";
  const auto append = [&](const std::vector<BufferInfo>& more) { pass::append(info.buffers, more); };
  info.buffers = {
      {.name = "craters",
       .format = "records",
       .sentence = "The size classes of drops, smallest first: amplitude and radius; x and y are 0.",
       .record = "Drop",
       .variant = correct},
      {.name = "count_thresholds",
       .format = "records",
       .sentence = "Thresholds of the number of drops in a step, ascending.",
       .range = {0, 4294967295.0},
       .record = "CountThreshold",
       .variant = correct},
      {.name = "shelter",
       .format = "records",
       .sentence = "Where a roof keeps rain off: cells over the water, row-major.",
       .range = {0, 65536},
       .record = "ShelterCell",
       .variant = correct},
      {.name = "objects",
       .format = "records",
       .sentence = "What objects in the water do in this step.",
       .range = {-1e6, 1e6},
       .record = "Drop",
       .variant = correct},
  };
  append(pass::buffers_of<PublishedRaindropsPass, RaindropsPass>());
  append(pass::buffers_of<WaveStepPass>());
  append({
      {.name = "shore",
       .format = "r32f",
       .sentence = "Natural shape: share of the wave that the shore leaves, 1 in the water, 0 on dry ground.",
       .variant = correct},
      {.name = "bounds",
       .format = "rg32f",
       .sentence = "For each block of 32 x 32 cells the highest water [m] and the steepest slope [1] in it and the eight around it.",
       .unit = "m, 1",
       .variant = correct},
  });
  append(pass::buffers_of<SurfaceHitPass>());
  append(pass::buffers_of<GroundNoisePass>());
  append({
      {.name = "environment",
       .format = "rgba32f",
       .sentence = "Radiance by direction.",
       .encoding = "radiance = s^2.2",
       .colour_space = "Rec. 709 primaries, encoded by the power 1/2.2",
       .alpha = "unused",
       .orientation = around,
       .variant = published},
      {.name = "environment",
       .format = "rgba32f",
       .sentence = "Radiance by direction, with mips.",
       .colour_space = "linear Rec. 709",
       .alpha = "unused",
       .orientation = around,
       .variant = correct},
      {.name = "ground",
       .format = "rgba32f",
       .sentence = "Tile of the ground.",
       .encoding = "albedo = s^2.2",
       .colour_space = "Rec. 709 primaries, encoded by the power 1/2.2",
       .alpha = "unused",
       .variant = published},
      {.name = "ground",
       .format = "rgba32f",
       .sentence = "Tile of the ground, with mips.",
       .colour_space = "linear Rec. 709",
       .alpha = "unused",
       .variant = correct},
      {.name = "relief", .format = "rg32f", .sentence = "Slopes of the ground tile, with mips.", .range = signed_one, .variant = correct},
      {.name = "bed",
       .format = "r32f",
       .sentence = "Depth of the water over the puddle's rectangle, negative where dry.",
       .unit = "m",
       .range = signed_one,
       .variant = correct},
  });
  append(pass::buffers_of<ShadePass>());
  append(pass::buffers_of<DisplayPass>());
  info.records = {drop, threshold, cell};
  return info;
}

}  // namespace

const capture::EffectInfo& effect_info() {
  static const capture::EffectInfo info = make();
  return info;
}

}  // namespace rainref::puddle
