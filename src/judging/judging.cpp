#include "rainref/judging.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/floating_point.h"
#include "base/path_text.h"
#include "judge/profiles.h"
#include "judging/case_list.h"
#include "judging/judge_cases.h"
#include "judging/judge_folder.h"
#include "judging/make_pack.h"
#include "scene/toml.h"
#include "simulation/opened.h"

namespace rainref {
namespace {

Field::Type type_of(scene::Scalar scalar) {
  return scalar == scene::Scalar::float32 ? Field::float32 : scalar == scene::Scalar::int32 ? Field::int32 : Field::uint32;
}

CaseArray records(std::string name, const scene::UniformBlock& record, std::span<const std::byte> bytes) {
  CaseArray a;
  a.name = std::move(name);
  a.is_records = true;
  a.width = static_cast<int>(bytes.size() / record.size);
  a.element_bytes = record.size;
  a.record = record.name;
  for (const scene::Member& m : record.members) a.fields.push_back({m.name, m.unit, m.sentence, type_of(m.scalar), m.components, m.offset});
  a.bytes = bytes;
  return a;
}

CaseArray array_of(const std::string& name, const capture::Array& array, int level) {
  judging::require_index(static_cast<std::size_t>(level), array.levels.size(), "level");
  const std::span<const std::byte> bytes = array.levels[static_cast<std::size_t>(level)];
  if (array.is_records) return records(name, array.record, bytes);
  CaseArray a;
  a.name = name;
  a.format = array.format;
  a.width = array.level_width(level);
  a.height = array.level_height(level);
  a.levels = static_cast<int>(array.levels.size());
  a.element_bytes = array.element_bytes();
  a.bytes = bytes;
  return a;
}

}  // namespace

struct Cases::State {
  judging::CaseList list;
};
struct Judgement::State {
  judging::Judged judged;
};

Cases::Cases(const Simulation& simulation) {
  const FloatingPointGuard guard;
  state_ = std::make_unique<State>(State{judging::CaseList(simulation)});
}
Cases::Cases(const std::filesystem::path& pack, const std::vector<std::string>& passes) {
  const FloatingPointGuard guard;
  state_ = std::make_unique<State>(State{judging::CaseList(pack, passes)});
}
Cases::~Cases() = default;
Cases::Cases(Cases&&) noexcept = default;

void Cases::add_next_frame(Simulation& simulation, const std::vector<std::string>& passes) {
  const FloatingPointGuard guard;
  state_->list.add_next_frame(simulation, passes);
}

std::size_t Cases::size() const { return state_->list.runs().size(); }
CaseInfo Cases::info(std::size_t index) const {
  const FloatingPointGuard guard;
  const judging::Run& run = state_->list.run(index);
  const capture::PassCase& c = *run.c;
  CaseInfo about{run.id, c.effect, c.variant, c.pass, run.formula, c.frame, c.step, c.level, c.time, c.dt, {}, {}};
  for (const capture::CaseInput& i : c.inputs) about.inputs.push_back(i.name);
  for (const capture::CaseOutput& o : c.outputs) about.outputs.push_back(o.name);
  return about;
}
CaseArray Cases::uniforms(std::size_t index) const {
  const FloatingPointGuard guard;
  const judging::Run& run = state_->list.run(index);
  const scene::UniformBlock& block = state_->list.pass_of(run).block;
  return records(block.name, block, run.c->uniforms);
}
CaseArray Cases::input(std::size_t index, std::string_view name, int level) const {
  const FloatingPointGuard guard;
  const judging::Run& run = state_->list.run(index);
  const capture::CaseInput& from = run.input(run.input_index(name));
  return array_of(from.name, from.array, level);
}
CaseSampling Cases::sampling(std::size_t index, std::string_view input) const {
  const FloatingPointGuard guard;
  const judging::Run& run = state_->list.run(index);
  const capture::CaseInput& from = run.input(run.input_index(input));
  return {from.filter, from.mip_filter, from.address_u, from.address_v, from.border};
}
CaseArray Cases::expected(std::size_t index, std::string_view output) const {
  const FloatingPointGuard guard;
  const judging::Run& run = state_->list.run(index);
  const capture::CaseOutput& from = run.output(run.output_index(output));
  return array_of(from.name, from.array, 0);
}
void Cases::give(std::size_t index, std::string_view output, const void* data, std::size_t row_bytes, std::size_t count) {
  const FloatingPointGuard guard;
  state_->list.give(index, state_->list.run(index).output_index(output), data, row_bytes, count);
}

Judgement Cases::judge(const parallel::Executor& executor, const JudgeOptions& options) const {
  const FloatingPointGuard guard;
  return Judgement(std::make_unique<Judgement::State>(Judgement::State{judging::judge_cases(state_->list, options, executor)}));
}

Judgement::Judgement(std::unique_ptr<State> state) : state_(std::move(state)) {}
Judgement::~Judgement() = default;
Judgement::Judgement(Judgement&&) noexcept = default;

const Verdict& Judgement::verdict() const { return state_->judged.verdict; }
std::string Judgement::text() const {
  const FloatingPointGuard guard;
  return state_->judged.text();
}
std::string Judgement::json() const {
  const FloatingPointGuard guard;
  return state_->judged.json();
}
std::string Judgement::html() const {
  const FloatingPointGuard guard;
  return state_->judged.html();
}
std::string Judgement::junit() const {
  const FloatingPointGuard guard;
  return state_->judged.junit();
}

std::vector<std::string> profile_names() {
  const FloatingPointGuard guard;
  return judge::profile_names();
}

Judgement Judgement::of_folder(const std::filesystem::path& pack, const std::filesystem::path& port, const parallel::Executor& executor,
                               const FolderOptions& options) {
  const FloatingPointGuard guard;
  judging::FolderOptions how;
  how.profile = options.profile;
  how.only = options.passes;
  how.partial = options.partial;
  how.strict = options.strict;
  if (options.exhaustive) how.sample = 0;
  how.spirv = options.spirv;
  how.progress = options.progress;
  how.executor = &executor;
  return Judgement(std::make_unique<Judgement::State>(
      Judgement::State{judging::judge_folder(std::make_shared<const capture::Pack>(pack), {port}, how)}));
}

PackSummary write_pack(const SceneText& scene, const std::filesystem::path& folder, const parallel::Executor& executor,
                       const PackOptions& options) {
  const FloatingPointGuard guard;
  SceneText seeded = scene;
  if (!options.seed.empty()) seeded.set.push_back(fmt::format("seed={}", judging::seed_of(options.seed, "seed")));
  judging::PackRequest request{simulation::config_of_passes(scene::parse(seeded, simulation::effect_table())), scene.toml,
                               utf8_path(scene.file), folder};
  request.frames = options.frames.empty() ? judging::usual_frames : options.frames;
  request.may_add_frames = options.frames.empty();
  request.passes = options.passes;
  request.is_for_one_use = options.seed == "random";
  std::sort(request.frames.begin(), request.frames.end());
  if (request.frames.front() < 0) throw Error(ExitCode::usage, fmt::format("frames: expected 0 or more, found {}", request.frames.front()));
  PackSummary made;
  const auto note = [&](const std::string& line) { made.notes.push_back(line); };
  const auto warn = [&](const effect::Inputs& inputs) {
    for (const std::string& warning : inputs.warnings) note("warning: " + warning);
  };
  const auto advance = [&](int done, int of) {
    if (options.progress) options.progress(done, of);
  };
  const judging::WrittenPack written = judging::make_pack(request, executor, {warn, note, advance});
  made.seed = request.config.integer("seed");
  made.cases = written.total.cases;
  made.passes = written.passes;
  return made;
}

}  // namespace rainref
