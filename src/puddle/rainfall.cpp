#include "puddle/rainfall.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/number_text.h"
#include "image/texture.h"
#include "math/constants.h"
#include "rain/rain.h"
#include "rainref/error.h"
#include "random/draws.h"
#include "scene/rows_of_text.h"

namespace rainref::puddle {
namespace {

constexpr double energy_share = 0.01;                            // share of the impact energy that goes into the wave; the rest goes into
                                                                 // splashes and stirring
constexpr double crater_per_diameter = 7;                        // crater radius over drop diameter
constexpr std::int32_t reflecting = 0, periodic = 1, fixed = 2;  // RainfallUniforms::boundary

}  // namespace

WaterEdges edges_of(const Settings& s) {
  return {static_cast<std::uint32_t>(s.grid[0]), static_cast<std::uint32_t>(s.grid[1]),
          s.boundary == Boundary::reflecting ? reflecting
          : s.boundary == Boundary::periodic ? periodic
                                             : fixed};
}

void add_with_images(const Drop& drop, const WaterEdges& e, std::vector<Drop>& out) {
  out.push_back(drop);
  if (e.boundary == fixed) return;
  const auto reaches = [&](float at, std::uint32_t size) { return at + drop.radius > 0 && at - drop.radius < static_cast<float>(size); };
  // The position, and its image beyond the lower and the upper edge of a side; exact, because positions have few bits.
  const auto images = [&](float at, std::uint32_t size) {
    const auto side = static_cast<float>(size);
    return e.boundary == periodic ? std::array{at, at - side, at + side} : std::array{at, -at, 2 * side - at};
  };
  const auto xs = images(drop.x, e.columns), ys = images(drop.y, e.rows);
  for (std::size_t j = 0; j < ys.size(); ++j) {
    for (std::size_t i = 0; i < xs.size(); ++i) {
      if ((i > 0 || j > 0) && reaches(xs[i], e.columns) && reaches(ys[j], e.rows))
        out.push_back({xs[i], ys[j], drop.amplitude, drop.radius});
    }
  }
}

double crater_depth(double diameter, double speed, double radius) {
  return __builtin_sqrt(energy_share * diameter * diameter * diameter * speed * speed * 35 / (18 * standard_gravity * radius * radius));
}

Rainfall::Rainfall(const Settings& s, double stored_per_metre, Shelter shelter)
    : seed_(s.seed), edges_(edges_of(s)), shelter_(std::move(shelter)) {
  const rain::DropSizes sizes_of_rain(s.rain_rate, s.smallest_drop);
  const double area = s.grid[0] * s.cell_size * (s.grid[1] * s.cell_size);
  mean_ = sizes_of_rain.flux() * area / s.step_rate;
  count_ = random::PoissonTable(mean_);
  for (const double diameter_mm : sizes_of_rain.quantiles(sizes)) {
    const double diameter = diameter_mm * 1e-3;
    const double radius = std::max(crater_per_diameter * diameter, least_crater_radius * s.cell_size);
    const double depth = crater_depth(diameter, rain::terminal_velocity(diameter_mm), radius);
    craters_.push_back({0, 0, static_cast<float>(-depth * s.drop_intensity * stored_per_metre), static_cast<float>(radius / s.cell_size)});
  }
}

template <class W>
std::vector<Drop> drops_of(const RainfallUniforms& u, const RainTables& tables) {
  const auto& [craters, thresholds, shelter, objects] = tables;
  constexpr std::int32_t most = 4 * static_cast<std::int32_t>(random::PoissonTable::max_mean);
  if ((!craters.empty() && craters.size() != Rainfall::sizes) || u.threshold_count < 0 ||
      static_cast<std::size_t>(u.threshold_count) > thresholds.size() || u.first_count < 0 || u.first_count > most ||
      u.threshold_count > most) {
    throw Error(
        ExitCode::port_files,
        fmt::format(
            "raindrops: expected {} craters and at most {} thresholds, found {} craters, {} thresholds, first_count {}, threshold_count {}",
            int{Rainfall::sizes}, most, craters.size(), thresholds.size(), u.first_count, u.threshold_count));
  }
  if (u.shelter_columns > 65536 || u.shelter_rows > 65536 || std::uint64_t{u.shelter_columns} * u.shelter_rows != shelter.size() ||
      u.object_count < 0 || static_cast<std::size_t>(u.object_count) > objects.size()) {
    throw Error(ExitCode::port_files, fmt::format("raindrops: expected a shelter of {} x {} and {} objects, found {} and {} records",
                                                  u.shelter_columns, u.shelter_rows, u.object_count, shelter.size(), objects.size()));
  }
  std::vector<Drop> out;
  const std::uint64_t seed = u.seed[0] | static_cast<std::uint64_t>(u.seed[1]) << 32;
  const auto used = thresholds.first(static_cast<std::size_t>(u.threshold_count));
  const auto drawn = W::count(W::block(seed, random::Purpose::puddle_drop_count, u.step, 0)[0], u.first_count, used);
  const int count = craters.empty() ? 0 : drawn;
  for (int i = 0; i < count; ++i) {
    const auto r = W::block(seed, random::Purpose::puddle_drop, u.step, static_cast<std::uint32_t>(i));
    if (!shelter.empty()) {
      const std::uint32_t column = ((r[0] >> 16) * u.shelter_columns) >> 16, row = ((r[1] >> 16) * u.shelter_rows) >> 16;
      if ((r[3] >> 16) >= shelter[column + std::size_t{u.shelter_columns} * row].open) continue;
    }
    Drop drop = craters[r[2] >> 22];
    drop.x = static_cast<float>(((r[0] >> 16) * u.columns) >> 8) * 0x1p-8f;
    drop.y = static_cast<float>(((r[1] >> 16) * u.rows) >> 8) * 0x1p-8f;
    add_with_images(drop, {u.columns, u.rows, u.boundary}, out);
  }
  out.insert(out.end(), objects.begin(), objects.begin() + u.object_count);
  return out;
}
template std::vector<Drop> drops_of<random::Words>(const RainfallUniforms&, const RainTables&);
template std::vector<Drop> drops_of<random::PerturbedWords>(const RainfallUniforms&, const RainTables&);

std::vector<Drop> Rainfall::drops(std::int64_t step, std::span<const Drop> objects) const {
  return drops_of(uniforms(step, objects.size()), {craters_, count_.thresholds(), shelter_.cells, objects});
}

RainfallUniforms Rainfall::uniforms(std::int64_t step, std::size_t objects) const {
  RainfallUniforms u{};
  u.seed[0] = static_cast<std::uint32_t>(seed_);
  u.seed[1] = static_cast<std::uint32_t>(seed_ >> 32);
  // Steps wrap at 2^32: at 240 steps per second after 207 days.
  u.step = static_cast<std::uint32_t>(step);
  u.first_count = count_.first();
  u.columns = edges_.columns;
  u.rows = edges_.rows;
  u.boundary = edges_.boundary;
  u.threshold_count = static_cast<std::int32_t>(count_.thresholds().size());
  u.shelter_columns = static_cast<std::uint32_t>(shelter_.columns);
  u.shelter_rows = static_cast<std::uint32_t>(shelter_.rows);
  u.object_count = static_cast<std::int32_t>(objects);
  return u;
}

namespace {

constexpr std::size_t most_roofs = 64;
constexpr double farthest_roof = 1e4;  // [m]
constexpr int most_shelter_texels = 8192;

ShelterCell open(double share) { return {static_cast<std::uint32_t>(std::clamp(share, 0.0, 1.0) * 65536 + 0.5)}; }
/// Share of [from, to] that lies in [low, high].
double covered(double from, double to, double low, double high) {
  return std::max(std::min(to, high) - std::max(from, low), 0.0) / (to - from);
}

}  // namespace

std::vector<Roof> parse_roofs(std::string_view text) {
  std::vector<Roof> roofs;
  for (const std::string_view row : scene::split(text, ';')) {
    if (row.empty()) continue;
    const auto fail = [&] {
      throw Error(ExitCode::usage,
                  fmt::format("rain.shelter, roof {}: expected \"x0 z0 x1 z1\", the lower corner first, numbers of at most "
                              "{:g} m, and at most {} roofs; found '{}'",
                              roofs.size() + 1, farthest_roof, most_roofs, row));
    };
    double at[4];
    const std::vector<std::string_view> words = scene::words_of(row);
    if (words.size() != 4 || roofs.size() == most_roofs) fail();
    for (std::size_t k = 0; k < 4; ++k) {
      at[k] = number_from<double>(words[k]).value_or(2 * farthest_roof);
      if (!(std::abs(at[k]) <= farthest_roof)) fail();
    }
    if (!(at[0] < at[2] && at[1] < at[3])) fail();
    roofs.push_back({at[0], at[1], at[2], at[3]});
  }
  return roofs;
}

Shelter shelter_of(const Settings& s, const Image& picture) {
  const std::vector<Roof> roofs = parse_roofs(s.shelter);
  Shelter shelter;
  if (!picture.empty()) {
    if (!roofs.empty()) throw Error(ExitCode::usage, "rain.shelter: expected none beside rain.shelter_image");
    if (std::max(picture.width(), picture.height()) > most_shelter_texels)
      throw Error(ExitCode::usage, fmt::format("rain.shelter_image: expected at most {0}x{0} texels, found {1}x{2}", most_shelter_texels,
                                               picture.width(), picture.height()));
    const TextureData texels(picture, Address::clamp, Address::clamp);
    const Texture& t = texels.view();
    shelter = {picture.width(), picture.height(), {}};
    for (std::ptrdiff_t k = 0; k < static_cast<std::ptrdiff_t>(shelter.columns) * shelter.rows; ++k)
      shelter.cells.push_back(open(t.texels[t.channels * k]));
  } else if (!roofs.empty()) {
    shelter = {s.grid[0], s.grid[1], {}};
    for (int row = 0; row < shelter.rows; ++row) {
      for (int column = 0; column < shelter.columns; ++column) {
        double share = 1;
        const double x = (column - 0.5 * shelter.columns) * s.cell_size, z = (row - 0.5 * shelter.rows) * s.cell_size;
        for (const Roof& r : roofs) share -= covered(x, x + s.cell_size, r.x0, r.x1) * covered(z, z + s.cell_size, r.z0, r.z1);
        shelter.cells.push_back(open(share));
      }
    }
  }
  return shelter;
}

}  // namespace rainref::puddle
