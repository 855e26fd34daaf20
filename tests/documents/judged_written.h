// A port of what is written from the documents, judged.
#pragma once

#include <algorithm>

#include "documents/all_written.h"
#include "judge/mini_port.h"

namespace rainref::documents {

using capture::Pack;
using capture::PackCase;
using capture::PackPass;
using capture::PassCase;
using namespace judge;

inline bool is_of(const Written& w, const std::string& pack) { return std::find(w.packs.begin(), w.packs.end(), pack) != w.packs.end(); }
inline const Written* written(const std::string& pack, const std::string& pass) {
  for (const Written& w : all_written())
    if (is_of(w, pack) && w.pass == pass) return &w;
  return nullptr;
}

inline std::vector<capture::Array> given(const Written& w, const Pack& pack, const PassCase& c, const std::string& mistake,
                                         HalfMode stores = HalfMode::either) {
  const scene::UniformBlock& block = pack.pass(c.pass).block;
  const Run run(c, block, mistake);
  Given out(c, stores);
  if (w.loop)
    give_texels(w.loop, run, out);
  else
    w.give(run, out);
  return out.arrays;
}
/// A port of the functions, each with a mistake or with "", judged; these passes alone, or all (none).
template <class MistakeOf>
PortJudgement judged(const Pack& pack, const MistakeOf& mistake_of, const std::string& profile = "vulkan",
                     const std::vector<std::string>& only = {}, decltype(ValidateOptions::explain) explain = {}) {
  const TemporaryFolder folder;
  ValidateOptions options;
  options.profile = profile;
  options.partial = true;
  options.only = only;
  options.executor = &test_executor();
  options.explain = explain;
  for (const PackCase& entry : pack.cases) {
    const PassCase c = pack.read(entry);
    const Written* w = written(pack.effect + "-" + c.variant, c.pass);
    if (!w || !options.wants(c.pass)) continue;
    const std::vector<capture::Array> arrays = given(*w, pack, c, mistake_of(*w));
    for (std::size_t o = 0; o < arrays.size(); ++o) put_array(folder / c.folder(), "out." + c.outputs[o].name, arrays[o]);
  }
  return validate(pack, folder.path(), options);
}

inline std::string without_mistake(const Written&) { return ""; }

/// Every pass that a port is judged by.
inline void expect_pass(const PortJudgement& j, const std::string& pack) {
  for (const PassJudgement& p : j.passes) {
    const Written* w = written(pack, p.pass);
    if (!w || w->wrong.empty()) continue;
    EXPECT_EQ(p.status, Status::pass) << j.profile << ", " << p.pass << ' ' << name(p.status) << ' ' << p.reason << ' ' << p.where;
  }
}

}  // namespace rainref::documents
