#include "scene/check.h"

#include <optional>

#include <fmt/format.h>

#include "scene/value_text.h"

namespace rainref::scene {
namespace {

template <class T>
std::optional<T> scalar(const RawValue& raw) {
  if (const T* v = std::get_if<T>(&raw.data)) return *v;
  if constexpr (std::is_same_v<T, double>) {
    if (const auto* whole = std::get_if<std::int64_t>(&raw.data)) return static_cast<double>(*whole);
  }
  return std::nullopt;
}

template <class T>
T without_negative_zero(T v) {
  return v == T(0) ? T(0) : v;
}

// The value, whole and in range, or the part of `raw` that is wrong.
struct Result {
  Value value;
  const RawValue* wrong = nullptr;
};

template <class T>
Result one(const RawValue& raw, const Parameter& p) {
  const std::optional<T> v = scalar<T>(raw);
  if (!v) return {{}, &raw};
  if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
    const Value value = without_negative_zero(*v);
    return {value, accepts(p, value) ? nullptr : &raw};
  } else {
    return {*v, accepts(p, *v) ? nullptr : &raw};
  }
}

template <class T, std::size_t N>
Result several(const RawValue& raw, const Parameter& p) {
  const auto* elements = std::get_if<std::vector<RawValue>>(&raw.data);
  if (!elements || elements->size() != N) return {{}, &raw};
  Parameter component = p;  // the same range for one number
  component.type = std::is_same_v<T, double> ? Type::real : Type::integer;
  std::array<T, N> out{};
  for (std::size_t i = 0; i < N; ++i) {
    const Result r = one<T>((*elements)[i], component);
    if (r.wrong) return r;
    out[i] = std::get<T>(r.value);
  }
  return {out};
}

Result convert(const RawValue& raw, const Parameter& p) {
  switch (p.type) {
    case Type::boolean:
      return one<bool>(raw, p);
    case Type::integer:
      return one<std::int64_t>(raw, p);
    case Type::integer2:
      return several<std::int64_t, 2>(raw, p);
    case Type::real:
      return one<double>(raw, p);
    case Type::real2:
      return several<double, 2>(raw, p);
    case Type::real3:
      return several<double, 3>(raw, p);
    case Type::choice:
    case Type::text:
      return one<std::string>(raw, p);
  }
  return {{}, &raw};
}

}  // namespace

void refuse(const Origin& origin, const std::string& key, const std::string& message) {
  if (origin.kind == Origin::override_option && origin.at.file.empty()) {
    throw Error(ExitCode::usage, fmt::format("--set {}: {}", key, message));
  }
  throw Error(ExitCode::usage, origin.at, fmt::format("{}: {}", key, message));
}

Value checked(const RawValue& raw, const Parameter& p, Origin origin) {
  Result result = convert(raw, p);
  if (!result.wrong) return std::move(result.value);
  if (origin.kind != Origin::by_default && !result.wrong->at.file.empty()) origin.at = result.wrong->at;
  std::string message = fmt::format("expected {}, found {}", expectation(p), raw.text());
  if (const auto* word = std::get_if<std::string>(&raw.data); word && p.type == Type::choice) {
    message += did_you_mean(*word, p.choices);
  }
  refuse(origin, p.key, message);
}

}  // namespace rainref::scene
