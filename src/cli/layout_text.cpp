#include "cli/layout_text.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rainref/error.h"
#include "scene/binding_layout.h"

namespace rainref::cli {
namespace {

using scene::Language;

/// The bindings of a pass in a variant, in order.
struct Bound {
  std::string name, record, format;  ///< record: "" for an image
  bool is_written;
  int slot;  ///< HLSL: t or u register
  bool operator==(const Bound&) const = default;
};
struct Interface {
  std::string variant, block;
  std::vector<Bound> bound;

  bool writes_lists() const {
    return std::any_of(bound.begin(), bound.end(), [](const Bound& b) { return b.is_written && !b.record.empty(); });
  }
};

Interface interface_of(const capture::EffectInfo& effect, const capture::PassInfo& pass, const capture::PassVariant& variant) {
  Interface out{variant.name, variant.uniforms, {}};
  int slots[2] = {0, 0};
  const auto add = [&](const std::string& buffer, const std::string& name, bool is_written) {
    const capture::BufferInfo& info = effect.buffer(buffer, variant.name);
    out.bound.push_back({name, info.format == "records" ? info.record : "", info.format, is_written, slots[is_written]++});
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

/// Where members of a block are names of the whole shader, an image or a list of the same name gets another.
void set_apart(Interface& of, const scene::UniformBlock& block, Language language) {
  if (language != Language::hlsl && language != Language::gdshader) return;
  for (Bound& b : of.bound)
    if (std::any_of(block.members.begin(), block.members.end(), [&](const scene::Member& m) { return m.name == b.name; }))
      b.name += b.record.empty() ? "_image" : "_list";
}

// "0 WaveStepUniforms, 1 wave (image), 2 drops, 3 wave_out (image)".
std::string places(const Interface& of, Language language) {
  if (language == Language::c || language == Language::cuda || language == Language::gdshader || language == Language::glsl330) {
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

/// Declares images and lists.
std::string declarations(const capture::EffectInfo& effect, const std::string& pass, const Interface& of, Language language) {
  int counter = static_cast<int>(std::count_if(of.bound.begin(), of.bound.end(), [](const Bound& b) { return b.is_written; }));
  std::vector<scene::ImageBinding> images;
  std::string lists;
  for (std::size_t i = 0; i < of.bound.size(); ++i) {
    const Bound& b = of.bound[i];
    const scene::Place place{static_cast<int>(i) + 1, b.slot};
    if (b.record.empty()) {
      images.push_back({b.name, b.format, b.is_written, place});
      continue;
    }
    const scene::ListBinding list{b.name, b.record, b.is_written, place, b.is_written ? counter++ : 0};
    const bool is_texels = language == Language::glsl330 || language == Language::gdshader;
    lists += is_texels ? scene::list_in_texels(list, effect.record(b.record), language) : scene::list_layout(list, language);
  }
  return scene::image_layout(images, pass, !of.writes_lists(), language) + lists;
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

  std::string text = scene::layout_preamble(language);
  std::set<std::string> printed;
  for (const capture::PassInfo* p : passes) {
    std::vector<Interface> interfaces;
    for (const capture::PassVariant& v : p->variants)
      if (!variant || v.name == *variant) interfaces.push_back(interface_of(effect, *p, v));
    for (Interface& i : interfaces) set_apart(i, p->block(i.variant), language);
    // Variants with equal bindings are listed once.
    const bool are_alike = std::all_of(interfaces.begin(), interfaces.end(), [&](const Interface& i) {
      return i.block == interfaces[0].block && i.bound == interfaces[0].bound;
    });
    if (are_alike && interfaces.size() > 1) interfaces.resize(1);
    for (const Interface& of : interfaces) {
      text += fmt::format("// Pass {}{}. {}\n", p->name, are_alike && !variant ? "" : ", " + of.variant, places(of, language));
      for (const Bound& b : of.bound) {
        if (b.record.empty() || !printed.insert(b.record).second) continue;
        if (const std::string record = scene::record_layout(effect.record(b.record), language); !record.empty()) text += record + "\n";
      }
      if (printed.insert(of.block).second) text += scene::layout(p->block(of.variant), language) + "\n";
      const std::string bindings = declarations(effect, p->name, of, language);
      if (!bindings.empty()) text += bindings + "\n";
    }
  }
  return text;
}

}  // namespace rainref::cli
