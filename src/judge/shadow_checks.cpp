#include "judge/shadow_checks.h"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "capture/difference.h"
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

/// A buffer's run and its name with "in." or "out.".
std::pair<std::string, std::string> parts_of(const std::string& buffer) {
  const std::size_t slash = buffer.rfind('/');
  return {buffer.substr(0, slash), buffer.substr(slash + 1)};
}
std::string pass_of(const std::string& buffer) { return buffer.substr(0, buffer.find('/')); }

/// What a wrong input is, in words, from the buffers that equal it.
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
      earlier = b;  // the last of them: names sort by frame and step
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

/// Whether the member is the frame's time in every run of the pass.
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
/// The run of the pass whose value of the member this is, or null.
const PlannedRun* run_with(const ShadowPlan& plan, const std::string& pass, const Member& m, const std::vector<std::byte>& uniforms) {
  for (const PlannedRun& r : plan.runs)
    if (r.c.pass == pass && same(m, r.c.uniforms, uniforms)) return &r;
  return nullptr;
}

}  // namespace

std::string check_uniforms(const ShadowPlan& plan, const PlannedRun& run, const std::vector<std::byte>& uniforms, Tally& differing) {
  const std::string& pass = run.c.pass;
  const auto declared = std::find_if(plan.passes.begin(), plan.passes.end(), [&](const capture::PackPass& p) { return p.name == pass; });
  std::string why;
  for (const Member& m : declared->block.members) {
    if (m.name.starts_with("padding")) continue;
    const auto refuse = [&](const std::string& reason) {
      if (why.empty())
        why = fmt::format("uniform {} is {}, expected {}{}", m.name, text_of(m, uniforms), text_of(m, run.c.uniforms), reason);
    };
    if (same(m, run.c.uniforms, uniforms)) continue;
    const PlannedRun* other = run_with(plan, pass, m, uniforms);
    const bool counts = m.scalar != scene::Scalar::float32;
    if (is_time(plan, pass, m) || (counts && other)) {
      refuse(other ? fmt::format(": it is that of {}", other->c.folder()) : "");
    } else {
      differing.add(fmt::format("uniform {} of {} is not the {}", m.name, pass, plan.from_scene ? "scene's" : "manifest's"),
                    fmt::format("{}: {}, expected {}", run.c.folder(), text_of(m, uniforms), text_of(m, run.c.uniforms)));
    }
  }
  return why;
}

}  // namespace rainref::judge
