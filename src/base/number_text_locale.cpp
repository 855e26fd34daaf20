// By the C library, in the locale "C" whatever the program's locale is.
#include <locale.h>
#include <stdlib.h>
#if __has_include(<xlocale.h>)
#include <xlocale.h>  // macOS
#endif

#include <string>

#include "base/number_text_value.h"

namespace rainref {
namespace {

locale_t plain() {
  static const locale_t only = ::newlocale(LC_ALL_MASK, "C", locale_t{});
  return only;
}

}  // namespace

template <>
float nearest_value(std::string_view decimal) {
  return ::strtof_l(std::string(decimal).c_str(), nullptr, plain());
}
template <>
double nearest_value(std::string_view decimal) {
  return ::strtod_l(std::string(decimal).c_str(), nullptr, plain());
}

}  // namespace rainref
