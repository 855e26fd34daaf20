// The version of rainref and of its golden results.
#pragma once

#define RAINREF_VERSION_MAJOR 0
#define RAINREF_VERSION_MINOR 2
#define RAINREF_VERSION_PATCH 0

#include <string_view>

namespace rainref {

/// "major.minor.patch" of this build.
const char* version();

/// Generation of the golden results. It rises when a change alters the bits of any published pass; CHANGELOG.md says which and why. It
/// seeds every hash, so hashes of two generations are not equal by accident.
inline constexpr unsigned golden_generation = 2;

/// Identifies the bits of this build: the first 32 hexadecimal digits of the SHA-256 of tests/golden/hashes.txt. It changes with every
/// golden result, even if the generation stays.
const char* golden_hash();
/// The same for one effect: only of the lines that begin with its name and "/". "" for an effect without such lines.
const char* golden_hash(std::string_view effect);

}  // namespace rainref
