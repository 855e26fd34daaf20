#include "capture/check_case.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rainref/error.h"

namespace rainref::capture {
namespace {

std::string shape(const Array& a) { return a.is_records ? fmt::format("{} records", a.width) : fmt::format("{}x{}", a.width, a.height); }
std::string type(const Array& a) { return a.is_records ? fmt::format("records of {}", a.record.name) : std::string(info(a.format).name); }

class CaseCheck {
 public:
  CaseCheck(const EffectInfo& effect, std::span<const scene::Parameter> parameters, const PassCase& c)
      : effect_(effect), parameters_(parameters), c_(c) {}

  void run() {
    const std::vector<std::string> names = effect_.pass_names(c_.variant);
    if (std::find(names.begin(), names.end(), c_.pass) == names.end()) {
      throw Error(ExitCode::port_files, fmt::format("{}: {} {} has the passes {}, found '{}'{}", c_.folder(), effect_.name, c_.variant,
                                                    fmt::join(names, ", "), c_.pass, did_you_mean(c_.pass, names)));
    }
    const PassInfo& pass = effect_.pass(c_.pass);
    if (const std::size_t size = pass.block(c_.variant).size; c_.uniforms.size() != size)
      refuse("uniforms.bin", fmt::format("{} bytes", size), fmt::format("{}", c_.uniforms.size()));
    const std::vector<std::string> writes = effect_.writes(pass, c_.variant);
    for (std::size_t o = 0; o < c_.outputs.size(); ++o) check_output(pass, writes, o);
    // Models return values in the order of the outputs.
    std::vector<std::string> found;
    for (const CaseOutput& output : c_.outputs) found.push_back(output.name);
    if (found != writes)
      refuse("", fmt::format("the outputs {}, in this order", fmt::join(writes, ", ")),
             found.empty() ? "none" : fmt::format("{}", fmt::join(found, ", ")));
    for (std::size_t i = 0; i < c_.inputs.size(); ++i) check_input(pass, i);
  }

 private:
  [[noreturn]] void refuse(const std::string& what, const std::string& expected, const std::string& found) const {
    throw Error(ExitCode::port_files,
                fmt::format("{}: {}{}expected {}, found {}", c_.folder(), what, what.empty() ? "" : ": ", expected, found));
  }

  void check_output(const PassInfo& pass, const std::vector<std::string>& writes, std::size_t o) {
    const CaseOutput& output = c_.outputs[o];
    const std::string what = "out." + output.name;
    if (std::find(writes.begin(), writes.end(), output.name) == writes.end())
      refuse(what, fmt::format("one of the outputs {}", fmt::join(writes, ", ")), fmt::format("'{}'", output.name));
    for (std::size_t k = 0; k < o; ++k)
      if (c_.outputs[k].name == output.name) refuse(what, "one output of this name", "two");
    check_type(what, output.name, output.array, true);
    if (output.array.levels.size() > 1) refuse(what, "one mip level", fmt::format("{}", output.array.levels.size()));
    const Judge declared = pass.variant(c_.variant)->judge,
                own = declared == Judge::keyed && !output.array.is_records ? Judge::envelope : declared;
    if (output.judge != own) refuse(what, fmt::format("judge \"{}\"", name(own)), fmt::format("\"{}\"", name(output.judge)));
    if (output.array.is_records) return;
    if (output.array.width < 1 || output.array.height < 1) refuse(what, "at least one texel", shape(output.array));
    if (!first_image_)
      first_image_ = &output;
    else
      check_size(what, output.array);
  }
  void check_input(const PassInfo& pass, std::size_t i) {
    const CaseInput& input = c_.inputs[i];
    const std::string what = "in." + input.name;
    std::vector<std::string> reads;
    const ReadInfo* read = nullptr;
    for (const ReadInfo& r : pass.reads) {
      if (!r.variant.empty() && r.variant != c_.variant) continue;
      reads.push_back(r.buffer);
      if (r.buffer == input.name) read = &r;
    }
    if (!read)
      refuse(what, fmt::format("one of the inputs {}", fmt::join(reads, ", ")),
             fmt::format("'{}'{}", input.name, did_you_mean(input.name, reads)));
    for (std::size_t k = 0; k < i; ++k)
      if (c_.inputs[k].name == input.name) refuse(what, "one input of this name", "two");
    check_type(what, input.name, input.array, read->per_texel);
    if (input.array.is_records) return;
    if (input.array.width < 1 || input.array.height < 1) refuse(what, "at least one texel", shape(input.array));
    if (read->per_texel && first_image_) check_size(what, input.array);
  }
  void check_size(const std::string& what, const Array& a) const {
    const Array& first = first_image_->array;
    if (a.width != first.width || a.height != first.height)
      refuse(what, fmt::format("{} as out.{} has", shape(first), first_image_->name), shape(a));
  }

  /// Accepts the format in the buffer's declaration, those of its scene key, or records. An input that is looked up by coordinates may be
  /// floats with the same number of channels, because textures are captured that way.
  void check_type(const std::string& what, const std::string& buffer_name, const Array& a, bool is_exact) {
    const BufferInfo& buffer = effect_.buffer(buffer_name, c_.variant);
    if (buffer.format == "records") {
      const scene::UniformBlock& record = effect_.record(buffer.record);
      if (!a.is_records || !scene::same_layout(a.record, record))
        refuse(what, fmt::format("records of {} as this version declares them", record.name), type(a));
      return;
    }
    const auto key =
        std::find_if(parameters_.begin(), parameters_.end(), [&](const scene::Parameter& p) { return p.key == buffer.format; });
    const bool has_key = key != parameters_.end();
    const std::vector<std::string> formats = has_key ? key->choices : std::vector<std::string>{buffer.format};
    const auto fits = [&](const std::string& format) {
      const Format declared = format_from_name(format);
      return a.format == declared ||
             (!is_exact && info(a.format).kind == FormatInfo::float32 && info(a.format).channels == info(declared).channels);
    };
    if (a.is_records || std::none_of(formats.begin(), formats.end(), fits))
      refuse(what, fmt::format("{}", fmt::join(formats, " or ")), type(a));
    if (!has_key) return;
    for (const auto& [other, format] : chosen_) {
      if (other == buffer.format && format != a.format)
        refuse(what, fmt::format("{} as the case's other buffers have ({})", info(format).name, other), type(a));
    }
    chosen_.emplace_back(buffer.format, a.format);
  }

  const EffectInfo& effect_;
  std::span<const scene::Parameter> parameters_;
  const PassCase& c_;
  const CaseOutput* first_image_ = nullptr;
  std::vector<std::pair<std::string, Format>> chosen_;  ///< scene keys and their formats
};

}  // namespace

void check_case(const EffectInfo& effect, std::span<const scene::Parameter> parameters, const PassCase& c) {
  CaseCheck(effect, parameters, c).run();
}

std::string uniform_fault(const EffectInfo& effect, const PassCase& c) {
  const std::string why = scene::value_fault(effect.pass(c.pass).block(c.variant), c.uniforms.data());
  return why.empty() ? "" : "uniform " + why;
}

std::string record_fault(const PassCase& c) {
  for (const CaseInput& input : c.inputs) {
    if (!input.array.is_records) continue;
    const std::byte* records = input.array.levels.at(0).data();
    for (int k = 0; k < input.array.width; ++k) {
      const std::string why = scene::value_fault(input.array.record, records + static_cast<std::size_t>(k) * input.array.record.size);
      if (!why.empty()) return fmt::format("in.{}: record {}: {}", input.name, k, why);
    }
  }
  return "";
}

}  // namespace rainref::capture
