#include "port_dump/read_encoded.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/path_text.h"
#include "port_dump/conversion.h"
#include "port_dump/kept.h"
#include "port_dump/read_buffer.h"
#include "rainref/error.h"
#include "scene/record_key.h"

namespace rainref::port_dump {
namespace {

using Form = ChannelSource::Form;
using Kind = FormatInfo::Kind;

/// "out.wave.L2" in its parts: "out.", "wave", ".L2".
struct Stem {
  explicit Stem(std::string_view stem)
      : prefix(stem.substr(0, stem.find('.') + 1)), buffer(buffer_of(stem)), level(stem.substr(prefix.size() + buffer.size())) {}
  std::string of_file(const std::string& file) const { return prefix + (file.empty() ? buffer : file) + level; }
  std::string prefix, buffer, level;
};

[[noreturn]] void refuse(const std::filesystem::path& folder, std::string_view stem, const std::string& why) {
  throw Error(ExitCode::port_files, fmt::format("'{}': encodings.{}: {}", path_text(folder / utf8_path(stem)), buffer_of(stem), why));
}

/// The values of a channel as the port stored them, or with the other sign, or counted from the other end.
void put_bits(std::byte* to, const std::byte* from, const FormatInfo& format, Form form) {
  const auto bytes = static_cast<std::size_t>(format.channel_bytes);
  std::memcpy(to, from, bytes);
  if (form == Form::complement) *to = static_cast<std::byte>(255 - static_cast<int>(*to));
  if (form != Form::negated) return;
  const bool is_zero =
      std::all_of(to, to + bytes - 1, [](std::byte b) { return b == std::byte{0}; }) && (to[bytes - 1] & std::byte{0x7f}) == std::byte{0};
  to[bytes - 1] = is_zero ? std::byte{0} : to[bytes - 1] ^ std::byte{0x80};  // little endian; a zero has no sign
}

/// Puts a buffer together from the channels of a port's files.
class Channels {
 public:
  Channels(const capture::Array& expected, std::vector<ChannelSource> sources, std::optional<Rounding> half_store)
      : expected_(expected), format_(info(expected.format)), sources_(std::move(sources)), half_store_(half_store) {
    // What is exact for codes is not for others.
    for (ChannelSource& s : sources_)
      if (s.form == Form::complement && format_.channel_bytes != 1) s.form = Form::computed;
  }

  /// Why the buffer has no such channels, or "".
  std::string fault() const {
    if (sources_.size() != static_cast<std::size_t>(format_.channels))
      return fmt::format("expected {} channel{} of {}, found {}", format_.channels, format_.channels == 1 ? "" : "s", format_.name,
                         sources_.size());
    const bool are_codes = format_.channel_bytes == 1;
    for (const ChannelSource& s : sources_) {
      if (s.form == Form::negated && (are_codes || format_.kind == Kind::uint32)) return fmt::format("{} has no sign", format_.name);
      if (s.form == Form::computed && (format_.kind == Kind::srgb8 || format_.kind == Kind::uint32))
        return fmt::format("expected a channel without a number, as {} needs, found a sum", format_.name);
    }
    return "";
  }

  template <class Read>
  void read_files(const Read& read) {
    std::map<std::string, std::pair<int, bool>> wanted;  // channels; whether all of its sources are computed
    for (const ChannelSource& s : sources_)
      for (const ChannelTerm& t : s.terms) {
        auto& [count, are_computed] = wanted.try_emplace(t.file, 0, true).first->second;
        count = std::max(count, t.channel + 1);
        are_computed &= s.form == Form::computed;
      }
    for (const auto& [file, what] : wanted) files_[file] = read(file, what.first, what.second ? Kinds::any : Kinds::own);
  }

  /// The buffer, and what its form leaves open.
  capture::Array array(KeptForm& form) {
    capture::Array out = expected_;
    out.levels.clear();
    Kept kept;
    for (std::size_t level = 0; level < expected_.levels.size(); ++level) out.levels.emplace_back(made(level, kept));
    if (kept.widest > 0) form = std::make_shared<Kept>(std::move(kept));
    return out;
  }

 private:
  StoredValue stored(const ChannelTerm& term, std::size_t level, std::size_t texel) const {
    const capture::Array& from = files_.at(term.file);
    const FormatInfo& format = info(from.format);
    return {format.kind == Kind::srgb8 ? Kind::unorm8 : format.kind,
            from.levels[level].data() + texel * from.element_bytes() + static_cast<std::size_t>(term.channel * format.channel_bytes)};
  }

  std::vector<std::byte> made(std::size_t level, Kept& kept) {
    const auto texels = static_cast<std::size_t>(expected_.level_width(static_cast<int>(level))) *
                        static_cast<std::size_t>(expected_.level_height(static_cast<int>(level)));
    const auto bytes = static_cast<std::size_t>(format_.channel_bytes);
    std::vector<std::byte> out(texels * sources_.size() * bytes);
    std::vector<StoredValue> values;
    for (std::size_t c = 0; c < sources_.size(); ++c) {
      const ChannelSource& source = sources_[c];
      for (std::size_t t = 0; t < texels; ++t) {
        std::byte* const to = &out[(t * sources_.size() + c) * bytes];
        if (source.form != Form::computed) {
          put_bits(to, stored(source.terms[0], level, t).at, format_, source.form);
          continue;
        }
        values.clear();
        for (const ChannelTerm& term : source.terms) values.push_back(stored(term, level, t));
        const Converted converted = convert(source, values, format_.kind, half_store_);
        put_value(format_.kind, converted.value, to);
        const float widest = std::max(converted.below, converted.above);
        if (widest == 0) continue;
        kept.widest = std::max<double>(kept.widest, widest);
        if (level > 0) continue;
        if (kept.spread.empty()) kept.spread.resize(texels * sources_.size());
        kept.spread[t * sources_.size() + c] = {converted.below, converted.above};
      }
    }
    return out;
  }

  const capture::Array& expected_;
  const FormatInfo& format_;
  std::vector<ChannelSource> sources_;
  std::optional<Rounding> half_store_;
  std::map<std::string, capture::Array> files_;
};

/// True if a member of every record is 0.
bool is_zero(const capture::Array& list, const scene::Member& member) {
  const std::vector<std::byte>& bytes = list.levels[0];
  for (std::size_t at = member.offset; at + member.size() <= bytes.size(); at += list.record.size)
    for (std::size_t b = at; b < at + member.size(); ++b)
      if (bytes[b] != std::byte{0}) return false;
  return true;
}

}  // namespace

capture::Array read_channels(const std::filesystem::path& folder, std::string_view stem, const capture::Array& expected,
                             const Encoding& encoding, const PortInfo& port, ReadNotes& notes) {
  if (expected.is_records) refuse(folder, stem, R"(a list has no channels; expected {"members": [...]})");
  Channels channels(expected, encoding.channels, port.half_store);
  if (const std::string fault = channels.fault(); !fault.empty()) refuse(folder, stem, fault);
  PortInfo plain = port;
  plain.encodings.clear();
  const Stem parts(stem);
  channels.read_files([&](const std::string& file, int count, Kinds kinds) {
    capture::Array own = expected;
    const std::optional<Format> format = format_of(info(expected.format).kind, count);
    if (!format) refuse(folder, stem, fmt::format("expected channels of {}, found channel {}", info(expected.format).name, count));
    own.format = *format;
    own = read_port_buffer(folder, parts.of_file(file), own, plain, notes, Alpha::stored, kinds);
    if (info(own.format).kind == Kind::uint32 && kinds == Kinds::any)
      refuse(folder, stem,
             fmt::format("expected halves, floats or 8-bit codes in {}, found {}", parts.of_file(file), kind_text(Kind::uint32)));
    return own;
  });
  return channels.array(notes.kept);
}

capture::Array read_members(const std::filesystem::path& folder, std::string_view stem, const capture::Array& expected,
                            const Encoding& encoding, const PortInfo& port, ReadNotes& notes) {
  if (!expected.is_records) refuse(folder, stem, R"(an image has no members; expected ["x", ...])");
  std::vector<std::string> names;
  for (const scene::Member& m : expected.record.members) names.push_back(m.name);
  capture::Array own = expected;
  own.record.members.clear();
  own.record.size = 0;
  for (const std::string& name : encoding.members) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
      refuse(folder, stem,
             fmt::format("members: expected members of {}, found '{}'{}", expected.record.name, name.substr(0, 64),
                         did_you_mean(name, names)));
    scene::Member member = expected.record.members[static_cast<std::size_t>(found - names.begin())];
    for (const scene::Member& m : own.record.members)
      if (m.name == name) refuse(folder, stem, fmt::format("members: expected each once, found '{}' twice", name));
    member.offset = own.record.size;
    own.record.size += member.size();
    own.record.members.push_back(std::move(member));
  }
  auto kept = std::make_shared<Kept>();
  for (const scene::Member& m : expected.record.members) {
    if (std::find(encoding.members.begin(), encoding.members.end(), m.name) != encoding.members.end()) continue;
    if (!is_key(m) && !is_zero(expected, m))
      refuse(folder, stem,
             fmt::format("members: '{}' is missing; expected every member but an id, and those that are 0 everywhere", m.name));
    kept->from_expected.push_back(m.name);
  }
  PortInfo plain = port;
  plain.encodings.clear();
  const capture::Array read = read_port_buffer(folder, stem, own, plain, notes);
  const std::size_t records = static_cast<std::size_t>(read.width), size = expected.record.size;
  std::vector<std::byte> made = expected.levels[0];
  made.resize(records * size);
  for (std::size_t i = 0; i < records; ++i)
    for (const scene::Member& m : own.record.members) {
      const auto& whole = *std::find_if(expected.record.members.begin(), expected.record.members.end(),
                                        [&](const scene::Member& other) { return other.name == m.name; });
      std::memcpy(&made[i * size + whole.offset], read.levels[0].data() + i * own.record.size + m.offset, m.size());
    }
  capture::Array out = expected;
  out.width = read.width;
  out.levels.assign(1, capture::Bytes(std::move(made)));
  if (!kept->from_expected.empty()) notes.kept = std::move(kept);
  return out;
}

}  // namespace rainref::port_dump
