#include "capture/pack_read.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "base/memory.h"
#include "base/path_text.h"
#include "base/system.h"
#include "capture/difference.h"
#include "capture/json_read.h"
#include "capture/manifest_read.h"
#include "capture/manifest_write.h"
#include "capture/npy_read.h"
#include "rainref/error.h"

namespace rainref::capture {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse(const fs::path& file, const std::string& why) {
  throw Error(ExitCode::port_files, fmt::format("{}: {}", path_text(file), why));
}

std::vector<std::byte> whole_file(const fs::path& path, std::uintmax_t bytes) {
  if (const MemoryLimit limit = memory_limit(); bytes > limit.bytes)
    refuse(path, fmt::format("its {} are too many; {} {} of memory", memory_text(bytes), limit.owner, memory_text(limit.bytes)));
  const auto unreadable = [&] { throw Error(ExitCode::io, fmt::format("{}: cannot be read: {}", path_text(path), reason_of(errno))); };
  const auto close = [](std::FILE* f) { std::fclose(f); };
  const std::unique_ptr<std::FILE, decltype(close)> in(system::stream_to_read(path), close);
  if (!in) unreadable();
  std::vector<std::byte> out(bytes);
  const std::size_t got = std::fread(out.data(), 1, out.size(), in.get());
  if (std::ferror(in.get())) unreadable();
  if (got != bytes) refuse(path, "the file became shorter while it was read");
  return out;
}

// Explains why a level's header does not fit the expected shape, or returns "".
std::string header_mismatch(const NpyHeader& header, const Array& shape, int level) {
  if (shape.is_records) {
    if (header.fields.size() != shape.record.members.size() || header.record_bytes != shape.record.size) {
      return fmt::format("expected records {} of {} fields and {} bytes", shape.record.name, shape.record.members.size(),
                         shape.record.size);
    }
    for (std::size_t i = 0; i < header.fields.size(); ++i) {
      const NpyField& found = header.fields[i];
      const scene::Member& expected = shape.record.members[i];
      const char* type = expected.scalar == scene::Scalar::float32 ? "<f4" : expected.scalar == scene::Scalar::uint32 ? "<u4" : "<i4";
      if (found.name != expected.name || found.offset != expected.offset || found.type != type ||
          found.components != static_cast<std::size_t>(expected.components)) {
        return fmt::format("expected field '{}' of type {} at offset {}, found '{}' of type {} at {}", expected.name, type, expected.offset,
                           found.name, found.type, found.offset);
      }
    }
    if (header.shape != std::vector<std::size_t>{static_cast<std::size_t>(shape.width)})
      return fmt::format("expected {} records", shape.width);
    return "";
  }
  const FormatInfo& format = info(shape.format);
  const char* type = format.kind == FormatInfo::float16   ? "<f2"
                     : format.kind == FormatInfo::float32 ? "<f4"
                     : format.kind == FormatInfo::uint32  ? "<u4"
                                                          : "|u1";
  std::vector<std::size_t> expected{static_cast<std::size_t>(shape.level_height(level)),
                                    static_cast<std::size_t>(shape.level_width(level))};
  if (format.channels > 1) expected.push_back(static_cast<std::size_t>(format.channels));
  if (header.type == type && header.shape == expected) return "";
  return fmt::format("expected type {} and shape ({}), found '{}' and ({})", type, fmt::join(expected, ", "), header.type,
                     fmt::join(header.shape, ", "));
}

/// The uniform bytes must equal the manifest's values; padding may hold anything.
void require_uniforms(const fs::path& file, const PackCase& entry, const scene::UniformBlock& block, const std::vector<std::byte>& bytes) {
  for (const scene::Member& m : block.members) {
    for (std::size_t at = m.offset; at < m.offset + m.size(); at += 4) {
      if (std::memcmp(&entry.block[at], &bytes[at], 4) == 0) continue;
      const std::string part = m.components == 1 ? "" : fmt::format(".{}", "xyzw"[(at - m.offset) / 4]);
      refuse(file, fmt::format("{}: uniform {}{}: expected {} as the manifest says, found {}", entry.id, m.name, part,
                               scalar_text(&entry.block[at], m.scalar), scalar_text(&bytes[at], m.scalar)));
    }
  }
}

}  // namespace

Pack::Pack(fs::path folder) : folder_(std::move(folder)) {
  std::error_code error;
  if (!fs::is_directory(folder_, error)) {
    throw Error(ExitCode::io,
                fmt::format("{}: {}", path_text(folder_),
                            fs::exists(folder_, error) ? "expected a pack's folder, found a file" : "there is no such folder"));
  }
  const fs::path path = folder_ / manifest_name;
  if (!fs::is_regular_file(path, error)) {
    // `run --capture` makes a folder inside the run's folder.
    const fs::path inner = folder_ / "capture";
    refuse(folder_, fmt::format("no pack: there is no {}{}", manifest_name,
                                fs::exists(inner / manifest_name, error) ? fmt::format(" (there is one in '{}')", path_text(inner)) : ""));
  }
  const nlohmann::ordered_json json = read_json(path, path_text(path), large_json);
  read_manifest(JsonField(json, path_text(path)), *this);
}

const PackPass& Pack::pass(std::string_view name) const {
  std::vector<std::string> names;
  for (const PackPass& p : passes) {
    if (p.name == name) return p;
    names.push_back(p.name);
  }
  throw Error(ExitCode::usage, fmt::format("{}: expected one of the passes {}, found '{}'{}", path_text(folder_), fmt::join(names, ", "),
                                           name, did_you_mean(name, names)));
}

std::vector<std::byte> Pack::read_file(const PackFileEntry& file) const {
  const fs::path path = folder_ / utf8_path(file.path);
  std::error_code error;
  if (!fs::is_regular_file(path, error)) refuse(path, "the manifest names this file, but it is missing");
  // A link may point anywhere.
  const fs::path real = fs::canonical(path, error), root = fs::canonical(folder_, error);
  if (error || std::mismatch(root.begin(), root.end(), real.begin(), real.end()).first != root.end())
    refuse(path, "the file lies outside the pack");
  const std::uintmax_t found = fs::file_size(path);
  if (found != file.bytes) refuse(path, fmt::format("damaged: expected {} bytes, found {}", file.bytes, found));
  std::vector<std::byte> bytes = whole_file(path, found);
  const std::string hash = file_hash(bytes).text();
  if (hash != file.xxh3) refuse(path, fmt::format("damaged: expected hash {}, found {}", file.xxh3, hash));
  return bytes;
}

Array Pack::read(const PackArray& array) const {
  Array out = array.shape;
  for (std::size_t level = 0; level < array.levels.size(); ++level) {
    const fs::path path = folder_ / utf8_path(array.levels[level].path);
    std::vector<std::byte> file = read_file(array.levels[level]);
    const NpyHeader header = parse_npy_header(file, path_text(path));
    const std::string why = header_mismatch(header, out, static_cast<int>(level));
    if (!why.empty()) refuse(path, why);
    file.erase(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(header.data_offset));  // moved, not copied to new memory
    out.levels.emplace_back(std::move(file));
  }
  return out;
}

PassCase Pack::described(const PackCase& entry) const {
  PassCase c;
  c.effect = effect;
  c.variant = variant;
  c.pass = entry.pass;
  c.frame = entry.frame;
  c.step = entry.step;
  c.level = entry.level;
  c.time = entry.time;
  c.dt = entry.dt;
  c.uniforms = entry.block;
  for (const PackInput& input : entry.inputs) {
    c.inputs.push_back(input.rules);
    c.inputs.back().array.levels.resize(input.levels.size());
  }
  for (const PackOutput& output : entry.outputs) {
    c.outputs.push_back(output.rules);
    c.outputs.back().array.levels.resize(output.levels.size());
  }
  return c;
}

PassCase Pack::read(const PackCase& entry) const {
  PassCase c = described(entry);
  c.uniforms = read_file(entry.uniforms);
  require_uniforms(folder_ / utf8_path(entry.uniforms.path), entry, pass(entry.pass).block, c.uniforms);
  for (std::size_t i = 0; i < entry.inputs.size(); ++i) c.inputs[i].array = read(entry.inputs[i]);
  for (std::size_t o = 0; o < entry.outputs.size(); ++o) c.outputs[o].array = read(entry.outputs[o]);
  return c;
}

std::string Pack::file_beside(std::string_view besides) const {
  std::set<std::string> named{manifest_name};
  for (const PackFileEntry& f : reference) named.insert(f.path);
  for (const PackCase& c : cases) {
    named.insert(c.uniforms.path);
    const auto add = [&](const PackArray& array) {
      for (const PackFileEntry& f : array.levels) named.insert(f.path);
    };
    for (const PackInput& input : c.inputs) add(input);
    for (const PackOutput& output : c.outputs) add(output);
  }
  for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
    if (entry.is_directory() && !entry.is_symlink()) continue;
    std::string path = path_text(fs::relative(entry.path(), folder_));
    if (!named.contains(path) && path != besides) return path;
  }
  return "";
}

}  // namespace rainref::capture
