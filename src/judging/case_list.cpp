#include "judging/case_list.h"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "base/path_text.h"
#include "capture/capture_recorder.h"
#include "judge/check_pack.h"
#include "judge/shadow_plan.h"
#include "judging/given_image.h"
#include "rainref/error.h"
#include "registry/registry.h"

namespace rainref::judging {
namespace {

using capture::Array;

bool is_among(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Index of a name; Error(usage) with the nearest name.
template <class Things>
std::size_t index_of(const Things& things, std::string_view name, const std::string& id, const char* what) {
  std::vector<std::string> names;
  for (const auto& thing : things) {
    if (thing.name == name) return names.size();
    names.push_back(thing.name);
  }
  throw Error(ExitCode::usage, fmt::format("{} has no {} '{}'{}", id, what, name, did_you_mean(name, names)));
}

std::string place_of(const capture::CaseOutput& output, const std::string& id) { return fmt::format("{}/out.{}", id, output.name); }

/// Copies a port's rows to contiguous bytes.
Array given_array(const capture::CaseOutput& output, const std::string& id, const void* data, std::size_t row_bytes, std::size_t count) {
  Array array = output.array;
  const std::string place = place_of(output, id);
  const std::size_t own_row = array.is_records ? array.record.size : array.element_bytes() * static_cast<std::size_t>(array.width);
  if (array.is_records ? row_bytes != own_row : row_bytes < own_row)
    throw Error(ExitCode::usage, fmt::format("{}: expected {}{} bytes for each {}, found {}", place, array.is_records ? "" : "at least ",
                                             own_row, array.is_records ? "record" : "row", row_bytes));
  if (!array.is_records && count != static_cast<std::size_t>(array.height))
    throw Error(ExitCode::usage, fmt::format("{}: expected {} rows, found {}", place, array.height, count));
  constexpr std::size_t most_records = std::size_t{1} << 28;
  if (count > most_records)
    throw Error(ExitCode::usage, fmt::format("{}: expected at most {} records, found {}", place, most_records, count));
  if (count > 0 && !data) throw Error(ExitCode::usage, "data: expected an address, found NULL");
  std::vector<std::byte> bytes(own_row * count);
  for (std::size_t y = 0; y < count; ++y)
    std::memcpy(bytes.data() + y * own_row, static_cast<const std::byte*>(data) + y * row_bytes, own_row);
  if (array.is_records) array.width = static_cast<int>(count);
  array.levels.assign(1, std::move(bytes));
  return array;
}

}  // namespace

void require_index(std::size_t index, std::size_t count, const char* what) {
  if (index >= count) throw Error(ExitCode::usage, fmt::format("{} {}: expected one of {}, counted from 0", what, index, count));
}

bool Run::has_any() const {
  return std::any_of(given.begin(), given.end(), [](const auto& g) { return g != nullptr; });
}
const capture::CaseInput& Run::input(std::size_t index) const {
  require_index(index, c->inputs.size(), "input");
  return c->inputs[index];
}
std::size_t Run::input_index(std::string_view name) const { return index_of(c->inputs, name, id, "input"); }
const capture::CaseOutput& Run::output(std::size_t index) const {
  require_index(index, c->outputs.size(), "output");
  return c->outputs[index];
}
std::size_t Run::output_index(std::string_view name) const { return index_of(c->outputs, name, id, "output"); }

CaseList::CaseList(const Simulation& simulation) : effect_(simulation.effect()), variant_(name(simulation.variant())) {
  scene_ = effect_ + " " + variant_;
  judge::ShadowPlan plan = judge::ShadowPlan::of_effect(*registry::find(effect_)->info, variant_, effect_);
  passes_ = std::move(plan.passes);
  edges_ = std::move(plan.edges);
}

CaseList::CaseList(const std::filesystem::path& folder, const std::vector<std::string>& passes) {
  pack_ = std::make_shared<const capture::Pack>(folder);
  if (!pack_->with_inputs)
    throw Error(ExitCode::usage, fmt::format("{}: a capture without inputs cannot judge a port; make a pack", path_text(pack_->folder())));
  judge::check_pack(*pack_);
  effect_ = pack_->effect;
  variant_ = pack_->variant;
  scene_ = pack_->scene;
  passes_ = pack_->passes;
  edges_ = pack_->edges;
  const std::vector<std::string> names = wanted(passes);
  for (const capture::PackCase& entry : pack_->cases)
    if (is_among(names, entry.pass)) add(judge::read_case(*pack_, entry));
}

std::vector<std::string> CaseList::wanted(const std::vector<std::string>& passes) const {
  std::vector<std::string> known;
  for (const capture::PackPass& p : passes_) known.push_back(p.name);
  for (const std::string& name : passes) {
    if (!is_among(known, name))
      throw Error(ExitCode::usage, fmt::format("{} {} has no pass '{}'{}", effect_, variant_, name, did_you_mean(name, known)));
  }
  return passes.empty() ? known : passes;
}

void CaseList::add_next_frame(Simulation& simulation, const std::vector<std::string>& passes) {
  const std::string variant = name(simulation.variant());
  if (effect_ != simulation.effect() || variant_ != variant || pack_)
    throw Error(ExitCode::usage, fmt::format("cases: expected those of a simulation of {} {}, found those of {}{} {}", simulation.effect(),
                                             variant, pack_ ? "a pack of " : "", effect_, variant_));
  const std::vector<std::string> names = wanted(passes);
  std::vector<capture::PassCase> found;  // all of the frame, or none
  capture::CaptureRecorder recorder(
      *registry::find(effect_)->info, variant, true, [&](int, std::string_view pass) { return is_among(names, pass); },
      [&](capture::PassCase c) { found.push_back(std::move(c)); });
  simulation.next_frame(&recorder);
  for (capture::PassCase& c : found) {
    for (capture::CaseOutput& o : c.outputs) {
      const FormatInfo::Kind kind = info(o.array.format).kind;
      if (!o.array.is_records && (kind == FormatInfo::unorm8 || kind == FormatInfo::srgb8)) o.range = {0, 1};
    }
    add(std::move(c));
  }
}

void CaseList::give(std::size_t index, std::size_t output, const void* data, std::size_t row_bytes, std::size_t count) {
  const Run& to = run(index);
  runs_[index].given[output] = std::make_shared<const Array>(given_array(to.output(output), to.id, data, row_bytes, count));
  runs_[index].notes[output].clear();
}
void CaseList::give_image(std::size_t index, std::size_t output, port_dump::StoredImage image) {
  const Run& to = run(index);
  const capture::CaseOutput& like = to.output(output);
  image.file = place_of(like, to.id);
  if (like.array.is_records) throw Error(ExitCode::usage, image.file + ": expected records, found an image");
  port_dump::ReadNotes notes;
  Array array = like.array;
  array.levels.assign(1, canonical_image(image, like.array, notes));
  runs_[index].given[output] = std::make_shared<const Array>(std::move(array));
  runs_[index].notes[output] = std::move(notes.lines);
}

const Run& CaseList::run(std::size_t index) const {
  require_index(index, runs_.size(), "case");
  return runs_[index];
}
const capture::PackPass& CaseList::pass_of(const Run& run) const {
  return *std::find_if(passes_.begin(), passes_.end(), [&](const capture::PackPass& p) { return p.name == run.c->pass; });
}
void CaseList::add(capture::PassCase c) {
  const auto held = std::make_shared<const capture::PassCase>(std::move(c));
  Run run{held, held->folder(), ""};
  run.formula = pass_of(run).formula;
  run.given.resize(held->outputs.size());
  run.notes.resize(held->outputs.size());
  runs_.push_back(std::move(run));
}

}  // namespace rainref::judging
