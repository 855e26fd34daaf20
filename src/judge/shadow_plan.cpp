#include "judge/shadow_plan.h"

#include <algorithm>
#include <cctype>
#include <tuple>

#include <fmt/format.h>

#include "base/hash.h"
#include "base/number_text.h"
#include "base/path_text.h"
#include "capture/npy_write.h"
#include "judge/check_pack.h"
#include "rainref/error.h"

namespace rainref::judge {

namespace fs = std::filesystem;
using capture::Array;
using capture::PassCase;

namespace {

/// Copies the array without its values.
Array shape_of(Array array) {
  for (capture::Bytes& level : array.levels) level = {};
  return array;
}

std::string stem_of(const std::string& path) { return path.ends_with(".npy") ? path.substr(0, path.size() - 4) : path; }

bool is_unorm(const Array& a) {
  return !a.is_records && (info(a.format).kind == FormatInfo::unorm8 || info(a.format).kind == FormatInfo::srgb8);
}

/// Parses "0012.3" or "0012.3.L1"; returns false for anything else.
bool parse_run(const std::string& name, DumpedRun& run) {
  std::size_t at = 0;
  const auto number = [&](std::size_t least, int& out) {
    const std::size_t begin = at;
    while (at < name.size() && std::isdigit(static_cast<unsigned char>(name[at])) && at - begin < 9) ++at;
    if (at - begin < least) return false;
    out = whole_from<int>(std::string_view(name).substr(begin, at - begin)).value_or(0);
    return true;
  };
  if (!number(4, run.frame) || at >= name.size() || name[at++] != '.' || !number(1, run.step)) return false;
  if (at == name.size()) return true;
  if (name.compare(at, 2, ".L") != 0) return false;
  at += 2;
  return number(1, run.level) && at == name.size();
}

std::string run_name(const DumpedRun& r) {
  return r.level < 0 ? fmt::format("{:04}.{}", r.frame, r.step) : fmt::format("{:04}.{}.L{}", r.frame, r.step, r.level);
}

}  // namespace

std::string content_hash(const Array& array) {
  Hasher hasher(0);
  for (std::size_t level = 0; level < array.levels.size(); ++level)
    hasher.add(file_hash(capture::npy_bytes(array, static_cast<int>(level))).text());
  return hasher.finish().text();
}

Array level_of(const Array& array, int level) {
  Array one = array;
  one.width = array.level_width(level);
  one.height = array.level_height(level);
  one.levels = {array.levels[static_cast<std::size_t>(level)]};
  return one;
}

ShadowPlan ShadowPlan::of_manifest(const capture::Pack& pack, bool shares_files) {
  check_pack(pack);
  if (!pack.reference.empty())
    throw Error(ExitCode::usage, fmt::format("{}: a pack that brings its own reference judges ports by --port", path_text(pack.folder())));
  ShadowPlan plan;
  plan.effect = pack.effect;
  plan.variant = pack.variant;
  plan.scene = pack.scene;
  plan.passes = pack.passes;
  plan.edges = pack.edges;
  for (const capture::PackCase& from : pack.cases) {
    PlannedRun& run = plan.runs.emplace_back();
    run.c = pack.described(from);
    if (shares_files) run.uniform_file = from.uniforms.path;
    for (const capture::PackInput& input : from.inputs) {
      Hasher hasher(0);
      for (const capture::PackFileEntry& level : input.levels) hasher.add(level.xxh3);
      run.input_hashes.push_back(hasher.finish().text());
      std::vector<std::string>& stems = run.input_stems.emplace_back();
      for (const capture::PackFileEntry& level : input.levels)
        if (shares_files) stems.push_back(stem_of(level.path));
    }
    plan.frames.insert(run.c.frame);
  }
  return plan;
}

ShadowPlan ShadowPlan::of_effect(const capture::EffectInfo& effect, const std::string& variant, const std::string& scene) {
  ShadowPlan plan;
  plan.effect = effect.name;
  plan.variant = variant;
  plan.scene = scene;
  plan.from_scene = true;
  for (const capture::PassInfo& pass : effect.passes) {
    const capture::PassVariant* own = pass.variant(variant);
    if (!own) continue;
    capture::PackPass& to = plan.passes.emplace_back();
    to.name = pass.name;
    to.formula = formula(effect, pass, *own);
    to.sentence = pass.sentence;
    to.writes = effect.writes(pass, variant);
    to.block = pass.block(variant);
    for (const capture::ReadInfo& read : pass.reads) {
      if (!read.variant.empty() && read.variant != variant) continue;
      to.reads.push_back(read.buffer);
      plan.edges.push_back({pass.name, read.buffer, read.from.empty() ? "host" : read.from, read.previous});
    }
  }
  return plan;
}

void ShadowPlan::add(const PassCase& from, const capture::EffectInfo& info_of_effect) {
  PlannedRun& run = runs.emplace_back();
  run.c = from;
  frames.insert(from.frame);
  for (capture::CaseInput& input : run.c.inputs) {
    run.input_hashes.push_back(content_hash(input.array));
    run.input_stems.emplace_back();
    if (is_given(run, input.name)) given.try_emplace(run.input_hashes.back(), input.array);
    input.array = shape_of(std::move(input.array));
  }
  for (capture::CaseOutput& output : run.c.outputs) {
    output.array = shape_of(std::move(output.array));
    const capture::BufferInfo& buffer = info_of_effect.buffer(output.name, variant);
    output.range = is_unorm(output.array) ? std::array<double, 2>{0, 1} : buffer.range;
    output.unit = buffer.unit;
    output.color_space = buffer.colour_space;
  }
}

void ShadowPlan::take_files(const ShadowPlan& manifest) {
  if (manifest.effect != effect || manifest.variant != variant) {
    throw Error(ExitCode::usage, fmt::format("the scene is {} {}, the manifest beside the dumps is of {} {}", effect, variant,
                                             manifest.effect, manifest.variant));
  }
  for (PlannedRun& run : runs) {
    const PlannedRun* other = manifest.find(run.c.folder());
    if (!other) continue;
    run.uniform_file = other->uniform_file;
    for (std::size_t i = 0; i < run.c.inputs.size(); ++i)
      for (std::size_t k = 0; k < other->c.inputs.size(); ++k)
        if (other->c.inputs[k].name == run.c.inputs[i].name) run.input_stems[i] = other->input_stems[k];
  }
}

const PlannedRun* ShadowPlan::find(std::string_view id) const {
  const auto found = std::find_if(runs.begin(), runs.end(), [&](const PlannedRun& r) { return r.c.folder() == id; });
  return found == runs.end() ? nullptr : &*found;
}
const PlannedRun* ShadowPlan::example(std::string_view pass) const {
  const auto found = std::find_if(runs.begin(), runs.end(), [&](const PlannedRun& r) { return r.c.pass == pass; });
  return found == runs.end() ? nullptr : &*found;
}
const capture::PackEdge* ShadowPlan::edge(std::string_view pass, std::string_view input) const {
  const auto found =
      std::find_if(edges.begin(), edges.end(), [&](const capture::PackEdge& e) { return e.pass == pass && e.input == input; });
  return found == edges.end() ? nullptr : &*found;
}

bool ShadowPlan::is_given(const PlannedRun& run, std::string_view input) const {
  const capture::PackEdge* e = edge(run.c.pass, input);
  return !e || e->from == "host" || (run.c.frame == 0 && !source(run, input));
}

const PlannedRun* ShadowPlan::source(const PlannedRun& run, std::string_view input, int level) const {
  const capture::PackEdge* e = edge(run.c.pass, input);
  if (!e || e->from == "host") return nullptr;
  const auto place = [&](std::string_view pass) {
    return std::find_if(passes.begin(), passes.end(), [&](const capture::PackPass& p) { return p.name == pass; }) - passes.begin();
  };
  // If a pass has already run in this step, "previous" means the run before that one.
  int to_skip = e->previous && place(e->from) < place(run.c.pass) ? 1 : 0;
  int frame = run.c.frame;
  for (const PlannedRun* r = &run; r != runs.data();) {
    --r;
    for (; frame > r->c.frame; --frame)
      if (!frames.contains(frame)) return nullptr;
    if (!frames.contains(frame)) return nullptr;
    if (r->c.pass != e->from || to_skip-- > 0) continue;
    // The last run of a pass by mip levels wrote the smallest; the runs before it wrote the others.
    const capture::CaseInput* taken = run.c.input(input);
    for (const int wanted = taken && taken->array.levels.size() > 1 && r->c.level >= 0 ? level : r->c.level; r->c.level != wanted;) {
      if (r == runs.data() || (r - 1)->c.pass != r->c.pass || (r - 1)->c.frame != r->c.frame || (r - 1)->c.level != r->c.level - 1)
        return nullptr;
      --r;
    }
    return r;
  }
  return nullptr;
}

std::vector<DumpedRun> dumped_runs(const fs::path& folder, const std::string& effect, const std::vector<std::string>& passes) {
  std::vector<std::string> names;
  for (const std::string& pass : passes) names.push_back(fmt::format("{}.{}", effect, pass));
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = path_text(entry.path().filename());
    if (!entry.is_directory() || !name.starts_with(effect + ".") || std::find(names.begin(), names.end(), name) != names.end()) continue;
    throw Error(ExitCode::port_files,
                fmt::format("'{}': no pass of this effect and variant{}", path_text(entry.path()), did_you_mean(name, names)));
  }
  if (error) throw Error(ExitCode::io, fmt::format("'{}': {}", path_text(folder), error.message()));
  std::vector<DumpedRun> out;
  for (std::size_t p = 0; p < passes.size(); ++p) {
    const std::size_t first = out.size();
    if (!fs::is_directory(folder / utf8_path(names[p]), error)) continue;
    for (const auto& entry : fs::directory_iterator(folder / utf8_path(names[p]))) {
      DumpedRun run;
      const std::string name = path_text(entry.path().filename());
      if (!entry.is_directory()) continue;
      if (!parse_run(name, run) || name != run_name(run))
        throw Error(ExitCode::port_files,
                    fmt::format("'{}': expected <frame>.<step> with four digits or more, such as 0012.0", path_text(entry.path())));
      run.pass = passes[p];
      run.id = fmt::format("{}/{}", names[p], name);
      out.push_back(run);
    }
    std::sort(out.begin() + static_cast<std::ptrdiff_t>(first), out.end(), [](const DumpedRun& a, const DumpedRun& b) {
      return std::tie(a.frame, a.step, a.level) < std::tie(b.frame, b.step, b.level);
    });
  }
  return out;
}

}  // namespace rainref::judge
