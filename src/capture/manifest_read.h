// Reads a pack's manifest into the structures of pack_read.h.
#pragma once

#include <array>

#include "capture/json_field.h"
#include "capture/pack_read.h"

namespace rainref::capture {

/// Reads a uniform block or record; the members' units and sentences may be missing.
scene::UniformBlock read_uniform_block(const JsonField& from);
/// A storage format, two numbers, and four numbers, each as a manifest has it.
Format read_format(const JsonField& from);
std::array<double, 2> read_range(const JsonField& from);
std::array<float, 4> read_border(const JsonField& from);
/// One of the first Count names of an enumeration.
template <class Enum, int Count>
Enum read_name(const JsonField& from) {
  std::vector<std::string> names;
  for (int i = 0; i < Count; ++i) names.emplace_back(name(static_cast<Enum>(i)));
  return static_cast<Enum>(from.one_of(names));
}
/// Fills a pack from its manifest. Throws Error(port_files) for the first violation of docs/packs.md.
void read_manifest(const JsonField& manifest, Pack& pack);

}  // namespace rainref::capture
