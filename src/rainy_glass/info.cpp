#include "rainy_glass/info.h"

#include "pass/display.h"
#include "pass/info.h"
#include "rainy_glass/bake.pass.h"
#include "rainy_glass/rain_on_glass.pass.h"
#include "scene/parameter.h"

namespace rainref::rainy_glass {
namespace {

using namespace rainref::scene;
using namespace rainref::capture;

EffectInfo make() {
  const UniformBlock droplet =
      record<Droplet>({member<&Droplet::x>("1", "Centre, in tiles."), member<&Droplet::y>("1", "Centre."),
                       member<&Droplet::radius>("1", "Of a disc that holds it, in tiles."), member<&Droplet::height>("1", "At the centre."),
                       member<&Droplet::m00>("1", "q = M d is 1 long at the rim."), member<&Droplet::m01>("1", "M is symmetric."),
                       member<&Droplet::m11>("1", "See m00."), member<&Droplet::offset>("1", "Of its timer.")});
  const UniformBlock trail = record<Trail>(
      {member<&Trail::x>("1", "Centre of the head, in tiles."), member<&Trail::y>("1", "Centre of the head."),
       member<&Trail::half_width>("1", "Of the head."), member<&Trail::inverse_length>("1", "1 over the length of the tail."),
       member<&Trail::height>("1", "Of the head."), member<&Trail::wiggle>("1", "Amplitude of the winding."),
       member<&Trail::wiggle_rate>("1", "Turns of the winding in a tile."), member<&Trail::wiggle_phase>("1", "At the head, in turns.")});

  EffectInfo info;
  info.name = "rainy_glass";
  info.passes = {
      pass::info_of<BakeRaindropsPass>(),
      pass::info_of<BakeRivuletsPass>(),
      pass::info_of<RainOnGlassPass>(),
      pass::display_info("rain_on_glass"),
  };
  const std::array<double, 2> signed_one{-1, 1};
  const auto append = [&](const std::vector<BufferInfo>& more) { pass::append(info.buffers, more); };
  info.buffers = {
      {.name = "droplets",
       .format = "records",
       .sentence = "Droplets of the raindrop map, largest first; they do not overlap.",
       .record = "Droplet"},
      {.name = "trails", .format = "records", .sentence = "Rivulets of the rivulet map.", .record = "Trail"},
      {.name = "lattice",
       .format = "rgba32f",
       .sentence = "Unit gradients of the flow across (x, y) and along (z, w) the glass.",
       .range = signed_one},
  };
  append(pass::buffers_of<BakeRaindropsPass>());
  append(pass::buffers_of<BakeRivuletsPass>());
  append({
      {.name = "surface",
       .format = "rgba32f",
       .sentence = "Place on the glass u, v; distance along the view axis, 0 beside the glass; 0.",
       .unit = "m, m, m, 1",
       .range = {-10, 10}},
      {.name = "orientation", .format = "rgba16f", .sentence = "World normal toward the rain; 1 on the glass.", .range = signed_one},
      {.name = "scene",
       .format = "rgba16f",
       .sentence = "The scene without the glass, linear radiance.",
       .colour_space = "linear Rec. 709",
       .alpha = "unused"},
      {.name = "scene_depth",
       .format = "r32f",
       .sentence = "Its depth along the view axis.",
       .unit = "m",
       .range = {0, 1000},
       .variant = correct},
      {.name = "near_depth",
       .format = "r32f",
       .sentence = "Least depth of a texel and its eight neighbours, times 1 - 2^-16.",
       .unit = "m",
       .range = {0, 1000},
       .variant = correct},
      {.name = "probe",
       .format = "rgba32f",
       .sentence = "Radiance by direction, with mips.",
       .colour_space = "linear Rec. 709",
       .alpha = "unused",
       .orientation =
           "latitude/longitude: u = 1/2 + atan2(z, x) / (2 pi), v = 1/2 + atan2(y, sqrt(x^2 + z^2)) / pi, row 0 looks straight down"},
  });
  append(pass::buffers_of<RainOnGlassPass>());
  info.buffers.push_back(pass::display_buffer());
  info.records = {droplet, trail};
  return info;
}

}  // namespace

const capture::EffectInfo& effect_info() {
  static const capture::EffectInfo info = make();
  return info;
}

}  // namespace rainref::rainy_glass
