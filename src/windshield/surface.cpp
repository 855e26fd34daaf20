#include "windshield/surface.h"

#include <algorithm>
#include <bit>

#include "math/real64.h"
#include "rainref/error.h"

namespace rainref::windshield {
namespace {

constexpr int tile_rows = 8;
constexpr const char *published = "as-published", *correct = "corrected";

bool is(const Image& image, Format format, const Image& like) {
  return image.format() == format && image.width() == like.width() && image.height() == like.height();
}
/// A multiple of the grid, a power of two: the quotient is exact and below 2^51.
double nearest(double time, double grid) {
  const double biased = time / grid + whole_bias;
  return (biased - whole_bias) * grid;
}

}  // namespace

std::vector<scene::Parameter> surface_parameters(const std::string& prefix) {
  const auto key = [&](const char* name) { return prefix + "." + name; };
  return {
      scene::real(key("wipe_strength"), "mm", 0, 1000, 10, "What a blade takes off the height.").only(published),
      scene::real(key("mask_tau"), "s", 0.01, 600, 4, "Time in which the mask of freshly wiped glass falls to 1/e."),
  };
}
void read_surface(const scene::Config& config, const std::string& prefix, SurfaceSettings& s) {
  s.corrected = config.variant() == correct;
  s.mask_tau = config.real(prefix + ".mask_tau");
  if (!s.corrected) s.wipe_strength = config.real(prefix + ".wipe_strength");
}

double wiped_grid(double tau) {
  // The power of two not above tau, over 2^19.
  constexpr std::uint64_t exponent = 0x7ff0000000000000u;
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(tau) & exponent) * 0x1p-19;
}
float wiped_limit(double tau) { return static_cast<float>(wiped_grid(tau) * 0x1p24); }

WipeTextureUniforms wipe_texture_uniforms(const SurfaceSettings& s, int frame) {
  WipeTextureUniforms u{};
  const double column = s.frame[0] / s.width, shear = s.frame[1] / s.height, row = s.frame[2] / s.height;
  u.frame[0] = static_cast<float>(column);
  u.frame[1] = static_cast<float>(shear);
  u.frame[2] = static_cast<float>(row);
  // A texel, but no wider than a blade: what two sweeps in turn cover by halves would stay as a seam.
  u.edge_width = static_cast<float>(std::max(1e-6, std::min(std::max(column, row), s.half_width)));
  u.axis_length[0] = static_cast<float>(s.frame[0]);
  u.axis_length[1] = static_cast<float>(s.frame[2]);
  if (s.corrected) {
    const double grid = wiped_grid(s.mask_tau);
    // The difference of two whole multiples, so that all frames together make the time that has passed.
    u.dt = static_cast<float>(nearest((frame + 1) / s.fps, grid) - nearest(frame / s.fps, grid));
    u.inverse_tau = static_cast<float>(1 / s.mask_tau);
    u.wiped_limit = wiped_limit(s.mask_tau);
  } else {
    u.strength = static_cast<float>(s.wipe_strength);
    u.keep = static_cast<float>(exp_real(Real64(-1 / (s.fps * s.mask_tau))).v);
  }
  return u;
}

NormalsUniforms normals_uniforms(const SurfaceSettings& s) {
  // Twice a texel is the span of a difference; heights are in mm. Plane axes: dh/dx = h_u / f0, dh/dy = (h_v - h_u f1 / f0) / f2.
  const double metres = 1e-3 / 2;
  NormalsUniforms u{};
  u.slope_x = static_cast<float>(metres * s.width / s.frame[0]);
  u.slope_shear = static_cast<float>(-metres * s.width * s.frame[1] / (s.frame[0] * s.frame[2]));
  u.slope_y = static_cast<float>(metres * s.height / s.frame[2]);
  return u;
}

Image make_mask(const SurfaceSettings& s) { return Image(Format::r16f, s.width, s.height); }
Image make_wiped(const SurfaceSettings& s) {
  Image wiped(Format::r32f, s.width, s.height);
  for (int y = 0; y < s.height; ++y) std::fill_n(wiped.row<float>(y), s.width, wiped_limit(s.mask_tau));
  return wiped;
}

void wipe_texture(const parallel::Executor& executor, WipeTextureUniforms uniforms, bool corrected, Rounding rounding,
                  std::span<const Wiper> wipers, const WipedTextures& t) {
  const Image& height = *t.height;
  if (height.format() != Format::r16f || !is(*t.mask, Format::r16f, height) || (corrected && !(t.wiped && is(*t.wiped, Format::r32f, height)))) {
    throw Error(ExitCode::internal, "wipe_texture: the textures do not fit");
  }
  uniforms.wiper_count = static_cast<std::int32_t>(wipers.size());
  executor.for_tiles(height.width(), height.height(), height.width(), tile_rows,
                     [&](const parallel::Tile& tile) { wipe_texture_rows(uniforms, corrected, rounding, wipers.data(), t, tile); });
}

capture::PassInfo wipe_texture_info() {
  using capture::per_texel;
  using scene::member;
  using U = WipeTextureUniforms;
  const scene::UniformBlock block = scene::uniform_block<U>(
      "WipeTextureUniforms", {member<&U::frame>("frame", "m/texel", {-1e4, 1e4}, "Plane coordinates of a step: x of a column, x and y of a row."),
                              member<&U::edge_width>("edge_width", "m", {0, 1e4}, "Width over which coverage falls at a blade's edge."),
                              member<&U::axis_length>("axis_length", "m", {0, 1e4}, "as-published: lengths of the axes u and v."),
                              member<&U::strength>("strength", "mm", {0, 1000}, "as-published: what full coverage takes off the height."),
                              member<&U::keep>("keep", "1", scene::share, "as-published: share of the mask that a frame leaves."),
                              member<&U::dt>("dt", "s", {0, 1}, "corrected: time since the frame before, so rounded that sums are exact."),
                              member<&U::inverse_tau>("inverse_tau", "1/s", {0, 100}, "corrected: 1 over the time constant of the mask."),
                              member<&U::wiped_limit>("wiped_limit", "s", {0, 1 << 15}, "corrected: the time since a wipe grows to this and no further."),
                              member<&U::wiper_count>("wiper_count", "1", {0, 65536}, "Wipers in the list.")});
  constexpr bool from_previous_run = true;
  return {"wipe_texture",
          "What the blades take off the height, and the mask of freshly wiped glass.",
          {{published, 1, capture::Judge::envelope, "WipeTextureUniforms"}, {correct, 1, capture::Judge::envelope, "WipeTextureUniforms"}},
          {per_texel({"height", "splat"}), per_texel({"mask", "wipe_texture", from_previous_run, published}), per_texel({"wiped", "wipe_texture", from_previous_run, correct}), {"wipers"}},
          {"height", "mask", "wiped"},
          {block},
          "gather",
          {"dot", "length"}};
}
std::vector<capture::BufferInfo> surface_buffers() {
  return {{"mask", "r16f", "Freshly wiped glass: 1, and falling.", "1", {0, 1}},
          {"wiped", "r32f", "Time since the last wipe, to about 32 time constants of the mask.", "s", {0, 16384}, "none", "none", "none", "", "", correct}};
}

}  // namespace rainref::windshield
