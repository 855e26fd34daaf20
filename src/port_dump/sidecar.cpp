#include "port_dump/sidecar.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "capture/json_field.h"
#include "capture/json_read.h"
#include "port_dump/format_names.h"
#include "rainref/error.h"

namespace rainref::port_dump {
namespace {

using capture::JsonField;

constexpr int format_count = static_cast<int>(Format::r32ui) + 1;

// Formats by their number, then "records".
std::vector<std::string> format_names() {
  std::vector<std::string> out;
  for (int i = 0; i < format_count; ++i) out.emplace_back(info(static_cast<Format>(i)).name);
  out.emplace_back("records");
  return out;
}

std::size_t count_of(const JsonField& object, const char* key, std::size_t otherwise) {
  return object.has(key) ? object[key].count() : otherwise;
}

void read_image_keys(const JsonField& object, Sidecar& out) {
  static const std::array<std::string, 2> origins{"top-left", "bottom-left"}, orders{"rgba", "bgra"}, encodings{"linear", "srgb"};
  out.height = object["height"].count();
  out.row_pitch = count_of(object, "row_pitch", 0);
  if (object.has("origin")) out.origin = static_cast<Origin>(object["origin"].one_of(origins));
  out.is_bgra = object.has("channel_order") && object["channel_order"].one_of(orders) == 1;
  if (out.is_bgra && info(out.format).channels != 4) {
    object["channel_order"].refuse(fmt::format("'bgra' needs four channels; {} has {}", info(out.format).name, info(out.format).channels));
  }
  if (object.has("encoding")) {
    out.is_srgb = object["encoding"].one_of(encodings) == 1;
    if (*out.is_srgb && info(out.format).channel_bytes != 1) {
      object["encoding"].refuse(fmt::format("'srgb' is for 8-bit codes, not for {}", info(out.format).name));
    }
  }
  for (const char* key : {"struct_stride", "fields"}) {
    if (object.has(key)) object[key].refuse("is for records; the format is an image's");
  }
}

void read_record_keys(const JsonField& object, Sidecar& out) {
  out.height = count_of(object, "height", 1);
  if (out.height != 1) object["height"].refuse(fmt::format("records have height 1, found {}", out.height));
  out.struct_stride = count_of(object, "struct_stride", 0);
  if (object.has("fields")) {
    for (const auto& [name, offset] : object["fields"].members()) out.fields.emplace_back(name, offset.count());
    std::ranges::sort(out.fields);
  }
  for (const char* key : {"row_pitch", "origin", "channel_order", "encoding"}) {
    if (object.has(key)) object[key].refuse("is for images; the format is records");
  }
}

}  // namespace

Sidecar parse_sidecar(std::string_view text, const std::string& file) {
  static const std::array<std::string, 10> keys{"format", "width",         "height", "offset",        "row_pitch",
                                                "origin", "channel_order", "fields", "struct_stride", "encoding"};
  static const std::vector<std::string> formats = format_names();
  const nlohmann::ordered_json json = capture::parse_json(text, file, capture::small_json);
  const JsonField object(json, file);
  object.require_known(keys);
  const int format = object["format"].one_of(formats, hint_of_other_name);
  Sidecar out;
  out.is_records = format == format_count;
  if (!out.is_records) out.format = static_cast<Format>(format);
  out.width = object["width"].count();
  out.offset = count_of(object, "offset", 0);
  if (out.is_records) {
    read_record_keys(object, out);
  } else {
    read_image_keys(object, out);
  }
  return out;
}

}  // namespace rainref::port_dump
