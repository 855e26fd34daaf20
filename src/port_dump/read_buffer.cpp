#include "port_dump/read_buffer.h"

#include <algorithm>
#include <limits>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/path_text.h"
#include "capture/json_read.h"
#include "capture/npy_read.h"
#include "image_io/evidence.h"
#include "port_dump/dds.h"
#include "port_dump/encoding.h"
#include "port_dump/raw_bytes.h"
#include "port_dump/read_encoded.h"
#include "port_dump/sidecar.h"
#include "port_dump/stored_records.h"
#include "rainref/error.h"

namespace rainref::port_dump {
namespace {

using Kind = FormatInfo::Kind;

[[noreturn]] void refuse(const FileBytes& file, const std::string& why) {
  throw Error(ExitCode::port_files, fmt::format("{}: {}", file.file, why));
}

Kind kind_of_npy(const std::string& type) {
  return type == "|u1" ? Kind::unorm8 : type == "<f2" ? Kind::float16 : type == "<f4" ? Kind::float32 : Kind::uint32;
}

StoredImage npy_image(const FileBytes& file) {
  const capture::NpyHeader header = capture::parse_npy_header(file.bytes, file.file);
  if (header.type.empty()) refuse(file, "records; an image was expected");
  if (header.shape.size() < 2 || header.shape.size() > 3 || (header.shape.size() == 3 && (header.shape[2] < 1 || header.shape[2] > 4))) {
    refuse(file, fmt::format("expected a shape of (height, width) or (height, width, channels up to 4), found ({})",
                             fmt::join(header.shape, ", ")));
  }
  StoredImage out;
  out.file = file.file;
  out.height = header.shape[0];
  out.width = header.shape[1];
  out.set_channels(kind_of_npy(header.type), header.shape.size() == 3 ? header.shape[2] : 1);
  out.row_pitch = out.width * out.texel_bytes;
  out.rows = file.bytes.subspan(header.data_offset);
  return out;
}

// The encoding of an 8-bit file is only a label: the codes are used unchanged, and a contradiction is noted.
void note_encoding(const FileBytes& file, bool is_srgb, std::string_view label, Format expected, ReadNotes& notes) {
  if (info(expected).channel_bytes != 1 || is_srgb == (info(expected).kind == Kind::srgb8)) return;
  notes.lines.push_back(fmt::format("{}: {}, the buffer is {}: the codes are taken as they are", file.file, label, info(expected).name));
}

std::vector<StoredImage> dds_levels(const FileBytes& file, const capture::Array& expected, int level, ReadNotes& notes) {
  Dds dds = parse_dds(file.bytes, file.file);
  const std::size_t missing = expected.levels.size() - static_cast<std::size_t>(level);
  if (dds.levels.size() > 1 && level == 0 && dds.levels.size() < missing) {
    refuse(file, fmt::format("expected {} mip levels, found {}", missing, dds.levels.size()));
  }
  const std::size_t wanted = level == 0 && dds.levels.size() > 1 ? missing : 1;
  if (dds.levels.size() > wanted) {
    notes.lines.push_back(fmt::format("{}: {} mip levels, {} read", file.file, dds.levels.size(), wanted));
    dds.levels.resize(wanted);
  }
  const Kind kind = dds.levels[0].channels[0].kind;
  if (kind == Kind::unorm8 && !dds.format.ends_with("TYPELESS")) note_encoding(file, dds.is_srgb, dds.format, expected.format, notes);
  return std::move(dds.levels);
}

// A picture file, decoded only if its size is right.
StoredImage picture(const FileBytes& file, const capture::Array& expected, int level, Kinds kinds, image_io::Evidence& storage) {
  const image_io::EvidenceSize size = image_io::evidence_size(file.file, file.bytes);
  check_level_size(file.file, size.width, size.height, expected, level);
  if (file.type == FileType::png && kinds == Kinds::own && info(expected.format).channel_bytes != 1) {
    refuse(file, fmt::format("a PNG holds 8-bit codes, the buffer is {}: the exporter has quantized; save EXR or NPY",
                             info(expected.format).name));
  }
  storage = image_io::read_evidence(file.file, file.bytes);
  StoredImage out;
  out.file = file.file;
  out.width = storage.width;
  out.height = storage.height;
  out.texel_bytes = storage.texel_bytes;
  out.row_pitch = storage.width * storage.texel_bytes;
  out.rows = storage.texels;
  for (const image_io::Evidence::Channel& channel : storage.channels) out.channels.push_back({channel.kind, channel.offset});
  return out;
}

// The format of the file's own values. Levels before it in `out` have set it.
Format format_in(const FileBytes& file, const StoredImage& stored, int channels, const capture::Array& out) {
  const Kind kind = stored.channels.front().kind;
  const std::optional<Format> format = format_of(kind, channels);
  if (!format) refuse(file, fmt::format("expected {} channels, found {}", channels, kind_text(kind)));
  if (!out.levels.empty() && *format != out.format)
    refuse(file, fmt::format("expected {} as level 0 has, found {}", kind_text(info(out.format).kind), kind_text(kind)));
  return *format;
}

// A longer file than any accepted layout of the buffer is refused before it is read.
std::size_t longest_file(const capture::Array& expected) {
  if (expected.is_records) return std::numeric_limits<std::size_t>::max();  // any number of records
  std::size_t texels = 0;
  for (std::size_t l = 0; l < expected.levels.size(); ++l) {
    texels += static_cast<std::size_t>(expected.level_width(static_cast<int>(l))) *
              static_cast<std::size_t>(expected.level_height(static_cast<int>(l)));
  }
  return 64 * texels + 65536 * static_cast<std::size_t>(expected.height) + (std::size_t{1} << 20);
}

// The bytes of a dump's file and of its sidecar.
struct LoadedFile {
  DumpFile file;
  std::vector<std::byte> bytes, sidecar;

  LoadedFile(const std::filesystem::path& folder, const std::string& stem, const capture::Array& expected)
      : file(find_dump_file(folder, stem)) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(file.path, error);
    if (!error && size > longest_file(expected)) {
      throw Error(ExitCode::port_files, fmt::format("{}: {} bytes are too many for {}x{} texels of {}", file.quoted(), size, expected.width,
                                                    expected.height, info(expected.format).name));
    }
    bytes = read_port_file(file.path, longest_file(expected));
    if (!file.sidecar.empty()) sidecar = read_port_file(file.sidecar, capture::small_json.bytes);
  }
  FileBytes view() const {
    return {file.type,
            file.quoted(),
            bytes,
            {reinterpret_cast<const char*>(sidecar.data()), sidecar.size()},
            fmt::format("'{}'", path_text(file.sidecar))};
  }
};

}  // namespace

void read_levels(const FileBytes& file, const capture::Array& expected, int level, const PortInfo& port, capture::Array& out,
                 ReadNotes& notes, Alpha alpha, Kinds kinds) {
  image_io::Evidence storage;  // outlives the views of it
  std::vector<StoredImage> levels;
  Origin origin = port.origin;
  switch (file.type) {
    case FileType::npy:
      levels = {npy_image(file)};
      break;
    case FileType::exr:
    case FileType::png:
      levels = {picture(file, expected, level, kinds, storage)};
      break;
    case FileType::dds:
      levels = dds_levels(file, expected, level, notes);
      break;
    case FileType::bin: {
      const Sidecar sidecar = parse_sidecar(file.sidecar, file.sidecar_file);
      if (sidecar.is_records) refuse(file, "its sidecar says records; an image was expected");
      levels = {image_in(file.bytes, file.file, sidecar, expected, level)};
      origin = sidecar.origin.value_or(origin);
      note_encoding(file, info(sidecar.format).kind == Kind::srgb8, info(sidecar.format).name, expected.format, notes);
      break;
    }
  }
  capture::Array wanted = expected;
  if (kinds == Kinds::any) out.format = wanted.format = format_in(file, levels.front(), info(expected.format).channels, out);
  for (StoredImage& stored : levels) {
    stored.bottom_up = origin == Origin::bottom_left;
    out.levels.push_back(canonical_level(stored, wanted, level++, notes, alpha));
  }
}

void read_records(const FileBytes& file, const capture::Array& expected, capture::Array& out, ReadNotes& notes) {
  StoredRecords stored;
  if (file.type == FileType::npy) {
    const capture::NpyHeader header = capture::parse_npy_header(file.bytes, file.file);
    if (!header.type.empty()) refuse(file, fmt::format("expected a structured array of {}, found '{}'", expected.record.name, header.type));
    if (header.shape.size() != 1) refuse(file, fmt::format("expected a shape of (records,), found ({})", fmt::join(header.shape, ", ")));
    stored = {file.file, header.fields, header.record_bytes, header.shape[0], file.bytes.subspan(header.data_offset)};
  } else if (file.type == FileType::bin) {
    const Sidecar sidecar = parse_sidecar(file.sidecar, file.sidecar_file);
    if (!sidecar.is_records) refuse(file, "its sidecar says an image; records were expected");
    stored = records_in(file.bytes, file.file, sidecar, expected.record);
  } else {
    refuse(file, "records are dumped as .npy or as .bin with a sidecar");
  }
  if (stored.count > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    refuse(file, fmt::format("{} records; expected fewer than 2^31", stored.count));
  }
  out.levels.push_back(canonical_records(stored, expected.record, notes));
  out.width = static_cast<int>(stored.count);
  out.height = 1;
}

capture::Array read_port_buffer(const std::filesystem::path& folder, std::string_view stem, const capture::Array& expected,
                                const PortInfo& port, ReadNotes& notes, Alpha alpha, Kinds kinds) {
  if (expected.levels.empty() || (!expected.is_records && (expected.width < 1 || expected.height < 1))) {
    throw Error(ExitCode::internal, fmt::format("buffer '{}' was asked for without a size", stem));
  }
  notes.kept = nullptr;
  if (const auto own = port.encodings.find(buffer_of(stem)); own != port.encodings.end())
    return own->second.channels.empty() ? read_members(folder, stem, expected, own->second, port, notes)
                                        : read_channels(folder, stem, expected, own->second, port, notes);
  capture::Array out = expected;
  out.levels.clear();
  if (expected.is_records) {
    const LoadedFile loaded(folder, std::string(stem), expected);
    read_records(loaded.view(), expected, out, notes);
    return out;
  }
  while (out.levels.size() < expected.levels.size()) {
    const std::size_t level = out.levels.size();
    const LoadedFile loaded(folder, level == 0 ? std::string(stem) : fmt::format("{}.L{}", stem, level), expected);
    read_levels(loaded.view(), expected, static_cast<int>(level), port, out, notes, alpha, kinds);
  }
  return out;
}

}  // namespace rainref::port_dump
