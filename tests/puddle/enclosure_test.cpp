// The passes of the puddle, read as enclosures: the reference and any conforming GPU lie inside, under every profile.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "image/footprint.h"
#include "image/random_sampler.h"
#include "math/constants.h"
#include "math/profiles.h"
#include "puddle/captured_scene.h"
#include "puddle/checkerboard.h"
#include "puddle/host.h"
#include "puddle/scalar.h"
#include "puddle/uniforms.h"

namespace rainref::puddle {
namespace text = scalar;

namespace {

using enclosed::Enclosure;
using enclosed::PathEnumeration;
using enclosed::Profile;
using enclosed::ProfileScope;
using random_gpu::RandomGpu;
using Single = scalar::Scalar<float>;
template <class N>
using Vec3 = scalar::Vec3<N>;

template <class N>
using Values = std::array<N, 3>;
template <class N>
Values<N> values(const Vec3<N>& v) {
  return {v.x, v.y, v.z};
}

// What the enclosures of many invocations of one pass under one profile were like.
struct Account {
  int channels = 3;  // that the pass gives; the others are constant
  int elements = 0, open = 0, vacuous = 0, outside_reference = 0, outside_gpu = 0, gpu_runs = 0, gpu_differs = 0;
  std::vector<double> widths{}, looseness{};  // looseness: width over the spread of the random GPUs
  std::string first_outside{};

  void print(const std::string& pass, const std::string& profile) {
    const auto at = [](std::vector<double>& x, double q) {
      std::sort(x.begin(), x.end());
      return x.empty() ? 0.0 : x[static_cast<std::size_t>(q * static_cast<double>(x.size() - 1))];
    };
    fmt::print(
        "{:<28} {:<8} open {:4}  vacuous {:4} of {}  width median {:8.0f} p90 {:9.0f} ULP  gpu runs that differ "
        "{:5.1f} %  width / spread {:.2f}\n",
        pass, profile, open, vacuous, elements, at(widths, 0.5), at(widths, 0.9), gpu_runs ? 100.0 * gpu_differs / gpu_runs : 0.0,
        at(looseness, 0.5));
  }
};

// pass(N()) gives the values of an invocation by the number N.
template <class Pass>
void judge(Account& account, const Pass& pass) {
  // RAINREF_GPUS=1000 shows how tight the enclosures are, in minutes.
  static const int gpus = std::getenv("RAINREF_GPUS") ? std::atoi(std::getenv("RAINREF_GPUS")) : 5;
  struct Alternative {
    Values<Enclosure> v;
  };
  std::vector<Alternative> alternatives;
  PathEnumeration paths;
  const bool whole = paths.for_each_alternative([&] { alternatives.push_back({pass(Enclosure())}); });
  ++account.elements;
  account.open += alternatives.size() > 1;
  const auto held = [&](const auto& value) {
    return std::any_of(alternatives.begin(), alternatives.end(), [&](const Alternative& a) {
      return a.v[0].contains(value[0].v) && a.v[1].contains(value[1].v) && a.v[2].contains(value[2].v);
    });
  };
  const bool vacuous =
      !whole || std::any_of(alternatives.begin(), alternatives.end(), [](const Alternative& a) { return a.v[0].is_vacuous(); });
  account.vacuous += vacuous;
  const Values<Single> reference = pass(Single());
  if (!whole) return;
  if (!vacuous) {
    for (int k = 0; k < account.channels; ++k) account.widths.push_back(alternatives[0].v[k].width_in_ulp());
  }
  if (!held(reference)) {
    ++account.outside_reference;
    account.first_outside = fmt::format("reference {} {} {} in [{}, {}] [{}, {}] [{}, {}]", reference[0].v, reference[1].v, reference[2].v,
                                        alternatives[0].v[0].lo, alternatives[0].v[0].hi, alternatives[0].v[1].lo, alternatives[0].v[1].hi,
                                        alternatives[0].v[2].lo, alternatives[0].v[2].hi);
  }
  if (enclosed::profile().reference) {
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(std::bit_cast<std::uint32_t>(alternatives[0].v[k].lo), std::bit_cast<std::uint32_t>(reference[k].v));
      EXPECT_TRUE(alternatives[0].v[k].is_point());
    }
    return;
  }
  Values<float> low{reference[0].v, reference[1].v, reference[2].v}, high = low;
  for (int i = 0; i < gpus; ++i) {
    const Values<RandomGpu> got = pass(RandomGpu());
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], got[k].v);
      high[k] = std::max(high[k], got[k].v);
    }
    ++account.gpu_runs;
    account.gpu_differs += got[0].v != reference[0].v || got[1].v != reference[1].v || got[2].v != reference[2].v;
    if (held(got)) continue;
    ++account.outside_gpu;
    account.first_outside = fmt::format("gpu {} {} {} in [{}, {}] [{}, {}] [{}, {}], reference {} {} {}", got[0].v, got[1].v, got[2].v,
                                        alternatives[0].v[0].lo, alternatives[0].v[0].hi, alternatives[0].v[1].lo, alternatives[0].v[1].hi,
                                        alternatives[0].v[2].lo, alternatives[0].v[2].hi, reference[0].v, reference[1].v, reference[2].v);
  }
  if (vacuous || alternatives.size() > 1) return;
  for (int k = 0; k < account.channels; ++k) {
    if (high[k] > low[k])
      account.looseness.push_back((static_cast<double>(alternatives[0].v[k].hi) - alternatives[0].v[k].lo) /
                                  (static_cast<double>(high[k]) - low[k]));
  }
}
void expect_inside(Account& account, const std::string& pass, const std::string& profile) {
  account.print(pass, profile);
  EXPECT_EQ(account.outside_reference, 0) << pass << ' ' << profile << ": " << account.first_outside;
  EXPECT_EQ(account.outside_gpu, 0) << pass << ' ' << profile << ": " << account.first_outside;
}

template <class N>
text::Surface<N> surface(const Scene& s, int x, int y) {
  const float* h = s.puddle->hit().row<float>(y) + 4 * x;
  const Half* n = s.puddle->normal().row<Half>(y) + 4 * x;
  return {Vec3<N>(N::load(h), N::load(h + 1), N::load(h + 2)), Vec3<N>(N::load(n), N::load(n + 1), N::load(n + 2)), N::load(n + 3)};
}
const std::string names[] = {"puddle/as-published/rg16f", "puddle/corrected/rg16f", "puddle/as-published/rg32f", "puddle/corrected/rg32f"};

TEST(PuddleEnclosure, WaveStepHoldsTheReferenceAndEveryGpu) {
  for (const std::string& name : names) {
    const Scene& s = scene(name);
    const auto [width, height] = wave_size(s.settings);
    Settings settings = s.settings;
    settings.rim_width = name == "puddle/corrected/rg32f" ? 12 * settings.cell_size : 0;
    WaveStepUniforms u = wave_step_uniforms(settings);
    u.drop_count = static_cast<int>(s.drops.size());
    for (const Profile& p : test::profiles()) {
      const ProfileScope scope(p);
      Account account{.channels = s.corrected ? 2 : 1};
      for (int i = 0; i < 400; ++i) {
        const int x = 2 + i * 37 % (width - 4), y = 2 + i * 11 % (height - 4);
        const float* here = s.newest.data() + static_cast<std::ptrdiff_t>(y) * width;
        const auto newest = [&](int dy) { return here + static_cast<std::ptrdiff_t>(dy) * width; };
        const auto rows =
            text::rows_around<float>(u, s.corrected, newest, s.previous.data() + static_cast<std::ptrdiff_t>(y) * width, nullptr);
        judge(account, [&]<class N>(N) -> Values<N> {
          if (!s.corrected) return {text::wave_step_as_published<N>(u, rows, s.drops, x, y), N(0.0f), N(0.0f)};
          return {text::wave_step_corrected<N>(u, rows, s.drops, x, y), text::wave_previous_corrected<N>(here, nullptr, s.drops, x, y),
                  N(0.0f)};
        });
      }
      expect_inside(account, "wave_step " + name.substr(7), p.name);
      EXPECT_EQ(account.vacuous, 0);
    }
  }
}

TEST(PuddleEnclosure, ShadeHoldsTheReferenceAndEveryGpu) {
  for (const std::string& name : {names[0], names[1]}) {
    const Scene& s = scene(name);
    for (const Profile& p : test::profiles()) {
      const ProfileScope scope(p);
      Account account;
      for (int i = 0; i < 400; ++i) {
        const int x = i * 37 % s.settings.width, y = i * 11 % s.settings.height;
        judge(account, [&]<class N>(N) -> Values<N> {
          if (s.corrected) {
            return values(text::shade_corrected<N>(s.shade, s.environment.view(), s.ground.view(), s.relief.view(), s.bed.view(),
                                                   surface<N>(s, x, y), x, y));
          }
          return values(text::shade_as_published<N>(s.shade, s.environment.view(), s.ground.view(), surface<N>(s, x, y), N(0.25f), x, y));
        });
      }
      expect_inside(account, "shade " + name.substr(7), p.name);
    }
  }
}

TEST(PuddleEnclosure, DisplayHoldsTheReferenceAndEveryGpu) {
  for (const std::string& name : {names[0], names[1]}) {
    const Scene& s = scene(name);
    const DisplayUniforms u = display_uniforms(s.settings);
    for (const Profile& p : test::profiles()) {
      const ProfileScope scope(p);
      Account account;
      for (int i = 0; i < 400; ++i) {
        const int x = i * 37 % s.settings.width, y = i * 11 % s.settings.height;
        const Half* c = s.puddle->colour().row<Half>(y) + 4 * x;
        judge(account, [&]<class N>(N) -> Values<N> {
          const Vec3<N> colour(N::load(c), N::load(c + 1), N::load(c + 2));
          return values(s.corrected ? text::display_corrected<N>(u, colour, x, y) : text::display_as_published<N>(u, colour, x, y));
        });
      }
      expect_inside(account, "display " + name.substr(7), p.name);
      EXPECT_EQ(account.vacuous, 0);
    }
  }
}

TEST(PuddleEnclosure, RaindropsHoldTheReferenceAndEveryGpu) {
  const Scene& s = scene(names[0]);
  for (const Profile& p : test::profiles()) {
    const ProfileScope scope(p);
    Account account;
    for (int frame = 0; frame < 40; ++frame) {
      const RaindropsUniforms u = raindrops_uniforms(s.settings, frame);
      for (int i = 0; i < s.settings.drop_count; ++i) {
        judge(account, [&]<class N>(N) -> Values<N> { return values(text::raindrop_as_published<N>(u, i)); });
      }
    }
    expect_inside(account, "raindrops", p.name);
  }
}

// The marches are judged by what they find, not by an enclosure of their steps; what that takes is here.
TEST(PuddleEnclosure, WhatTheMarchesAreJudgedByHoldsTheReference) {
  for (const std::string& name : {names[0], names[1]}) {
    const Scene& s = scene(name);
    const auto [width, height] = wave_size(s.settings);
    const TextureData water(s.corrected ? s.newest : s.previous, 1, width, height, Address::clamp, Address::clamp);
    const SurfaceHitUniforms u = surface_hit_uniforms(s.settings);
    for (const Profile& p : test::profiles()) {
      const ProfileScope scope(p);
      Account ray, distance{.channels = s.corrected ? 3 : 1};
      for (int i = 0; i < 400; ++i) {
        const int x = i * 37 % s.settings.width, y = i * 11 % s.settings.height;
        judge(ray, [&]<class N>(N) { return values(text::camera_ray<N>(u.camera, N::index(x), N(static_cast<float>(y)))); });
        judge(distance, [&]<class N>(N) -> Values<N> {
          const Vec3<N> place = surface<N>(s, x, y).position;
          if (!s.corrected) return {text::scene_distance<N>(u, water.view(), place), N(0.0f), N(0.0f)};
          const N q = place.x * N(u.inverse_size[0]) + N(0.5f), r = place.z * N(u.inverse_size[1]) + N(0.5f);
          const text::Neighbours<N> near = text::sample_neighbours<0, N>(water.view(), q, r);
          return {text::water_height<N>(u, water.view(), q, r), near.left - near.right, near.down - near.up};
        });
      }
      expect_inside(ray, "camera_ray " + name.substr(7), p.name);
      expect_inside(distance, "distance " + name.substr(7), p.name);
    }
  }
}

}  // namespace

// The whole texts instantiate.
template scalar::SurfaceHit<Enclosure> scalar::surface_hit_as_published<Enclosure>(const SurfaceHitUniforms&, const Texture&, int, int);
template scalar::SurfaceHit<Enclosure> scalar::surface_hit_corrected<Enclosure>(const SurfaceHitUniforms&, const Texture&, const Texture&,
                                                                                int, int);
template Enclosure scalar::ground_noise_as_published<Enclosure>(const GroundNoiseUniforms&, const text::Surface<Enclosure>&, int, int);

}  // namespace rainref::puddle
