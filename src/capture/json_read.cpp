#include "capture/json_read.h"

#include <set>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/read_file.h"

namespace rainref::capture {
namespace {

using OrderedJson = nlohmann::ordered_json;

/// Extracts "line 3, column 7: unexpected ','; expected ..." from the library's longer message.
std::string json_reason(std::string text) {
  if (const std::size_t at = text.find("parse error at "); at != std::string::npos) text.erase(0, at + 15);
  if (const std::size_t at = text.find("syntax error while parsing"); at != std::string::npos) {
    if (const std::size_t dash = text.find(" - ", at); dash != std::string::npos) text.erase(at, dash + 3 - at);
  }
  return text.substr(0, 160);
}

}  // namespace

// The library silently keeps one of several equal keys, and accepts any depth, which would overflow the stack of code that walks the
// result.
OrderedJson parse_json(std::string_view text, const std::string& name, const JsonLimits& limits) {
  const auto refuse = [&](const std::string& why) { throw Error(limits.code, fmt::format("{}: {}", name, why)); };
  if (text.size() > limits.bytes) refuse(fmt::format("{} bytes; expected at most {}", text.size(), limits.bytes));
  std::vector<std::set<std::string>> keys;
  const auto watch = [&](int depth, OrderedJson::parse_event_t event, OrderedJson& parsed) {
    if (depth > limits.depth) refuse(fmt::format("nested deeper than {}", limits.depth));
    if (event == OrderedJson::parse_event_t::object_start) keys.emplace_back();
    if (event == OrderedJson::parse_event_t::object_end) keys.pop_back();
    if (event == OrderedJson::parse_event_t::key && !keys.back().insert(parsed.get<std::string>()).second)
      refuse(fmt::format("key '{}' appears twice", parsed.get<std::string>().substr(0, 40)));
    return true;
  };
  try {
    return OrderedJson::parse(text, watch);
  } catch (const nlohmann::json::exception& e) {
    throw Error(limits.code, fmt::format("{}: not JSON: {}", name, json_reason(e.what())));
  }
}

OrderedJson read_json(const std::filesystem::path& file, const std::string& name, const JsonLimits& limits) {
  const std::vector<std::byte> bytes = read_file(file, {limits.bytes, limits.code});
  return parse_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, name, limits);
}

}  // namespace rainref::capture
