#include "screen_drops/host.h"

#include <algorithm>

#include <fmt/format.h>

#include "image/texture.h"
#include "math/constants.h"
#include "math/half_array.h"
#include "math/real64.h"
#include "math/unorm.h"
#include "random/counter.h"
#include "rainref/error.h"
#include "screen_drops/cells.h"

namespace rainref::screen_drops {
namespace {

using scene::Vector3;

constexpr int tap_count = 24;
constexpr int most_cells = 1 << 24, most_side = 65535;    // a cell's position has 16 bits a side
constexpr double visible_from = 0.02, visible_to = 0.12;  // height of flowing water [mm]

bool corrected(const Settings& s) { return s.variant == Variant::corrected; }
Vector3 vector(const std::array<double, 3>& a) { return {a[0], a[1], a[2]}; }
double log2_of(double x) { return log_real(Real64(x)).v / log_real(Real64(2)).v; }
/// Millimetres of glass per pixel.
double millimetres(const Settings& s) { return 1e3 * s.pane_height / s.height; }
/// The mip level of the scene behind a cap of base radius R [mm]: the cap deflects a ray by (ior - 1) sin a / R per millimetre.
float level_of(const Settings& s, double radius) {
  const double per_pixel = (s.water_ior - 1) * sin_real(Real64(s.contact_angle_deg * pi / 180)).v / radius * millimetres(s);
  const double texel = 2 * scene_camera(s).half_height() / s.height;
  return static_cast<float>(std::max(0.0, log2_of(std::max(per_pixel / texel, 1.0))));
}

}  // namespace

scene::Camera camera(const Settings& s) {
  return {vector(s.camera_position), vector(s.camera_target), vector(s.camera_up), s.vertical_fov_deg};
}
scene::Camera scene_camera(const Settings& s) {
  scene::Camera wide = camera(s);
  if (corrected(s)) wide.vertical_fov_deg = 2 * atan2_real(Real64(wide.half_height() * s.scene_margin), Real64(1)).v * 180 / pi;
  return wide;
}

void check(const Settings& s) {
  const auto positive = [](double x, const char* key) {
    if (!(x > 0)) throw Error(ExitCode::usage, fmt::format("{}: expected more than 0, found {}", key, x));
  };
  positive(s.width, "run.size");
  positive(s.height, "run.size");
  positive(s.fps, "run.fps");
  if (corrected(s)) {
    positive(s.pane_height, "glass.height");
    positive(s.largest_radius, "drops.largest_radius");
    positive(s.scene_margin, "scene.margin");
    positive(s.shortest_cycle, "drops.shortest_cycle");
    if (!(s.shortest_cycle <= s.longest_cycle)) {
      throw Error(ExitCode::usage, fmt::format("drops.shortest_cycle: expected at most drops.longest_cycle = {} s, found {}",
                                               s.longest_cycle, s.shortest_cycle));
    }
    if (!(s.longest_cycle <= 65.535))
      throw Error(ExitCode::usage, fmt::format("drops.longest_cycle: expected at most 65.535 s, found {}", s.longest_cycle));
    if (!(s.impact > 0 && s.impact < 1))
      throw Error(ExitCode::usage, fmt::format("drops.impact: expected a share between 0 and 1, found {}", s.impact));
    if (!(s.contact_angle_deg > 0 && s.contact_angle_deg < 90))
      throw Error(ExitCode::usage,
                  fmt::format("drops.contact_angle: expected an angle between 0 and 90 degrees, found {}", s.contact_angle_deg));
    const double fine = cell_over_radius * s.largest_radius / (1 << (layers - 1)),
                 cells = 1.4 * s.height * millimetres(s) / fine * (s.width * millimetres(s) / fine);
    if (!(cells < most_cells && std::max(s.width, s.height) * millimetres(s) / fine < most_side)) {
      throw Error(ExitCode::usage,
                  fmt::format("drops.largest_radius: expected drops that {} million cells hold, found {} mm for a pane {} m high",
                              most_cells >> 20, s.largest_radius, s.pane_height));
    }
  } else {
    positive(s.grid, "drops.grid");
    positive(s.noise_size, "noise.size");
    positive(s.layers, "drops.layers");
    if (!(s.layers <= most_published_layers))
      throw Error(ExitCode::usage, fmt::format("drops.layers: expected at most {}, found {}", most_published_layers, s.layers));
    if (s.wrap == Address::border) throw Error(ExitCode::usage, "scene.wrap: expected clamp, repeat or mirror, found border");
    if (!(s.threshold >= least_threshold))
      throw Error(ExitCode::usage, fmt::format("drops.threshold: expected {} or more, found {}", least_threshold, s.threshold));
  }
  camera(s).basis();  // throws for an invalid camera
  scene_camera(s).half_height();
}

void check_scene(const Settings& s, const Image& colour) {
  if (colour.empty() || colour.channels() != 4) throw Error(ExitCode::usage, "scene.image: expected an image of four channels");
  if (colour.width() != s.width || colour.height() != s.height) {
    throw Error(ExitCode::usage, fmt::format("scene.image: expected {}x{} like the picture, found {}x{}", s.width, s.height, colour.width(),
                                             colour.height()));
  }
}
void check(const Settings& s, const Inputs& in) {
  check_scene(s, in.colour);
  if (!in.noise.empty() && in.noise.channels() != 4)
    throw Error(ExitCode::usage, fmt::format("noise.image: expected four channels, found {}", in.noise.channels()));
}

std::array<Layer, layers> make_layers(const Settings& s) {
  std::array<Layer, layers> all{};
  int row = 0;
  for (int l = 0; l < layers; ++l) {
    Layer& layer = all[static_cast<std::size_t>(l)];
    layer.cells_per_pixel = millimetres(s) / (cell_over_radius * s.largest_radius / (1 << l));
    const random::Block word = random::block(s.seed, random::Purpose::screen_layer, static_cast<std::uint32_t>(l), 0);
    for (std::size_t k = 0; k < 2; ++k) layer.offset[k] = static_cast<float>(word[k] >> 16) * 0x1p-16f;
    layer.columns = static_cast<int>(s.width * layer.cells_per_pixel + layer.offset[0]) + 1;
    layer.rows = static_cast<int>(s.height * layer.cells_per_pixel + layer.offset[1]) + 1;
    layer.first_row = row;
    row += layer.rows;
  }
  return all;
}
std::array<int, 2> cells_size(const std::array<Layer, layers>& all) {
  int columns = 1;
  for (const Layer& l : all) columns = std::max(columns, l.columns);
  return {columns, all.back().first_row + all.back().rows};
}

std::vector<Tap> make_taps(const Settings& s) {
  const double radius = s.defocus / s.scene_margin;  // in heights of the scene's picture
  const double golden = pi * (3 - __builtin_sqrt(5.0));
  std::vector<Tap> taps;
  for (int k = 0; k < tap_count; ++k) {
    const double r = radius * __builtin_sqrt((k + 0.5) / tap_count);
    const Real64 angle(k * golden);
    taps.push_back({static_cast<float>(r * cos_real(angle).v * s.height / s.width), static_cast<float>(r * sin_real(angle).v), 0, 0});
  }
  return taps;
}

BackgroundUniforms background_uniforms(const Settings& s) {
  BackgroundUniforms u{};
  u.resolution[0] = static_cast<float>(s.width);
  u.resolution[1] = static_cast<float>(s.height);
  u.level = static_cast<float>(s.blur_level);
  if (corrected(s)) {
    // A tap represents a square with the area of the disc divided by their number.
    const double side = s.defocus * s.height / s.scene_margin * __builtin_sqrt(pi / tap_count);
    u.level = static_cast<float>(log2_of(std::max(side, 1.0)));
    u.weight = static_cast<float>(1.0 / tap_count);
    const double sides[2] = {static_cast<double>(s.width), static_cast<double>(s.height)};
    for (int k = 0; k < 2; ++k) {
      u.scale[k] = static_cast<float>(1 / (sides[k] * s.scene_margin));
      u.offset[k] = static_cast<float>(0.5 - 0.5 / s.scene_margin);
    }
    u.tap_count = tap_count;
  }
  return u;
}

PublishedDropsUniforms published_drops_uniforms(const Settings& s, int frame) {
  PublishedDropsUniforms u{};
  u.resolution[0] = static_cast<float>(s.width);
  u.resolution[1] = static_cast<float>(s.height);
  u.time = static_cast<float>(frame / s.fps);
  u.grid = static_cast<float>(s.grid);
  u.keep = static_cast<float>(s.keep);
  u.refraction = static_cast<float>(s.refraction);
  u.printed_misprint = s.printed_misprint;
  u.noise_nearest = s.noise_filter == Filter::nearest;
  u.layers = s.layers;
  u.water_step = static_cast<float>(1.0 / s.layers);
  u.cell_angle = static_cast<float>(s.cell_angle);
  u.noise_middle = static_cast<float>(s.noise_middle);
  u.displacement = static_cast<float>(s.displacement);
  u.keep_from = static_cast<float>(s.keep_from);
  u.threshold = static_cast<float>(s.threshold);
  u.printed_normal = s.printed_normal;
  u.level = s.lod == Lod::fixed ? static_cast<float>(s.lod_level) : 0.0f;
  u.gradient_level = s.lod == Lod::gradient;
  return u;
}

CellsUniforms cells_uniforms(const Settings& s, const std::array<Layer, layers>& all, int frame) {
  CellsUniforms u{};
  u.seed[0] = static_cast<std::uint32_t>(s.seed);
  u.seed[1] = static_cast<std::uint32_t>(s.seed >> 32);
  const auto whole = [](double x) { return static_cast<std::uint32_t>(static_cast<std::uint64_t>(x + 0.5)); };
  u.tick = whole(frame / s.fps * 1e3);
  u.keep = whole(s.share * 65536);
  for (int l = 0; l < layers; ++l) {
    const Layer& layer = all[static_cast<std::size_t>(l)];
    u.columns[l] = layer.columns;
    u.rows[l] = layer.rows;
    u.first_row[l] = layer.first_row;
  }
  u.shortest = std::max<std::uint32_t>(1, whole(s.shortest_cycle * 1e3));
  u.span = std::max(u.shortest, whole(s.longest_cycle * 1e3)) - u.shortest;
  u.largest = static_cast<float>(1 / cell_over_radius);
  u.impact = static_cast<float>(s.impact);
  return u;
}

DropsUniforms drops_uniforms(const Settings& s, const std::array<Layer, layers>& all, const std::array<int, 2>& flow) {
  DropsUniforms u{};
  for (int l = 0; l < layers; ++l) {
    const Layer& layer = all[static_cast<std::size_t>(l)];
    u.cells_per_pixel[l] = static_cast<float>(layer.cells_per_pixel);
    u.offset_x[l] = layer.offset[0];
    u.offset_y[l] = layer.offset[1];
    u.pixels_per_cell[l] = static_cast<float>(1 / layer.cells_per_pixel);
    u.level[l] = level_of(s, 0.7 * s.largest_radius / (1 << l));
    u.first_row[l] = layer.first_row;
  }
  const double half_height = camera(s).half_height(), half_width = half_height * s.width / s.height;
  u.pixel[0] = static_cast<float>(2 * half_width / s.width);
  u.pixel[1] = static_cast<float>(2 * half_height / s.height);
  u.half_size[0] = static_cast<float>(half_width);
  u.half_size[1] = static_cast<float>(half_height);
  u.scene_scale[0] = static_cast<float>(0.5 / (half_width * s.scene_margin));
  u.scene_scale[1] = static_cast<float>(0.5 / (half_height * s.scene_margin));
  u.sine = static_cast<float>(sin_real(Real64(s.contact_angle_deg * pi / 180)).v);
  u.water_ior = static_cast<float>(s.water_ior);
  u.inner = static_cast<float>(s.inner);
  u.has_flow = flow[0] > 0;
  if (u.has_flow != 0) {
    u.flow_slope[0] = static_cast<float>(flow[0] / (2 * s.width * millimetres(s)));
    u.flow_slope[1] = static_cast<float>(flow[1] / (2 * s.height * millimetres(s)));
    u.flow_texel[0] = static_cast<float>(1.0 / flow[0]);
    u.flow_texel[1] = static_cast<float>(1.0 / flow[1]);
  }
  u.flow_pixel[0] = static_cast<float>(1.0 / s.width);
  u.flow_pixel[1] = static_cast<float>(1.0 / s.height);
  u.visible_from = static_cast<float>(visible_from);
  u.visible_to = static_cast<float>(visible_to);
  u.flow_level = u.level[0];
  return u;
}

Image make_noise(std::uint64_t seed, int side) {
  Image noise(Format::rgba8, side, side);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const random::Block word =
          random::block(seed, random::Purpose::screen_noise, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
      for (std::size_t k = 0; k < 4; ++k) noise.row<Unorm8>(y)[4 * x + static_cast<int>(k)].code = static_cast<std::uint8_t>(word[k] >> 24);
    }
  }
  return noise;
}
Image stored_noise(const Image& noise) {
  const TextureData decoded(noise, Address::repeat, Address::repeat);
  Image out(Format::rgba8, noise.width(), noise.height());
  const float* in = decoded.view().texels;
  for (int y = 0; y < noise.height(); ++y) {
    for (int i = 0; i < 4 * noise.width(); ++i) out.row<Unorm8>(y)[i] = to_unorm8(*in++, Rounding::rne);
  }
  return out;
}

std::vector<Image> scene_levels(const Image& colour, const Rows& rows) {
  TextureData decoded(colour, Address::clamp, Address::clamp, rows);
  const std::size_t count = static_cast<std::size_t>(4) * colour.width();
  rows(colour.height(), [&](int begin, int end) {
    float* const texels = decoded.texels();
    for (std::size_t i = static_cast<std::size_t>(begin) * count; i < static_cast<std::size_t>(end) * count; ++i)
      texels[i] = std::clamp(texels[i], 0.0f, 65504.0f);
  });
  decoded.build_mips(Texture::max_levels, rows);
  const Texture t = decoded.view();
  std::vector<Image> levels;
  for (int l = 0; l < t.levels; ++l) {
    Image level(Format::rgba16f, t.width[l], t.height[l]);
    const float* in = t.texels + static_cast<std::ptrdiff_t>(4) * t.offset[l];
    const std::size_t row = static_cast<std::size_t>(4) * level.width();
    rows(level.height(), [&](int begin, int end) {
      for (int y = begin; y < end; ++y) to_half_array(in + static_cast<std::size_t>(y) * row, level.row<Half>(y), row, Rounding::rne);
    });
    levels.push_back(std::move(level));
  }
  return levels;
}

}  // namespace rainref::screen_drops
