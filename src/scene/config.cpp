#include "scene/config.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "scene/value_text.h"

namespace rainref::scene {
namespace {

void require_accepted(const Parameter& p, const Value& value) {
  if (accepts(p, value)) return;
  throw Error(ExitCode::internal, fmt::format("configuration: '{}' expects {}, found {}", p.key, expectation(p), value_text(value)));
}

}  // namespace

std::string Origin::text() const {
  if (kind == file || !at.file.empty()) return at.text();
  return kind == override_option ? "--set" : "default";
}

Config::Config(std::vector<Entry> entries, std::filesystem::path directory)
    : entries_(std::move(entries)), directory_(std::move(directory)) {
  for (const Entry& e : entries_) require_accepted(e.parameter, e.value);
  by_key_.resize(entries_.size());
  std::iota(by_key_.begin(), by_key_.end(), 0u);
  std::stable_sort(by_key_.begin(), by_key_.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return entries_[a].parameter.key < entries_[b].parameter.key; });
  text("effect");
  text("variant");
}

std::size_t Config::place_of(std::string_view key) const {
  const auto at = std::lower_bound(by_key_.begin(), by_key_.end(), key,
                                   [&](std::uint32_t e, std::string_view k) { return entries_[e].parameter.key < k; });
  if (at == by_key_.end() || entries_[*at].parameter.key != key)
    throw Error(ExitCode::internal, fmt::format("configuration: no parameter '{}' here", key));
  return *at;
}

const Config::Entry& Config::entry(std::string_view key) const { return entries_[place_of(key)]; }

void Config::set(std::string_view key, Value value, Origin origin) {
  Entry& e = entries_[place_of(key)];
  require_accepted(e.parameter, value);
  e.value = std::move(value);
  e.origin = std::move(origin);
}

template <class T>
const T& Config::get(std::string_view key, const char* asked) const {
  const Entry& e = entry(key);
  const T* value = std::get_if<T>(&e.value);
  if (value) return *value;
  throw Error(ExitCode::internal, fmt::format("configuration: '{}' is {}, asked for as {}", key, name(e.parameter.type), asked));
}

bool Config::boolean(std::string_view key) const { return get<bool>(key, "boolean"); }
std::int64_t Config::integer(std::string_view key) const { return get<std::int64_t>(key, "integer"); }
const Integer2& Config::integer2(std::string_view key) const { return get<Integer2>(key, "integer2"); }
double Config::real(std::string_view key) const { return get<double>(key, "real"); }
const Real2& Config::real2(std::string_view key) const { return get<Real2>(key, "real2"); }
const Real3& Config::real3(std::string_view key) const { return get<Real3>(key, "real3"); }
const std::string& Config::text(std::string_view key) const { return get<std::string>(key, "text"); }

std::string Config::canonical_text() const {
  std::string out;
  for (const Entry& e : entries_) out += fmt::format("{} = {}\n", e.parameter.key, value_text(e.value));
  return out;
}

}  // namespace rainref::scene
