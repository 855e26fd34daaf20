#include "port_dump/raw_bytes.h"

#include <fmt/format.h>

#include "rainref/error.h"

namespace rainref::port_dump {
namespace {

[[noreturn]] void refuse(const std::string& file, const std::string& why) {
  throw Error(ExitCode::port_files, fmt::format("{}: {}", file, why));
}

/// "; row_pitch 256 would fit" if rows of this many bytes, with or without padding after the last one, match the number of bytes found; ""
/// if no multiple of 4 bytes does. If several do, a multiple of 256 is preferred.
std::string fitting_pitch(std::size_t found, std::size_t row, std::size_t height) {
  constexpr std::size_t most_padding = 4096;
  std::size_t best = 0;
  const auto offer = [&](std::size_t pitch) {
    if (pitch < row || pitch - row > most_padding || pitch % 4 != 0) return;
    if (best == 0 || (best % 256 != 0 && pitch % 256 == 0)) best = pitch;
  };
  if (height > 1 && found % height == 0) offer(found / height);
  if (height > 1 && found >= row && (found - row) % (height - 1) == 0) offer((found - row) / (height - 1));
  return best == 0 ? "" : fmt::format("; row_pitch {} would fit", best);
}

std::span<const std::byte> behind_offset(std::span<const std::byte> bytes, const std::string& file, const Sidecar& sidecar) {
  if (sidecar.offset > bytes.size()) {
    refuse(file, fmt::format("truncated: offset {} in a file of {} bytes", sidecar.offset, bytes.size()));
  }
  return bytes.subspan(sidecar.offset);
}

void check_encoding(const std::string& file, const Sidecar& sidecar, Format expected) {
  if (!sidecar.is_srgb || info(expected).channel_bytes != 1) return;
  const bool srgb = info(expected).kind == FormatInfo::srgb8;
  if (*sidecar.is_srgb != srgb) {
    refuse(file, fmt::format("encoding: {} stores {} codes, the sidecar says '{}'; converted codes are not the buffer's",
                             info(expected).name, srgb ? "sRGB" : "linear", *sidecar.is_srgb ? "srgb" : "linear"));
  }
}

}  // namespace

StoredImage image_in(std::span<const std::byte> bytes, const std::string& file, const Sidecar& sidecar, const capture::Array& expected,
                     int level) {
  check_level_size(file, sidecar.width, sidecar.height, expected, level);
  check_encoding(file, sidecar, expected.format);
  StoredImage out;
  out.file = file;
  out.width = sidecar.width;
  out.height = sidecar.height;
  out.set_channels(info(sidecar.format).kind, info(sidecar.format).channels);
  if (sidecar.is_bgra) std::swap(out.channels[0].offset, out.channels[2].offset);
  const std::size_t row = out.width * out.texel_bytes;
  out.row_pitch = sidecar.row_pitch == 0 ? row : sidecar.row_pitch;
  if (out.row_pitch < row) {
    refuse(file, fmt::format("row_pitch {} is less than a row of {} {} texels, {} bytes", out.row_pitch, out.width,
                             info(sidecar.format).name, row));
  }
  out.rows = behind_offset(bytes, file, sidecar);
  // The last row may lack its padding. Compared by division, because height times pitch may not fit.
  const std::size_t found = out.rows.size();
  const auto text = [&] {
    return fmt::format("{} rows of {} bytes behind offset {}, found {} bytes{}", out.height, out.row_pitch, sidecar.offset, found,
                       fitting_pitch(found, row, out.height));
  };
  if (found < row || (found - row) / out.row_pitch < out.height - 1) refuse(file, "truncated: expected " + text());
  const std::size_t rest = found - (out.height - 1) * out.row_pitch;
  if (rest > out.row_pitch) refuse(file, fmt::format("{} bytes too many: expected {}", rest - out.row_pitch, text()));
  return out;
}

StoredRecords records_in(std::span<const std::byte> bytes, const std::string& file, const Sidecar& sidecar,
                         const scene::UniformBlock& record) {
  StoredRecords out;
  out.file = file;
  out.count = sidecar.width;
  out.stride = sidecar.struct_stride == 0 ? record.size : sidecar.struct_stride;
  out.bytes = behind_offset(bytes, file, sidecar);
  if (sidecar.fields.empty()) {
    for (const scene::Member& member : record.members) out.fields.push_back({member.name, "", member.offset, 1});
  }
  for (const auto& [name, offset] : sidecar.fields) out.fields.push_back({name, "", offset, 1});
  if (out.bytes.size() / out.stride > out.count || (out.bytes.size() / out.stride == out.count && out.bytes.size() % out.stride != 0)) {
    refuse(file, fmt::format("bytes too many: expected {} records of {} bytes behind offset {}, found {} bytes", out.count, out.stride,
                             sidecar.offset, out.bytes.size()));
  }
  return out;
}

}  // namespace rainref::port_dump
