// What the tests of the street share.
#pragma once

#include <initializer_list>
#include <string>

#include "base/hash.h"
#include "image/images.h"
#include "night_street/night_street.h"
#include "rainref/image.h"

namespace rainref::night_street {

/// Seeded as in the first golden generation, of which these hashes are: no pass makes the street.
inline constexpr std::uint64_t seed_of_hashes = 1;

/// The hash of the images one behind the other.
inline std::string hash_of(std::initializer_list<const Image*> images) {
  Hasher hasher(seed_of_hashes);
  for (const Image* image : images) hasher.add(bytes_of(*image));
  return hasher.finish().text();
}
inline std::string hash_of(const Image& image) { return hash_of({&image}); }

inline std::string hash_of(const Street::View& view) { return hash_of({&view.colour, &view.depth, &view.normal}); }

/// A driver's look down the street.
inline scene::Camera driver() { return {{1.9, 1.35, 0}, {1.2, 1.75, -20}, {0, 1, 0}, 50}; }
inline constexpr scene::Vector3 puddle_eye{0, 0.05, 0};

}  // namespace rainref::night_street
