#include "capture/manifest_read.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>

#include <fmt/format.h>

#include "base/number_text.h"
#include "base/path_text.h"
#include "capture/difference.h"
#include "capture/manifest_write.h"
#include "capture/record_format.h"
#include "rainref/error.h"

namespace rainref::capture {
namespace {

constexpr std::int64_t largest_side = 65536, largest_count = INT32_MAX, largest_file = std::int64_t{1} << 40;

}  // namespace

scene::UniformBlock read_uniform_block(const JsonField& from) {
  scene::UniformBlock block;
  block.name = from["name"].text();
  block.size = static_cast<std::size_t>(from["size"].whole(4, largest_side));
  const std::vector<std::string> scalars{"float", "int", "uint"};
  for (const JsonField& m : from["members"].elements()) {
    scene::Member member{m["name"].text(),
                         static_cast<scene::Scalar>(m["type"].one_of(scalars)),
                         static_cast<int>(m["components"].whole(1, 4)),
                         static_cast<std::size_t>(m["offset"].whole(0, largest_side)),
                         m.is_null("unit") ? "1" : m["unit"].text(),
                         m.is_null("sentence") ? "" : m["sentence"].text()};
    if (member.offset + member.size() > block.size)
      m["offset"].refuse(fmt::format("the member ends beyond the {} bytes of {}", block.size, block.name));
    block.members.push_back(std::move(member));
  }
  return block;
}

Format read_format(const JsonField& from) {
  try {
    return format_from_name(from.text());
  } catch (const Error& e) {
    from.refuse(e.what());
  }
}
std::array<double, 2> read_range(const JsonField& from) {
  const std::vector<JsonField> range = from.elements();
  if (range.size() != 2) from.fail("two numbers");
  return {range[0].number(), range[1].number()};
}
std::array<float, 4> read_border(const JsonField& from) {
  const std::vector<JsonField> border = from.elements();
  if (border.size() != 4) from.fail("four numbers");
  std::array<float, 4> out{};
  for (std::size_t k = 0; k < 4; ++k) out[k] = static_cast<float>(border[k].number());
  return out;
}

namespace {

PackFileEntry read_file_entry(const JsonField& from) {
  PackFileEntry file;
  const JsonField path = from["file"];
  file.path = path.text();
  const std::filesystem::path p = utf8_path(file.path);
  const bool leaves =
      p.is_absolute() || std::any_of(p.begin(), p.end(), [](const auto& part) { return part == ".." || part == "." || part.empty(); });
  if (file.path.empty() || leaves || file.path.find_first_of(std::string("\\\0", 2)) != std::string::npos) {
    path.fail("the path of a file below the pack's folder");
  }
  file.bytes = static_cast<std::size_t>(from["bytes"].whole(0, largest_file));
  file.xxh3 = from["xxh3"].text();
  return file;
}

using Records = std::vector<scene::UniformBlock>;

PackArray read_array(const JsonField& from, const Records& records) {
  PackArray out;
  out.name = from["name"].text();
  const JsonField format = from["format"];
  if (format.text() == "records") {
    out.shape.is_records = true;
    std::vector<std::string> names;
    for (const scene::UniformBlock& r : records) names.push_back(r.name);
    out.shape.record = records[static_cast<std::size_t>(from["record"].one_of(names))];
    out.shape.format = record_format(out.shape.record).value_or(out.shape.format);
    out.shape.width = static_cast<int>(from["count"].whole(0, largest_count));
    out.shape.height = 1;
  } else {
    out.shape.format = read_format(format);
    out.shape.width = static_cast<int>(from["width"].whole(1, largest_side));
    out.shape.height = static_cast<int>(from["height"].whole(1, largest_side));
    from["channels"].whole(info(out.shape.format).channels, info(out.shape.format).channels);
  }
  out.levels.push_back(read_file_entry(from));
  const std::int64_t levels = from["levels"].whole(1, Texture::max_levels);
  if (levels > 1) {
    const std::vector<JsonField> mips = from["mips"].elements();
    if (static_cast<std::int64_t>(mips.size()) != levels - 1)
      from["mips"].refuse(fmt::format("expected {} levels below the first, found {}", levels - 1, mips.size()));
    for (const JsonField& mip : mips) out.levels.push_back(read_file_entry(mip));
  }
  out.range = read_range(from["range"]);
  out.unit = from["unit"].text();
  out.meaning = from["channel_meaning"].text();
  return out;
}

PackInput read_input(const JsonField& from, const Records& records) {
  PackInput input{read_array(from, records), {}};
  CaseInput& rules = input.rules;
  rules.name = input.name;
  rules.array = input.shape;
  if (input.shape.is_records) return input;
  rules.address_u = read_name<Address, 4>(from["address_u"]);
  rules.address_v = read_name<Address, 4>(from["address_v"]);
  if (!from.is_null("border")) rules.border = read_border(from["border"]);
  rules.filter = read_name<Filter, 3>(from["min_filter"]);
  rules.mip_filter = read_name<Filter, 3>(from["mip_filter"]);
  rules.linear = rules.filter == Filter::linear;
  return input;
}

/// True if records have a key: an id, or the index in the list if they consist of floats only.
bool is_keyed_record(const Array& shape) {
  const auto& members = shape.record.members;
  return shape.is_records && (record_format(shape.record) || std::any_of(members.begin(), members.end(), [](const scene::Member& m) {
                                return m.name == "id" && m.scalar == scene::Scalar::uint32 && m.components == 1;
                              }));
}

PackOutput read_output(const JsonField& from, const Records& records) {
  PackOutput output{read_array(from, records), {}};
  output.rules.name = output.name;
  output.rules.array = output.shape;
  output.rules.store_rounding = read_name<Rounding, 2>(from["store_rounding"]);
  output.rules.judge = read_name<Judge, 4>(from["judge"]);
  if (output.shape.is_records && output.rules.judge == Judge::envelope) from["judge"].fail("bits, keyed or input_only for records");
  if (output.rules.judge == Judge::keyed && !is_keyed_record(output.shape))
    from["judge"].fail("bits, envelope or input_only for what is no list of records with a uint 'id' or of floats alone");
  output.rules.range = output.range;
  output.rules.unit = output.unit;
  output.rules.color_space = from["color_space"].text();
  return output;
}

std::uint32_t read_bits(const JsonField& field) {
  const std::string bits = field.text();
  if (bits.size() != 10 || !bits.starts_with("0x") || bits.find_first_not_of("0123456789abcdef", 2) != std::string::npos)
    field.fail("eight hexadecimal digits behind 0x");
  return *whole_from<std::uint32_t>(std::string_view(bits).substr(2), 16);
}

/// The value beside the bits is for people, so it must agree with them. Null stands for a value that JSON cannot represent.
void require_value(const JsonField& value, scene::Scalar scalar, std::uint32_t bits) {
  bool is_same = false;
  if (scalar == scene::Scalar::float32) {
    const float number = std::bit_cast<float>(bits);
    is_same = std::isfinite(number) ? value.is_number() && std::bit_cast<std::uint32_t>(static_cast<float>(value.number())) == bits
                                    : value.dump() == "null";
  } else {
    is_same =
        value.dump() == (scalar == scene::Scalar::int32 ? fmt::format("{}", std::bit_cast<std::int32_t>(bits)) : fmt::format("{}", bits));
  }
  if (!is_same) value.fail(fmt::format("{}, as its bits say", scalar_text(reinterpret_cast<const std::byte*>(&bits), scalar)));
}

float read_float(const JsonField& from) {
  const std::uint32_t bits = read_bits(from["bits"]);
  require_value(from["value"], scene::Scalar::float32, bits);
  return std::bit_cast<float>(bits);
}

std::vector<std::byte> read_uniforms(const JsonField& from, const scene::UniformBlock& block) {
  std::vector<std::byte> out(block.size);
  const std::vector<JsonField> found = from.elements();
  if (found.size() != block.members.size())
    from.refuse(fmt::format("expected the {} members of {}, found {}", block.members.size(), block.name, found.size()));
  for (std::size_t i = 0; i < found.size(); ++i) {
    const scene::Member& m = block.members[i];
    if (found[i]["name"].text() != m.name) found[i]["name"].fail(fmt::format("'{}'", m.name));
    const auto components = [&](const char* key) {
      const JsonField all = found[i][key];
      const std::vector<JsonField> parts = m.components == 1 ? std::vector<JsonField>{all} : all.elements();
      if (parts.size() != static_cast<std::size_t>(m.components))
        all.refuse(fmt::format("expected {} components, found {}", m.components, parts.size()));
      return parts;
    };
    const std::vector<JsonField> bits = components("bits"), values = components("value");
    for (std::size_t k = 0; k < bits.size(); ++k) {
      const std::uint32_t word = read_bits(bits[k]);
      require_value(values[k], m.scalar, word);
      std::memcpy(out.data() + m.offset + 4 * k, &word, sizeof word);
    }
  }
  return out;
}

PackCase read_case(const JsonField& from, const Records& records) {
  PackCase c;
  c.id = from["id"].text();
  c.pass = from["pass"].text();
  c.frame = static_cast<int>(from["frame"].whole(0, largest_count));
  c.step = static_cast<int>(from["step"].whole(0, largest_count));
  c.level = from.is_null("level") ? -1 : static_cast<int>(from["level"].whole(0, Texture::max_levels - 1));
  c.time = read_float(from["time"]);
  c.dt = read_float(from["dt"]);
  c.uniforms = read_file_entry(from["uniform_block"]);
  for (const JsonField& input : from["inputs"].elements()) c.inputs.push_back(read_input(input, records));
  for (const JsonField& output : from["outputs"].elements()) c.outputs.push_back(read_output(output, records));
  if (c.outputs.empty()) from["outputs"].refuse("expected one output or more, found none");
  return c;
}

}  // namespace

void read_manifest(const JsonField& manifest, Pack& pack) {
  if (!manifest.has("format") || manifest["format"].dump() != fmt::format("\"{}\"", pack_format)) {
    manifest.refuse(fmt::format("this is no manifest of a pack: expected \"format\": \"{}\"", pack_format));
  }
  const std::int64_t version = manifest["version"].whole(1, INT32_MAX);
  if (version > pack_version)
    manifest.refuse(fmt::format("version {} is newer than this rainref reads, which is {}", version, pack_version));
  pack.producer = manifest["rainref"]["version"].text();
  pack.golden_generation = static_cast<int>(manifest["rainref"]["golden_generation"].whole(0, INT32_MAX));
  if (manifest["rainref"].has("golden_hash")) pack.golden_hash = manifest["rainref"]["golden_hash"].text();
  const std::vector<std::string> contents{"outputs", "all"};
  pack.with_inputs = manifest["contents"].one_of(contents) == 1;
  pack.effect = manifest["effect"].text();
  pack.variant = manifest["variant"].text();
  pack.scene = manifest["scene"].text();
  for (const auto& [key, value] : manifest["config"].members()) pack.config.emplace_back(key, value.dump());
  for (const JsonField& edge : manifest["graph"]["edges"].elements()) {
    const std::vector<std::string> runs{"this", "previous"};
    pack.edges.push_back(
        {edge["pass"].text(), edge["input"].text(), edge["from"].text(), !edge.is_null("run") && edge["run"].one_of(runs) == 1});
  }
  if (!manifest.is_null("reference"))
    for (const JsonField& file : manifest["reference"].elements()) pack.reference.push_back(read_file_entry(file));
  std::vector<std::string> names;
  for (const JsonField& pass : manifest["passes"].elements()) {
    pack.passes.push_back({pass["name"].text(), pass["formula"].text(), pass["sentence"].text(), pass["reads"].texts(),
                           pass["writes"].texts(), read_uniform_block(pass["uniform_block"])});
    if (!pass.is_null("coverage") && !pass["coverage"].is_null("reasons"))
      for (const auto& [alternative, reason] : pass["coverage"]["reasons"].members())
        pack.passes.back().unexercised[alternative] = reason.text();
    names.push_back(pack.passes.back().name);
  }
  Records records;
  for (const JsonField& record : manifest["records"].elements()) records.push_back(read_uniform_block(record));
  std::set<std::string> ids;
  const std::vector<JsonField> cases = manifest["cases"].elements();
  if (cases.empty()) manifest["cases"].refuse("expected one run of a pass or more, found none");
  for (const JsonField& c : cases) {
    c["pass"].one_of(names);
    pack.cases.push_back(read_case(c, records));
    const PackCase& read = pack.cases.back();
    if (!ids.insert(read.id).second) c["id"].refuse(fmt::format("'{}' is there twice", read.id));
    PassCase run;
    run.effect = pack.effect;
    run.pass = read.pass;
    run.frame = read.frame;
    run.step = read.step;
    run.level = read.level;
    if (read.id != run.folder()) c["id"].refuse(fmt::format("expected '{}', found '{}'", run.folder(), read.id));
    pack.cases.back().block = read_uniforms(c["uniforms"], pack.pass(read.pass).block);
    const std::size_t size = pack.pass(read.pass).block.size;
    if (read.uniforms.bytes != size)
      c["uniform_block"]["bytes"].fail(fmt::format("the {} bytes of {}", size, pack.pass(read.pass).block.name));
  }
}

}  // namespace rainref::capture
