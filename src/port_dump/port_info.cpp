#include "port_dump/port_info.h"

#include <array>

#include <fmt/format.h>

#include "capture/json_read.h"
#include "port_dump/dump_file.h"
#include "port_dump/json_object.h"

namespace rainref::port_dump {

PortInfo parse_port_info(std::string_view text, const std::string& file) {
  static const std::array<std::string, 8> keys{"api", "device", "driver", "half_store", "flush_denormals", "origin", "precise", "notes"};
  static const std::array<std::string, 3> roundings{"rne", "rtz", "unknown"};
  static const std::array<std::string, 2> origins{"top-left", "bottom-left"};
  const JsonObject object(text, file, keys);
  PortInfo out;
  out.api = object.text("api").value_or("");
  out.device = object.text("device").value_or("");
  out.driver = object.text("driver").value_or("");
  out.notes = object.text("notes").value_or("");
  const std::size_t rounding = object.choice("half_store", roundings).value_or(2);
  if (rounding < 2) out.half_store = rounding == 0 ? Rounding::rne : Rounding::rtz;
  out.flush_denormals = object.boolean("flush_denormals");
  out.origin = static_cast<Origin>(object.choice("origin", origins).value_or(0));
  out.precise = object.boolean("precise").value_or(false);
  return out;
}

PortInfo read_port_info(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "port.json";
  std::error_code ignored;
  if (std::filesystem::symlink_status(path, ignored).type() == std::filesystem::file_type::not_found) return {};
  const std::vector<std::byte> bytes = read_port_file(path, capture::small_json.bytes);
  return parse_port_info({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, fmt::format("'{}'", path.string()));
}

}  // namespace rainref::port_dump
