// What list, describe, packs and layouts say of a pass, from its definition.
#pragma once

#include <string>
#include <vector>

#include "capture/pass_info.h"
#include "pass/definition.h"

namespace rainref::pass {

template <class P>
capture::PassInfo info_of() {
  capture::PassInfo all{std::string(P::about.name), std::string(P::about.sentence), {}, {}, {}, {P::uniforms()}, "gather", {}};
  const auto add = [&](const char* name, const VariantOf& variant) {
    if (variant.revision != 0) all.variants.push_back({name, variant.revision, variant.judge, all.uniforms.front().name});
  };
  add("as-published", P::about.as_published);
  add("corrected", P::about.corrected);
  const typename P::template Io<Declared> io;
  each<P>(io, [&](const auto& m) {
    if constexpr (requires { m.outs; }) all.writes.emplace_back(m.outs[0].name);
    else all.reads.push_back({std::string(m.name), std::string(m.from), m.previous, std::string(m.variant), requires { m.reach; }});
  });
  for (const std::string_view sum : P::about.order_free_sums)
    if (!sum.empty()) all.order_free_sums.emplace_back(sum);
  return all;
}

/// The buffers that a pass writes.
template <class P>
std::vector<capture::BufferInfo> buffers_of() {
  std::vector<capture::BufferInfo> all;
  const auto add = [&](const Out& o, Format format, const char* variant) {
    const auto text = [](std::string_view s) { return std::string(s); };
    all.push_back({text(o.name), text(info(format).name), text(o.sentence), text(o.unit), o.range, text(o.encoding), text(o.colour_space), text(o.alpha), "", "", variant});
  };
  const bool published = P::about.as_published.revision != 0, corrected = P::about.corrected.revision != 0;
  const typename P::template Io<Declared> io;
  each<P>(io, [&](const auto& m) {
    if constexpr (requires { m.outs; }) {
      if (published && corrected && m.outs[0] == m.outs[1]) return add(m.outs[0], m.format, "");
      if (published) add(m.outs[0], m.format, "as-published");
      if (corrected) add(m.outs[1], m.format, "corrected");
    }
  });
  return all;
}

}  // namespace rainref::pass
