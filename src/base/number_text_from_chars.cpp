// By the C++ library, which has no locale: for systems whose C library always uses the program's. Not every C++ library has it.
#include <charconv>

#include "base/number_text_value.h"

namespace rainref {

template <class T>
T nearest_value(std::string_view decimal) {
  T value{};  // remains if it is out of range
  std::from_chars(decimal.data(), decimal.data() + decimal.size(), value);
  return value;
}
template float nearest_value(std::string_view);
template double nearest_value(std::string_view);

}  // namespace rainref
