// From a pack and a port's files to a verdict, on packs that nobody meant: what the fuzzer calls, and the replay of what it
// found. Files lie in a temporary folder, because that is how they reach rainref.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/temporary_folder.h"
#include "capture/check_case.h"
#include "capture/manifest_write.h"
#include "capture/npy_write.h"
#include "capture/pack_read.h"
#include "faults/diagnose.h"
#include "faults/mutate.h"
#include "fuzz/pack_edits.h"
#include "judge/judge_pass.h"
#include "registry/registry.h"
#include "judge/reference_outputs.h"
#include "judge/profiles.h"
#include "judge/shadow.h"
#include "judge/validate.h"
#include "rainref/error.h"
#include "shipped_packs.h"

namespace rainref::fuzz {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Bytes = std::span<const std::byte>;

/// A small pack of the repository, and the first case of each of the passes that the proofs take of it, cut to a few texels.
struct Base {
  std::string name;
  Json head;  ///< the manifest without cases
  std::string effect;
  std::vector<capture::PassCase> cases;
};
/// Passes whose uniforms say how large their images are, or whose images must be of a certain size, keep theirs.
inline bool keeps_size(const std::string& pass) {
  return pass == "merge" || pass == "wipe_drops" || pass == "splat" || pass == "bake_rivulets" || pass == "bake_raindrops" ||
         pass == "cells";
}

inline const std::vector<Base>& bases() {
  static const std::vector<Base> all = [] {
    std::vector<Base> out;
    for (const rainref::test::PackPasses& proven : rainref::test::proven_packs()) {
      const capture::Pack pack(rainref::test::pack_folder(proven.name));
      Base base{proven.name, Json::parse(contents(pack.folder() / capture::manifest_name)), pack.effect, {}};
      base.head["cases"] = Json::array();
      std::vector<std::string> seen;
      for (const capture::PackCase& entry : pack.cases) {
        if (!proven.has(entry.pass)) continue;
        const std::string key = entry.pass + (entry.level > 0 ? "+" : "");
        if (std::find(seen.begin(), seen.end(), key) != seen.end()) continue;
        seen.push_back(key);
        capture::PassCase c = pack.read(entry);
        constexpr int most = 7;
        if (!keeps_size(c.pass)) {
          for (capture::CaseInput& i : c.inputs)
            if (!i.array.is_records) resize(i.array, std::min(i.array.width, most), std::min(i.array.height, most));
          for (capture::CaseOutput& o : c.outputs)
            if (!o.array.is_records) resize(o.array, std::min(o.array.width, most), std::min(o.array.height, most));
        }
        base.cases.push_back(std::move(c));
      }
      out.push_back(std::move(base));
    }
    return out;
  }();
  return all;
}

/// The files of a case as a pack has them.
class Folder {
 public:
  explicit Folder(fs::path root) : root_(std::move(root)) {}
  const fs::path& root() const { return root_; }
  void put(const std::string& name, const std::vector<std::byte>& bytes) const {
    fs::create_directories((root_ / name).parent_path());
    rainref::put(root_ / name, std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  }
  std::vector<capture::PackFile> put(const std::string& stem, const capture::Array& array) const {
    std::vector<capture::PackFile> files;
    for (std::size_t l = 0; l < array.levels.size(); ++l) {
      const std::string name = l == 0 ? stem + ".npy" : stem + ".L" + std::to_string(l) + ".npy";
      const std::vector<std::byte> bytes = capture::npy_bytes(array, static_cast<int>(l));
      put(name, bytes);
      files.push_back({name, bytes.size(), file_hash(bytes)});
    }
    return files;
  }

 private:
  fs::path root_;
};

/// What the reference gives for the case becomes what is expected, so that the judge is reached, not only its door. False where
/// the case is none that may be evaluated.
inline bool settle(const Base& base, capture::PassCase& c) {
  const effect::Effect& effect = registry::effect_of_pack(base.effect);
  try {
    capture::check_case(*effect.info, effect.parameters, c);
    if (!capture::uniform_fault(*effect.info, c).empty() || !capture::record_fault(c).empty()) return false;
    const capture::PassEvaluations* evaluations = judge::evaluations_of(base.effect, c.pass);
    const bool is_data =
        std::all_of(c.outputs.begin(), c.outputs.end(), [](const auto& o) { return o.judge == capture::Judge::input_only; });
    if (!evaluations || is_data) return true;
    std::vector<capture::Array> expected;
    const std::unique_ptr<capture::PassModel> model = judge::bound(c.pass, evaluations->bind, c);
    if (model) {
      const parallel::Executor executor(1);
      expected = judge::reference_outputs(c, *model, executor);
    } else if (evaluations->recompute) {
      expected = evaluations->recompute(c);
    }
    for (std::size_t o = 0; o < expected.size(); ++o) c.outputs[o].array = std::move(expected[o]);
    return true;
  } catch (const Error& e) {
    if (e.code() == ExitCode::internal) throw;
    return false;
  }
}

/// An Error with a code that a user may see; an internal one, or anything else, ends the fuzzer. True when nothing was refused.
template <class F>
bool is_taken(F&& f) {
  try {
    f();
    return true;
  } catch (const Error& e) {
    if (e.code() == ExitCode::internal) throw;
    return false;
  }
}

/// The whole way. The program's first bytes choose pack, pass and verb, the others are edits. True when the verb came to its end.
inline bool judge_pack(Bytes bytes) {
  Program p(bytes);
  const Base& base = p.one_of(bases());
  const std::uint32_t way = p.next(), verb = way % 4;  // validate, mutate, shadow by the manifest, shadow with the port's own uniforms
  const bool is_explained = way / 4 % 4 == 0;          // a search for a cause takes a hundred times as long as all else
  capture::PassCase c = p.one_of(base.cases);
  const capture::EffectInfo& effect = *registry::effect_of_pack(base.effect).info;
  const scene::UniformBlock& block = effect.pass(c.pass).block(c.variant);
  const capture::PassCase good = c;
  for (std::size_t edits = p.below(4); edits > 0; --edits) edit_case(c, block, p);
  settle(base, c);

  const TemporaryFolder folder;
  const Folder pack(folder / "pack"), port(folder / "port");
  // A port's own uniforms and inputs beside a pack that is good.
  const capture::PassCase& planned = verb == 3 ? good : c;
  const std::string id = planned.folder() + "/";
  Json manifest = base.head;
  const std::vector<std::byte>& uniforms = planned.uniforms;
  pack.put(id + "uniforms.bin", uniforms);
  Json entry = capture::case_json(planned, effect, {id + "uniforms.bin", uniforms.size(), file_hash(uniforms)});
  entry["inputs"] = entry["outputs"] = Json::array();
  for (const capture::CaseInput& i : planned.inputs)
    entry["inputs"].push_back(capture::input_json(i, effect.buffer(i.name, planned.variant), pack.put(id + "in." + i.name, i.array)));
  for (const capture::CaseOutput& o : planned.outputs)
    entry["outputs"].push_back(capture::output_json(o, effect.buffer(o.name, planned.variant), effect.pass(planned.pass),
                                                    pack.put(id + "out." + o.name, o.array)));
  manifest["cases"].push_back(std::move(entry));
  for (std::size_t edits = p.below(8) < 4 ? 0 : 1 + p.below(3); edits > 0; --edits) edit_manifest(manifest, p);
  std::string text = manifest.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (p.below(32) == 31) text.insert(text.size() - 1, ",\"deep\":" + std::string(100 * p.below(2000), '[') + "1");
  rainref::put(pack.root() / capture::manifest_name, text);

  // The port: what is expected, with or without a wrong value, shape or byte.
  capture::PassCase stored = c;
  for (std::size_t edits = p.below(3); edits > 0; --edits) edit_case(stored, block, p);
  const std::string own = c.folder() + "/";
  port.put(own + "uniforms.bin", c.uniforms);
  for (const capture::CaseInput& i : c.inputs) port.put(own + "in." + i.name, i.array);
  for (const capture::CaseOutput& o : stored.outputs) port.put(own + "out." + o.name, o.array);
  if (p.below(8) == 7) {
    const std::string name = own + "out." + c.outputs.front().name + ".npy";
    std::string file = contents(port.root() / name);
    if (!file.empty()) file[p.below(file.size())] = static_cast<char>(p.next());
    rainref::put(port.root() / name, file);
  }

  static const parallel::Executor executor(1);
  judge::ValidateOptions options;
  options.executor = &executor;
  if (is_explained) options.explain = faults::diagnose;
  options.profile = p.one_of(judge::profile_names());
  return is_taken([&] {
    const capture::Pack opened(pack.root());
    if (verb == 0) {
      judge::validate(opened, port.root(), options);
    } else if (verb == 1) {
      faults::mutate(opened, options, 9);
    } else {
      const judge::ShadowPlan plan = judge::ShadowPlan::of_manifest(opened, false);
      std::vector<std::string> passes;
      for (const capture::PackPass& pass : plan.passes) passes.push_back(pass.name);
      judge::shadow(plan, port.root(), judge::dumped_runs(port.root(), plan.effect, passes), options);
    }
  });
}

}  // namespace rainref::fuzz
