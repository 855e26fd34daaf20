// Cases of passes: recorded from a scene that runs, or read from a pack; what they hold, and what a port gives for them.
#include <algorithm>
#include <cstring>

#include "c_library/arrays.h"
#include "c_library/call.h"
#include "c_library/handles.h"
#include "capture/capture_recorder.h"
#include "judge/check_pack.h"
#include "judge/shadow_plan.h"
#include "judge/slots.h"
#include "registry/registry.h"

using namespace rainref;
using c_library::call;
using c_library::require_index;
using c_library::required;
using c_library::Run;
using c_library::sized;
using capture::Array;

bool Run::has_any() const {
  return std::any_of(given.begin(), given.end(), [](const auto& g) { return g != nullptr; });
}
bool Run::has_all() const {
  for (std::size_t o = 0; o < given.size(); ++o)
    if (!given[o] && c->outputs[o].judge != capture::Judge::input_only) return false;
  return true;
}

const capture::PackPass* rr_cases::pass(const std::string& name) const {
  const auto found = std::find_if(passes.begin(), passes.end(), [&](const capture::PackPass& p) { return p.name == name; });
  return found == passes.end() ? nullptr : &*found;
}
void rr_cases::add(capture::PassCase c) {
  const auto held = std::make_shared<const capture::PassCase>(std::move(c));
  runs.push_back({held, held->folder(), pass(held->pass)->formula});
  runs.back().given.resize(held->outputs.size());
}

namespace {

/// Names that are asked for; Error(usage) for one that is no pass of these cases.
std::vector<std::string> wanted_passes(const rr_cases& cases, const char* const* passes, size_t count) {
  std::vector<std::string> known, wanted = c_library::texts(passes, count, "passes");
  for (const capture::PackPass& p : cases.passes) known.push_back(p.name);
  for (const std::string& name : wanted) {
    if (!cases.pass(name))
      throw Error(ExitCode::usage, fmt::format("{} {} has no pass '{}'{}", cases.effect, cases.variant, name, did_you_mean(name, known)));
  }
  return wanted.empty() ? known : wanted;
}
bool is_among(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

const Run& run_of(const rr_cases* cases, size_t index) {
  const rr_cases& c = required(cases, "cases");
  require_index(index, c.runs.size(), "case");
  return c.runs[index];
}
const capture::CaseInput& input_of(const Run& run, size_t input) {
  require_index(input, run.c->inputs.size(), "input");
  return run.c->inputs[input];
}
const capture::CaseOutput& output_of(const Run& run, size_t output) {
  require_index(output, run.c->outputs.size(), "output");
  return run.c->outputs[output];
}

/// The bytes of a port's rows, one behind the other.
Array given_array(const capture::CaseOutput& output, const std::string& id, const void* data, size_t row_bytes, size_t count) {
  Array array = output.array;
  const std::string place = fmt::format("{}/out.{}", id, output.name);
  const std::size_t own_row = array.is_records ? array.record.size : array.element_bytes() * static_cast<std::size_t>(array.width);
  if (array.is_records ? row_bytes != own_row : row_bytes < own_row)
    throw Error(ExitCode::usage, fmt::format("{}: expected {}{} bytes for each {}, found {}", place, array.is_records ? "" : "at least ",
                                             own_row, array.is_records ? "record" : "row", row_bytes));
  const auto expected = static_cast<std::size_t>(array.is_records ? array.width : array.height);
  if (array.is_records ? judge::is_placed(output) && count != expected : count != expected)
    throw Error(ExitCode::usage,
                fmt::format("{}: expected {} {}, found {}", place, expected, array.is_records ? "records" : "rows", count));
  constexpr std::size_t most_records = std::size_t{1} << 28;
  if (count > most_records)
    throw Error(ExitCode::usage, fmt::format("{}: expected at most {} records, found {}", place, most_records, count));
  if (count > 0) required(static_cast<const std::byte*>(data), "data");
  std::vector<std::byte> bytes(own_row * count);
  for (std::size_t y = 0; y < count; ++y)
    std::memcpy(bytes.data() + y * own_row, static_cast<const std::byte*>(data) + y * row_bytes, own_row);
  if (array.is_records) array.width = static_cast<int>(count);
  array.levels.assign(1, std::move(bytes));
  return array;
}

}  // namespace

int rr_cases_of_simulation(rr_simulation* simulation, rr_cases** cases) {
  return call([&] {
    const rr_simulation& s = required(simulation, "simulation");
    required(cases, "cases") = nullptr;
    const std::string variant = name(s.running.variant());
    judge::ShadowPlan plan = judge::ShadowPlan::of_effect(*registry::find(s.running.effect())->info, variant, s.running.effect());
    *cases = new rr_cases{plan.effect, variant, s.running.effect() + " " + variant, std::move(plan.passes), std::move(plan.edges)};
  });
}

int rr_next_frame_cases(rr_simulation* simulation, const char* const* passes, size_t pass_count, rr_cases* cases) {
  return call([&] {
    rr_simulation& s = required(simulation, "simulation");
    rr_cases& to = required(cases, "cases");
    const std::string variant = name(s.running.variant());
    if (to.effect != s.running.effect() || to.variant != variant || to.pack)
      throw Error(ExitCode::usage, fmt::format("cases: expected those of a simulation of {} {}, found those of {} {}{}", s.running.effect(),
                                               variant, to.pack ? "a pack of " : "", to.effect, to.variant));
    const std::vector<std::string> wanted = wanted_passes(to, passes, pass_count);
    std::vector<capture::PassCase> found;  // all of the frame or none
    capture::CaptureRecorder recorder(
        *registry::find(to.effect)->info, variant, true, [&](int, std::string_view pass) { return is_among(wanted, pass); },
        [&](capture::PassCase c) { found.push_back(std::move(c)); });
    s.running.next_frame(&recorder);
    for (capture::PassCase& c : found) {
      for (capture::CaseOutput& o : c.outputs) {
        const FormatInfo::Kind kind = info(o.array.format).kind;
        if (!o.array.is_records && (kind == FormatInfo::unorm8 || kind == FormatInfo::srgb8)) o.range = {0, 1};
      }
      to.add(std::move(c));
    }
  });
}

int rr_cases_of_pack(const char* folder, const char* const* passes, size_t pass_count, rr_cases** cases) {
  return call([&] {
    required(cases, "cases") = nullptr;
    const auto pack = std::make_shared<const capture::Pack>(&required(folder, "folder"));
    if (!pack->with_inputs)
      throw Error(ExitCode::usage, fmt::format("{}: a capture without inputs cannot judge a port; make a pack", pack->folder().string()));
    judge::check_pack(*pack);
    auto made = std::make_unique<rr_cases>(rr_cases{pack->effect, pack->variant, pack->scene, pack->passes, pack->edges, pack});
    const std::vector<std::string> wanted = wanted_passes(*made, passes, pass_count);
    for (const capture::PackCase& entry : pack->cases)
      if (is_among(wanted, entry.pass)) made->add(judge::read_case(*pack, entry));
    *cases = made.release();
  });
}

void rr_free_cases(rr_cases* cases) {
  call([&] { delete cases; });
}
size_t rr_case_count(const rr_cases* cases) { return cases ? cases->runs.size() : 0; }

int rr_get_case(const rr_cases* cases, size_t index, rr_case_info* info) {
  return call([&] {
    const Run& run = run_of(cases, index);
    const capture::PassCase& c = *run.c;
    sized(info, "rr_case_info") = {sizeof(rr_case_info),
                                   run.id.c_str(),
                                   c.effect.c_str(),
                                   c.variant.c_str(),
                                   c.pass.c_str(),
                                   run.formula.c_str(),
                                   c.frame,
                                   c.step,
                                   c.level,
                                   c.time,
                                   c.dt,
                                   c.inputs.size(),
                                   c.outputs.size()};
  });
}
int rr_get_uniforms(const rr_cases* cases, size_t index, rr_array* block) {
  return call([&] {
    const Run& run = run_of(cases, index);
    sized(block, "rr_array") = c_library::array_of(cases->pass(run.c->pass)->block, run.c->uniforms.data());
  });
}
int rr_get_input(const rr_cases* cases, size_t index, size_t input, int32_t level, rr_array* array) {
  return call([&] {
    const capture::CaseInput& from = input_of(run_of(cases, index), input);
    sized(array, "rr_array") = c_library::array_of(from.name.c_str(), from.array, level);
  });
}
int rr_get_sampling(const rr_cases* cases, size_t index, size_t input, rr_sampling* sampling) {
  return call([&] {
    const capture::CaseInput& from = input_of(run_of(cases, index), input);
    rr_sampling& to = sized(sampling, "rr_sampling");
    to = {sizeof to, name(from.filter), name(from.mip_filter), name(from.address_u), name(from.address_v), {}};
    std::copy(from.border.begin(), from.border.end(), to.border);
  });
}
int rr_get_expected(const rr_cases* cases, size_t index, size_t output, rr_array* array) {
  return call([&] {
    const capture::CaseOutput& from = output_of(run_of(cases, index), output);
    sized(array, "rr_array") = c_library::array_of(from.name.c_str(), from.array, 0);
  });
}
const char* rr_get_judge(const rr_cases* cases, size_t index, size_t output) {
  const char* how = nullptr;
  call([&] { how = capture::name(output_of(run_of(cases, index), output).judge); });
  return how;
}

int rr_give(rr_cases* cases, size_t index, size_t output, const void* data, size_t row_bytes, size_t count) {
  return call([&] {
    const Run& run = run_of(cases, index);
    const capture::CaseOutput& to = output_of(run, output);
    cases->runs[index].given[output] = std::make_shared<const Array>(given_array(to, run.id, data, row_bytes, count));
  });
}
