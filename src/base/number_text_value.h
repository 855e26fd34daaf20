// The value of a decimal number. CMake compiles one of number_text_<how>.cpp.
#pragma once

#include <string_view>

namespace rainref {

/// The float or double nearest to a decimal number, whose form was checked, in the processor's rounding mode. Infinite or 0 if it is out of
/// range.
template <class T>
T nearest_value(std::string_view decimal);

}  // namespace rainref
