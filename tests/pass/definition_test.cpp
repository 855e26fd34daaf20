// What is made of a definition: lanes against loops written here by hand, the judge's evaluations, what is declared and recorded.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "base/error_of.h"
#include "capture/check_case.h"
#include "image/footprint.h"
#include "image/images.h"
#include "image/texture.h"
#include "math/simd_target.h"
#include "pass/frost.pass.h"
#include "pass/info.h"
#include "pass/model.h"
#include "pass/run.h"
#include "pass/same_as_definition.h"

namespace rainref::frost {
namespace scalar {
using namespace rainref::scalar;
#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "image/sampling_numbers-inl.h"
#include "pass/frost.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA
}  // namespace scalar
namespace {

using testing::ElementsAre;

template <class Storage>
Image noise(Format format, int width, int height, unsigned seed) {
  std::mt19937 words(seed);
  return make_image(format, width, height, [&](int, int, int) {
    const float value = static_cast<float>(words() >> 8) * 0x1p-24f;
    if constexpr (std::is_same_v<Storage, Half>)
      return to_half(value);
    else if constexpr (std::is_same_v<Storage, Unorm8>)
      return to_unorm8(value);
    else
      return value;
  });
}

/// A pane of frost and its two passes.
struct Pane {
  int width, height;
  Image heights, mask, tint, thickness, picture, thick;
  TextureData sky;
  std::vector<Seed> seeds{{1, 0.25f}, {4.5f, 0.7f}};
  GrowUniforms grow{0.7f, 0.3f, 2, 0};
  ShineUniforms shine{0.9f, 0.4f, 1, 0};

  Pane(int w, int h)
      : width(w),
        height(h),
        heights(noise<Half>(Format::r16f, w, h, 1)),
        mask(noise<Unorm8>(Format::r8, w, h, 2)),
        tint(noise<Half>(Format::rgba16f, w, h, 3)),
        thickness(Format::r32f, w, h),
        picture(Format::rgba8, w, h),
        thick(Format::r8, w, h),
        sky({0.5f, 0.75f, 0.25f, 1.0f}, 4, 1, 1, Address::clamp, Address::clamp) {}

  pass::HostIo<GrowPass> grow_io(bool corrected) {
    pass::HostIo<GrowPass> io;
    io.height = heights;
    io.mask = mask;
    if (corrected) io.seeds = seeds;
    io.thickness = thickness;
    return io;
  }
  pass::HostIo<ShinePass> shine_io() {
    pass::HostIo<ShinePass> io;
    io.thickness = thickness;
    io.sky = sky.view();
    io.tint = tint;
    io.picture = picture;
    io.thick = thick;
    return io;
  }
  void frame(const parallel::Executor& executor, bool corrected, Rounding rounding, Recorder* recorder = nullptr) {
    const pass::Moment now{recorder, 5, 0, 0.25, 0.05, rounding};
    pass::Run<GrowPass> growing(grow, corrected, rounding, grow_io(corrected));
    growing.start(now);
    growing.tiles(executor, 2);
    growing.finish(now);
    if (!corrected) return;
    pass::Run<ShinePass> shining(shine, corrected, rounding, shine_io());
    shining.start(now);
    executor.for_tiles(width, height, width, 3, [&](const parallel::Tile& t) { shining.tile(t); });
    shining.finish(now, executor.threads());
  }

  // The arithmetic again, by hand.
  float height_at(int x, int y) const { return to_float(heights.row<Half>(std::clamp(y, 0, height - 1))[std::clamp(x, 0, width - 1)]); }
  float expected_thickness(bool corrected, int x, int y) const {
    const float slope = grow.gain * (height_at(x - 2, y - 1) - height_at(x + 1, y + 2)), m = to_float(mask.row<Unorm8>(y)[x]);
    if (!corrected) return slope + m;
    float t = slope * m + grow.rate * height_at(x, y);
    for (const Seed& s : seeds) t = t + s.strength * std::max(1.0f - std::abs(static_cast<float>(x) - s.column), 0.0f);
    return t;
  }
};

TEST(Definition, LanesGiveTheBitsOfLoopsWrittenByHand) {
  parallel::Executor executors[] = {parallel::Executor(1), parallel::Executor(2), parallel::Executor(3), parallel::Executor(8)};
  for (const std::string& target : simd_targets()) {
    select_simd_target(target);
    for (int width = 1; width <= 33; ++width) {
      for (const bool corrected : {false, true}) {
        for (parallel::Executor& executor : executors) {
          Pane p(width, 7);
          executor.shuffle_tiles(static_cast<std::uint64_t>(width));
          const Rounding rounding = width % 2 ? Rounding::rne : Rounding::rtz;
          p.frame(executor, corrected, rounding);
          for (int y = 0; y < 7; ++y) {
            for (int x = 0; x < width; ++x) {
              const float t = p.expected_thickness(corrected, x, y), v = p.shine.scale * t;
              ASSERT_EQ(p.thickness.row<float>(y)[x], t) << target << ' ' << width << ": " << x << ", " << y;
              if (!corrected) continue;
              for (int c = 0; c < 3; ++c)
                ASSERT_EQ(p.picture.row<Unorm8>(y)[4 * x + c].code,
                          to_unorm8(v * p.sky.view().texels[c] * to_float(p.tint.row<Half>(y)[4 * x + c]), rounding).code)
                    << target << ' ' << width;
              ASSERT_EQ(p.picture.row<Unorm8>(y)[4 * x + 3].code, 255);
              ASSERT_EQ(p.thick.row<Unorm8>(y)[x].code, v >= p.shine.threshold ? 255 : 0);
            }
          }
        }
      }
    }
  }
  select_simd_target("");
}

capture::EffectInfo frost() {
  capture::EffectInfo info;
  info.name = "frost";
  info.passes = {pass::info_of<GrowPass>(), pass::info_of<ShinePass>()};
  info.records = {
      scene::record<Seed>({scene::member<&Seed::column>("texel", "Of the crystal."), scene::member<&Seed::strength>("mm", "There.")})};
  info.buffers = {{"height", "r16f", "Of the glass."},
                  {"mask", "r8", "Where ice may be."},
                  {"seeds", "records", "Crystals.", "1", {0, 1}, "none", "none", "none", "", "Seed", "corrected"},
                  {"sky", "rgba32f", "Radiance."},
                  {"tint", "rgba16f", "Of the ice."}};
  for (const capture::BufferInfo& b : pass::buffers_of<GrowPass>()) info.buffers.push_back(b);
  for (const capture::BufferInfo& b : pass::buffers_of<ShinePass>()) info.buffers.push_back(b);
  return info;
}
std::vector<capture::PassCase> captured(Pane& p, bool corrected, Rounding rounding = Rounding::rne) {
  static const capture::EffectInfo info = frost();
  const std::vector<capture::PassCase> cases = rainref::test::captured(
      info, corrected, "", [&](Recorder& recorder) { p.frame(parallel::Executor(2), corrected, rounding, &recorder); });
  for (const capture::PassCase& c : cases) {
    capture::check_case(info, {}, c);
    EXPECT_EQ(capture::uniform_fault(info, c), "");
  }
  return cases;
}

TEST(Definition, SaysWhatThePassIs) {
  const capture::EffectInfo info = frost();
  const capture::PassInfo& grow = info.pass("grow");
  EXPECT_EQ(grow.sentence, "Ice on the pane.");
  ASSERT_EQ(grow.variants.size(), 2u);
  EXPECT_EQ(capture::formula(info, grow, grow.variants[0]), "frost.grow.as-published/3");
  EXPECT_EQ(capture::formula(info, grow, grow.variants[1]), "frost.grow.corrected/4");
  EXPECT_EQ(grow.block("corrected").name, "GrowUniforms");
  ASSERT_EQ(grow.reads.size(), 3u);
  EXPECT_EQ(grow.reads[0].buffer, "height");
  EXPECT_TRUE(grow.reads[0].per_texel);
  EXPECT_EQ(grow.reads[2].buffer, "seeds");
  EXPECT_EQ(grow.reads[2].variant, "corrected");
  EXPECT_FALSE(grow.reads[2].per_texel);
  EXPECT_THAT(grow.writes, ElementsAre("thickness"));
  EXPECT_THAT(grow.order_free_sums, ElementsAre("the seeds"));
  EXPECT_EQ(info.buffer("thickness", "as-published").sentence, "Of the ice, as printed.");
  EXPECT_EQ(info.buffer("thickness", "corrected").sentence, "Of the ice.");
  EXPECT_EQ(info.buffer("picture", "corrected").format, "rgba8");
  EXPECT_THAT(info.pass_names("as-published"), ElementsAre("grow"));
  const capture::PassInfo& shine = info.pass("shine");
  EXPECT_EQ(shine.reads[0].from, "grow");
  EXPECT_FALSE(shine.reads[1].per_texel) << "looked up by coordinates";
}

TEST(Definition, IsRecordedAsItRan) {
  Pane p(9, 5);
  const std::vector<capture::PassCase> cases = captured(p, true, Rounding::rtz);
  ASSERT_EQ(cases.size(), 2u);
  const capture::PassCase &grow = cases[0], &shine = cases[1];
  EXPECT_EQ(grow.pass, "grow");
  EXPECT_EQ(grow.frame, 5);
  EXPECT_EQ(grow.time, 0.25f);
  EXPECT_EQ(grow.dt, 0.05f);
  const auto names = [](const auto& list) {
    std::vector<std::string> all;
    for (const auto& one : list) all.push_back(one.name);
    return all;
  };
  EXPECT_THAT(names(grow.inputs), ElementsAre("height", "mask", "seeds"));
  EXPECT_THAT(names(grow.outputs), ElementsAre("thickness"));
  EXPECT_THAT(names(shine.inputs), ElementsAre("thickness", "sky", "tint"));
  EXPECT_THAT(names(shine.outputs), ElementsAre("picture", "thick"));
  EXPECT_EQ(shine.outputs[0].store_rounding, Rounding::rtz);
  EXPECT_EQ(shine.input("sky")->filter, Filter::linear);
  EXPECT_EQ(shine.input("tint")->filter, Filter::none);
  EXPECT_THAT(names(captured(p, false)[0].inputs), ElementsAre("height", "mask"));
}

TEST(Definition, TheJudgesEvaluationsAreOfTheSameText) {
  for (const bool corrected : {false, true}) {
    Pane p(9, 5);
    const std::vector<capture::PassCase> cases = captured(p, corrected);
    const auto grow = pass::bind<GrowPass, scalar::GrowPassText>(cases[0]);
    ASSERT_EQ(grow->width(), 9);
    ASSERT_EQ(grow->height(), 5);
    ASSERT_EQ(grow->values(), 1);
    for (int y = 0; y < 5; ++y) {
      for (int x = 0; x < 9; ++x) {
        scalar::Scalar<float> f;
        scalar::Scalar<double> d;
        perturbed::Perturbed perturbed;
        enclosed::Enclosure e;
        grow->evaluate(x, y, &f);
        grow->evaluate(x, y, &d);
        grow->evaluate(x, y, &perturbed);
        grow->enclose(x, y, nullptr, &e);
        ASSERT_EQ(f.v, p.expected_thickness(corrected, x, y));
        ASSERT_EQ(perturbed.v, f.v);
        ASSERT_NEAR(d.v, f.v, 8 * 0x1p-24) << "six operations on numbers below 2";
        ASSERT_LE(e.lo, f.v);
        ASSERT_GE(e.hi, f.v);
      }
    }
    if (!corrected) continue;
    const auto shine = pass::bind<ShinePass, scalar::ShinePassText>(cases[1]);
    ASSERT_EQ(shine->values(), 5);
    scalar::Scalar<float> out[5];
    shine->evaluate(3, 2, out);
    const float v = p.shine.scale * p.expected_thickness(true, 3, 2);
    EXPECT_EQ(out[1].v, v * 0.75f * to_float(p.tint.row<Half>(2)[4 * 3 + 1]));
    EXPECT_EQ(out[3].v, 1);
    EXPECT_EQ(out[4].v, v >= p.shine.threshold ? 1 : 0);
  }
}

/// A code may be divided by 255 as a device does it: wider than the float that it was decoded to.
TEST(Definition, ACodeIsLoadedAsDevicesMayLoadIt) {
  Pane p(9, 5);
  p.grow.gain = 0;
  p.grow.rate = 0;
  const auto model = pass::bind<GrowPass, scalar::GrowPassText>(captured(p, false)[0]);
  enclosed::Profile loose;
  loose.reference = false;
  loose.unorm_load.ulp = 1;
  const enclosed::ProfileScope scope(loose);
  int wide = 0;
  for (int x = 0; x < 9; ++x) {
    enclosed::Enclosure e;
    model->enclose(x, 0, nullptr, &e);
    wide += e.lo < e.hi;
  }
  EXPECT_GT(wide, 3);
}

TEST(Definition, ACaseWithoutItsInputsIsRefused) {
  Pane p(9, 5);
  capture::PassCase c = captured(p, true)[0];
  capture::PassCase fewer = c;
  fewer.inputs.erase(fewer.inputs.begin());
  EXPECT_THROW((pass::bind<GrowPass, scalar::GrowPassText>(fewer)), Error);
  // The uniform counts a third seed.
  reinterpret_cast<GrowUniforms*>(c.uniforms.data())->seed_count = 3;
  EXPECT_THAT(error_of([&] { pass::bind<GrowPass, scalar::GrowPassText>(c); }),
              testing::EndsWith(" frost.grow/0005.0: uniform seed_count: expected 0 to 2, the records of in.seeds, found 3"));
  // What is optional may be missing.
  capture::PassCase bare = captured(p, true)[1];
  bare.inputs.pop_back();
  EXPECT_NO_THROW((pass::bind<ShinePass, scalar::ShinePassText>(bare)));
}

TEST(Definition, ARunWithoutItsImagesIsRefused) {
  Pane p(9, 5);
  const auto refused = [&](const pass::HostIo<GrowPass>& io) {
    return error_of([&] { pass::Run<GrowPass>(p.grow, true, Rounding::rne, io); });
  };
  EXPECT_EQ(refused(p.grow_io(true)), "none");
  EXPECT_EQ(refused(p.grow_io(false)), "5 grow: seeds is missing");
  pass::HostIo<GrowPass> io = p.grow_io(true);
  io.mask = p.heights;
  EXPECT_EQ(refused(io), "5 grow: mask has another format");
  EXPECT_THROW(pass::Run<ShinePass>(p.shine, false, Rounding::rne, p.shine_io()), Error) << "as published there is none";
  p.grow.seed_count = 3;
  EXPECT_EQ(refused(p.grow_io(true)), "5 grow: seeds does not fit: uniform seed_count: expected 0 to 2, the records of in.seeds, found 3");
  p.grow.seed_count = 2;
  const Image narrow(Format::r8, 8, 5);
  io.mask = narrow;
  EXPECT_EQ(refused(io), "5 grow: mask has another size");
}

}  // namespace
}  // namespace rainref::frost
