// What wipe_texture and normals declare: scene keys, uniform blocks, buffers; and the host's values.
#include <gtest/gtest.h>

#include "rainref/error.h"
#include "scene/toml.h"
#include "pass/info.h"
#include "windshield/info.h"
#include "windshield/parameters.h"

namespace rainref::windshield {
namespace {

Settings read(const std::string& variant, const std::vector<std::string>& values) {
  const scene::EffectTable table{{{"windshield", {"as-published", "corrected"}, parameters()}}};
  return settings_from(scene::parse("effect = 'windshield'\nvariant = '" + variant + "'\n", "test", values, table));
}

TEST(SurfaceDeclared, ScenesSetWhatTheVariantUses) {
  const SurfaceSettings published = read("as-published", {"windshield.wipe_strength=2", "windshield.mask_tau=10"}).surface;
  EXPECT_FALSE(published.corrected);
  EXPECT_EQ(published.wipe_strength, 2);
  EXPECT_EQ(published.mask_tau, 10);
  EXPECT_TRUE(read("corrected", {}).surface.corrected);
  EXPECT_THROW(read("corrected", {"windshield.wipe_strength=2"}), Error);

  const blur_pyramid::BlurSettings blur =
      read("corrected", {"blur.blur_levels=3", "blur.fog_density=0.5", "blur.fog_colour=[1, 2, 3]", "windshield.rounding=rtz"}).blur;
  EXPECT_TRUE(blur.corrected);
  EXPECT_EQ(blur.levels, 3);
  EXPECT_EQ(blur.fog_density, 0.5);
  EXPECT_EQ(blur.fog_colour[2], 3);
  EXPECT_EQ(blur.rounding, Rounding::rtz);
}

TEST(SurfaceDeclared, PassesAndTheirBuffers) {
  // Making a block validates it: an error would throw.
  const capture::PassInfo wipe = pass::info_of<WipeTexturePass>(), normal = pass::info_of<NormalsPass>();
  EXPECT_EQ(wipe.block("corrected").size, sizeof(WipeTextureUniforms));
  EXPECT_EQ(normal.block("as-published").size, sizeof(NormalsUniforms));
  capture::EffectInfo effect;
  effect.buffers = pass::buffers_of<WipeTexturePass>();
  for (const char* name : {"mask", "wiped"}) EXPECT_NO_THROW(effect.buffer(name, "corrected")) << name;
  EXPECT_NO_THROW(effect.buffer("mask", "as-published"));
}

TEST(SurfaceDeclared, PassesNameOnlyBuffersThatTheVariantHas) {
  const capture::EffectInfo& effect = effect_info();
  for (const std::string variant : {"as-published", "corrected"}) {
    for (const std::string& name : effect.pass_names(variant)) {
      const capture::PassInfo& pass = effect.pass(name);
      for (const capture::ReadInfo& read : pass.reads)
        if (read.variant.empty() || read.variant == variant) {
          EXPECT_NO_THROW(effect.buffer(read.buffer, variant)) << name << ' ' << variant;
        }
      EXPECT_FALSE(effect.writes(pass, variant).empty()) << name;
    }
    for (std::size_t i = 0; i < effect.buffers.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) {
        const capture::BufferInfo &a = effect.buffers[i], &b = effect.buffers[k];
        EXPECT_FALSE(a.name == b.name && (a.variant.empty() || b.variant.empty() || a.variant == b.variant))
            << a.name << " is declared twice";
      }
  }
  const std::vector<std::string> published{"height", "mask"}, correct{"height", "mask", "wiped"};
  EXPECT_EQ(effect.writes(effect.pass("wipe_texture"), "as-published"), published);
  EXPECT_EQ(effect.writes(effect.pass("wipe_texture"), "corrected"), correct);
  EXPECT_EQ(effect.writes(effect.pass("wipe_drops"), "as-published"), std::vector<std::string>{"drops"});
}

// The declared range holds what the largest time constant lets `wiped` grow to.
TEST(SurfaceDeclared, TheTimeSinceAWipeStaysInItsRange) {
  EXPECT_EQ(wiped_limit(600), effect_info().buffer("wiped", "corrected").range[1]);
  EXPECT_LT(wiped_limit(4), wiped_limit(600));
}

TEST(SurfaceDeclared, FramesTogetherMakeTheTimeThatHasPassed) {
  SurfaceSettings s;
  s.corrected = true;
  for (const double fps : {23.976, 60.0, 144.0}) {
    s.fps = fps;
    double sum = 0;
    for (int frame = 0; frame < 2000; ++frame) sum += wipe_texture_uniforms(s, frame).dt;
    EXPECT_NEAR(sum, 2000 / fps, wiped_grid(s.mask_tau)) << fps;
  }
}

TEST(SurfaceDeclared, TheEdgeIsNoWiderThanABlade) {
  SurfaceSettings s;
  s.frame = {1.4, 0, 0.8};
  EXPECT_FLOAT_EQ(wipe_texture_uniforms(s, 0).edge_width, 1.4f / 1024);
  s.half_width = 1e-3;
  EXPECT_FLOAT_EQ(wipe_texture_uniforms(s, 0).edge_width, 1e-3f);
  s.half_width = 0;
  EXPECT_GT(wipe_texture_uniforms(s, 0).edge_width, 0) << "the pass divides by it";
}

}  // namespace
}  // namespace rainref::windshield
