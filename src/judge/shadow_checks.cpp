#include "judge/shadow_checks.h"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "capture/difference.h"
#include "judge/host_values.h"
#include "judge/rearrange.h"

namespace rainref::judge {

using capture::Array;

const std::string& DumpedContents::hash(const std::string& buffer) const {
  static const std::string none;
  const auto found = hashes_.find(buffer);
  return found == hashes_.end() ? none : found->second;
}

std::vector<std::string> DumpedContents::with(const std::string& hash) const {
  std::vector<std::string> out;
  for (const auto& [buffer, own] : hashes_)
    if (own == hash) out.push_back(buffer);
  return out;
}

namespace {

/// Splits a buffer's name into its run and its name with "in." or "out.".
std::pair<std::string, std::string> parts_of(const std::string& buffer) {
  const std::size_t slash = buffer.rfind('/');
  return {buffer.substr(0, slash), buffer.substr(slash + 1)};
}
std::string pass_of(const std::string& buffer) { return buffer.substr(0, buffer.find('/')); }

/// Describes a wrong input by the buffers that equal it.
std::string origin_text(const std::string& input, const std::string& output, const std::vector<std::string>& equal) {
  const auto [output_run, output_name] = parts_of(output);
  const std::string before = output_run + "/" + parts_of(input).second;
  std::string earlier, later, other;
  for (const std::string& b : equal) {
    if (b == before) return fmt::format("it is {}, the state before that run: a missing swap or a stale frame", b);
    if (!parts_of(b).second.starts_with("out.")) continue;
    if (pass_of(b) != pass_of(output) || parts_of(b).second != output_name)
      other = b;
    else if (b < output)
      earlier = b;  // the latest of them: names sort by frame and step
    else if (later.empty())
      later = b;
  }
  if (!earlier.empty()) return fmt::format("it is {}: a stale frame", earlier);
  if (!later.empty()) return fmt::format("it is {}: of a later run", later);
  if (!other.empty()) return fmt::format("it is {}: another buffer is bound", other);
  return "";
}

}  // namespace

std::string broken_link(const std::string& input, const std::string& output, const DumpedContents& contents,
                        const std::function<Array(const std::string&)>& read) {
  const std::string head = fmt::format("input {} is not the previous output {}; ", input, output);
  if (std::string text = origin_text(input, output, contents.with(contents.hash(input))); !text.empty()) return head + text;
  const Array found = read(input), expected = read(output);
  if (!capture::same_shape(found, expected))
    return head + fmt::format("it has {}, not {}", capture::shape_text(found), capture::shape_text(expected));
  if (!expected.is_records) {
    struct Change {
      int channels;
      const char* text;
      void (*apply)(Array&);
    };
    constexpr Change changes[] = {{2, "with its first two channels swapped: ping-pong order", [](Array& a) { swap_channels(a, 0, 1); }},
                                  {3, "with red and blue swapped", [](Array& a) { swap_channels(a, 0, 2); }},
                                  {1, "upside down", flip_rows},
                                  {1, "mirrored left to right", flip_columns},
                                  {1, "moved by a column", [](Array& a) { shift(a, 1, 0); }},
                                  {1, "moved by a column", [](Array& a) { shift(a, -1, 0); }},
                                  {1, "moved by a row", [](Array& a) { shift(a, 0, 1); }},
                                  {1, "moved by a row", [](Array& a) { shift(a, 0, -1); }}};
    for (const Change& change : changes) {
      if (info(expected.format).channels < change.channels) continue;
      Array changed = expected;
      change.apply(changed);
      if (changed.levels == found.levels) return head + fmt::format("it is that output {}", change.text);
    }
  }
  const auto difference = capture::first_difference(expected, found);
  return head + fmt::format("{} of {} values differ, first at {}: output {}, input {}: a pass between them that the graph does not name?",
                            difference->count, difference->of, difference->place, difference->a, difference->b);
}

void Tally::add(const std::string& subject, const std::string& example) {
  auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.subject == subject; });
  if (found == entries_.end()) found = entries_.insert(entries_.end(), {subject, example});
  ++found->count;
}
std::vector<std::string> Tally::lines() const {
  std::vector<std::string> out;
  for (const Entry& e : entries_)
    out.push_back(fmt::format("{} in {} run{}, first {}", e.subject, e.count, e.count == 1 ? "" : "s", e.first));
  return out;
}

namespace {

using Member = scene::Member;

std::string text_of(const Member& m, const std::vector<std::byte>& block) {
  std::string out;
  for (int k = 0; k < m.components; ++k)
    out +=
        fmt::format("{}{}", k == 0 ? "" : ", ", capture::scalar_text(block.data() + m.offset + 4 * static_cast<std::size_t>(k), m.scalar));
  return out;
}
bool same(const Member& m, const std::vector<std::byte>& a, const std::vector<std::byte>& b) {
  return std::memcmp(a.data() + m.offset, b.data() + m.offset, m.size()) == 0;
}

/// True if the member is the frame's time in every run of the pass.
bool is_time(const ShadowPlan& plan, const std::string& pass, const Member& m) {
  if (m.scalar != scene::Scalar::float32 || m.components != 1) return false;
  bool some = false;
  for (const PlannedRun& r : plan.runs) {
    if (r.c.pass != pass) continue;
    if (std::memcmp(r.c.uniforms.data() + m.offset, &r.c.time, sizeof r.c.time) != 0) return false;
    some |= r.c.time != 0;
  }
  return some;
}
/// The run of the pass in which the member has this value, or null.
const PlannedRun* run_with(const ShadowPlan& plan, const std::string& pass, const Member& m, const std::vector<std::byte>& uniforms) {
  for (const PlannedRun& r : plan.runs)
    if (r.c.pass == pass && same(m, r.c.uniforms, uniforms)) return &r;
  return nullptr;
}

/// True if a count is the length of an input list of the run: "drop_count" and the records of drops.
bool counts_own_list(const capture::PassCase& taken, const Member& m) {
  constexpr std::string_view ending = "_count";
  if (m.scalar == scene::Scalar::float32 || m.components != 1 || !m.name.ends_with(ending)) return false;
  const capture::CaseInput* list = taken.input(m.name.substr(0, m.name.size() - ending.size()) + "s");
  std::uint32_t count;
  std::memcpy(&count, taken.uniforms.data() + m.offset, 4);
  return list && list->array.is_records && count == static_cast<std::uint32_t>(list->array.width);
}

constexpr const char* remedy = "; a host that chooses otherwise: --foreign-host";

}  // namespace

bool HostRules::hangs_on_state(std::string_view name) const {
  return evaluations && std::find(evaluations->of_state.begin(), evaluations->of_state.end(), name) != evaluations->of_state.end();
}

std::string check_uniforms(const ShadowPlan& plan, const PlannedRun& run, const capture::PassCase& taken, const HostRules& rules,
                           HostNotes& notes) {
  const std::string& pass = run.c.pass;
  const std::vector<std::byte>& uniforms = taken.uniforms;
  const auto declared = std::find_if(plan.passes.begin(), plan.passes.end(), [&](const capture::PackPass& p) { return p.name == pass; });
  std::string why;
  for (const Member& m : declared->block.members) {
    if (m.name.starts_with("padding")) continue;
    const Likeness like = compare_member(m, run.c.uniforms.data(), uniforms.data());
    if (like == Likeness::same || counts_own_list(taken, m)) continue;
    const std::string values = fmt::format("{}, expected {}", text_of(m, uniforms), text_of(m, run.c.uniforms));
    const auto note = [&](Tally& tally, const char* what) {
      tally.add(fmt::format("uniform {} of {} {} {}'s", m.name, pass, what, plan.source_word()),
                fmt::format("{}: {}", run.c.folder(), values));
    };
    if (rules.hangs_on_state(m.name)) {
      if (!rules.evaluations->doubt) note(notes.of_state, "hangs on the port's own state and is not");
      continue;
    }
    const PlannedRun* other = run_with(plan, pass, m, uniforms);
    const bool is_of_another = other && (m.scalar != scene::Scalar::float32 || is_time(plan, pass, m));
    if (!is_of_another && like == Likeness::rounded) {
      note(notes.rounded, "differs by rounding from");
    } else if (!is_of_another && !is_time(plan, pass, m) && rules.is_foreign) {
      note(notes.foreign, "is not");
    } else if (why.empty()) {
      why = fmt::format("uniform {} is {}", m.name, values) + (other && is_of_another ? fmt::format(": it is that of {}", other->c.folder())
                                                               : is_time(plan, pass, m) ? ""
                                                                                        : remedy);
    }
  }
  return why;
}

std::string check_given(const ShadowPlan& plan, const PlannedRun& run, std::size_t i, const Array& given, const std::string& hash,
                        const HostRules& rules, HostNotes& notes) {
  const std::string &name = run.c.inputs[i].name, &expected_hash = run.input_hashes[i];
  if (hash == expected_hash || rules.hangs_on_state(name)) return "";
  const capture::PackEdge* edge = plan.edge(run.c.pass, name);
  const bool is_state = edge && edge->from != "host";
  const auto known = plan.given.find(expected_hash);
  const Likeness like = known == plan.given.end() ? Likeness::other : compare_arrays(known->second, given);
  if (like == Likeness::same) return "";
  const auto note = [&](Tally& tally, const char* what) {
    tally.add(fmt::format("input {} of {} {} {}'s", name, run.c.pass, what, plan.source_word()), run.c.folder());
  };
  if (like == Likeness::rounded) {
    note(notes.rounded, "differs by rounding from");
    return "";
  }
  if (rules.is_foreign) {
    note(notes.foreign, "is not");
    return "";
  }
  std::string out =
      fmt::format("input {}/in.{} is not {}", run.c.folder(), name,
                  is_state ? fmt::format("the state that {} begins with", plan.source_word()) : fmt::format("{}'s", plan.source_word()));
  if (known == plan.given.end()) {
    out += ": of its values the manifest has the hash alone";
  } else if (!capture::same_shape(known->second, given)) {
    out += fmt::format(": it has {}, not {}", capture::shape_text(given), capture::shape_text(known->second));
  } else if (const auto d = capture::first_difference(known->second, given)) {
    out += fmt::format(": {} of {} values differ, first at {}: expected {}, found {}", d->count, d->of, d->place, d->a, d->b);
  }
  return out + remedy;
}

}  // namespace rainref::judge
