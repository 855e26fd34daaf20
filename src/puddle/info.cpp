#include "puddle/info.h"

#include "puddle/host.h"
#include "puddle/uniforms.h"

namespace rainref::puddle {
namespace {

using namespace rainref::scene;
using namespace rainref::capture;

constexpr const char *published = "as-published", *correct = "corrected";

std::vector<Member> camera() {
  return {member<&CameraUniforms::position>("position", "m", {-1e5, 1e5}, "Eye."),
          member<&CameraUniforms::pixel_scale>("pixel_scale", "1", {0, 23}, "Height of a pixel on the image plane at distance 1."),
          member<&CameraUniforms::right>("right", "1", component, "Unit vector to the right of the picture."),
          member<&CameraUniforms::plane_left>("plane_left", "1", {-1e6, 0}, "Left edge of the image plane at distance 1."),
          member<&CameraUniforms::up>("up", "1", component, "Unit vector to the top of the picture."),
          member<&CameraUniforms::plane_bottom>("plane_bottom", "1", {-12, 0}, "Bottom edge of the image plane at distance 1."),
          member<&CameraUniforms::forward>("forward", "1", component, "Unit vector into the picture.")};
}
std::vector<Member> with_camera(std::vector<Member> head, std::vector<Member> rest) {
  head.insert(head.end(), rest.begin(), rest.end());
  return head;
}

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
  const UniformBlock surface_hit = uniform_block<SurfaceHitUniforms>(
      "SurfaceHitUniforms",
      with_camera(nested<&SurfaceHitUniforms::camera>("camera", camera()),
                  {member<&SurfaceHitUniforms::half_size>("half_size", "m", {0, 1e5}, "Half the puddle's extent."),
                   member<&SurfaceHitUniforms::epsilon>("epsilon", "m", {1e-5, 1}, "Distance that counts as a hit."),
                   member<&SurfaceHitUniforms::texel>("texel", "1", share, "1 over the wave's columns and rows."),
                   member<&SurfaceHitUniforms::max_steps>("max_steps", "1", {1, 4096}, "Most steps of the march."),
                   member<&SurfaceHitUniforms::normal_gain>("normal_gain", "1", {0, 1e5}, "Factor from a height difference to a slope."),
                   member<&SurfaceHitUniforms::height_scale>("height_scale", "m", {0, 2}, "corrected: height = scale * stored + bias."),
                   member<&SurfaceHitUniforms::height_bias>("height_bias", "m", {-1, 0}, "corrected: see height_scale."),
                   member<&SurfaceHitUniforms::surface_top>("surface_top", "m", {0, 1e6}, "corrected: no height lies above this, or below its negative."),
                   member<&SurfaceHitUniforms::surface_slope>("surface_slope", "1", {0, 1e9}, "corrected: no slope of the surface is above this."),
                   member<&SurfaceHitUniforms::inverse_size>("inverse_size", "1/m", {0, 1e5}, "corrected: 1 over the puddle's extent in x and z."),
                   member<&SurfaceHitUniforms::bounds_scale>("bounds_scale", "1", share, "corrected: texture coordinates of bounds to one of the water."),
                   member<&SurfaceHitUniforms::bounds_reach>("bounds_reach", "m", {0, 1e6}, "corrected: a texel of bounds holds this far around its points.")}));
  const UniformBlock ground_noise = uniform_block<GroundNoiseUniforms>(
      "GroundNoiseUniforms", with_camera(nested<&GroundNoiseUniforms::camera>("camera", camera()),
                                         {member<&GroundNoiseUniforms::puddle_depth>("puddle_depth", "m", {0, 100}, "Depth of the ground under y = 0.")}));
  const UniformBlock shade = uniform_block<ShadeUniforms>(
      "ShadeUniforms",
      with_camera(nested<&ShadeUniforms::camera>("camera", camera()),
                  {member<&ShadeUniforms::tint>("tint", "1", share, "Colour of the water's body, linear RGB."),
                   member<&ShadeUniforms::reflectivity>("reflectivity", "1", share, "Weight of the reflection."),
                   member<&ShadeUniforms::rotation>("rotation", "1", component, "Cosine and sine of env_rotation."),
                   member<&ShadeUniforms::ground_scale>("ground_scale", "1/m", {0, 100}, "Tiles of the ground in a metre."),
                   member<&ShadeUniforms::water_turbidity>("water_turbidity", "1/m", {0, 1000}, "Extinction of light in the water."),
                   member<&ShadeUniforms::puddle_depth>("puddle_depth", "m", {0, 100}, "as-published: depth of the ground under y = 0."),
                   member<&ShadeUniforms::fog_depth>("fog_depth", "1/m", {0, 10}, "Extinction of the fog."),
                   member<&ShadeUniforms::use_checkerboard>("use_checkerboard", "1", flag, "1: checkerboard ground, 0: image."),
                   member<&ShadeUniforms::environment_is_cube>("environment_is_cube", "1", flag, "1: cube faces, 0: latitude/longitude."),
                   member<&ShadeUniforms::ambient>("ambient", "1", radiance, "corrected: radiance of a white diffuse level ground."),
                   member<&ShadeUniforms::gloss_level>("gloss_level", "1", mip_level, "corrected: mip level of the environment in wet ground."),
                   member<&ShadeUniforms::inverse_size>("inverse_size", "1/m", {0, 1e5}, "corrected: 1 over the puddle's extent in x and z."),
                   member<&ShadeUniforms::shore_width>("shore_width", "m", share, "corrected: depth over which wet ground turns into water."),
                   member<&ShadeUniforms::ground_footprint>("ground_footprint", "1/m", {0, 1e9}, "corrected: texels of the ground under a pixel at distance 1."),
                   member<&ShadeUniforms::fog_colour>("fog_colour", "1", radiance, "corrected: radiance of the fog."),
                   member<&ShadeUniforms::exact_fresnel>("exact_fresnel", "1", flag, "corrected: 1: Fresnel's equations, 0: Schlick."),
                   member<&ShadeUniforms::wetness>("wetness", "1", share, "corrected: reflectance of the wet ground over that of water."),
                   member<&ShadeUniforms::background_level>("background_level", "1", mip_level, "corrected: mip level of the environment behind the scene."),
                   member<&ShadeUniforms::mirror_level>("mirror_level", "1", mip_level, "corrected: mip level of the environment in the water.")}));
  const UniformBlock display =
      uniform_block<DisplayUniforms>("DisplayUniforms", {member<&DisplayUniforms::vignette>("vignette", "1", {0, 1.5}, "Loss at distance 1 from the centre."),
                                                         member<&DisplayUniforms::exposure>("exposure", "1", exposure_factor, "corrected: factor of the radiance."),
                                                         member<&DisplayUniforms::width>("width", "pixel", whole(1, 65536), "Columns of the picture."),
                                                         member<&DisplayUniforms::height>("height", "pixel", whole(1, 65536), "Rows of the picture.")});
  const UniformBlock drop = record<Drop>("Drop", {member<&Drop::x>("x", "texel", "Centre; texel centres lie at k + 1/2."),
                                                  member<&Drop::y>("y", "texel", "Centre."),
                                                  member<&Drop::amplitude>("amplitude", "1", "as-published: strength times activation; corrected: stored height at the centre."),
                                                  member<&Drop::radius>("radius", "texel", "Nothing is added from this distance on.")});
  const UniformBlock rainfall = uniform_block<RainfallUniforms>(
      "RainfallUniforms", {member<&RainfallUniforms::seed>("seed", "1", any_word, "Low and high word of the seed."),
                           member<&RainfallUniforms::step>("step", "1", any_word, "Wave steps made before this one, modulo 2^32."),
                           member<&RainfallUniforms::first_count>("first_count", "1", {0, 16000}, "Drops where the word is below every threshold."),
                           member<&RainfallUniforms::columns>("columns", "texel", {1, 65536}, "Columns of the wave."),
                           member<&RainfallUniforms::rows>("rows", "texel", {1, 65536}, "Rows of the wave."),
                           member<&RainfallUniforms::boundary>("boundary", "1", {0, 2}, "0: reflecting, 1: periodic, 2: fixed."),
                           member<&RainfallUniforms::threshold_count>("threshold_count", "1", {0, 16000}, "Thresholds in the list.")});
  const UniformBlock threshold = record<CountThreshold>(
      "CountThreshold", {member<&CountThreshold::threshold>("threshold", "1", "A word not below k thresholds draws first_count + k drops.")});

  constexpr auto envelope = Judge::envelope, input_only = Judge::input_only, bits = Judge::bits;
  constexpr bool from_previous_run = true;
  // Both variants, at these revisions of their formulas.
  const auto both = [](int published_revision, int corrected_revision, const char* block) {
    return std::vector<PassVariant>{{published, published_revision, envelope, block}, {correct, corrected_revision, envelope, block}};
  };
  const std::vector<std::string> lengths{"dot", "length", "normalize"};
  EffectInfo info;
  info.name = "puddle";
  info.passes = {
      {"raindrops", "The drops that fall in this step.",
       {{published, 1, input_only, "RaindropsUniforms"}, {correct, 1, bits, "RainfallUniforms"}},
       {{"craters", "", false, correct}, {"count_thresholds", "", false, correct}}, {"drops"}, {raindrops, rainfall}},
      {"wave_step", "The next level of the water from the newest and the previous one.", both(1, 1, "WaveStepUniforms"),
       {per_texel({"wave", "wave_step", from_previous_run}), {"drops", "raindrops"}, per_texel({"shore", "", false, correct})}, {"wave"}, {wave_step}, "gather",
       {"the four neighbours", "length"}},
      {"surface_hit", "Where each pixel's view ray meets the water, and the normal there.", both(1, 2, "SurfaceHitUniforms"),
       {{"wave", "wave_step"}, {"bounds", "", false, correct}}, {"hit", "normal"}, {surface_hit}, "gather", lengths},
      {"ground_noise", "The sine hash of the ground point, which shade takes as data.", {{published, 1, input_only, "GroundNoiseUniforms"}},
       {per_texel({"hit", "surface_hit"}), per_texel({"normal", "surface_hit"})}, {"noise"}, {ground_noise}, "gather", lengths},
      {"shade", "Reflection, refraction, water and ground: linear radiance.", both(1, 1, "ShadeUniforms"),
       {per_texel({"hit", "surface_hit"}), per_texel({"normal", "surface_hit"}), per_texel({"noise", "ground_noise", false, published}), {"environment"}, {"ground"},
        {"relief", "", false, correct}, {"bed", "", false, correct}}, {"colour"}, {shade}, "gather", lengths},
      {"display", "Vignette and display code.", both(1, 1, "DisplayUniforms"), {per_texel({"colour", "shade"})}, {"picture"}, {display}, "gather", {"length"}},
  };
  const std::array<double, 2> one{0, 1}, signed_one{-1, 1};
  const std::string around =
      "latitude/longitude, width not height / 6: u = 1/2 + atan2(z, x) / (2 pi), v = 1/2 + atan2(y, sqrt(x^2 + z^2)) / pi, row 0 looks straight down; "
      "cube, height = 6 width: faces +x -x +y -y +z -z below each other, each from its first row as graphics APIs orient it";
  info.buffers = {
      {"craters", "records", "The size classes of drops, smallest first: amplitude and radius; x and y are 0.", "1", one, "none", "none", "none", "", "Drop", correct},
      {"count_thresholds", "records", "Thresholds of the number of drops in a step, ascending.", "1", {0, 4294967295.0}, "none", "none", "none", "", "CountThreshold", correct},
      {"drops", "records", "Drop records of this step.", "1", one, "none", "none", "none", "", "Drop"},
      {"wave", "puddle.storage", "Newest level, previous level.", "1", one, "u = 2 (s - 1/2)", "none", "none", "", "", published},
      {"wave", "puddle.storage", "Newest level, previous level.", "m", {-rgba8_range, rgba8_range}, "floats: height = s; rgba8: height = 0.04 (s - 128/255)",
       "none", "none", "", "", correct},
      {"shore", "r32f", "Natural shape: share of the wave that the shore leaves, 1 in the water, 0 on dry ground.", "1", one, "none", "none", "none", "", "", correct},
      {"bounds", "rg32f", "For each block of 32 x 32 cells the highest water [m] and the steepest slope [1] in it and the eight around it.", "m, 1", one,
       "none", "none", "none", "", "", correct},
      {"hit", "rgba32f", "Position x y z [m], march steps.", "m, m, m, 1", {-42, 42}, "none", "none", "none", "", "", published},
      {"hit", "rgba32f", "Position x y z [m], march steps.", "m, m, m, 1", {-2, 2}, "none", "none", "none", "", "", correct},
      {"normal", "rgba16f", "Unit normal x y z; 1 where the ray hit, 0 where not.", "1", signed_one},
      {"noise", "r32f", "Noise of the ground point in [0, 1).", "1", one, "none", "none", "none", "", "", published},
      {"environment", "rgba32f", "Radiance by direction.", "1", one, "radiance = s^2.2", "Rec. 709 primaries, encoded by the power 1/2.2", "unused", around, "", published},
      {"environment", "rgba32f", "Radiance by direction, with mips.", "1", one, "none", "linear Rec. 709", "unused", around, "", correct},
      {"ground", "rgba32f", "Tile of the ground.", "1", one, "albedo = s^2.2", "Rec. 709 primaries, encoded by the power 1/2.2", "unused", "", "", published},
      {"ground", "rgba32f", "Tile of the ground, with mips.", "1", one, "none", "linear Rec. 709", "unused", "", "", correct},
      {"relief", "rg32f", "Slopes of the ground tile, with mips.", "1", signed_one, "none", "none", "none", "", "", correct},
      {"bed", "r32f", "Depth of the water over the puddle's rectangle, negative where dry.", "m", signed_one, "none", "none", "none", "", "", correct},
      {"colour", "rgba16f", "Linear radiance, alpha 1.", "1", one, "none", "linear Rec. 709", "1"},
      {"picture", "rgba8", "Display code, alpha 1. Row 0 is the bottom of the picture.", "1", one, "code = power 0.4545 of the radiance", "Rec. 709 primaries", "1", "", "", published},
      {"picture", "rgba8", "Display code, alpha 1. Row 0 is the bottom of the picture.", "1", one, "sRGB (IEC 61966-2-1)", "sRGB", "1", "", "", correct},
  };
  info.records = {drop, threshold};
  return info;
}

}  // namespace

const capture::EffectInfo& effect_info() {
  static const capture::EffectInfo info = make();
  return info;
}

}  // namespace rainref::puddle
