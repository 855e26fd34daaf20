#include "capture/pass_case.h"

#include <algorithm>

#include <fmt/format.h>

namespace rainref::capture {
namespace {

template <class T>
const T* named(const std::vector<T>& all, std::string_view name) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const T& t) { return t.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace

std::string PassCase::folder() const {
  const std::string base = fmt::format("{}.{}/{:04}.{}", effect, pass, frame, step);
  return level < 0 ? base : fmt::format("{}.L{}", base, level);
}
const CaseInput* PassCase::input(std::string_view name) const { return named(inputs, name); }
const CaseOutput* PassCase::output(std::string_view name) const { return named(outputs, name); }

}  // namespace rainref::capture
