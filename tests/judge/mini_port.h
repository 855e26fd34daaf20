// A port in miniature: the passes of a small pack, evaluated as some device might, with or without a mistake.
#pragma once

#include <cstring>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/error_of.h"
#include "base/temporary_folder.h"
#include "capture/npy_write.h"
#include "capture/pack_read.h"
#include "faults/diagnose.h"
#include "judge/judge.h"
#include "judge/judge_pass.h"
#include "judge/slots.h"
#include "judge/validate.h"
#include "shipped_packs.h"

namespace rainref::judge {

inline const std::filesystem::path small_packs = rainref::test::packs_folder();

inline const parallel::Executor& test_executor() {
  static const parallel::Executor executor(2);
  return executor;
}

inline void put_bytes(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  std::filesystem::create_directories(path.parent_path());
  put(path, std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}
/// `stem`: "in.wave".
inline void put_array(const std::filesystem::path& run, const std::string& stem, const capture::Array& array) {
  for (std::size_t l = 0; l < array.levels.size(); ++l)
    put_bytes(run / (l == 0 ? stem + ".npy" : stem + ".L" + std::to_string(l) + ".npy"), capture::npy_bytes(array, static_cast<int>(l)));
}

struct MiniPort {
  explicit MiniPort(const std::string& name) : pack(small_packs / name) {}

  capture::Pack pack;
  HalfMode stores = HalfMode::either;              ///< how it rounds half stores; either: as the reference does
  std::string stores_only;                         ///< the pass that rounds so, the others as the reference does; "": each
  perturbed::Behaviour behaviour;                  ///< of its arithmetic
  std::string only;                                ///< the pass that behaves so; "": each
  bool free_running = false;                       ///< inputs are the outputs of its own runs before, and are dumped too
  std::function<void(capture::PassCase&)> before;  ///< changes what a pass takes
  std::function<void(capture::PassCase&)> dumped;  ///< changes what is dumped of that
  std::function<void(const capture::PassCase&, std::vector<capture::Array>&)> after;  ///< changes what it gave

  /// What a pass gives for a case.
  std::vector<capture::Array> outputs(const capture::PassCase& c) const {
    std::vector<capture::Array> out;
    for (const capture::CaseOutput& o : c.outputs) out.push_back(o.array);
    const capture::PassEvaluations* evaluations = evaluations_of(pack.effect, c.pass);
    const bool has_lists = std::any_of(c.outputs.begin(), c.outputs.end(), [](const auto& o) { return o.judge == capture::Judge::keyed; });
    if (!is_enveloped(c) && !has_lists) return out;
    if (!evaluations->bind) return evaluations->recompute(c);
    const std::unique_ptr<capture::PassModel> model = evaluations->bind(c);
    const std::vector<Slot> slots = slots_of(c);
    const perturbed::Scope scope(only.empty() || only == c.pass ? behaviour : perturbed::Behaviour());
    for (std::size_t o = 0; o < out.size(); ++o) {
      if (c.outputs[o].judge != capture::Judge::keyed || is_placed(c.outputs[o])) continue;
      out[o].levels = {*model->keyed(c.outputs[o].name)->perturbed()};
      out[o].width = static_cast<int>(out[o].levels[0].size() / out[o].element_bytes());
    }
    std::vector<perturbed::Perturbed> values(slots.size());
    for (int y = 0; y < model->height(); ++y) {
      for (int x = 0; x < model->width(); ++x) {
        model->evaluate(x, y, values.data());
        for (std::size_t v = 0; v < slots.size(); ++v) {
          const Slot& s = slots[v];
          store_value(s, values[v].v, rounding_of(s, stores_only.empty() || stores_only == c.pass ? stores : HalfMode::either),
                      out[static_cast<std::size_t>(s.output)].levels[0].edit().data() + s.offset(x, y));
        }
      }
    }
    return out;
  }

  void run(const std::filesystem::path& folder) const {
    std::map<std::string, capture::Array> latest;                 // of each buffer
    std::map<std::string, std::map<int, capture::Array>> levels;  // of those that a pass gives level by level
    for (const capture::PackCase& entry : pack.cases) {
      capture::PassCase c = pack.read(entry);
      for (capture::CaseInput& input : c.inputs)
        if (free_running && latest.contains(input.name)) {
          const std::size_t wanted = input.array.levels.size();
          input.array = wanted > 1 ? levels[input.name][0] : latest[input.name];
          for (std::size_t l = 1; l < wanted; ++l) input.array.levels.push_back(levels[input.name][static_cast<int>(l)].levels[0]);
        }
      if (before) before(c);
      std::vector<capture::Array> gave = outputs(c);
      if (after) after(c, gave);
      for (std::size_t o = 0; o < gave.size(); ++o) {
        put_array(folder / c.folder(), "out." + c.outputs[o].name, gave[o]);
        latest[c.outputs[o].name] = gave[o];
        if (c.level >= 0) levels[c.outputs[o].name][c.level] = gave[o];
      }
      if (!free_running) continue;
      if (dumped) dumped(c);
      for (const capture::CaseInput& input : c.inputs) put_array(folder / c.folder(), "in." + input.name, input.array);
      put_bytes(folder / c.folder() / "uniforms.bin", c.uniforms);
    }
  }
};

/// Runs a port and judges what it gave.
inline PortJudgement judged(const MiniPort& port, ValidateOptions options = {}) {
  const TemporaryFolder folder;
  port.run(folder.path());
  options.executor = &test_executor();
  return validate(port.pack, folder.path(), options);
}
inline PortJudgement judged(const MiniPort& port, const std::string& profile) {
  ValidateOptions options;
  options.profile = profile;
  return judged(port, options);
}
inline PortJudgement judge(const capture::Pack& pack, const std::filesystem::path& port, const std::string& profile = "vulkan",
                           bool diagnose = false) {
  ValidateOptions options;
  options.profile = profile;
  if (diagnose) options.explain = faults::diagnose;
  options.executor = &test_executor();
  return validate(pack, port, options);
}

inline const PassJudgement& pass_of(const PortJudgement& j, const std::string& name) {
  for (const PassJudgement& p : j.passes)
    if (p.pass == name) return p;
  throw std::runtime_error("no pass " + name);
}
inline std::string why(const PortJudgement& j) {
  std::string out = name(j.status);
  for (const PassJudgement& p : j.passes) out += "\n" + p.pass + " " + name(p.status) + " " + p.reason;
  for (const std::string& note : j.notes) out += "\nnote: " + note;
  return out;
}

/// Makes of the value that lies there what `change` gives.
template <class T, class Change>
void change_at(std::byte* at, const Change& change) {
  T value;
  std::memcpy(&value, at, sizeof value);
  value = change(value);
  std::memcpy(at, &value, sizeof value);
}
inline std::size_t uniform_offset(const capture::Pack& pack, const std::string& pass, const std::string& name) {
  for (const scene::Member& m : pack.pass(pass).block.members)
    if (m.name == name) return m.offset;
  throw std::runtime_error(name + " is no uniform of " + pass);
}

inline capture::CaseInput& input_of(capture::PassCase& c, const std::string& name) {
  for (capture::CaseInput& i : c.inputs)
    if (i.name == name) return i;
  throw std::runtime_error("no input " + name);
}

}  // namespace rainref::judge
