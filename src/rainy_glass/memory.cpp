
#include <fmt/format.h>

#include "base/floating_point.h"
#include "image/memory.h"
#include "rainy_glass/host.h"

namespace rainref::rainy_glass {

PictureSizes sizes_of(const Surroundings& s) {
  return {{s.probe.width(), s.probe.height()}, {s.raindrops.width(), s.raindrops.height()}, {s.rivulets.width(), s.rivulets.height()}};
}

MemoryPeak memory(const Settings& s, const PictureSizes& sizes) {
  const bool corrected = s.variant == Variant::corrected;
  const auto image = [&](Format f) { return Image::memory_bytes(f, s.width, s.height); };
  MemoryPeak m;
  std::uint64_t decoded_maps = 0;
  for (const std::array<int, 2>& given : {sizes.raindrops, sizes.rivulets}) {
    const std::array<int, 2> map = given[0] == 0 ? std::array{s.map_size, s.map_size} : given;
    if (given[0] != 0) m.pass(texel_bytes(map[0], map[1], 4) + Image::memory_bytes(s.map_storage, map[0], map[1]));
    m.hold(Image::memory_bytes(s.map_storage, map[0], map[1]));
    // Maps of halves are read in place.
    if (s.map_storage != Format::rgba16f) decoded_maps += texel_bytes(map[0], map[1], 4);
  }
  m.pass(texel_bytes(s.width, s.height, 4) + image(Format::rgba16f));  // the scene, decoded and in halves
  m.hold(image(Format::rgba16f));
  if (corrected) {
    m.hold(2 * image(Format::r32f));
    m.pass(texel_bytes(s.width, s.height, 1));
  }
  if (s.use_probe) {
    m.hold(texel_bytes(sizes.probe[0], sizes.probe[1], 4));
    hold_mips(m, sizes.probe[0], sizes.probe[1], 4);
  }
  m.hold(image(Format::rgba32f) + image(Format::rgba16f));  // surface, orientation
  if (s.shape == Shape::image) m.pass(texel_bytes(s.width, s.height, 4));
  m.hold(image(Format::rgba16f) + image(Format::rgba8));  // colour, picture
  m.hold(decoded_maps);
  return m;
}

void check_memory(const Settings& s, const PictureSizes& sizes) {
  require_memory(fmt::format("run.size {}x{} with maps.size {}", s.width, s.height, s.map_size), memory(s, sizes).peak());
}

std::uint64_t memory_bytes(const Settings& settings) {
  const FloatingPointGuard guard;
  return memory(settings).peak();
}

}  // namespace rainref::rainy_glass
