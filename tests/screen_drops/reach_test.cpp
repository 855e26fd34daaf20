// What drops need not ask for shows nothing, and there is enough of it to be worth the asking.
#include "screen_drops/reach.h"

#include "image/images.h"
#include "screen_drops/support.h"

namespace rainref::screen_drops {
namespace {

using test::Single;

struct Count {
  int stretches = 0, missed = 0, layers_left_out = 0, flows_left_out = 0;
};
/// Asks each layer alone of every pixel of a window of this size, with wet cells and flowing water on some texels.
Count ask(int width, int height, int stretch, std::uint32_t seed) {
  Settings s = test::settings(Variant::corrected, width, height);
  s.seed = seed;
  const auto grids = make_layers(s);
  const auto size = cells_size(grids);
  Image cells(Format::rgba32f, size[0], size[1]);
  test::fill_cells(cells_uniforms(s, grids, 7), cells);
  const Image flow = make_image(Format::r16f, width / 2 + 1, height / 3 + 1, [&](int x, int y, int) {
    return to_half((x * 7 + y * 13 + static_cast<int>(seed)) % 61 == 0 ? 3.0f : 0.0f);
  });
  const DropsUniforms u = drops_uniforms(s, grids, {flow.width(), flow.height()});
  const TextureData cell_texture(cells, Address::clamp, Address::clamp), flow_texture(flow, Address::clamp, Address::clamp);
  const auto stored_cells = stored_texture<float>(cells);
  const auto stored_flow = stored_texture<Half>(flow);
  Reach reach(u, stored_cells, stored_flow, width, stretch);
  Count count;
  for (int y = 0; y < height; ++y) {
    reach.enter_row(y);
    for (int first = 0; first < width; first += stretch) {
      const Wanted wanted = reach.of(first / stretch);
      ++count.stretches;
      for (std::uint32_t bit = 0; bit <= layers; ++bit) {
        if ((wanted >> bit & 1) != 0) continue;
        ++(bit == layers ? count.flows_left_out : count.layers_left_out);
        for (int x = first; x < std::min(first + stretch, width); ++x) {
          if (scalar::water_at<Single>(u, cell_texture.view(), flow_texture.view(), x, y, 1u << bit).cover.v > 0) ++count.missed;
        }
      }
    }
  }
  return count;
}

TEST(ScreenDropsReach, LeavesOutNoWater) {
  for (const int stretch : {1, 4, 16}) {
    for (const std::uint32_t seed : {1u, 2u, 3u}) {
      const Count c = ask(211, 97, stretch, seed);
      EXPECT_EQ(c.missed, 0) << stretch << ", seed " << seed;
      // A pixel is wet in a layer by chance of a few in ten at most, and a stretch of 16 crosses some cells.
      EXPECT_GT(c.layers_left_out, layers * c.stretches * (stretch == 16 ? 1 : 5) / 10);
      EXPECT_GT(c.flows_left_out, 0);
    }
  }
}
}  // namespace
}  // namespace rainref::screen_drops
