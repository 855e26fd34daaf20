// Descriptions of a pass for list, describe, packs and layouts, made from its definition.
#pragma once

#include <algorithm>
#include <iterator>
#include <string>
#include <tuple>
#include <vector>

#include "capture/pass_info.h"
#include "pass/definition.h"

namespace rainref::pass {

template <class P>
capture::PassInfo info_of() {
  capture::PassInfo all{
      std::string(P::about.name), std::string(P::about.sentence), {}, {}, {}, {P::uniforms()}, std::string(P::about.independence), {}};
  const auto add = [&](const char* name, const VariantOf& variant) {
    if (variant.revision != 0) all.variants.push_back({name, variant.revision, variant.judge, all.uniforms.front().name});
  };
  add("as-published", P::about.as_published);
  add("corrected", P::about.corrected);
  const typename P::template Io<Declared> io;
  each<P>(io, [&](const auto& m) {
    constexpr bool is_per_texel = requires { m.reach; };
    if constexpr (requires { m.outs; }) all.writes.emplace_back(m.outs[0].name);
    if constexpr (requires { m.from; })
      all.reads.push_back({std::string(m.name), std::string(m.from), m.previous, std::string(m.variant), m.same_size || is_per_texel});
  });
  for (const std::string_view sum : P::about.order_free_sums)
    if (!sum.empty()) all.order_free_sums.emplace_back(sum);
  return all;
}

/// For a pass with one definition for each variant: as published, corrected.
template <class P, class Q>
capture::PassInfo info_of() {
  static_assert(P::about.corrected.revision == 0 && Q::about.as_published.revision == 0);
  capture::PassInfo all = info_of<P>();
  const capture::PassInfo other = info_of<Q>();
  all.variants.push_back(other.variants.front());
  all.uniforms.push_back(other.uniforms.front());
  const auto reads = [](const capture::PassInfo& p, const std::string& buffer) {
    return std::any_of(p.reads.begin(), p.reads.end(), [&](const capture::ReadInfo& r) { return r.buffer == buffer; });
  };
  for (capture::ReadInfo& r : all.reads)
    if (!reads(other, r.buffer)) r.variant = "as-published";
  for (const capture::ReadInfo& r : other.reads) {
    if (reads(all, r.buffer)) continue;
    all.reads.push_back(r);
    all.reads.back().variant = "corrected";
  }
  const auto unite = [](std::vector<std::string>& into, const std::vector<std::string>& more) {
    for (const std::string& one : more)
      if (std::find(into.begin(), into.end(), one) == into.end()) into.push_back(one);
  };
  unite(all.writes, other.writes);
  unite(all.order_free_sums, other.order_free_sums);
  return all;
}

/// Sets the passes that write the inputs of a pass shared by several effects.
inline void set_source(capture::PassInfo& pass, const std::string& buffer, const std::string& from) {
  for (capture::ReadInfo& r : pass.reads)
    if (r.buffer == buffer) r.from = from;
}
/// The same if the variants have different ones.
inline void set_sources(capture::PassInfo& pass, const std::string& buffer, const std::string& as_published, const std::string& corrected) {
  const auto at = std::find_if(pass.reads.begin(), pass.reads.end(), [&](const capture::ReadInfo& r) { return r.buffer == buffer; });
  at->variant = "as-published";
  at->from = as_published;
  capture::ReadInfo other = *at;
  other.variant = "corrected";
  other.from = corrected;
  pass.reads.insert(at + 1, other);
}

/// Appends these to the others.
template <class T>
void append(std::vector<T>& all, std::vector<T> more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

/// The buffers that a pass writes.
template <class P>
std::vector<capture::BufferInfo> buffers_of() {
  std::vector<capture::BufferInfo> all;
  const auto add = [&](const Out& o, std::string_view format, std::string_view variant) {
    if (o.sentence.empty()) return;
    const auto text = [](std::string_view s) { return std::string(s); };
    all.push_back({text(o.name), text(o.format_key.empty() ? format : o.format_key), text(o.sentence), text(o.unit), o.range,
                   text(o.encoding), text(o.colour_space), text(o.alpha), "", text(o.record), text(variant)});
  };
  const bool published = P::about.as_published.revision != 0, corrected = P::about.corrected.revision != 0;
  const typename P::template Io<Declared> io;
  each<P>(io, [&](const auto& m) {
    if constexpr (requires { m.outs; }) {
      std::string_view format = "records";
      if constexpr (requires { m.format; }) format = info(m.format).name;
      if (!m.outs[0].variant.empty()) return add(m.outs[0], format, m.outs[0].variant);
      if (published && corrected && m.outs[0] == m.outs[1]) return add(m.outs[0], format, "");
      if (published) add(m.outs[0], format, "as-published");
      if (corrected) add(m.outs[1], format, "corrected");
    }
  });
  return all;
}
/// For the definitions of both variants: one entry if they agree.
template <class P, class Q>
std::vector<capture::BufferInfo> buffers_of() {
  std::vector<capture::BufferInfo> all;
  const std::vector<capture::BufferInfo> corrected = buffers_of<Q>();
  const auto named = [](const std::vector<capture::BufferInfo>& list, const std::string& name) {
    return std::find_if(list.begin(), list.end(), [&](const auto& b) { return b.name == name; });
  };
  for (const capture::BufferInfo& b : buffers_of<P>()) {
    all.push_back(b);
    const auto other = named(corrected, b.name);
    if (other == corrected.end()) continue;
    const auto meaning = [](const capture::BufferInfo& x) {
      return std::tie(x.format, x.sentence, x.unit, x.range, x.encoding, x.colour_space, x.alpha);
    };
    if (meaning(b) == meaning(*other))
      all.back().variant = "";
    else
      all.push_back(*other);
  }
  for (const capture::BufferInfo& b : corrected)
    if (named(all, b.name) == all.end()) all.push_back(b);
  return all;
}

}  // namespace rainref::pass
