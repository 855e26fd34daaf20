// What the tests of the street share.
#pragma once

#include <string>

#include "capture/hashing.h"
#include "night_street/night_street.h"

namespace rainref::night_street {

inline std::string hash_of(const Image& image) { return capture::hash_of(image).text(); }
inline std::string hash_of(const Street::View& view) { return hash_of(view.colour) + hash_of(view.depth); }

/// A driver's look down the street.
inline scene::Camera driver() { return {{1.9, 1.35, 0}, {1.2, 1.75, -20}, {0, 1, 0}, 50}; }
inline constexpr scene::Vector3 puddle_eye{0, 0.05, 0};

}  // namespace rainref::night_street
