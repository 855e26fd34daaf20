#include "port_dump/port_info.h"

#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "base/path_text.h"
#include "capture/json_field.h"
#include "capture/json_read.h"
#include "port_dump/apis.h"
#include "port_dump/dump_file.h"
#include "rainref/error.h"

namespace rainref::port_dump {
namespace {

/// The text of `api`, which names a known one, or is empty.
std::string api_text(const capture::JsonField& field) {
  const std::string text = field.text();
  if (text.empty() || api_of(text)) return text;
  std::vector<std::string> names;
  for (const Api& api : apis()) names.emplace_back(api.name);
  field.refuse(fmt::format("expected one of {}, with or without a version, found '{}'{}", fmt::join(names, ", "), text.substr(0, 64),
                           did_you_mean(text.substr(0, text.find_first_of(" 0123456789")), names)));
}

std::vector<ChannelSource> channels_of(const capture::JsonField& list) {
  const std::vector<std::string> texts = list.texts();
  if (texts.empty() || texts.size() > 4) list.refuse(fmt::format("expected 1 to 4 channels, found {}", texts.size()));
  std::vector<ChannelSource> out(texts.size());
  for (std::size_t i = 0; i < texts.size(); ++i)
    if (!parse_source(texts[i], out[i]))
      list.refuse(fmt::format("expected a channel such as x, -y, 1-g, newest.x, 0.5*x+0.5 or x-y, found '{}'", texts[i].substr(0, 64)));
  return out;
}

std::vector<std::string> members_of(const capture::JsonField& object) {
  static const std::array<std::string, 1> keys{"members"};
  object.require_known(keys);
  std::vector<std::string> out = object["members"].texts();
  if (out.empty()) object["members"].refuse("expected the members that the port's records have, found none");
  return out;
}

Encodings encodings_of(const capture::JsonField& object) {
  Encodings out;
  for (const auto& [buffer, own] : object.members()) {
    if (own.is_object())
      out[buffer].members = members_of(own);
    else
      out[buffer].channels = channels_of(own);
  }
  return out;
}

}  // namespace

PortInfo parse_port_info(std::string_view text, const std::string& file) {
  static const std::array<std::string, 9> keys{"api",    "device",    "driver",  "half_store", "flush_denormals",
                                               "origin", "encodings", "precise", "notes"};
  static const std::array<std::string, 3> roundings{"rne", "rtz", "unknown"};
  static const std::array<std::string, 2> origins{"top-left", "bottom-left"};
  const nlohmann::ordered_json json = capture::parse_json(text, file, capture::small_json);
  const capture::JsonField object(json, file);
  object.require_known(keys);
  const auto text_of = [&](const char* key) { return object.has(key) ? object[key].text() : std::string(); };
  PortInfo out;
  if (object.has("api")) out.api = api_text(object["api"]);
  out.device = text_of("device");
  out.driver = text_of("driver");
  out.notes = text_of("notes");
  const int rounding = object.has("half_store") ? object["half_store"].one_of(roundings) : 2;
  if (rounding < 2) out.half_store = rounding == 0 ? Rounding::rne : Rounding::rtz;
  if (object.has("flush_denormals")) out.flush_denormals = object["flush_denormals"].boolean();
  if (object.has("origin")) out.origin = static_cast<Origin>(object["origin"].one_of(origins));
  if (object.has("encodings")) out.encodings = encodings_of(object["encodings"]);
  out.precise = object.has("precise") && object["precise"].boolean();
  return out;
}

PortInfo read_port_info(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "port.json";
  std::error_code ignored;
  if (std::filesystem::symlink_status(path, ignored).type() == std::filesystem::file_type::not_found) return {};
  const std::vector<std::byte> bytes = read_port_file(path, capture::small_json.bytes);
  return parse_port_info({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, fmt::format("'{}'", path_text(path)));
}

}  // namespace rainref::port_dump
