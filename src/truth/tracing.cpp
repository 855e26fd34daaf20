#include "truth/tracing.h"

#include <algorithm>
#include <array>

#include "capture/pass_clock.h"

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

}  // namespace rainref::truth
