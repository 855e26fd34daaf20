// All five effects from the public headers alone: opened, advanced by a frame, rendered, and told apart by a sum over their pictures.
#include <algorithm>
#include <cstdint>
#include <cstdio>

#include "rainref/edge_splash.h"
#include "rainref/error.h"
#include "rainref/puddle.h"
#include "rainref/rainy_glass.h"
#include "rainref/screen_drops.h"
#include "rainref/windshield.h"

using namespace rainref;

namespace {

constexpr int width = 32, height = 18;

template <class Settings>
Settings small() {
  Settings settings;
  settings.width = width;
  settings.height = height;
  return settings;
}
/// A ramp in every channel, from `low` to twice that.
Image ramp(Format format, float low) {
  Image image(format, width, height);
  for (int y = 0; y < height; ++y) {
    for (int i = 0; i < width * image.channels(); ++i)
      image.row<float>(y)[i] = low * (1 + static_cast<float>(i) / static_cast<float>(width * image.channels()));
  }
  return image;
}
/// One from 1/2 to 1 in halves, its alpha 1, as light; and 9 m away.
windshield::Surroundings before_the_car() {
  windshield::Surroundings out{Image(Format::rgba16f, width, height), Image(Format::r32f, width, height)};
  for (int y = 0; y < height; ++y) {
    for (int i = 0; i < 4 * width; ++i) out.colour.row<Half>(y)[i].bits = static_cast<std::uint16_t>(i % 4 == 3 ? 0x3c00 : 0x3800 + 8 * i);
    std::fill_n(out.depth.row<float>(y), width, 9.0f);
  }
  return out;
}
void tell(const char* effect, const Image& picture) {
  std::uint32_t sum = 2166136261u;  // FNV-1a
  for (int y = 0; y < picture.height(); ++y) {
    for (int i = 0; i < 4 * picture.width(); ++i) sum = (sum ^ picture.row<Unorm8>(y)[i].code) * 16777619u;
  }
  std::printf("%s %dx%d %08x\n", effect, picture.width(), picture.height(), sum);
}

}  // namespace

int main() try {
  const parallel::Executor executor(2);
  {
    puddle::Surroundings around;
    around.environment = ramp(Format::rgba32f, 0.5f);
    puddle::Puddle effect(small<puddle::Settings>(), around, executor);
    effect.next_frame();
    tell("puddle", effect.picture());
  }
  {
    const SceneText scene{"[run]\nsize = [32, 18]\n",
                          {"windshield.height_size=[64, 36]", "vehicle.speed=20", "falling_rain.on=true", "rain.rate=50"}};
    windshield::Windshield effect(scene, before_the_car(), executor);
    effect.next_frame();
    tell("windshield", effect.picture());
    if (effect.falling().empty()) return 1;
  }
  {
    edge_splash::Inputs in;
    in.colour = ramp(Format::rgba32f, 0.5f);
    in.depth = ramp(Format::r32f, 2);
    in.depth_is_distance = true;
    edge_splash::EdgeSplash effect(small<edge_splash::Settings>(), in, executor);
    effect.next_frame();
    tell("edge_splash", effect.picture());
  }
  {
    screen_drops::Inputs in;
    in.colour = ramp(Format::rgba32f, 0.5f);
    screen_drops::ScreenDrops still(small<screen_drops::Settings>(), in, executor);
    still.next_frame();
    tell("screen_drops", still.picture());
    screen_drops::ScreenDrops flowing(SceneText{"", {"run.size=[32, 18]", "flow.height_size=[64, 36]", "flow.warm_up=1"}}, in, executor);
    flowing.next_frame();
    tell("screen_drops.flow", flowing.picture());
  }
  {
    rainy_glass::Surroundings around;
    around.colour = ramp(Format::rgba32f, 0.5f);
    around.depth = ramp(Format::r32f, 9);
    rainy_glass::RainyGlass effect(small<rainy_glass::Settings>(), around, executor);
    effect.next_frame();
    tell("rainy_glass", effect.picture());
  }
  windshield::Windshield({"[wipers]\ncuont = 1\n", {}, "mine.toml"}, {}, executor);
  return 1;
} catch (const Error& e) {
  std::printf("%d %s\n", static_cast<int>(e.code()), e.what());
  return e.code() == ExitCode::usage ? 0 : 1;
}
