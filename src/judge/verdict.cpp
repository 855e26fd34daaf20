#include "judge/verdict.h"

#include <algorithm>
#include <iterator>

namespace rainref::judge {

const char* name(Status status) {
  constexpr const char* names[] = {"PASS", "WARN", "FAIL", "UNTESTED", "KNOWN", "DATA", "NOT JUDGED"};
  return names[static_cast<int>(status)];
}
const char* name(Counted counted) {
  constexpr const char* names[] = {"values", "texels", "fields", "records"};
  return names[static_cast<int>(counted)];
}
const char* name(HalfMode mode) {
  constexpr const char* names[] = {"rne", "rtz", "either"};
  return names[static_cast<int>(mode)];
}
Status worse(Status a, Status b) {
  const auto rank = [](Status s) {
    constexpr Status ascending[] = {Status::data,     Status::pass,       Status::warn, Status::known,
                                    Status::untested, Status::not_judged, Status::fail};
    return std::find(std::begin(ascending), std::end(ascending), s) - std::begin(ascending);
  };
  return rank(a) >= rank(b) ? a : b;
}

}  // namespace rainref::judge
