// The two forms that every effect has.
#pragma once

#include <cstdint>
#include <string_view>

namespace rainref {

enum class Variant : std::uint8_t {
  as_published,  ///< what the source says, its defects included
  corrected      ///< in metres and seconds, its defects mended
};
/// "as-published" or "corrected", as scenes and packs say it.
constexpr const char* name(Variant variant) { return variant == Variant::corrected ? "corrected" : "as-published"; }
/// The one of that name; as_published for any other.
constexpr Variant variant_from_name(std::string_view name) { return name == "corrected" ? Variant::corrected : Variant::as_published; }

}  // namespace rainref
