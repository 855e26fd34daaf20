// The passes that have a definition, for numbers of their own.
#pragma once

#include <string>

#include "blur_pyramid/scalar.h"
#include "capture/pass_case.h"
#include "drops/splat/scalar.h"
#include "edge_splash/scalar.h"
#include "pass/display_scalar.h"
#include "pass/model.h"
#include "puddle/scalar.h"
#include "rainy_glass/scalar.h"
#include "rainy_glass/rain_on_glass_text.h"
#include "screen_drops/scalar.h"
#include "windshield/scalar.h"

namespace rainref::devices {

/// Calls f(pass::Bound<...>) with the pass of a case; false where it has no definition.
template <class F>
bool with_defined_pass(const capture::PassCase& c, const F& f) {
  const auto run = [&]<class P, class Text>(std::type_identity<P>, std::type_identity<Text>) { f(pass::bound<P, Text>(c)); };
#define RAINREF_PASS(effect_name, pass_name, is_it, P, Text) \
  if (c.effect == effect_name && c.pass == pass_name && (is_it)) return run(std::type_identity<P>(), std::type_identity<Text>()), true
  RAINREF_PASS("puddle", "wave_step", true, puddle::WaveStepPass, puddle::scalar::WaveStepPassText);
  RAINREF_PASS("puddle", "shade", true, puddle::ShadePass, puddle::scalar::ShadePassText);
  RAINREF_PASS("puddle", "display", true, puddle::DisplayPass, puddle::scalar::DisplayPassText);
  RAINREF_PASS("screen_drops", "background", true, screen_drops::BackgroundPass, screen_drops::scalar::BackgroundPassText);
  RAINREF_PASS("screen_drops", "cells", true, screen_drops::CellsPass, screen_drops::scalar::CellsPassText);
  RAINREF_PASS("screen_drops", "drops", c.corrected(), screen_drops::DropsPass, screen_drops::scalar::DropsPassText);
  RAINREF_PASS("screen_drops", "drops", !c.corrected(), screen_drops::PublishedDropsPass, screen_drops::scalar::PublishedDropsPassText);
  RAINREF_PASS("edge_splash", "splash", c.corrected(), edge_splash::SplashPass, edge_splash::scalar::SplashPassText);
  RAINREF_PASS("edge_splash", "splash", !c.corrected(), edge_splash::PublishedSplashPass, edge_splash::scalar::PublishedSplashPassText);
  RAINREF_PASS("windshield", "wipe_texture", true, windshield::WipeTexturePass, windshield::scalar::WipeTexturePassText);
  RAINREF_PASS("windshield", "persist", true, windshield::PersistPass, windshield::scalar::PersistPassText);
  RAINREF_PASS("windshield", "falling_rain", true, windshield::FallingRainPass, windshield::scalar::FallingRainPassText);
  RAINREF_PASS("windshield", "join_panes", true, windshield::JoinPanesPass, windshield::scalar::JoinPanesPassText);
  RAINREF_PASS("windshield", "normals", true, windshield::NormalsPass, windshield::scalar::NormalsPassText);
  RAINREF_PASS("windshield", "smear", true, windshield::SmearPass, windshield::scalar::SmearPassText);
  RAINREF_PASS("windshield", "condense", true, windshield::CondensePass, windshield::scalar::CondensePassText);
  RAINREF_PASS("windshield", "composite", true, windshield::CompositePass, windshield::scalar::CompositePassText);
  RAINREF_PASS("windshield", "soften", true, windshield::SoftenPass, windshield::scalar::SoftenPassText);
  RAINREF_PASS("windshield", "mist", true, windshield::MistPass, windshield::scalar::MistPassText);
  RAINREF_PASS("windshield", "interior", true, windshield::InteriorPass, windshield::scalar::InteriorPassText);
  RAINREF_PASS("rainy_glass", "bake_raindrops", true, rainy_glass::BakeRaindropsPass, rainy_glass::scalar::BakeRaindropsPassText);
  RAINREF_PASS("rainy_glass", "bake_rivulets", true, rainy_glass::BakeRivuletsPass, rainy_glass::scalar::BakeRivuletsPassText);
  RAINREF_PASS("rainy_glass", "rain_on_glass", true, rainy_glass::RainOnGlassPass, rainy_glass::RainOnGlassText);
  RAINREF_PASS(c.effect, "blur_pyramid", c.level == 0, blur_pyramid::FogPass, blur_pyramid::scalar::FogPassText);
  RAINREF_PASS(c.effect, "blur_pyramid", c.level != 0, blur_pyramid::HalvePass, blur_pyramid::scalar::HalvePassText);
  RAINREF_PASS(c.effect, "splat", true, drops::SplatPass, drops::scalar::SplatPassText);
  const capture::CaseInput* const shown = c.input("colour");
  RAINREF_PASS(c.effect, "display", shown && shown->array.format == Format::rgba8, pass::DisplayOfCodesPass,
               pass::scalar::DisplayOfCodesPassText);
  RAINREF_PASS(c.effect, "display", true, pass::DisplayPass, pass::scalar::DisplayPassText);
#undef RAINREF_PASS
  return false;
}

}  // namespace rainref::devices
