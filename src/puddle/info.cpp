#include "puddle/info.h"

#include "pass/info.h"
#include "puddle/display.pass.h"
#include "puddle/host.h"
#include "puddle/shade.pass.h"
#include "puddle/surface_hit.pass.h"

namespace rainref::puddle {
namespace {

using namespace rainref::scene;
using namespace rainref::capture;

constexpr const char *published = "as-published", *correct = "corrected";

EffectInfo make() {
  const UniformBlock raindrops = uniform_block<RaindropsUniforms>(
      "RaindropsUniforms", {member<&RaindropsUniforms::time>("time", "s", frame_time, "Frame number over frame rate, rounded once."),
                            member<&RaindropsUniforms::rain_speed>("rain_speed", "1/s", {0, 20}, "Pulses of each drop a second."),
                            member<&RaindropsUniforms::drop_intensity>("drop_intensity", "1", {0, 4}, "Strength of an impact."),
                            member<&RaindropsUniforms::width>("width", "texel", whole(1, 65536), "Columns of the wave."),
                            member<&RaindropsUniforms::height>("height", "texel", whole(1, 65536), "Rows of the wave."),
                            member<&RaindropsUniforms::drop_count>("drop_count", "1", {1, 10}, "Drops in the list.")});
  const UniformBlock wave_step = uniform_block<WaveStepUniforms>(
      "WaveStepUniforms",
      {member<&WaveStepUniforms::damping>("damping", "1", share, "as-published: factor of the new level; corrected: gamma of a step."),
       member<&WaveStepUniforms::step>("step", "texel", {1, 8}, "as-published: offset of the neighbours."),
       member<&WaveStepUniforms::courant_sq>("courant_sq", "1", {0, 0.5}, "corrected: Courant number squared, times (1 + gamma) / 2."),
       member<&WaveStepUniforms::drop_count>("drop_count", "1", {0, 1 << 20}, "Drops in the list."),
       member<&WaveStepUniforms::rest>("rest", "1", share, "Stored value of level water.")});
  const UniformBlock drop = record<Drop>(
      "Drop",
      {member<&Drop::x>("x", "texel", "Centre; texel centres lie at k + 1/2."), member<&Drop::y>("y", "texel", "Centre."),
       member<&Drop::amplitude>("amplitude", "1", "as-published: strength times activation; corrected: stored height at the centre."),
       member<&Drop::radius>("radius", "texel", "Nothing is added from this distance on.")});
  const UniformBlock rainfall = uniform_block<RainfallUniforms>(
      "RainfallUniforms",
      {member<&RainfallUniforms::seed>("seed", "1", any_word, "Low and high word of the seed."),
       member<&RainfallUniforms::step>("step", "1", any_word, "Wave steps made before this one, modulo 2^32."),
       member<&RainfallUniforms::first_count>("first_count", "1", {0, 16000}, "Drops where the word is below every threshold."),
       member<&RainfallUniforms::columns>("columns", "texel", {1, 65536}, "Columns of the wave."),
       member<&RainfallUniforms::rows>("rows", "texel", {1, 65536}, "Rows of the wave."),
       member<&RainfallUniforms::boundary>("boundary", "1", {0, 2}, "0: reflecting, 1: periodic, 2: fixed."),
       member<&RainfallUniforms::threshold_count>("threshold_count", "1", {0, 16000}, "Thresholds in the list.")});
  const UniformBlock threshold = record<CountThreshold>(
      "CountThreshold",
      {member<&CountThreshold::threshold>("threshold", "1", "A word not below k thresholds draws first_count + k drops.")});

  constexpr auto envelope = Judge::envelope, input_only = Judge::input_only, bits = Judge::bits;
  constexpr bool from_previous_run = true;
  // Both variants, at these revisions of their formulas.
  const auto both = [](int published_revision, int corrected_revision, const char* block) {
    return std::vector<PassVariant>{{published, published_revision, envelope, block}, {correct, corrected_revision, envelope, block}};
  };
  EffectInfo info;
  info.name = "puddle";
  info.passes = {
      {"raindrops",
       "The drops that fall in this step.",
       {{published, 1, input_only, "RaindropsUniforms"}, {correct, 1, bits, "RainfallUniforms"}},
       {{"craters", "", false, correct}, {"count_thresholds", "", false, correct}},
       {"drops"},
       {raindrops, rainfall}},
      {"wave_step",
       "The next level of the water from the newest and the previous one.",
       both(1, 1, "WaveStepUniforms"),
       {per_texel({"wave", "wave_step", from_previous_run}), {"drops", "raindrops"}, per_texel({"shore", "", false, correct})},
       {"wave"},
       {wave_step},
       "gather",
       {"the four neighbours", "length"}},
      pass::info_of<SurfaceHitPass>(),
      pass::info_of<GroundNoisePass>(),
      pass::info_of<ShadePass>(),
      pass::info_of<DisplayPass>(),
  };
  const std::array<double, 2> one{0, 1}, signed_one{-1, 1};
  const std::string around =
      "latitude/longitude, width not height / 6: u = 1/2 + atan2(z, x) / (2 pi), v = 1/2 + atan2(y, sqrt(x^2 + z^2)) / pi, row 0 looks "
      "straight down; "
      "cube, height = 6 width: faces +x -x +y -y +z -z below each other, each from its first row as graphics APIs orient it";
  info.buffers = {
      {"craters", "records", "The size classes of drops, smallest first: amplitude and radius; x and y are 0.", "1", one, "none", "none",
       "none", "", "Drop", correct},
      {"count_thresholds",
       "records",
       "Thresholds of the number of drops in a step, ascending.",
       "1",
       {0, 4294967295.0},
       "none",
       "none",
       "none",
       "",
       "CountThreshold",
       correct},
      {"drops", "records", "Drop records of this step.", "1", one, "none", "none", "none", "", "Drop"},
      {"wave", "puddle.storage", "Newest level, previous level.", "1", one, "u = 2 (s - 1/2)", "none", "none", "", "", published},
      {"wave",
       "puddle.storage",
       "Newest level, previous level.",
       "m",
       {-rgba8_range, rgba8_range},
       "floats: height = s; rgba8: height = 0.04 (s - 128/255)",
       "none",
       "none",
       "",
       "",
       correct},
      {"shore", "r32f", "Natural shape: share of the wave that the shore leaves, 1 in the water, 0 on dry ground.", "1", one, "none",
       "none", "none", "", "", correct},
      {"bounds", "rg32f", "For each block of 32 x 32 cells the highest water [m] and the steepest slope [1] in it and the eight around it.",
       "m, 1", one, "none", "none", "none", "", "", correct},
  };
  const auto append = [&](const std::vector<BufferInfo>& more) { info.buffers.insert(info.buffers.end(), more.begin(), more.end()); };
  append(pass::buffers_of<SurfaceHitPass>());
  append(pass::buffers_of<GroundNoisePass>());
  append({
      {"environment", "rgba32f", "Radiance by direction.", "1", one, "radiance = s^2.2", "Rec. 709 primaries, encoded by the power 1/2.2",
       "unused", around, "", published},
      {"environment", "rgba32f", "Radiance by direction, with mips.", "1", one, "none", "linear Rec. 709", "unused", around, "", correct},
      {"ground", "rgba32f", "Tile of the ground.", "1", one, "albedo = s^2.2", "Rec. 709 primaries, encoded by the power 1/2.2", "unused",
       "", "", published},
      {"ground", "rgba32f", "Tile of the ground, with mips.", "1", one, "none", "linear Rec. 709", "unused", "", "", correct},
      {"relief", "rg32f", "Slopes of the ground tile, with mips.", "1", signed_one, "none", "none", "none", "", "", correct},
      {"bed", "r32f", "Depth of the water over the puddle's rectangle, negative where dry.", "m", signed_one, "none", "none", "none", "",
       "", correct},
  });
  append(pass::buffers_of<ShadePass>());
  append(pass::buffers_of<DisplayPass>());
  info.records = {drop, threshold};
  return info;
}

}  // namespace

const capture::EffectInfo& effect_info() {
  static const capture::EffectInfo info = make();
  return info;
}

}  // namespace rainref::puddle
