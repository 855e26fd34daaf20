#include "drops/splat/splat.h"

#include <algorithm>

#include <fmt/format.h>

#include "math/constants.h"
#include "math/real64.h"
#include "rainref/error.h"
#include "scene/member_parameter.h"

namespace rainref::drops {
namespace {

using namespace rainref::scene;

std::vector<MemberParameter<SplatKeys>> splat_members(const std::string& prefix) {
  const auto key = [&](const char* name) { return prefix + "." + name; };
  return {
      {integer2(key("height_size"), "texel", 1, 16384, {}, "Columns and rows of the height texture."),
       [](SplatKeys& k, const Value& v) {
         k.width = static_cast<int>(std::get<Integer2>(v)[0]);
         k.height = static_cast<int>(std::get<Integer2>(v)[1]);
       },
       [](const SplatKeys& k) {
         return Value(Integer2{k.width, k.height});
       }},
      choice<&SplatKeys::kernel>(key("kernel"),
                                 {{"paraboloid", SplatKernel::paraboloid},
                                  {"quartic", SplatKernel::quartic},
                                  {"smoothstep", SplatKernel::smoothstep},
                                  {"hemisphere", SplatKernel::hemisphere},
                                  {"disc", SplatKernel::disc}},
                                 "How the height of a drop falls from its centre to its rim."),
      choice<&SplatKeys::blend>(key("blend"), {{"add", SplatBlend::add}, {"max", SplatBlend::max}},
                                "How the heights of several drops in a texel combine."),
      choice<&SplatKeys::half_accumulation>(
          key("accumulate"), {{"half", true}, {"float", false}},
          "half: the sum is rounded after each drop, as in a blending unit with an r16f target. float: the sum is rounded once.")
          .only(published),
      choice<&SplatKeys::rounding>(key("rounding"), {{"rne", Rounding::rne}, {"rtz", Rounding::rtz}},
                                   "Rounding of stored results: to nearest even, or toward zero as many GPUs do."),
      real<&SplatKeys::drop_radius>(key("drop_radius"), "m", 1e-5, 1, "Radius of a drop of mass 1.").only(published),
      real<&SplatKeys::drop_height>(key("drop_height"), "mm", 0, 100, "Height of a drop of mass 1.").only(published),
      real<&SplatKeys::smallest_radius>(
          key("smallest_radius"), "texel", 0, 16,
          "A smaller drop is drawn with this radius and lower by as much, so that no drop falls between texels.")
          .only(correct),
      real<&SplatKeys::lean>(key("lean"), "1", 0, 1,
                             "How much drops that contact-angle hysteresis holds lean with gravity, wind and the car. They become longer, "
                             "and wider and steeper below; 0: all are round.")
          .only(correct),
  };
}

constexpr double longest = 0.3, tapered = 0.3;  // for a drop that is just held
constexpr double steepest = 89 * degree, most_skewed = 0.95;

}  // namespace

std::vector<scene::Parameter> splat_parameters(const std::string& prefix) { return parameters_of(splat_members(prefix)); }

SplatKeys splat_keys(const scene::Config& config, const std::string& prefix, std::optional<Rounding> rounding) {
  SplatKeys k;
  std::vector<MemberParameter<SplatKeys>> table = splat_members(prefix);
  if (rounding) std::erase_if(table, [&](const auto& m) { return m.parameter.key == prefix + ".rounding"; });
  apply(table, config, k);
  if (rounding) k.rounding = *rounding;
  if (config.variant() == correct) k.half_accumulation = false;
  return k;
}

double cap_radius(double contact_angle) {
  // V = pi a^3 (2 + c) (1 - c)^2 / (3 sin^3), c the cosine of the contact angle.
  const double c = cos_real(Real64(contact_angle)).v, s = sin_real(Real64(contact_angle)).v;
  const double cube = mass_unit / water_density * 3 * s * s * s / (pi * (2 + c) * (1 - c) * (1 - c));
  return pow_real(Real64(cube), Real64(1.0 / 3)).v;
}

double kernel_volume(SplatKernel kernel) {
  switch (kernel) {
    case SplatKernel::paraboloid:
      return pi / 2;
    case SplatKernel::quartic:
      return pi / 3;
    case SplatKernel::smoothstep:
      return pi * 3 / 10;
    case SplatKernel::hemisphere:
      return pi * 2 / 3;
    default:
      return pi;
  }
}

double kernel_moment(SplatKernel kernel) {
  switch (kernel) {
    case SplatKernel::paraboloid:
      return 1.0 / 6;
    case SplatKernel::quartic:
      return 1.0 / 8;
    case SplatKernel::smoothstep:
      return 5.0 / 42;
    case SplatKernel::hemisphere:
      return 1.0 / 5;
    default:
      return 1.0 / 4;
  }
}

Pull pull_on_drops(const Settings& s, const PlaneFrame& frame, const GlassFrame& glass) {
  const IntegrateUniforms one = integrate_uniforms(s, frame, 1);
  const double hold = static_cast<double>(one.hold);
  const auto in_plane = [&](const float(&v)[2]) {
    const double along = static_cast<double>(v[0]), up = static_cast<double>(v[1]);
    return std::array<double, 2>{frame[0] * along + frame[1] * up, frame[2] * up};
  };
  const std::array<double, 2> gravity = in_plane(glass.gravity), wind = in_plane(glass.wind);
  const double push = static_cast<double>(one.wind_push) * __builtin_sqrt(wind[0] * wind[0] + wind[1] * wind[1]);
  Pull pull;
  if (!(hold > 0)) return pull;
  pull.gravity = {gravity[0] / hold, gravity[1] / hold};
  pull.wind = {push * wind[0] / hold, push * wind[1] / hold};
  pull.wetting = {s.advancing_deg * degree, s.receding_deg * degree};
  return pull;
}

SplatUniforms splat_uniforms(const SplatSettings& s, const Pull& pull) {
  SplatUniforms u = splat_uniforms(s);
  if (!(s.keys.lean > 0) || !(pull.wetting.advancing > 0)) return u;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    u.gravity[axis] = static_cast<float>(pull.gravity[axis]);
    u.wind[axis] = static_cast<float>(pull.wind[axis]);
  }
  const auto tangent = [](double angle) {
    const Real64 below(std::min(angle, steepest));
    return (sin_real(below) / cos_real(below)).v;
  };
  const double advancing = tangent(pull.wetting.advancing), receding = tangent(pull.wetting.receding);
  u.longer = static_cast<float>(s.keys.lean * longest);
  u.taper = static_cast<float>(s.keys.lean * tapered);
  u.skew = static_cast<float>(s.keys.lean * std::min((advancing - receding) / (advancing + receding), most_skewed));
  u.moment = static_cast<float>(kernel_moment(s.keys.kernel));
  return u;
}

SplatUniforms splat_uniforms(const SplatSettings& s) {
  SplatUniforms u{};
  const SplatKeys& k = s.keys;
  const double column = s.frame[0] / k.width, shear = s.frame[1] / k.height, row = s.frame[2] / k.height;
  u.size[0] = static_cast<float>(k.width);
  u.size[1] = static_cast<float>(k.height);
  u.frame[0] = static_cast<float>(column);
  u.frame[1] = static_cast<float>(shear);
  u.frame[2] = static_cast<float>(row);
  u.kernel = static_cast<std::int32_t>(k.kernel);
  const bool rounds_each = !s.corrected && k.half_accumulation && k.blend == SplatBlend::add;
  u.blend = static_cast<std::int32_t>(rounds_each ? SplatBlend::add_in_half : k.blend);
  double smallest = 0;
  if (s.corrected) {
    const double radius = cap_radius(s.contact_angle), volume = mass_unit / water_density;
    u.radius_scale = static_cast<float>(radius);
    u.height_scale = static_cast<float>(1e3 * volume / (kernel_volume(k.kernel) * radius * radius));
    u.film_scale = static_cast<float>(1e3 * volume / (column * row));
    // The longer side of a texel, which a shear stretches.
    smallest = k.smallest_radius * std::max(column, __builtin_sqrt(row * row + shear * shear));
  } else {
    u.radius_scale = static_cast<float>(k.drop_radius);
    u.height_scale = static_cast<float>(k.drop_height);
  }
  u.smallest_radius = static_cast<float>(std::max(smallest, 1e-6));  // never 0: the pass divides by it
  return u;
}

void splat(const parallel::Executor& executor, SplatUniforms uniforms, bool half_accumulation, Rounding rounding,
           std::span<const Drop> drops, std::span<const Neck> necks, const Image* film, Image& height, SplatScratch& scratch) {
  const bool fits = height.format() == Format::r16f && height.width() == static_cast<int>(uniforms.size[0]) &&
                    height.height() == static_cast<int>(uniforms.size[1]);
  const bool film_fits = !film || (film->format() == Format::r32f && film->width() == height.width() && film->height() == height.height() &&
                                   !half_accumulation);
  if (!fits || !film_fits) throw Error(ExitCode::internal, "splat: the images do not fit the uniforms");
  uniforms.drop_count = static_cast<std::int32_t>(drops.size());
  const Bands bands = splat_bands(height.height());
  const std::size_t chunk_count = (drops.size() + drops_of_chunk - 1) / drops_of_chunk;
  if (scratch.chunks.size() < chunk_count) scratch.chunks.resize(chunk_count);
  const std::span<StampChunk> chunks(scratch.chunks.data(), chunk_count);
  executor.for_range(static_cast<std::int64_t>(drops.size()), drops_of_chunk, [&](std::int64_t begin, std::int64_t end) {
    make_stamps(uniforms, bands, drops.subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin)), necks,
                chunks[static_cast<std::size_t>(begin / drops_of_chunk)]);
  });
  const SplatJob job{uniforms, half_accumulation, rounding, film, &height};
  executor.for_range(bands.count, 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t band = begin; band < end; ++band) splat_band(job, bands, static_cast<int>(band), chunks);
  });
}

}  // namespace rainref::drops
