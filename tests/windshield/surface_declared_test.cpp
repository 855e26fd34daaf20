// What wipe_texture and normals declare: scene keys, uniform blocks, buffers; and the host's values.
#include <gtest/gtest.h>

#include "rainref/error.h"
#include "scene/toml.h"
#include "windshield/surface.h"

namespace rainref::windshield {
namespace {

SurfaceSettings read(const std::string& variant, const std::vector<std::string>& values) {
  const std::vector<scene::Parameter> keys = surface_parameters("windshield");
  const scene::EffectTable table{{{"windshield", {"as-published", "corrected"}, keys}}};
  SurfaceSettings s;
  read_surface(scene::parse("effect = 'windshield'\nvariant = '" + variant + "'\n", "test", values, table), "windshield", s);
  return s;
}

TEST(SurfaceDeclared, ScenesSetWhatTheVariantUses) {
  const SurfaceSettings published = read("as-published", {"windshield.wipe_strength=2", "windshield.mask_tau=10"});
  EXPECT_FALSE(published.corrected);
  EXPECT_EQ(published.wipe_strength, 2);
  EXPECT_EQ(published.mask_tau, 10);
  EXPECT_TRUE(read("corrected", {}).corrected);
  EXPECT_THROW(read("corrected", {"windshield.wipe_strength=2"}), Error);
}

TEST(SurfaceDeclared, PassesAndTheirBuffers) {
  // Making a block validates it: an error would throw.
  const capture::PassInfo wipe = wipe_texture_info(), normal = normals_info();
  EXPECT_EQ(wipe.block("corrected").size, sizeof(WipeTextureUniforms));
  EXPECT_EQ(normal.block("as-published").size, sizeof(NormalsUniforms));
  capture::EffectInfo effect;
  effect.buffers = surface_buffers();
  for (const char* name : {"mask", "wiped", "normal"}) EXPECT_NO_THROW(effect.buffer(name, "corrected")) << name;
  EXPECT_NO_THROW(effect.buffer("mask", "as-published"));
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
