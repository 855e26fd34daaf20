#include "cli/layout_text.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rainref/error.h"

namespace rainref::cli {
namespace {

using scene::Language;

/// The bindings of a pass in a variant, in order.
struct Bound {
  std::string name, record;  ///< record: "" for an image
  bool is_written;
  int slot;  ///< HLSL: t or u register
  bool operator==(const Bound&) const = default;
};
struct Interface {
  std::string variant, block;
  std::vector<Bound> bound;
};

Interface interface_of(const capture::EffectInfo& effect, const capture::PassInfo& pass, const capture::PassVariant& variant) {
  Interface out{variant.name, variant.uniforms, {}};
  int slots[2] = {0, 0};
  const auto add = [&](const std::string& buffer, const std::string& name, bool is_written) {
    const capture::BufferInfo& info = effect.buffer(buffer, variant.name);
    out.bound.push_back({name, info.format == "records" ? info.record : "", is_written, slots[is_written]++});
  };
  for (const capture::ReadInfo& r : pass.reads)
    if (r.variant.empty() || r.variant == variant.name) add(r.buffer, r.buffer, false);
  const std::vector<Bound> read = out.bound;
  for (const std::string& written : effect.writes(pass, variant.name)) {
    const bool is_read = std::any_of(read.begin(), read.end(), [&](const Bound& b) { return b.name == written; });
    add(written, is_read ? written + "_out" : written, true);
  }
  return out;
}

// "0 WaveStepUniforms, 1 wave (image), 2 drops, 3 wave_out (image)".
std::string places(const Interface& of, Language language) {
  if (language == Language::c || language == Language::cuda) {
    std::vector<std::string> read, written;
    for (const Bound& b : of.bound) (b.is_written ? written : read).push_back(b.record.empty() ? b.name + " (image)" : b.name);
    return fmt::format("Reads {}; writes {}.", read.empty() ? "nothing" : fmt::format("{}", fmt::join(read, ", ")),
                       fmt::join(written, ", "));
  }
  const bool has_registers = language == Language::hlsl;
  std::string text = fmt::format("{}: {} {}", has_registers ? "Registers" : "Bindings", has_registers ? "b0" : "0", of.block);
  for (std::size_t i = 0; i < of.bound.size(); ++i) {
    const Bound& b = of.bound[i];
    const std::string place = has_registers ? fmt::format("{}{}", b.is_written ? 'u' : 't', b.slot) : std::to_string(i + 1);
    text += fmt::format(", {} {}{}", place, b.name, b.record.empty() ? " (image)" : "");
  }
  return text + ".";
}

const capture::PassInfo& find_pass(const capture::EffectInfo& effect, const std::string& name) {
  std::vector<std::string> names;
  for (const capture::PassInfo& p : effect.passes) {
    if (p.name == name) return p;
    names.push_back(p.name);
  }
  throw Error(ExitCode::usage,
              fmt::format("--pass: expected one of {}, found '{}'{}", fmt::join(names, ", "), name, did_you_mean(name, names)));
}

}  // namespace

std::string layout_text(const capture::EffectInfo& effect, Language language, const std::optional<std::string>& pass,
                        const std::optional<std::string>& variant) {
  std::vector<const capture::PassInfo*> passes;
  for (const capture::PassInfo& p : effect.passes) passes.push_back(&p);
  if (pass) passes = {&find_pass(effect, *pass)};
  std::vector<std::string> variants;
  for (const capture::PassInfo* p : passes) {
    for (const capture::PassVariant& v : p->variants)
      if (std::find(variants.begin(), variants.end(), v.name) == variants.end()) variants.push_back(v.name);
  }
  if (variant && std::find(variants.begin(), variants.end(), *variant) == variants.end()) {
    throw Error(ExitCode::usage,
                fmt::format("--variant: expected one of {}{}, found '{}'{}", fmt::join(variants, ", "),
                            pass ? fmt::format(", in which {} runs", *pass) : "", *variant, did_you_mean(*variant, variants)));
  }

  std::string text;
  std::set<std::string> printed;
  for (const capture::PassInfo* p : passes) {
    std::vector<Interface> interfaces;
    for (const capture::PassVariant& v : p->variants)
      if (!variant || v.name == *variant) interfaces.push_back(interface_of(effect, *p, v));
    // Variants with equal bindings are listed once.
    const bool are_alike = std::all_of(interfaces.begin(), interfaces.end(), [&](const Interface& i) {
      return i.block == interfaces[0].block && i.bound == interfaces[0].bound;
    });
    if (are_alike && interfaces.size() > 1) interfaces.resize(1);
    for (const Interface& of : interfaces) {
      text += fmt::format("// Pass {}{}. {}\n", p->name, are_alike && !variant ? "" : ", " + of.variant, places(of, language));
      for (const Bound& b : of.bound) {
        if (!b.record.empty() && printed.insert(b.record).second) text += scene::record_layout(effect.record(b.record), language) + "\n";
      }
      if (printed.insert(of.block).second) text += scene::layout(p->block(of.variant), language) + "\n";
      std::string lists;
      for (std::size_t i = 0; i < of.bound.size(); ++i) {
        const Bound& b = of.bound[i];
        if (!b.record.empty()) lists += scene::list_layout({b.name, b.record, b.is_written, static_cast<int>(i) + 1, b.slot}, language);
      }
      if (!lists.empty()) text += lists + "\n";
    }
  }
  return text;
}

}  // namespace rainref::cli
