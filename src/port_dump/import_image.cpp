#include "port_dump/import_image.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/path_text.h"
#include "math/half.h"
#include "port_dump/dump_file.h"
#include "port_dump/raw_bytes.h"
#include "port_dump/read_buffer.h"
#include "rainref/error.h"

namespace rainref::port_dump {
namespace {

using Bytes = std::vector<std::byte>;

/// One way to read the file.
struct Reading {
  std::string how;  ///< "origin bottom-left, row_pitch 256": what distinguishes it
  Bytes values;
  std::size_t near = 0;            ///< values near the expected ones
  std::vector<std::string> notes;  ///< of what was read
};

FileType type_of(std::span<const std::byte> bytes) {
  constexpr std::pair<std::string_view, FileType> magic[] = {
      {"DDS ", FileType::dds}, {"\x93NUMPY", FileType::npy}, {"\x76\x2f\x31\x01", FileType::exr}, {"\x89PNG", FileType::png}};
  for (const auto& [begin, type] : magic)
    if (bytes.size() >= begin.size() && std::memcmp(bytes.data(), begin.data(), begin.size()) == 0) return type;
  return FileType::bin;
}

// ---- values --------------------------------------------------------------------------------------------------------
double value_at(const FormatInfo& format, const std::byte* at) {
  std::uint32_t word = 0;
  std::memcpy(&word, at, static_cast<std::size_t>(format.channel_bytes));
  switch (format.kind) {
    case FormatInfo::float16:
      return to_float(Half{static_cast<std::uint16_t>(word)});
    case FormatInfo::float32:
      return std::bit_cast<float>(word);
    default:
      return word;
  }
}
/// Values within 1/64 of the largest expected one; whole numbers of 32 bits are equal.
std::size_t near_values(const Bytes& got, const Bytes& expected, const FormatInfo& format) {
  const auto step = static_cast<std::size_t>(format.channel_bytes);
  double largest = 0;
  for (std::size_t i = 0; i + step <= expected.size(); i += step)
    if (const double v = value_at(format, &expected[i]); std::isfinite(v)) largest = std::max(largest, std::abs(v));
  const double most = format.kind == FormatInfo::uint32 ? 0 : largest / 64;
  std::size_t near = 0;
  for (std::size_t i = 0; i + step <= expected.size() && i + step <= got.size(); i += step)
    near += std::abs(value_at(format, &got[i]) - value_at(format, &expected[i])) <= most;
  return near;
}

// ---- raw bytes -----------------------------------------------------------------------------------------------------
/// Formats that hold the buffer's values: its own, then with four channels, then floats for halves.
std::vector<Format> formats_for(Format own) {
  const FormatInfo& format = info(own);
  std::vector<Format> out{own};
  for (int i = 0; i <= static_cast<int>(Format::r32ui); ++i) {
    const auto other = static_cast<Format>(i);
    const FormatInfo& found = info(other);
    const bool same_kind = found.kind == format.kind || (found.kind == FormatInfo::float32 && format.kind == FormatInfo::float16);
    if (other != own && same_kind && (found.channels == format.channels || found.channels == 4)) out.push_back(other);
  }
  return out;
}
/// Distances of rows that use all bytes, with padding after the last row or without; the tight one alone if that fits. Others are what APIs
/// give: multiples of 64 bytes, or rows padded to 4, 8 or 16.
std::vector<std::size_t> pitches_for(std::size_t bytes, std::size_t row, std::size_t height) {
  constexpr std::size_t most_padding = 4096;
  if (bytes == row * height) return {row};
  std::vector<std::size_t> out;
  const auto offer = [&](std::size_t pitch) {
    const bool is_usual = pitch % 64 == 0 ? pitch - row <= most_padding : pitch % 4 == 0 && pitch - row < 16;
    if (pitch > row && is_usual) out.push_back(pitch);
  };
  if (bytes % height == 0) offer(bytes / height);
  if (height > 1 && bytes > row && (bytes - row) % (height - 1) == 0) offer((bytes - row) / (height - 1));
  return out;
}

class Importer {
 public:
  Importer(const std::filesystem::path& path, const capture::Array& expected, int level, const ImportHints& hints, Alpha alpha)
      : file_(fmt::format("'{}'", path_text(path))),
        bytes_(read_port_file(path, std::uint64_t{1} << 32)),
        expected_(expected),
        level_(level),
        height_(static_cast<std::size_t>(expected.level_height(level))),
        hints_(hints),
        alpha_(alpha) {}

  ImportedLevel read() {
    const FileType type = type_of(bytes_);
    if (type == FileType::bin) {
      read_raw();
    } else {
      if (hints_.row_pitch || hints_.is_bgra)
        refuse("its own header says how its rows and channels lie; expected no row pitch or channel order");
      constexpr const char* names[] = {"NPY", "EXR", "DDS", "PNG"};
      said_.push_back(fmt::format("{}: {}", file_, names[static_cast<std::size_t>(type)]));
      add_origins("", [&](ReadNotes& notes) {
        capture::Array out = expected_;
        out.levels.clear();
        read_levels({type, file_, bytes_, {}, {}}, of_level(), 0, {}, out, notes, alpha_);
        return out.levels.front().all();
      });
    }
    return chosen();
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const { throw Error(ExitCode::port_files, fmt::format("{}: {}", file_, why)); }
  /// The expected level as an image of its own.
  capture::Array of_level() const {
    capture::Array out = expected_;
    out.width = expected_.level_width(level_);
    out.height = expected_.level_height(level_);
    out.levels = {expected_.levels[static_cast<std::size_t>(level_)]};
    return out;
  }
  const Bytes& wanted() const { return expected_.levels[static_cast<std::size_t>(level_)]; }

  void read_raw() {
    const auto width = static_cast<std::size_t>(expected_.level_width(level_));
    std::vector<std::string> sizes;
    for (const Format format : formats_for(expected_.format)) {
      const std::size_t row = width * static_cast<std::size_t>(info(format).texel_bytes());
      sizes.push_back(fmt::format("{} of {}", row * height_, info(format).name));
      for (const std::size_t pitch : hints_.row_pitch ? std::vector{*hints_.row_pitch} : pitches_for(bytes_.size(), row, height_)) {
        const bool may_be_bgra = info(format).channels == 4 && info(format).channel_bytes == 1;
        for (const bool is_bgra : {false, true}) {
          if ((is_bgra && !may_be_bgra) || (hints_.is_bgra && *hints_.is_bgra != is_bgra)) continue;
          Sidecar rows;
          rows.format = format;
          rows.width = width;
          rows.height = height_;
          rows.row_pitch = pitch;
          rows.is_bgra = is_bgra;
          add_raw(rows, pitch != row);
        }
      }
    }
    if (!readings_.empty()) return;
    if (!why_.empty()) throw Error(ExitCode::port_files, why_);
    refuse(fmt::format("raw bytes: expected {} bytes for {}x{} texels, or rows padded alike, found {}", fmt::join(sizes, ", "), width,
                       height_, bytes_.size()));
  }
  void add_raw(const Sidecar& sidecar, bool is_padded) {
    std::string how = fmt::format("format {}", info(sidecar.format).name);
    if (is_padded) how += fmt::format(", row_pitch {}", sidecar.row_pitch);
    if (sidecar.is_bgra) how += ", channel_order bgra";
    add_origins(how, [&](ReadNotes& notes) {
      return canonical_level(image_in(bytes_, file_, sidecar, of_level(), 0), of_level(), 0, notes, alpha_);
    });
  }
  /// The rows as they lie, and turned over. A reading that gives the values of an earlier one is the same.
  template <class Read>
  void add_origins(const std::string& how, const Read& read) {
    ReadNotes notes;
    Bytes top_left;
    try {
      top_left = read(notes);
    } catch (const Error& error) {
      if (type_of(bytes_) != FileType::bin) throw;
      if (why_.empty()) why_ = error.what();
      return;
    }
    for (const Origin origin : {Origin::top_left, Origin::bottom_left}) {
      if (hints_.origin && *hints_.origin != origin) continue;
      Bytes values = origin == Origin::top_left ? top_left : turned_over(top_left, height_);
      if (std::any_of(readings_.begin(), readings_.end(), [&](const Reading& r) { return r.values == values; })) continue;
      const std::size_t near = near_values(values, wanted(), info(expected_.format));
      const std::string name = origin == Origin::top_left ? "top-left" : "bottom-left";
      readings_.push_back({fmt::format("{}{}origin {}", how, how.empty() ? "" : ", ", name), std::move(values), near, notes.lines});
    }
  }

  ImportedLevel chosen() {
    auto best = std::max_element(readings_.begin(), readings_.end(), [](const Reading& a, const Reading& b) { return a.near < b.near; });
    const std::size_t count = wanted().size() / static_cast<std::size_t>(info(expected_.format).channel_bytes);
    if (readings_.size() == 1) {
      said_.push_back(fmt::format("read as {}", best->how));
    } else {
      std::size_t next = 0;
      for (auto r = readings_.begin(); r != readings_.end(); ++r)
        if (r != best) next = std::max(next, r->near);
      if (2 * best->near >= count && best->near >= next + std::max<std::size_t>(1, count / 100)) {
        said_.push_back(fmt::format("read as {}: so {} of {} values are near the expected ones, the next best way {}", best->how,
                                    best->near, count, next));
      } else {
        best = readings_.begin();
        std::vector<std::string> others;
        for (auto r = readings_.begin() + 1; r != readings_.end(); ++r) others.push_back(r->how);
        said_.push_back(fmt::format("read as {}; the values do not tell it from {}", best->how, fmt::join(others, "; or ")));
      }
    }
    said_.insert(said_.end(), best->notes.begin(), best->notes.end());
    return {std::move(best->values), said_};
  }

  std::string file_;
  Bytes bytes_;
  const capture::Array& expected_;
  int level_;
  std::size_t height_;
  ImportHints hints_;
  Alpha alpha_;
  std::vector<Reading> readings_;
  std::vector<std::string> said_;
  std::string why_;  // the first reading's refusal
};

}  // namespace

std::vector<std::byte> turned_over(const std::vector<std::byte>& rows, std::size_t height) {
  const std::size_t row = rows.size() / height;
  std::vector<std::byte> out(rows.size());
  for (std::size_t y = 0; y < height; ++y) std::memcpy(&out[y * row], &rows[(height - 1 - y) * row], row);
  return out;
}

ImportedLevel import_level(const std::filesystem::path& file, const capture::Array& expected, int level, const ImportHints& hints,
                           Alpha alpha) {
  return Importer(file, expected, level, hints, alpha).read();
}

}  // namespace rainref::port_dump
