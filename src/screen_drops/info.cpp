#include "screen_drops/info.h"

#include "capture/display.h"
#include "screen_drops/flow_info.h"
#include "screen_drops/uniforms.h"

namespace rainref::screen_drops {
namespace {

using namespace rainref::scene;
using namespace rainref::capture;

constexpr const char *published = "as-published", *correct = "corrected";

EffectInfo make() {
  using B = BackgroundUniforms;
  const UniformBlock background = uniform_block<B>(
      "BackgroundUniforms", {member<&B::resolution>("resolution", "pixel", whole(1, 65536), "as-published: columns and rows of the picture."),
                             member<&B::level>("level", "1", {0, 16}, "Mip level of the lookups."), member<&B::weight>("weight", "1", share, "corrected: of a tap."),
                             member<&B::scale>("scale", "1", share, "corrected: texture coordinates of the scene in a pixel."),
                             member<&B::offset>("offset", "1", share, "corrected: those of the picture's corner."), member<&B::tap_count>("tap_count", "1", {0, 4096}, "corrected: taps in the list.")});
  using P = PublishedDropsUniforms;
  const UniformBlock printed = uniform_block<P>(
      "PublishedDropsUniforms", {member<&P::resolution>("resolution", "pixel", whole(1, 65536), "Columns and rows of the picture."), member<&P::time>("time", "s", frame_time, "Frame number over frame rate, rounded once."),
                                 member<&P::grid>("grid", "cell/pixel", share, "Cells of layer 1 in a pixel."), member<&P::keep>("keep", "1", share, "Times 5 - layer: the noise below which a cell holds a drop."),
                                 member<&P::refraction>("refraction", "1", component, "Pictures per unit of the normal."),
                                 member<&P::printed_misprint>("printed_misprint", "1", flag, "1: the displacement as the report prints it.")});
  using C = CellsUniforms;
  const UniformBlock cells = uniform_block<C>(
      "CellsUniforms", {member<&C::seed>("seed", "1", any_word, "Low and high word of the seed."), member<&C::tick>("tick", "ms", any_word, "The frame's time, modulo 2^32."),
                        member<&C::keep>("keep", "1", {0, 65536}, "Of 65536 cells hold a drop."), member<&C::columns>("columns", "cell", {1, 65536}, "Columns of each layer."),
                        member<&C::rows>("rows", "cell", {1, 65536}, "Rows of each layer."), member<&C::first_row>("first_row", "texel", {0, 1 << 24}, "Row of the buffer where each layer begins."),
                        member<&C::shortest>("shortest", "ms", {1, 65535}, "Shortest cycle."), member<&C::span>("span", "ms", {0, 65535}, "Longest cycle less shortest."),
                        member<&C::largest>("largest", "cell", share, "Radius of a layer's largest drop."), member<&C::impact>("impact", "1", share, "Share of the cycle in which a drop spreads.")});
  using D = DropsUniforms;
  const UniformBlock drops = uniform_block<D>(
      "DropsUniforms", {member<&D::cells_per_pixel>("cells_per_pixel", "cell/pixel", {0, 1e6}, "Of each layer."), member<&D::offset_x>("offset_x", "cell", share, "Place of the picture's corner in each layer."),
                        member<&D::offset_y>("offset_y", "cell", share, "Place of the picture's corner in each layer."), member<&D::pixels_per_cell>("pixels_per_cell", "pixel/cell", {0, 1e9}, "Of each layer."),
                        member<&D::level>("level", "1", {0, 32}, "Mip level at which each layer's drops see the scene."), member<&D::first_row>("first_row", "texel", {0, 1 << 24}, "Row of cells where each layer begins."),
                        member<&D::pixel>("pixel", "1", {0, 1e6}, "Extent of a pixel on the image plane at distance 1."), member<&D::half_size>("half_size", "1", {0, 1e6}, "Half the extent of the image plane at distance 1."),
                        member<&D::scene_scale>("scene_scale", "1", {0, 1e6}, "Texture coordinates of the scene per unit of the image plane."),
                        member<&D::sine>("sine", "1", share, "Of the contact angle."), member<&D::water_ior>("water_ior", "1", {1, 2}, "Refractive index of water."),
                        member<&D::inner>("inner", "1", share, "Share of the background that the water's surface mirrors."), member<&D::has_flow>("has_flow", "1", flag, "1: height counts."),
                        member<&D::flow_slope>("flow_slope", "1/mm", {0, 1e9}, "Slope per difference of heights two texels apart."),
                        member<&D::flow_pixel>("flow_pixel", "1", share, "1 over the picture's columns and rows."),
                        member<&D::visible_from>("visible_from", "mm", {0, 10}, "Height at which flowing water begins to show."), member<&D::visible_to>("visible_to", "mm", {0, 10}, "Height from which it shows fully."),
                        member<&D::flow_level>("flow_level", "1", {0, 32}, "Mip level at which flowing water sees the scene."),
                        member<&D::flow_texel>("flow_texel", "1", share, "1 over the columns and rows of height.")});
  const UniformBlock tap = record<Tap>("Tap", {member<&Tap::x>("x", "1", "From the pixel's place, in texture coordinates of the scene."), member<&Tap::y>("y", "1", "See x.")});

  constexpr auto envelope = Judge::envelope;
  EffectInfo info;
  info.name = "screen_drops";
  info.passes = flow_passes();
  for (const PassInfo& pass : std::vector<PassInfo>{
      {"background", "The scene out of focus, without water. Once, before frame 0.", {{published, 1, envelope, "BackgroundUniforms"}, {correct, 1, envelope, "BackgroundUniforms"}},
       {{"scene"}, {"taps", "", false, correct}}, {"background"}, {background}},
      {"cells", "The drop that each cell of four grids holds now.", {{correct, 1, envelope, "CellsUniforms"}}, {}, {"cells"}, {cells}},
      {"drops", "The scene through the drops on the window: linear radiance, and where water is.", {{published, 1, envelope, "PublishedDropsUniforms"}, {correct, 1, envelope, "DropsUniforms"}},
       {per_texel({"background", "background"}), {"scene"}, {"noise", "", false, published}, {"cells", "cells", false, correct}, {"height", "splat", false, correct}}, {"water", "colour"}, {printed, drops},
       "gather", {"dot", "length", "normalize"}},
      display_info("drops"),
       }) {
    info.passes.push_back(pass);
  }
  const std::array<double, 2> one{0, 1};
  info.buffers = flow_buffers();
  for (const BufferInfo& buffer : std::vector<BufferInfo>{
      {"scene", "rgba16f", "The scene without the glass and without blur, linear radiance, with mips.", "1", one, "none", "linear Rec. 709", "unused"},
      {"taps", "records", "Places that the background is the mean of.", "1", one, "none", "none", "none", "", "Tap", correct},
      {"background", "rgba16f", "The scene out of focus: linear radiance, alpha 1.", "1", one, "none", "linear Rec. 709", "1"},
      {"noise", "rgba8", "Noise, a tile: x and y displace the grid; x keeps a cell's drop, y is its time offset, z its rate.", "1", one, "none", "none", "none", "", "", published},
      {"cells", "rgba32f", "Of a cell's drop: centre x, y and radius, in cells; how far its cycle has come. Radius 0: none. Layers above each other, coarsest first.", "cell, cell, cell, 1", one, "none", "none", "none", "", "", correct},
      {"water", "r8", "A quarter of the layer whose drop shows; 0: none.", "1", one, "none", "none", "none", "", "", published},
      {"water", "r8", "Share of the pixel that water covers.", "1", one, "none", "none", "none", "", "", correct},
      {"colour", "rgba16f", "Linear radiance, alpha 1.", "1", one, "none", "linear Rec. 709", "1"},
      {"picture", "rgba8", "Display code, alpha 1. Row 0 is the bottom of the picture.", "1", one, "sRGB (IEC 61966-2-1)", "sRGB", "1"},
       }) {
    info.buffers.push_back(buffer);
  }
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
