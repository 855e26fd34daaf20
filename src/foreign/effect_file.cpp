#include "foreign/effect_file.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/path_text.h"
#include "capture/json_field.h"
#include "capture/json_read.h"
#include "capture/manifest_read.h"
#include "capture/record_format.h"
#include "rainref/error.h"
#include "registry/registry.h"
#include "spirv/interface.h"

namespace rainref::foreign {
namespace {

using capture::JsonField;
using spirv::Bound, spirv::Wanted;

constexpr std::int64_t largest_side = 65536;
constexpr capture::JsonLimits file_limits{std::uint64_t{4} << 20, 12};

bool is_name(const std::string& text) {
  return !text.empty() && text.size() <= 64 && std::isalpha(static_cast<unsigned char>(text[0])) &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c) || c == '_'; });
}
std::string name_in(const JsonField& from) {
  const std::string text = from.text();
  if (!is_name(text)) from.fail("a name of up to 64 letters, digits and _ that begins with a letter");
  return text;
}
std::string text_or(const JsonField& from, const char* key, const char* otherwise) {
  return from.is_null(key) ? otherwise : from[key].text();
}
template <class Enum, int Count>
Enum named_or(const JsonField& from, const char* key, Enum otherwise) {
  return from.is_null(key) ? otherwise : capture::read_name<Enum, Count>(from[key]);
}

/// Reads one pass; its inputs from other passes are checked once all passes are known.
class PassReader {
 public:
  PassReader(const JsonField& from, const std::filesystem::path& folder, const MayRead& may_read, EffectFile& file)
      : from_(from), file_(file) {
    static const std::vector<std::string> keys{"name", "sentence", "spirv", "uniform_block", "inputs", "outputs"};
    from.require_known(keys);
    pass_.name = name_in(from["name"]);
    pass_.program.spirv = folder / utf8_path(from["spirv"].text());
    if (may_read) may_read(pass_.program.spirv);
    pass_.words = spirv::read_spirv(pass_.program);
    const spirv::Module module(pass_.words, "'" + path_text(pass_.program.spirv) + "'");
    if (module.is_cooperative)
      module.refuse(0, 0, "its invocations work together: a reference must be one whose invocations are judged one by one");
    wanted_ = spirv::interface_of(module);
    pass_.program.group[0] = module.group[0];
    pass_.program.group[1] = module.group[1];
    pass_.program.at = {{0, 0}};
    read_block();
    for (const JsonField& input : from["inputs"].elements()) read_input(input);
    for (const JsonField& output : from["outputs"].elements()) read_output(output);
    if (pass_.outputs.empty()) from["outputs"].refuse("expected one output or more, found none");
    require_all_bound();
  }
  Pass take() {
    capture::PassInfo info;
    info.name = pass_.name;
    info.sentence = text_or(from_, "sentence", "");
    info.variants = {{variant, 1, capture::Judge::envelope, pass_.block.name}};
    info.uniforms = {pass_.block};
    for (const Input& input : pass_.inputs) info.reads.push_back({input.like.name, input.from, input.previous});
    for (const capture::CaseOutput& output : pass_.outputs) info.writes.push_back(output.name);
    file_.info.passes.push_back(std::move(info));
    return std::move(pass_);
  }

 private:
  /// The shader's descriptor for an entry of the file: by the set and binding that it says, else by its position in the file.
  const Wanted& descriptor(const JsonField& at, std::initializer_list<Bound> kinds) {
    const auto position = static_cast<std::int64_t>(pass_.program.at.size());
    constexpr std::int64_t most = 1 << 16;
    const std::int64_t set = at.is_null("set") ? 0 : at["set"].whole(0, most);
    const std::int64_t binding = at.is_null("binding") ? position : at["binding"].whole(0, most);
    const auto found = std::find_if(wanted_.begin(), wanted_.end(), [&](const Wanted& w) { return w.set == set && w.binding == binding; });
    const std::string where = fmt::format("set {}, binding {}", set, binding);
    if (found == wanted_.end()) at.refuse(fmt::format("expected a binding that {} has, found {}", shader(), where));
    if (std::find(kinds.begin(), kinds.end(), found->bound) == kinds.end())
      at.refuse(fmt::format("{} has {} at {}", shader(), spirv::name(found->bound), where));
    pass_.program.at.push_back({found->set, found->binding});
    return *found;
  }
  std::string shader() const { return "'" + path_text(pass_.program.spirv.filename()) + "'"; }

  void read_block() {
    const auto found = std::find_if(wanted_.begin(), wanted_.end(), [](const Wanted& w) { return w.bound == Bound::uniform_buffer; });
    pass_.block = {"Nothing", 16, {}};
    if (found == wanted_.end()) {
      if (!from_.is_null("uniform_block")) from_["uniform_block"].refuse(shader() + " has no uniform block");
      return;
    }
    pass_.program.at[0] = {found->set, found->binding};
    const JsonField block = from_["uniform_block"];
    pass_.block = capture::read_uniform_block(block);
    require_layout(block, pass_.block, found->block);
  }
  /// Offsets and types must be equal; names are the author's choice.
  void require_layout(const JsonField& at, const scene::UniformBlock& said, const scene::UniformBlock& own) const {
    const auto place = [](const scene::Member& m) {
      return fmt::format("{}{} at byte {}", scene::name(m.scalar), m.components > 1 ? std::to_string(m.components) : "", m.offset);
    };
    if (said.size != own.size) at["size"].fail(fmt::format("{} bytes, as {} has", own.size, shader()));
    const std::vector<JsonField> members = at["members"].elements();
    for (std::size_t i = 0; i < std::min(said.members.size(), own.members.size()); ++i)
      if (place(said.members[i]) != place(own.members[i]))
        members[i].refuse(
            fmt::format("expected {}, '{}' of {}, found {}", place(own.members[i]), own.members[i].name, shader(), place(said.members[i])));
    if (said.members.size() != own.members.size())
      at["members"].refuse(fmt::format("expected the {} members that {} has, found {}", own.members.size(), shader(), said.members.size()));
  }

  void read_size(const JsonField& at, capture::Array& array) const {
    array.format = capture::read_format(at["format"]);
    if (info(array.format).kind == FormatInfo::uint32) at["format"].fail("a format of numbers with fractions");
    array.width = static_cast<int>(at["width"].whole(1, largest_side));
    array.height = static_cast<int>(at["height"].whole(1, largest_side));
  }

  void read_input(const JsonField& at) {
    static const std::vector<std::string> keys{"name",      "set",    "binding", "sentence",   "from",   "run",
                                               "format",    "record", "width",   "height",     "levels", "address_u",
                                               "address_v", "border", "filter",  "mip_filter", "unit",   "range"};
    at.require_known(keys);
    Input input;
    capture::CaseInput& like = input.like;
    like.name = name_in(at["name"]);
    const std::string from = text_or(at, "from", "host");
    input.from = from == "host" ? "" : from;
    static const std::vector<std::string> runs{"this", "previous"};
    input.previous = !at.is_null("run") && at["run"].one_of(runs) == 1;
    const Wanted& wanted = descriptor(at, {Bound::sampled_image, Bound::storage_buffer});
    if (wanted.bound == Bound::storage_buffer) {
      if (at["format"].text() != "records") at["format"].fail(fmt::format("\"records\", for {} has a storage buffer there", shader()));
      if (!input.from.empty()) at["from"].fail("\"host\": passes write no records");
      like.array.is_records = true;
      like.array.height = 1;
      like.array.record = capture::read_uniform_block(at["record"]);
      require_layout(at["record"], like.array.record, wanted.block);
      like.array.format = capture::record_format(like.array.record).value_or(like.array.format);
    } else {
      read_size(at, like.array);
      const std::int64_t levels = at.is_null("levels") ? 1 : at["levels"].whole(1, Texture::max_levels);
      input.levels = static_cast<std::size_t>(levels);
      like.address_u = named_or<Address, 4>(at, "address_u", Address::clamp);
      like.address_v = named_or<Address, 4>(at, "address_v", Address::clamp);
      like.filter = named_or<Filter, 3>(at, "filter", Filter::none);
      like.mip_filter = named_or<Filter, 3>(at, "mip_filter", Filter::none);
      like.linear = like.filter == Filter::linear;
      if (!at.is_null("border")) like.border = capture::read_border(at["border"]);
      if (levels > 1 && like.mip_filter == Filter::none) at["mip_filter"].fail("nearest or linear, for an image of several levels");
    }
    pass_.program.inputs.push_back(like.name);
    declare(at, like.name, like.array);
    pass_.inputs.push_back(std::move(input));
  }

  void read_output(const JsonField& at) {
    static const std::vector<std::string> keys{"name", "set", "binding", "sentence", "format", "width", "height", "unit", "range"};
    at.require_known(keys);
    capture::CaseOutput output;
    output.name = name_in(at["name"]);
    const Wanted& wanted = descriptor(at, {Bound::storage_image});
    read_size(at, output.array);
    if (wanted.format && *wanted.format != output.array.format)
      at["format"].fail(fmt::format("\"{}\", as {} has", info(*wanted.format).name, shader()));
    if (!pass_.outputs.empty() &&
        (output.array.width != pass_.outputs[0].array.width || output.array.height != pass_.outputs[0].array.height))
      at["width"].refuse(fmt::format("expected {}x{} as '{}' has: an invocation writes one texel of each output, found {}x{}",
                                     pass_.outputs[0].array.width, pass_.outputs[0].array.height, pass_.outputs[0].name, output.array.width,
                                     output.array.height));
    pass_.program.outputs.push_back(output.name);
    const capture::BufferInfo& buffer = declare(at, output.name, output.array);
    output.range = buffer.range;
    output.unit = buffer.unit;
    pass_.outputs.push_back(std::move(output));
  }
  /// A buffer has one entry, whichever pass names it; its writer's description counts.
  const capture::BufferInfo& declare(const JsonField& at, const std::string& name, const capture::Array& array) {
    capture::BufferInfo buffer{name, array.is_records ? "records" : std::string(info(array.format).name), text_or(at, "sentence", "")};
    buffer.unit = text_or(at, "unit", "1");
    if (!at.is_null("range")) {
      buffer.range = capture::read_range(at["range"]);
      if (!(buffer.range[0] < buffer.range[1])) at["range"].fail("two numbers, the lower one first");
    }
    if (array.is_records) {
      buffer.record = array.record.name;
      auto& records = file_.info.records;
      const auto same = std::find_if(records.begin(), records.end(), [&](const auto& r) { return r.name == array.record.name; });
      if (same == records.end())
        records.push_back(array.record);
      else if (!scene::same_layout(*same, array.record))
        at["record"].refuse(fmt::format("another record has the name '{}' and other members", array.record.name));
    }
    auto& all = file_.info.buffers;
    const auto known = std::find_if(all.begin(), all.end(), [&](const auto& b) { return b.name == name; });
    if (known == all.end()) return all.emplace_back(std::move(buffer));
    if (known->format != buffer.format) at["format"].fail(fmt::format("\"{}\", as '{}' has it elsewhere", known->format, name));
    if (!at.is_null("range")) *known = std::move(buffer);
    return *known;
  }

  void require_all_bound() const {
    for (const Wanted& w : wanted_) {
      const std::array<std::uint32_t, 2> place{w.set, w.binding};
      if (std::find(pass_.program.at.begin(), pass_.program.at.end(), place) == pass_.program.at.end())
        from_.refuse(fmt::format("{} has {} '{}' at set {}, binding {}, and nothing here is of it", shader(), spirv::name(w.bound), w.name,
                                 w.set, w.binding));
    }
  }

  const JsonField& from_;
  EffectFile& file_;
  std::vector<Wanted> wanted_;
  Pass pass_;
};

/// Checks that inputs from other passes exist and have the same shape.
void require_graph(const JsonField& passes, const EffectFile& file) {
  const std::vector<JsonField> all = passes.elements();
  std::vector<std::string> names;
  for (const Pass& pass : file.passes) names.push_back(pass.name);
  for (std::size_t p = 0; p < all.size(); ++p) {
    const std::vector<JsonField> inputs = all[p]["inputs"].elements();
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      const Input& input = file.passes[p].inputs[i];
      if (input.from.empty()) continue;
      const auto source = static_cast<std::size_t>(inputs[i]["from"].one_of(names));
      if (!input.previous && source >= p)
        inputs[i]["from"].refuse(
            fmt::format("'{}' runs no earlier than '{}': say \"run\": \"previous\"", names[source], file.passes[p].name));
      const auto& outputs = file.passes[source].outputs;
      const auto output = std::find_if(outputs.begin(), outputs.end(), [&](const auto& o) { return o.name == input.like.name; });
      if (output == outputs.end()) inputs[i]["from"].refuse(fmt::format("'{}' has no output '{}'", names[source], input.like.name));
      const capture::Array &a = input.like.array, &b = output->array;
      if (a.width != b.width || a.height != b.height || input.levels != 1)
        inputs[i].refuse(fmt::format("expected one level of {}x{} as '{}' gives, found {} of {}x{}", b.width, b.height, names[source],
                                     input.levels, a.width, a.height));
    }
  }
}

}  // namespace

const Pass* EffectFile::find(const std::string& name) const {
  const auto found = std::find_if(passes.begin(), passes.end(), [&](const Pass& p) { return p.name == name; });
  return found == passes.end() ? nullptr : &*found;
}

EffectFile read_effect(const std::filesystem::path& path, const MayRead& may_read) {
  const nlohmann::ordered_json json = capture::read_json(path, path_text(path), file_limits);
  const JsonField top(json, path_text(path));
  if (!top.has("format") || top["format"].dump() != fmt::format("\"{}\"", file_format))
    top.refuse(fmt::format("this describes no effect: expected \"format\": \"{}\"", file_format));
  static const std::vector<std::string> keys{"format", "version", "effect", "passes"};
  top.require_known(keys);
  top["version"].whole(1, 1);
  EffectFile file;
  file.info.name = name_in(top["effect"]);
  if (registry::find(file.info.name)) top["effect"].fail("a name that none of rainref's own effects has");
  for (const JsonField& from : top["passes"].elements()) {
    Pass pass = PassReader(from, path.parent_path(), may_read, file).take();
    if (file.find(pass.name)) from["name"].refuse(fmt::format("'{}' is there twice", pass.name));
    file.passes.push_back(std::move(pass));
  }
  if (file.passes.empty()) top["passes"].refuse("expected one pass or more, found none");
  require_graph(top["passes"], file);
  return file;
}

}  // namespace rainref::foreign
