#include "judge/verdict.h"

namespace rainref::judge {

const char* name(Status status) {
  constexpr const char* names[] = {"PASS", "WARN", "FAIL", "UNTESTED", "KNOWN", "DATA"};
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
    return s == Status::fail ? 4 : s == Status::untested ? 3 : s == Status::known ? 2 : s == Status::warn ? 1 : s == Status::pass ? 0 : -1;
  };
  return rank(a) >= rank(b) ? a : b;
}

}  // namespace rainref::judge
