#include "screen_drops/info.h"

#include "pass/display.h"
#include "pass/info.h"
#include "scene/parameter.h"
#include "screen_drops/background.pass.h"
#include "screen_drops/cells.pass.h"
#include "screen_drops/drops.pass.h"
#include "screen_drops/flow.h"

namespace rainref::screen_drops {
namespace {

using namespace rainref::scene;
using namespace rainref::capture;

EffectInfo make() {
  const UniformBlock tap =
      record<Tap>({member<&Tap::x>("1", "From the pixel's place, in texture coordinates of the scene."), member<&Tap::y>("1", "See x.")});

  EffectInfo info;
  info.name = "screen_drops";
  info.passes = flow_passes();
  pass::append(info.passes, {pass::info_of<BackgroundPass>(), pass::info_of<CellsPass>(), pass::info_of<PublishedDropsPass, DropsPass>(),
                             pass::display_info("drops")});
  info.buffers = flow_buffers();
  const auto append = [&](const std::vector<BufferInfo>& more) { pass::append(info.buffers, more); };
  append({
      {.name = "scene",
       .format = "rgba16f",
       .sentence = "The scene without the glass and without blur, linear radiance, with mips.",
       .colour_space = "linear Rec. 709",
       .alpha = "unused"},
      {.name = "taps", .format = "records", .sentence = "Places that the background is the mean of.", .record = "Tap", .variant = correct},
  });
  append(pass::buffers_of<BackgroundPass>());
  append({
      {.name = "noise",
       .format = "rgba8",
       .sentence = "Noise, a tile: x and y displace the grid; x keeps a cell's drop, y is its time offset, z its rate.",
       .variant = published},
  });
  append(pass::buffers_of<CellsPass>());
  append(pass::buffers_of<PublishedDropsPass, DropsPass>());
  info.buffers.push_back(pass::display_buffer());
  info.records = flow_records();
  info.records.push_back(tap);
  return info;
}

}  // namespace

const capture::EffectInfo& effect_info() {
  static const capture::EffectInfo info = make();
  return info;
}

}  // namespace rainref::screen_drops
