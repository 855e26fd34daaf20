#include "truth/tracing.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "capture/pass_clock.h"
#include "scene/parameter.h"

namespace rainref::truth {

void Tracing::trace(int frame, Recorder* recorder) {
  const capture::Stopwatch time;
  picture_ = picture();
  shown_ = display(picture_.beauty);
  if (!recorder) return;
  const std::vector<PassOutput> outputs{{"beauty", picture_.beauty}, {"normal", picture_.normal}, {"depth", picture_.depth},
                                        {"film", picture_.film},     {"mask", picture_.mask},     {"picture", shown_}};
  recorder->pass({frame, 0, traced_pass, outputs, time.seconds()});
}

std::vector<image_io::Layer> Tracing::layers() const {
  return {{"", {"R", "G", "B"}, &picture_.beauty},
          {"normal", {"X", "Y", "Z"}, &picture_.normal},
          {"depth", {"Z"}, &picture_.depth},
          {"", {"film"}, &picture_.film},
          {"", {"mask"}, &picture_.mask}};
}

const EffectTracing* tracing_of(std::string_view effect) {
  static const std::array all{puddle_tracing(), windshield_tracing(), screen_drops_tracing(), rainy_glass_tracing()};
  const auto found = std::find_if(all.begin(), all.end(), [&](const EffectTracing& t) { return t.effect == effect; });
  return found == all.end() ? nullptr : &*found;
}

void hold_traced(effect::RunMemory& m, const scene::Config& config) {
  if (!choice_from(config).is_traced) return;
  m.peak.hold(2 * image_bytes(m, Format::rgba16f) + image_bytes(m, Format::r32f) + 2 * image_bytes(m, Format::r16f) +
              image_bytes(m, Format::rgba8));
  m.exr_images = 8 + 8 + 4 + 2 + 2;
  m.exr_texel = 6 + 6 + 4 + 2 + 2;
}

namespace {

scene::Parameter samples_parameter() {
  scene::Parameter p = scene::integer("compositor.samples", "1", sample_counts.front(), sample_counts.back(), 1, "Traced rays per pixel.");
  for (const int count : sample_counts) p.choices.push_back(fmt::format("{}", count));
  return p;
}

}  // namespace

std::vector<scene::Parameter> parameters() {
  using scene::correct;
  return {
      scene::choice("compositor.picture", {"passes", "traced"}, "passes", "The picture to show: that of the passes, or a traced one.")
          .only(correct),
      samples_parameter().only(correct),
      scene::integer("compositor.depth", "1", 1, 64, 8, "Maximum number of surfaces that a traced ray meets one after the other.")
          .only(correct),
      scene::text("compositor.embree_config", "", "Configuration of Embree, such as isa=sse2; it does not affect results.").only(correct),
  };
}

scene::Parameter pane_thickness() {
  return scene::real("compositor.glass_thickness", "m", 1e-5, 0.1, 5e-3, "Thickness of the pane that rays go through.");
}

std::vector<scene::Parameter> pane_parameters() {
  std::vector<scene::Parameter> all = parameters();
  all.push_back(pane_thickness().only("corrected"));
  return all;
}

Choice choice_from(const scene::Config& config) {
  Choice c;
  const auto& entries = config.entries();
  const auto declared = [](const scene::Config::Entry& e) { return e.parameter.key == "compositor.picture"; };
  if (std::none_of(entries.begin(), entries.end(), declared)) return c;
  c.is_traced = config.text("compositor.picture") == "traced";
  c.picture.samples = static_cast<int>(config.integer("compositor.samples"));
  c.picture.shading.depth = static_cast<int>(config.integer("compositor.depth"));
  c.tracer.embree_config = config.text("compositor.embree_config");
  return c;
}

}  // namespace rainref::truth
