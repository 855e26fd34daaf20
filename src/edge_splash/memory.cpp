
#include "base/floating_point.h"
#include "edge_splash/host.h"
#include "image/memory.h"

namespace rainref::edge_splash {

MemoryPeak memory(const Settings& s, int noise_side) {
  const auto image = [&](Format f) { return Image::memory_bytes(f, s.width, s.height); };
  MemoryPeak m;
  m.hold(image(Format::rgba16f) + image(Format::r32f) + image(Format::r8));  // scene, depth, layer
  const std::uint64_t map = Image::memory_bytes(Format::r8, noise_side, noise_side);
  if (s.variant == Variant::corrected && s.has_crowns) {
    const std::uint64_t crowns = Image::memory_bytes(Format::r32f, crown_side, crown_side);
    m.hold(crowns + texel_bytes(crown_side, crown_side, 1));
    m.pass(crowns + texel_bytes(crown_side, crown_side, 1));  // those of the next frame
  } else if (s.variant == Variant::corrected) {
    m.hold(2 * map);
    MemoryPeak halved;
    halved.hold(texel_bytes(noise_side, noise_side, 1));
    halved.pass(texel_bytes(noise_side, noise_side, 1) + texel_bytes(noise_side / 2, noise_side / 2, 1));
    m.pass(halved.peak());
    m.release(2 * map);
    m.hold(Image::memory_bytes(Format::r32f, noise_side / 2, noise_side / 2) + texel_bytes(noise_side / 2, noise_side / 2, 1));
  } else {
    m.pass(2 * map);
    m.hold(map + texel_bytes(noise_side, noise_side, 1));
  }
  m.hold(texel_bytes(s.width, s.height, 1));                                       // depth as it is looked up
  m.hold(3 * image(Format::r8) + image(colour_format(s)) + image(Format::rgba8));  // masks, colour, picture
  return m;
}

std::uint64_t memory_bytes(const Settings& settings) {
  const FloatingPointGuard guard;
  return memory(settings).peak();
}

}  // namespace rainref::edge_splash
