#include "port_dump/encoding.h"

#include <algorithm>
#include <cctype>
#include <cstring>

#include <fmt/format.h>

#include "port_dump/read_buffer.h"
#include "rainref/error.h"

namespace rainref::port_dump {
namespace {

using Change = ChannelSource::Change;

/// The format of this kind with the fewest channels that has `channels` of them.
Format format_of(FormatInfo::Kind kind, int channels) {
  Format best = Format::r8;
  int fewest = 5;
  for (int i = 0; i <= static_cast<int>(Format::r32ui); ++i) {
    const FormatInfo& f = info(static_cast<Format>(i));
    if (f.kind != kind || f.channels < channels || f.channels >= fewest) continue;
    best = static_cast<Format>(i);
    fewest = f.channels;
  }
  return best;
}

void change_channel(std::byte* at, const FormatInfo& format, Change change) {
  if (change == Change::complement) *at = static_cast<std::byte>(255 - static_cast<int>(*at));
  if (change != Change::negated) return;
  const auto bytes = static_cast<std::size_t>(format.channel_bytes);
  const bool is_zero =
      std::all_of(at, at + bytes - 1, [](std::byte b) { return b == std::byte{0}; }) && (at[bytes - 1] & std::byte{0x7f}) == std::byte{0};
  at[bytes - 1] = is_zero ? std::byte{0} : at[bytes - 1] ^ std::byte{0x80};  // little endian; a zero has no sign
}

}  // namespace

std::string buffer_of(std::string_view stem) {
  const std::string_view name = stem.substr(stem.find('.') + 1);
  return std::string(name.substr(0, name.find('.')));
}

std::vector<std::string> stems_of(std::string_view stem, const PortInfo& port) {
  const std::string buffer = buffer_of(stem);
  const auto own = port.encodings.find(buffer);
  if (own == port.encodings.end()) return {std::string(stem)};
  std::vector<std::string> out;
  for (const ChannelSource& source : own->second) {
    std::string file(stem);
    if (!source.file.empty()) file.replace(stem.find('.') + 1, buffer.size(), source.file);
    if (std::find(out.begin(), out.end(), file) == out.end()) out.push_back(std::move(file));
  }
  return out;
}

bool parse_source(std::string_view text, ChannelSource& source) {
  source = {};
  if (text.starts_with("1-")) {
    source.change = Change::complement;
    text.remove_prefix(2);
  } else if (text.starts_with("-")) {
    source.change = Change::negated;
    text.remove_prefix(1);
  }
  if (const std::size_t dot = text.rfind('.'); dot != std::string_view::npos) {
    source.file = text.substr(0, dot);
    const auto is_of_name = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
    if (source.file.empty() || !std::all_of(source.file.begin(), source.file.end(), is_of_name)) return false;
    text.remove_prefix(dot + 1);
  }
  if (text.size() != 1) return false;
  for (const std::string_view names : {"xyzw", "rgba"})
    if (const std::size_t at = names.find(text); at != std::string_view::npos) {
      source.channel = static_cast<int>(at);
      return true;
    }
  return false;
}

capture::Array read_encoded(const std::filesystem::path& folder, std::string_view stem, const capture::Array& expected,
                            const std::vector<ChannelSource>& sources, const PortInfo& port, ReadNotes& notes) {
  const std::string kind(stem.substr(0, stem.find('.') + 1)), buffer = buffer_of(stem), level(stem.substr(kind.size() + buffer.size()));
  const auto refuse = [&](const std::string& why) {
    throw Error(ExitCode::port_files, fmt::format("'{}': encodings.{}: {}", (folder / std::string(stem)).string(), buffer, why));
  };
  if (expected.is_records) refuse("a list has no channels");
  const FormatInfo& format = info(expected.format);
  if (sources.size() != static_cast<std::size_t>(format.channels))
    refuse(fmt::format("expected {} channel{} of {}, found {}", format.channels, format.channels == 1 ? "" : "s", format.name,
                       sources.size()));
  std::map<std::string, int> channels;  // that each file must have
  const bool are_codes = format.channel_bytes == 1;
  for (const ChannelSource& s : sources) {
    if (s.change == Change::negated && (are_codes || format.kind == FormatInfo::uint32)) refuse(fmt::format("{} has no sign", format.name));
    if (s.change == Change::complement && !are_codes) refuse(fmt::format("1- is for codes of 8 bits, found {}", format.name));
    int& most = channels[s.file];
    most = std::max(most, s.channel + 1);
  }
  PortInfo plain = port;
  plain.encodings.clear();
  std::map<std::string, capture::Array> files;
  for (const auto& [file, count] : channels) {
    capture::Array own = expected;
    own.format = format_of(format.kind, count);
    files[file] = read_port_buffer(folder, kind + (file.empty() ? buffer : file) + level, own, plain, notes);
  }
  capture::Array out = expected;
  out.levels.clear();
  const auto bytes = static_cast<std::size_t>(format.channel_bytes);
  for (std::size_t l = 0; l < expected.levels.size(); ++l) {
    const auto texels = static_cast<std::size_t>(expected.level_width(static_cast<int>(l))) *
                        static_cast<std::size_t>(expected.level_height(static_cast<int>(l)));
    std::vector<std::byte> made(texels * sources.size() * bytes);
    for (std::size_t c = 0; c < sources.size(); ++c) {
      const capture::Array& from = files[sources[c].file];
      const std::size_t stride = from.element_bytes();
      for (std::size_t t = 0; t < texels; ++t) {
        std::byte* at = &made[(t * sources.size() + c) * bytes];
        std::memcpy(at, from.levels[l].data() + t * stride + static_cast<std::size_t>(sources[c].channel) * bytes, bytes);
        change_channel(at, format, sources[c].change);
      }
    }
    out.levels.emplace_back(std::move(made));
  }
  return out;
}

}  // namespace rainref::port_dump
