#include "scene/config.h"

#include <fmt/format.h>

#include "scene/value_text.h"

namespace rainref::scene {

std::string Origin::text() const {
  if (kind == file || !at.file.empty()) return at.text();
  return kind == override_option ? "--set" : "default";
}

Config::Config(std::vector<Entry> entries, std::filesystem::path directory)
    : entries_(std::move(entries)), directory_(std::move(directory)) {
  for (const Entry& e : entries_) {
    if (accepts(e.parameter, e.value)) continue;
    throw Error(ExitCode::internal,
                fmt::format("configuration: '{}' expects {}, found {}", e.parameter.key, expectation(e.parameter), value_text(e.value)));
  }
  text("effect");
  text("variant");
}

const Config::Entry& Config::entry(std::string_view key) const {
  for (const Entry& e : entries_) {
    if (e.parameter.key == key) return e;
  }
  throw Error(ExitCode::internal, fmt::format("configuration: no parameter '{}' here", key));
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
