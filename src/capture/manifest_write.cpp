#include "capture/manifest_write.h"

#include <bit>
#include <cstring>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "rainref/version.h"
#include "scene/json.h"

namespace rainref::capture {
namespace {

using Json = nlohmann::ordered_json;

bool used(const std::string& of, const std::string& variant) { return of.empty() || of == variant; }

Json graph_json(const EffectInfo& effect, const std::string& variant) {
  Json edges = Json::array(), ping_pong = Json::array();
  for (const PassInfo& pass : effect.passes) {
    if (!pass.variant(variant)) continue;
    for (const ReadInfo& read : pass.reads) {
      if (!used(read.variant, variant)) continue;
      Json edge{{"pass", pass.name}, {"input", read.buffer}, {"from", read.from.empty() ? "host" : read.from}};
      if (!read.from.empty()) edge["run"] = read.previous ? "previous" : "this";
      edges.push_back(edge);
      // A buffer that a pass reads from its own previous run cannot be written in place.
      if (read.previous && read.from == pass.name) ping_pong.push_back({{"pass", pass.name}, {"buffer", read.buffer}});
    }
  }
  return {{"passes", effect.pass_names(variant)}, {"edges", edges}, {"ping_pong", ping_pong}};
}

Json pass_json(const EffectInfo& effect, const PassInfo& pass, const std::string& variant) {
  Json reads = Json::array();
  for (const ReadInfo& read : pass.reads) {
    if (used(read.variant, variant)) reads.push_back(read.buffer);
  }
  return {{"name", pass.name},
          {"sentence", pass.sentence},
          {"formula", formula(effect, pass, *pass.variant(variant))},
          {"reads", reads},
          {"writes", effect.writes(pass, variant)},
          {"uniform_block", scene::uniform_block_json(pass.block(variant))},
          {"independence", pass.independence}};
}

// A 4-byte scalar as a value and as bits.
std::pair<Json, Json> scalar_json(const std::byte* at, scene::Scalar scalar) {
  std::uint32_t bits;
  std::memcpy(&bits, at, sizeof bits);
  const Json text = fmt::format("0x{:08x}", bits);
  switch (scalar) {
    case scene::Scalar::float32:
      return {std::bit_cast<float>(bits), text};
    case scene::Scalar::int32:
      return {std::bit_cast<std::int32_t>(bits), text};
    case scene::Scalar::uint32:
      return {bits, text};
  }
  return {};
}
Json float_json(float x) { return {{"value", x}, {"bits", fmt::format("0x{:08x}", std::bit_cast<std::uint32_t>(x))}}; }

Json uniforms_json(const scene::UniformBlock& block, const std::vector<std::byte>& bytes) {
  Json out = Json::array();
  for (const scene::Member& m : block.members) {
    Json values = Json::array(), bits = Json::array();
    for (int k = 0; k < m.components; ++k) {
      const auto [value, text] = scalar_json(bytes.data() + m.offset + 4 * static_cast<std::size_t>(k), m.scalar);
      values.push_back(value);
      bits.push_back(text);
    }
    const bool one = m.components == 1;
    out.push_back({{"name", m.name},
                   {"type", one ? scene::name(m.scalar) : fmt::format("{}{}", scene::name(m.scalar), m.components)},
                   {"value", one ? values[0] : values},
                   {"bits", one ? bits[0] : bits}});
  }
  return out;
}

// Keys that inputs and outputs share.
Json storage_json(const std::string& name, const Array& array, const BufferInfo& buffer, const std::vector<PackFile>& files) {
  Json out{{"name", name}};
  put_file(out, files.front());
  if (array.is_records) {
    out["format"] = "records";
    out["count"] = array.width;
    out["record"] = array.record.name;
  } else {
    const FormatInfo& format = info(array.format);
    out["format"] = format.name;
    out["width"] = array.width;
    out["height"] = array.height;
    out["channels"] = format.channels;
  }
  out["levels"] = files.size();
  if (files.size() > 1) {
    for (std::size_t level = 1; level < files.size(); ++level) {
      Json mip{{"width", array.level_width(static_cast<int>(level))}, {"height", array.level_height(static_cast<int>(level))}};
      put_file(mip, files[level]);
      out["mips"].push_back(mip);
    }
  }
  const bool unorm = !array.is_records && (info(array.format).kind == FormatInfo::unorm8 || info(array.format).kind == FormatInfo::srgb8);
  out["channel_meaning"] = buffer.sentence;
  out["unit"] = buffer.unit;
  out["range"] = unorm ? std::array<double, 2>{0, 1} : buffer.range;
  out["encoding"] = buffer.encoding;
  out["color_space"] = buffer.colour_space;
  out["alpha"] = buffer.alpha;
  if (!buffer.orientation.empty()) out["orientation"] = buffer.orientation;
  return out;
}

// Effect of storing a value beyond the format's range.
const char* overflow(const Array& array, Rounding rounding) {
  if (array.is_records) return "none";
  switch (info(array.format).kind) {
    case FormatInfo::unorm8:
    case FormatInfo::srgb8:
      return "clamp";
    case FormatInfo::float16:
      return rounding == Rounding::rtz ? "largest" : "infinity";
    default:
      return "none";
  }
}

}  // namespace

void put_file(Json& to, const PackFile& file) {
  to["file"] = file.path;
  to["bytes"] = file.bytes;
  to["xxh3"] = file.hash.text();
}

Json manifest_head(const EffectInfo& effect, const scene::Config& config, const std::string& scene_name, bool with_inputs,
                   const std::vector<std::string>& passes) {
  const std::string& variant = config.variant();
  Json out{{"format", pack_format},
           {"version", pack_version},
           {"rainref", {{"version", version()}, {"golden_generation", golden_generation}, {"golden_hash", golden_hash(effect.name)}}},
           {"contents", with_inputs ? "all" : "outputs"},
           {"effect", effect.name},
           {"scene", scene_name},
           {"variant", variant},
           {"seed", config.integer("seed")},
           {"config", scene::config_json(config)}};
  out["conventions"] = {
      {"row0", "v=0"},
      {"texel_centre", 0.5},
      {"endian", "little"},
      {"y_up", effect.up_axis},
      {"handedness", effect.handedness},
      {"matrix", "column vectors, column-major"},
      {"depth", effect.depth},
      {"time", "frame n runs from n / fps to (n + 1) / fps; time is float(n / fps), outputs are those after the frame's last step"}};
  out["graph"] = graph_json(effect, variant);
  out["passes"] = Json::array();
  for (const std::string& name : passes) out["passes"].push_back(pass_json(effect, effect.pass(name), variant));
  out["records"] = Json::array();
  for (const scene::UniformBlock& record : effect.records) out["records"].push_back(scene::uniform_block_json(record));
  out["cases"] = Json::array();
  return out;
}

Json case_json(const PassCase& c, const EffectInfo& effect, const PackFile& uniforms) {
  Json block;
  put_file(block, uniforms);
  return {{"id", c.folder()},
          {"pass", c.pass},
          {"frame", c.frame},
          {"step", c.step},
          {"level", c.level < 0 ? Json() : Json(c.level)},
          {"time", float_json(c.time)},
          {"dt", float_json(c.dt)},
          {"uniforms", uniforms_json(effect.pass(c.pass).block(c.variant), c.uniforms)},
          {"uniform_block", block}};
}

Json input_json(const CaseInput& input, const BufferInfo& buffer, const std::vector<PackFile>& files) {
  Json out = storage_json(input.name, input.array, buffer, files);
  if (input.array.is_records) return out;
  const bool loads = input.filter == Filter::none;
  const bool border = input.address_u == Address::border || input.address_v == Address::border;
  out["address_u"] = name(input.address_u);
  out["address_v"] = name(input.address_v);
  out["address_w"] = "none";
  out["border"] = border ? Json(input.border) : Json();
  out["min_filter"] = out["mag_filter"] = name(input.filter);
  out["mip_filter"] = name(input.mip_filter);
  out["coordinates"] = loads ? "texel" : "normalized";
  out["lod"] = input.mip_filter == Filter::none ? "none" : "explicit";
  out["out_of_bounds"] = border ? "border" : "as the address rules say";
  return out;
}

Json output_json(const CaseOutput& output, const BufferInfo& buffer, const PassInfo& pass, const std::vector<PackFile>& files) {
  Json out = storage_json(output.name, output.array, buffer, files);
  out["store_rounding"] = name(output.store_rounding);
  out["overflow"] = overflow(output.array, output.store_rounding);
  out["written"] = "whole";
  out["prior"] = nullptr;
  out["blend"] = "none";
  out["order_free_sums"] = pass.order_free_sums;
  out["nan"] = "forbidden";
  out["judge"] = name(output.judge);
  return out;
}

namespace {

constexpr std::size_t short_line = 140;

void print(const Json& json, int depth, int deepest, std::string& out) {
  // A name may be invalid UTF-8; invalid bytes become U+FFFD.
  const std::string line = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (!json.is_structured() || line.size() <= short_line || depth >= deepest) {
    out += line;
    return;
  }
  const bool object = json.is_object();
  out += object ? '{' : '[';
  const char* separator = "\n";
  for (const auto& [key, value] : json.items()) {
    out += separator;
    out.append(static_cast<std::size_t>(depth) + 1, ' ');
    if (object) out += Json(key).dump() + ": ";
    print(value, depth + 1, deepest, out);
    separator = ",\n";
  }
  out += '\n';
  out.append(static_cast<std::size_t>(depth), ' ');
  out += object ? '}' : ']';
}

}  // namespace

std::string manifest_text(const Json& manifest, int deepest) {
  std::string out;
  print(manifest, 0, deepest, out);
  return out + "\n";
}

}  // namespace rainref::capture
