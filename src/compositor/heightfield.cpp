#include "compositor/heightfield.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "compositor/optics.h"
#include "compositor/reals.h"
#include "rainref/error.h"

namespace rainref::compositor {

namespace scalar {
#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "compositor/heightfield_normal-inl.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA
}  // namespace scalar

namespace {

int pieces_of(int cells, int piece) { return (cells + piece - 1) / piece; }

}  // namespace

void set_margins(const HeightfieldView& field, double cell_height, HeightfieldTile& tile) {
  const double columns = tile.x1 - tile.x0, rows = tile.y1 - tile.y0, longest = std::max(columns, rows) + 2;
  const double spread = std::max(tile.high - tile.low, 0x1p-8 * cell_height);
  tile.margin = 1e-6 * (tile.high - tile.low) + 1e-9 * (cell_height + std::max(magnitude(tile.low), magnitude(tile.high)));
  // About four roundings of the ray's height, which came down from `far`, and of its position, whose numbers have the size of the whole
  // field.
  constexpr double far = 0x1p14;
  tile.roundings = 0x1p-48 * ((far + field.columns + field.rows) * tile.steepest + far * cell_height +
                              std::max(magnitude(tile.low), magnitude(tile.high)));
  const float middle = static_cast<float>(0.5 * (tile.low + tile.high));
  const double doubt = 0x1p-20 * spread + 2 * tile.margin, doubt_for_cell = 8 * 0x1p-20 * tile.steepest;
  const double most_doubt = doubt + longest * doubt_for_cell, from_middle = static_cast<double>(middle);
  const auto x0 = static_cast<int>(tile.x0), y0 = static_cast<int>(tile.y0), x1 = static_cast<int>(tile.x1), y1 = static_cast<int>(tile.y1);
  const int block_x = x0 / block_cells, block_y = y0 / block_cells;
  FloatTile& f = tile.floats;
  f.columns = static_cast<float>(columns);
  f.rows = static_cast<float>(rows);
  f.middle = middle;
  f.low = static_cast<float>(tile.low - from_middle - most_doubt);
  f.high = static_cast<float>(tile.high - from_middle + most_doubt);
  f.beside = static_cast<float>(0x1p-18 * longest);
  f.longest = static_cast<float>(longest);
  f.away = longest <= 0x1p20 ? static_cast<float>(4 * longest) : -1;  // in a larger tile floats do not represent the cells exactly
  f.tall = static_cast<float>(2 * spread);
  f.far_beside = static_cast<float>(far);
  f.far_above = static_cast<float>(far * cell_height);
  f.doubt = static_cast<float>(doubt);
  f.doubt_for_cell = static_cast<float>(doubt_for_cell);
  f.steepest_twice = static_cast<float>(2 * tile.steepest);
  f.first = y0 * (static_cast<int>(field.columns) + 1) + x0;
  f.first_block = block_y * field.blocks_across + block_x;
  f.into_block_x = static_cast<float>(x0 - block_x * block_cells);
  f.into_block_y = static_cast<float>(y0 - block_y * block_cells);
  f.last_block_x = static_cast<float>((x1 - 1) / block_cells - block_x);
  f.last_block_y = static_cast<float>((y1 - 1) / block_cells - block_y);
}

Heightfield::Heightfield(const HeightfieldFrame& frame, int columns, int rows, int tile_cells)
    : frame_(frame), columns_(columns), rows_(rows) {
  if (columns < 1 || rows < 1 || static_cast<std::int64_t>(columns) * rows >= std::int64_t{1} << 30 || tile_cells < 1) {
    throw Error(ExitCode::usage,
                fmt::format("a heightfield of {} x {} cells in tiles of {}: each must be positive, and the cells fewer than 2^30", columns,
                            rows, tile_cells));
  }
  const Vec u = frame.edge_u / static_cast<double>(columns), v = frame.edge_v / static_cast<double>(rows), n = frame.axis;
  const double volume = dot(cross(u, v), n), largest = glm::length(u) * glm::length(v) * glm::length(n);
  if (!(magnitude(volume) > 1e-9 * largest))
    throw Error(ExitCode::usage, "the edges and the axis of a heightfield must not lie in one plane");
  const Vec to_x = cross(v, n) / volume, to_y = cross(n, u) / volume, to_h = cross(u, v) / volume;
  first_cell_ = static_cast<std::size_t>(cells_ahead - 1) * static_cast<std::size_t>(columns + 2);
  const auto across = static_cast<std::size_t>(columns + 1), down = static_cast<std::size_t>(rows);
  const std::size_t vertices = across * (down + 1), pairs = 2 * across * down, cells = across * down + 2 * first_cell_;
  memory_.resize(vertices + pairs + cells);
  heights_ = std::span(memory_).first(vertices);
  pairs_ = std::span(memory_).subspan(vertices, pairs);
  highest_ = std::span(memory_).last(cells);
  cell_height_ = std::max(glm::length(u), glm::length(v)) / glm::length(n);
  blocks_across_ = pieces_of(columns, block_cells);
  blocks_down_ = pieces_of(rows, block_cells);
  blocks_.assign(static_cast<std::size_t>(blocks_across_) * static_cast<std::size_t>(blocks_down_), 0.0f);
  nearby_ = blocks_;
  view_ = {heights_.data(),
           pairs_.data(),
           highest_.data() + first_cell_,
           nearby_.data(),
           blocks_across_,
           double(columns),
           rows,
           {frame.origin.x, frame.origin.y, frame.origin.z},
           to_x.y == 0 && to_x.z == 0 && to_y.x == 0 && to_y.y == 0 && to_h.x == 0 && to_h.z == 0,
           {{to_x.x, to_x.y, to_x.z}, {to_y.x, to_y.y, to_y.z}, {to_h.x, to_h.y, to_h.z}}};
  for (int y = 0; y < rows; y += tile_cells) {
    for (int x = 0; x < columns; x += tile_cells) {
      HeightfieldTile tile{double(x), double(std::min(x + tile_cells, columns)), double(y), double(std::min(y + tile_cells, rows))};
      set_margins(view_, cell_height_, tile);
      tiles_.push_back(tile);
    }
  }
}

void Heightfield::assign(std::span<const float> heights, const parallel::Executor& executor) {
  if (heights.size() != heights_.size())
    throw Error(ExitCode::internal, fmt::format("a heightfield takes {} heights, not {}", heights_.size(), heights.size()));
  executor.for_tiles(columns_ + 1, rows_ + 1, columns_ + 1, 64, [&](const parallel::Tile& t) {
    const auto begin = static_cast<std::size_t>(t.y0) * static_cast<std::size_t>(columns_ + 1),
               end = static_cast<std::size_t>(t.y1) * static_cast<std::size_t>(columns_ + 1);
    std::copy(heights.begin() + begin, heights.begin() + end, heights_.begin() + begin);
  });
  executor.for_range(static_cast<std::int64_t>(tiles_.size()), 1, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      summarize_tile(heights_.data(), columns_, highest_.data() + first_cell_, pairs_.data(), tiles_[i]);
      set_margins(view_, cell_height_, tiles_[i]);
    }
  });
  executor.for_range(blocks_down_, 1, [&](std::int64_t begin, std::int64_t end) {
    for (auto y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      summarize_blocks(view_.highest + static_cast<std::ptrdiff_t>(y) * block_cells * (columns_ + 1), columns_,
                       std::min(block_cells, rows_ - y * block_cells), blocks_.data() + static_cast<std::ptrdiff_t>(y) * blocks_across_);
    }
  });
  executor.for_range(blocks_down_, 8, [&](std::int64_t begin, std::int64_t end) {
    for (auto y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      for (int x = 0; x < blocks_across_; ++x) {
        float& top = nearby_[static_cast<std::size_t>(y) * static_cast<std::size_t>(blocks_across_) + static_cast<std::size_t>(x)];
        top = -std::numeric_limits<float>::infinity();
        for (int j = std::max(y - 1, 0); j < std::min(y + 2, blocks_down_); ++j) {
          const float* const row = blocks_.data() + static_cast<std::ptrdiff_t>(j) * blocks_across_;
          top = std::max(top, *std::max_element(row + std::max(x - 1, 0), row + std::min(x + 2, blocks_across_)));
        }
      }
    }
  });
  ++revision_;
}

Box Heightfield::bounds(std::uint32_t primitive) const {
  const HeightfieldTile& tile = tiles_[primitive];
  Box box{Vec(1e300), Vec(-1e300)};
  for (int corner = 0; corner < 8; ++corner) {
    const double x = (corner & 1 ? tile.x1 : tile.x0) / columns_, y = (corner & 2 ? tile.y1 : tile.y0) / rows_;
    const Vec p = frame_.origin + x * frame_.edge_u + y * frame_.edge_v + (corner & 4 ? tile.high : tile.low) * frame_.axis;
    for (int k = 0; k < 3; ++k) {
      box.low[k] = std::min(box.low[k], p[k]);
      box.high[k] = std::max(box.high[k], p[k]);
    }
  }
  return box;
}

void Heightfield::meet(std::uint32_t self, std::uint32_t primitive, const Ray& ray, Hit& first) const {
  meet_tile(view_, tiles_[primitive], self, ray, first);
}
std::uint32_t Heightfield::meet_packet(std::uint32_t self, std::uint32_t primitive, std::uint32_t lanes, Packet& packet) const {
  return meet_tile(view_, tiles_[primitive], self, lanes, packet);
}

Heightfield::Place Heightfield::place(const Hit& hit) const {
  const auto cell = static_cast<int>(hit.part / 2);
  return {cell % columns_ + hit.u, cell / columns_ + hit.v};
}

namespace {

using scalar::Number;
using scalar::vec;

struct Cell {
  Number::Int x, y, upper;
  Cell(const Hit& hit, int columns) {
    const auto cell = static_cast<std::int32_t>(hit.part / 2);
    x = {cell % columns};
    y = {cell / columns};
    upper = {static_cast<std::int32_t>(hit.part & 1)};
  }
};

}  // namespace

Vec Heightfield::normal_of_slopes(double slope_x, double slope_y) const {
  return vec(scalar::normal_of_slopes(view_, Number(slope_x), Number(slope_y)));
}

Vec Heightfield::normal(const Ray&, const Hit& hit) const {
  const Cell at(hit, columns_);
  return vec(scalar::facet_normal<Number>(view_, at.x, at.y, at.upper));
}
void Heightfield::normals(const RayArrays&, std::span<const std::uint32_t> which, const Hit* hits, const VecArraysOut& normals) const {
  facet_normals(view_, which.size(), hits, normals);
}

Vec Heightfield::smooth_normal(const Hit& hit) const {
  const Cell at(hit, columns_);
  return vec(scalar::interpolated_normal<Number>(view_, at.x, at.y, Number(hit.u), Number(hit.v)));
}

}  // namespace rainref::compositor
