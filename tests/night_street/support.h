// What the tests of the street share.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/hash.h"
#include "night_street/night_street.h"
#include "rainref/image.h"

namespace rainref::night_street {

inline void add_image(Hasher& hasher, const Image& image) {
  const BufferView view(image);
  std::vector<std::byte> row(view.row_bytes());
  for (int y = 0; y < view.height(); ++y) {
    view.copy_row(y, row.data());
    hasher.add(row);
  }
}

/// Seeded as in the first golden generation, of which these hashes are: no pass makes the street.
inline constexpr std::uint64_t seed_of_hashes = 1;

inline std::string hash_of(const Image& image) {
  Hasher hasher(seed_of_hashes);
  add_image(hasher, image);
  return hasher.finish().text();
}

inline std::string hash_of(const Street::View& view) {
  Hasher hasher(seed_of_hashes);
  add_image(hasher, view.colour);
  add_image(hasher, view.depth);
  add_image(hasher, view.normal);
  return hasher.finish().text();
}

/// A driver's look down the street.
inline scene::Camera driver() { return {{1.9, 1.35, 0}, {1.2, 1.75, -20}, {0, 1, 0}, 50}; }
inline constexpr scene::Vector3 puddle_eye{0, 0.05, 0};

}  // namespace rainref::night_street
