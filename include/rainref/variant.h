// The two variants of every effect.
#pragma once

#include <cstdint>
#include <string_view>

namespace rainref {

enum class Variant : std::uint8_t {
  as_published,  ///< the source's arithmetic, defects included
  corrected      ///< in metres and seconds, defects fixed
};
/// "as-published" or "corrected", as in scenes and packs.
constexpr const char* name(Variant variant) { return variant == Variant::corrected ? "corrected" : "as-published"; }
/// Returns the variant of that name, as_published for any other name.
constexpr Variant variant_from_name(std::string_view name) { return name == "corrected" ? Variant::corrected : Variant::as_published; }

}  // namespace rainref
