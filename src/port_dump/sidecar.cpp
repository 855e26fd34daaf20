#include "port_dump/sidecar.h"

#include <array>

#include <fmt/format.h>

#include "port_dump/format_names.h"
#include "port_dump/json_object.h"
#include "rainref/error.h"

namespace rainref::port_dump {
namespace {

constexpr int format_count = static_cast<int>(Format::r32ui) + 1;

// Formats by their number, then "records".
std::vector<std::string> format_names() {
  std::vector<std::string> out;
  for (int i = 0; i < format_count; ++i) out.emplace_back(info(static_cast<Format>(i)).name);
  out.emplace_back("records");
  return out;
}

std::size_t required(const JsonObject& object, const std::string& key) {
  const auto value = object.count(key);
  if (!value) object.refuse(key, "missing");
  return *value;
}

void read_image_keys(const JsonObject& object, Sidecar& out) {
  static const std::array<std::string, 2> origins{"top-left", "bottom-left"}, orders{"rgba", "bgra"}, encodings{"linear", "srgb"};
  out.height = required(object, "height");
  out.row_pitch = object.count("row_pitch").value_or(0);
  if (const auto origin = object.choice("origin", origins)) out.origin = static_cast<Origin>(*origin);
  out.is_bgra = object.choice("channel_order", orders).value_or(0) == 1;
  if (out.is_bgra && info(out.format).channels != 4) {
    object.refuse("channel_order", fmt::format("'bgra' needs four channels; {} has {}", info(out.format).name, info(out.format).channels));
  }
  if (const auto encoding = object.choice("encoding", encodings)) {
    out.is_srgb = *encoding == 1;
    if (*out.is_srgb && info(out.format).channel_bytes != 1) {
      object.refuse("encoding", fmt::format("'srgb' is for 8-bit codes, not for {}", info(out.format).name));
    }
  }
  for (const char* key : {"struct_stride", "fields"}) {
    if (object.has(key)) object.refuse(key, "is for records; the format is an image's");
  }
}

void read_record_keys(const JsonObject& object, Sidecar& out) {
  out.height = object.count("height").value_or(1);
  if (out.height != 1) object.refuse("height", fmt::format("records have height 1, found {}", out.height));
  out.struct_stride = object.count("struct_stride").value_or(0);
  out.fields = object.counts("fields").value_or(std::vector<std::pair<std::string, std::size_t>>());
  for (const char* key : {"row_pitch", "origin", "channel_order", "encoding"}) {
    if (object.has(key)) object.refuse(key, "is for images; the format is records");
  }
}

}  // namespace

Sidecar parse_sidecar(std::string_view text, const std::string& file) {
  static const std::array<std::string, 10> keys{"format", "width",         "height", "offset",        "row_pitch",
                                                "origin", "channel_order", "fields", "struct_stride", "encoding"};
  static const std::vector<std::string> formats = format_names();
  const JsonObject object(text, file, keys);
  const auto format = object.choice("format", formats, hint_of_other_name);
  if (!format) object.refuse("format", "missing");
  Sidecar out;
  out.is_records = *format == format_count;
  if (!out.is_records) out.format = static_cast<Format>(*format);
  out.width = required(object, "width");
  out.offset = object.count("offset").value_or(0);
  if (out.is_records) {
    read_record_keys(object, out);
  } else {
    read_image_keys(object, out);
  }
  return out;
}

}  // namespace rainref::port_dump
