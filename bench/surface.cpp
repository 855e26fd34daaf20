// Speed of the passes on a pane's textures through the shells that users run. What a row says: README.md.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <random>
#include <string>

#include <fmt/format.h>

#include "blur_pyramid/blur_pyramid.h"
#include "capture/hashing.h"
#include "drops/splat/scalar.h"
#include "drops/splat/splat.h"
#include "goes.h"
#include "math/half.h"
#include "pass/run.h"
#include "stream.h"
#include "thread_counts.h"
#include "windshield/surface/surface.h"

namespace rainref {
namespace {

constexpr int tile_rows = 8;

std::string hash(const Image& image) { return capture::hash_of(BufferView(image)).text().substr(0, 16); }
template <class Body>
double best_of(int goes, const Body& body) {
  double best = 1e9;
  for (int i = 0; i < goes; ++i) best = std::min(best, bench::seconds_of(body));
  return best;
}

// ---- splat: drops of 69 texels on 2048 x 2048 halves ---------------------------------------------------------------------
constexpr int side = 2048;

drops::SplatSettings splat_settings(bool corrected) {
  drops::SplatSettings s;
  s.corrected = corrected;
  s.keys.width = s.keys.height = side;
  s.keys.half_accumulation = !corrected;
  s.keys.drop_radius = 4.15 / side;  // bounding boxes of about 8.3 x 8.3
  return s;
}
std::vector<drops::Drop> drops_of(std::int64_t count, double mass) {
  std::mt19937 words(1);
  std::vector<drops::Drop> all;
  for (std::int64_t i = 0; i < count; ++i) {
    const float u = static_cast<float>(words() * 0x1p-32), v = static_cast<float>(words() * 0x1p-32);
    all.push_back({{u, v}, {0, 0}, static_cast<float>(mass), 1, static_cast<std::uint32_t>(i), 0});
  }
  return all;
}
/// One drop after another, one texel after another, by the scalar evaluation.
void naive(const drops::SplatUniforms& u, std::span<const drops::Drop> all, Image& height) {
  using F = drops::scalar::Scalar<float>;
  for (int y = 0; y < side; ++y) std::fill_n(height.row<Half>(y), side, Half{0});
  for (const drops::Drop& d : all) {
    const auto s = drops::scalar::splat_stamp(u, F(d.position[0]), F(d.position[1]), F(d.mass), F(d.life));
    const float half_width = s.radius.v / u.frame[0], half_height = s.radius.v / u.frame[2];
    const int x0 = std::max(0, static_cast<int>(s.x.v - half_width)), x1 = std::min(side, static_cast<int>(s.x.v + half_width) + 1);
    const int y0 = std::max(0, static_cast<int>(s.y.v - half_height)), y1 = std::min(side, static_cast<int>(s.y.v + half_height) + 1);
    for (int y = y0; y < y1; ++y) {
      Half* row = height.row<Half>(y);
      for (int x = x0; x < x1; ++x) {
        const F drop = drops::scalar::splat_contribution<false>(u, drops::SplatKernel::paraboloid, s, F(static_cast<float>(x) + 0.5f),
                                                                F(static_cast<float>(y) + 0.5f));
        store(row + x, F::load(row + x) + drop, Rounding::rne);
      }
    }
  }
}
/// The shell on one thread, without any scheduling.
void serial(const drops::SplatUniforms& u, bool half, drops::Bands bands, std::span<const drops::Drop> all, Image& height,
            drops::SplatScratch& scratch) {
  scratch.chunks.resize((all.size() + drops::drops_of_chunk - 1) / drops::drops_of_chunk);
  for (std::size_t i = 0; i < scratch.chunks.size(); ++i) {
    const std::size_t begin = i * drops::drops_of_chunk;
    drops::make_stamps(u, bands, all.subspan(begin, std::min<std::size_t>(drops::drops_of_chunk, all.size() - begin)), {},
                       scratch.chunks[i]);
  }
  for (int band = 0; band < bands.count; ++band) drops::splat_band({u, half, Rounding::rne, nullptr, &height}, bands, band, scratch.chunks);
}

void splat(benchmark::State& state, bool corrected, std::int64_t count, int threads) {
  const parallel::Executor executor(threads);
  const drops::SplatSettings s = splat_settings(corrected);
  drops::SplatUniforms u = drops::splat_uniforms(s);
  u.drop_count = static_cast<std::int32_t>(count);
  double mass = 1;
  if (corrected) {
    const double root = s.keys.drop_radius / static_cast<double>(u.radius_scale);
    mass = root * root * root;
  }
  const std::vector<drops::Drop> all = drops_of(count, mass);
  Image height(Format::r16f, side, side), other(Format::r16f, side, side);
  drops::SplatScratch scratch, own;
  const bool half = s.keys.half_accumulation;
  const auto run = [&] { drops::splat(executor, u, half, Rounding::rne, all, {}, nullptr, height, scratch); };
  run();
  const int goes = count > 100000 ? 3 : 10;
  // In one band, which is the loop over all drops, or cut as the pass is, whichever is the faster.
  const auto one_thread_in = [&](drops::Bands bands) { return best_of(goes, [&] { serial(u, half, bands, all, other, own); }); };
  const double one_thread = std::min(one_thread_in({side, 1}), one_thread_in(drops::splat_bands(side)));
  // The scalar evaluation is the definition, and what a straightforward program does.
  const double plain = half ? best_of(count > 100000 ? 1 : 3, [&] { naive(u, all, other); }) : 0;
  bench::Goes timed(state);
  for (auto _ : state) timed.add([&] { return bench::seconds_of(run); });
  const double best = timed.best();
  state.counters["Mdrop/s"] = static_cast<double>(count) * 1e-6 / best;
  state.counters["x_serial"] = one_thread / best;
  if (half) state.counters["x_naive"] = plain / best;
  state.SetLabel(hash(height));
  if (half && hash(height) != hash(other)) state.SkipWithError("the scalar evaluation gives other bits");
}

// ---- passes over whole textures --------------------------------------------------------------------------------------------
constexpr int columns = 1920, rows = 1080;

Image filled(Format format, double scale) {
  std::mt19937 words(2);
  Image image(format, columns, rows);
  for (int y = 0; y < rows; ++y) {
    for (int i = 0; i < columns * image.channels(); ++i) {
      const float value = static_cast<float>(scale * (words() >> 8) * 0x1p-24);
      if (info(format).kind == FormatInfo::float16)
        image.row<Half>(y)[i] = to_half(value);
      else
        image.row<float>(y)[i] = value;
    }
  }
  return image;
}
void timed(benchmark::State& state, const parallel::Executor& executor, bench::Traffic traffic, const Image& out, const auto& run) {
  run();
  const double bound = bench::stream_seconds(executor, out.width(), out.height(), tile_rows, traffic);
  bench::Goes timed(state);
  for (auto _ : state) timed.add([&] { return bench::seconds_of(run); });
  const double best = timed.best();
  state.counters["Mpix/s"] = 1e-6 * out.width() * out.height() / best;
  state.counters["stream_%"] = 100 * bound / best;
  state.SetLabel(hash(out));
}
windshield::SurfaceSettings surface(bool corrected) {
  windshield::SurfaceSettings s;
  s.corrected = corrected;
  s.width = columns;
  s.height = rows;
  s.frame = {1.4, 0, 0.8};
  return s;
}
void normals(benchmark::State& state, bool corrected, int threads) {
  const parallel::Executor executor(threads);
  const Image height = filled(Format::r16f, 2), mask = filled(Format::r16f, 1);
  Image normal(Format::rgba16f, columns, rows);
  pass::HostIo<windshield::NormalsPass> io;
  io.height = height;
  io.mask = mask;
  io.normal = normal;
  pass::Run<windshield::NormalsPass> normals(windshield::normals_uniforms(surface(corrected)), corrected, Rounding::rne, io);
  timed(state, executor, {4, 8}, normal, [&] { normals.tiles(executor, 8); });
}
void wipe_texture(benchmark::State& state, bool corrected, int threads) {
  const parallel::Executor executor(threads);
  const windshield::SurfaceSettings s = surface(corrected);
  Image height = filled(Format::r16f, 2), mask = filled(Format::r16f, 1), wiped = filled(Format::r32f, 4);
  windshield::Wiper w{
      {0.3f, 0.3f}, {0.3f, 0.8f}, {0.35f, 0.3f}, {0.4f, 0.8f}, {0.5f, 0.05f}, 0.15f, 0.65f, {0.6f, 0.8f}, {0.5f, 0.866f}, 0.006f, 3, 1, 0};
  windshield::Wiper second = w;
  second.pivot[0] = 0.9f;
  const std::vector<windshield::Wiper> both{w, second};
  windshield::WipeTextureUniforms u = windshield::wipe_texture_uniforms(s, 0);
  u.wiper_count = static_cast<std::int32_t>(both.size());
  pass::Run<windshield::WipeTexturePass> wiping(u, corrected, Rounding::rne,
                                                windshield::wipe_texture_io(corrected, both, {&height, &mask, &wiped}));
  timed(state, executor, {0, corrected ? 8 : 4}, mask, [&] { wiping.tiles(executor, 8); });
  state.SetLabel("");  // it goes on from what it left
}
void blur(benchmark::State& state, bool corrected, int level, int threads) {
  const parallel::Executor executor(threads);
  blur_pyramid::BlurSettings s;
  s.corrected = corrected;
  const blur_pyramid::BlurUniforms u = blur_pyramid::blur_uniforms(s, columns, rows, level);
  const Image colour = filled(Format::rgba16f, 2);
  if (level == 0) {
    const Image depth = filled(Format::r32f, 100);
    Image out(Format::rgba16f, columns, rows);
    timed(state, executor, {12, 8}, out,
          [&] { blur_pyramid::fog_run(u, Rounding::rne, colour, depth, out).tiles(executor, blur_pyramid::tile_rows(out.height())); });
  } else {
    Image out(Format::rgba16f, columns / 2, rows / 2);
    timed(state, executor, {32, 8}, out, [&] {
      blur_pyramid::halve_run(u, corrected, Rounding::rne, colour, out).tiles(executor, blur_pyramid::tile_rows(out.height()));
    });
  }
}

void add(const std::string& name, const std::function<void(benchmark::State&)>& run) {
  benchmark::RegisterBenchmark(name.c_str(), run)->UseManualTime()->Unit(benchmark::kMillisecond);
}
const bool registered = [] {
  for (const bool corrected : {false, true}) {
    const char* variant = corrected ? "corrected" : "as-published";
    for (const int threads : bench::thread_counts()) {
      for (const std::int64_t count : {1000, 10000, 100000, 1000000}) {
        add(fmt::format("splat/{}/{}/threads:{}", variant, count, threads),
            [=](benchmark::State& s) { splat(s, corrected, count, threads); });
      }
      add(fmt::format("wipe_texture/{}/1920x1080/threads:{}", variant, threads),
          [=](benchmark::State& s) { wipe_texture(s, corrected, threads); });
      add(fmt::format("normals/{}/1920x1080/threads:{}", variant, threads), [=](benchmark::State& s) { normals(s, corrected, threads); });
      for (const int level : {0, 1}) {
        add(fmt::format("blur_pyramid/{}/1920x1080.L{}/threads:{}", variant, level, threads),
            [=](benchmark::State& s) { blur(s, corrected, level, threads); });
      }
    }
  }
  return true;
}();

}  // namespace
}  // namespace rainref
