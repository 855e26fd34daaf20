#include "capture/pass_info.h"

#include <algorithm>

#include <fmt/format.h>

#include "rainref/error.h"

namespace rainref::capture {
namespace {

template <class T, class Test>
const T& declared(const std::vector<T>& all, const char* what, std::string_view name, const Test& test) {
  const auto found = std::find_if(all.begin(), all.end(), test);
  if (found == all.end()) throw Error(ExitCode::internal, fmt::format("{} '{}' is not declared", what, name));
  return *found;
}

}  // namespace

const PassVariant* PassInfo::variant(std::string_view variant_name) const {
  const auto found = std::find_if(variants.begin(), variants.end(), [&](const PassVariant& v) { return v.name == variant_name; });
  return found == variants.end() ? nullptr : &*found;
}

const scene::UniformBlock& PassInfo::block(std::string_view variant_name) const {
  const PassVariant* v = variant(variant_name);
  if (!v) throw Error(ExitCode::internal, fmt::format("pass '{}' does not run as {}", name, variant_name));
  return declared(uniforms, "uniform block", v->uniforms, [&](const scene::UniformBlock& b) { return b.name == v->uniforms; });
}

const PassInfo& EffectInfo::pass(std::string_view pass_name) const {
  return declared(passes, "pass", pass_name, [&](const PassInfo& p) { return p.name == pass_name; });
}

const BufferInfo& EffectInfo::buffer(std::string_view buffer_name, std::string_view variant) const {
  return declared(buffers, "buffer", buffer_name,
                  [&](const BufferInfo& b) { return b.name == buffer_name && (b.variant.empty() || b.variant == variant); });
}

const scene::UniformBlock& EffectInfo::record(std::string_view record_name) const {
  return declared(records, "record", record_name, [&](const scene::UniformBlock& b) { return b.name == record_name; });
}

std::vector<std::string> EffectInfo::writes(const PassInfo& pass, std::string_view variant) const {
  std::vector<std::string> out;
  for (const std::string& written : pass.writes) {
    const auto is_it = [&](const BufferInfo& b) { return b.name == written && (b.variant.empty() || b.variant == variant); };
    if (std::any_of(buffers.begin(), buffers.end(), is_it)) out.push_back(written);
  }
  return out;
}

std::vector<std::string> EffectInfo::pass_names(std::string_view variant) const {
  std::vector<std::string> out;
  for (const PassInfo& p : passes) {
    if (p.variant(variant)) out.push_back(p.name);
  }
  return out;
}

std::string formula(const EffectInfo& effect, const PassInfo& pass, const PassVariant& variant) {
  return fmt::format("{}.{}.{}/{}", effect.name, pass.name, variant.name, variant.revision);
}

const char* name(Judge judge) {
  constexpr const char* names[] = {"envelope", "bits", "keyed", "input_only"};
  return names[static_cast<int>(judge)];
}

std::string judge_text(const PassInfo& pass) {
  const Judge first = pass.variants.front().judge;
  if (std::all_of(pass.variants.begin(), pass.variants.end(), [&](const PassVariant& v) { return v.judge == first; })) return name(first);
  std::string text;
  for (const PassVariant& v : pass.variants) text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", v.name, name(v.judge));
  return text;
}

}  // namespace rainref::capture
