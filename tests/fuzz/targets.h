// What the fuzzers call: each reader of foreign bytes, on any bytes at all.
#pragma once

#include <array>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string_view>

#include "image_io/evidence.h"
#include "port_dump/port_info.h"
#include "port_dump/read_buffer.h"
#include "rainref/error.h"
#include "spirv/any_module.h"

namespace rainref::fuzz {

using Bytes = std::span<const std::byte>;

/// f() or a refusal; whatever else is thrown gets through and ends the fuzzer. True when accepted.
template <class F>
bool accepts(F&& f) {
  try {
    f();
    return true;
  } catch (const Error& error) {
    if (error.code() != ExitCode::port_files) throw;
    return false;
  }
}

inline void require(bool holds) {
  if (!holds) std::abort();
}

/// Reads one file as an image of this shape and looks at every byte that came out.
inline bool reads_image(const port_dump::FileBytes& file, Format format, std::size_t width, std::size_t height, std::size_t levels) {
  capture::Array expected, out;
  expected.format = format;
  expected.width = static_cast<int>(width);
  expected.height = static_cast<int>(height);
  expected.levels.resize(levels);
  port_dump::ReadNotes notes;
  port_dump::PortInfo port;
  port.origin = port_dump::Origin::bottom_left;
  if (!accepts([&] { port_dump::read_levels(file, expected, 0, port, out, notes); })) return false;
  require(!out.levels.empty() && out.levels.size() <= levels);
  for (std::size_t l = 0; l < out.levels.size(); ++l) {
    const auto level = static_cast<int>(l);
    require(out.levels[l].size() == expected.element_bytes() * expected.level_width(level) * expected.level_height(level));
  }
  return true;
}

inline bool reads_records(const port_dump::FileBytes& file) {
  using scene::Scalar;
  capture::Array expected, out;
  expected.is_records = true;
  expected.record = {
      "Drop", 16, {{"x", Scalar::float32, 1, 0, "m", "."}, {"y", Scalar::float32, 1, 4, "m", "."}, {"id", Scalar::uint32, 1, 8, "1", "."}}};
  port_dump::ReadNotes notes;
  if (!accepts([&] { port_dump::read_records(file, expected, out, notes); })) return false;
  require(out.levels.size() == 1 && out.levels[0].size() == 16 * static_cast<std::size_t>(out.width));
  return true;
}

// The shape that the seeds have.
constexpr std::size_t seed_width = 5, seed_height = 3;

inline bool any_image(const port_dump::FileBytes& file, std::size_t width = seed_width, std::size_t height = seed_height) {
  bool accepted = false;
  for (const Format format : {Format::r8, Format::rgba8, Format::rgba8_srgb, Format::r16f, Format::rgba16f, Format::rg32f, Format::r32ui}) {
    accepted = reads_image(file, format, width, height, 1) || accepted;
  }
  return reads_image(file, Format::r16f, width, height, 3) || accepted;
}

inline bool npy(Bytes bytes) {
  const port_dump::FileBytes file{port_dump::FileType::npy, "'a.npy'", bytes, {}, {}};
  const bool image = any_image(file);
  return reads_records(file) || image;
}

inline bool dds(Bytes bytes) { return any_image({port_dump::FileType::dds, "'a.dds'", bytes, {}, {}}); }

/// A sidecar's text, a zero byte, and the raw bytes.
inline bool sidecar(Bytes bytes) {
  const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::size_t end = std::min(all.find('\0'), all.size());
  const port_dump::FileBytes file{port_dump::FileType::bin, "'a.bin'", bytes.subspan(std::min(end + 1, all.size())), all.substr(0, end),
                                  "'a.json'"};
  const bool image = any_image(file);
  return reads_records(file) || image;
}

inline bool port_json(Bytes bytes) {
  return accepts([&] { port_dump::parse_port_info({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, "'port.json'"); });
}

/// EXR or PNG by its first bytes. Small sizes are taken from the file, so that they are decoded whatever they are.
inline bool picture(Bytes bytes) {
  image_io::EvidenceSize size{};
  if (!accepts([&] { size = image_io::evidence_size("'a'", bytes); })) return false;
  if (size.width > 256 || size.height > 256) size = {seed_width, seed_height};
  return any_image({port_dump::FileType::exr, "'a.exr'", bytes, {}, {}}, size.width, size.height);
}

/// Parsed and executed.
inline bool spirv_module(Bytes bytes) {
  return accepts([&] { spirv::execute_any(bytes); });
}

struct Target {
  const char* name;  ///< the folder of its seeds in tests/fuzz/seeds
  bool (*accepts)(Bytes);
};
constexpr std::array<Target, 7> targets{{{"npy", npy},
                                         {"dds", dds},
                                         {"sidecar", sidecar},
                                         {"port_json", port_json},
                                         {"exr", picture},
                                         {"png", picture},
                                         {"spirv", spirv_module}}};

}  // namespace rainref::fuzz
