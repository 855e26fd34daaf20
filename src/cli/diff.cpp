// `rainref diff`.
#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "capture/difference.h"
#include "capture/pack_read.h"
#include "cli/commands.h"
#include "cli/progress.h"
#include "cli/terminal.h"
#include "judge/check_pack.h"
#include "registry/registry.h"
#include "rainref/error.h"

namespace rainref::cli {
namespace {

using capture::Pack;
using capture::PackCase;

constexpr std::size_t most_listed = 10;

// Differences besides the values of common buffers.
struct Findings {
  std::vector<std::string> lines;
  void add(std::string line) { lines.push_back(std::move(line)); }
  void print() const {
    for (std::size_t i = 0; i < std::min(lines.size(), most_listed); ++i) say("{}\n", lines[i]);
    if (lines.size() > most_listed) say("... and {} more\n", lines.size() - most_listed);
  }
};

std::string run_text(const PackCase& c) {
  std::string text = fmt::format("frame {}, pass {}, step {}", c.frame, c.pass, c.step);
  return c.level < 0 ? text : fmt::format("{}, level {}", text, c.level);
}

std::string difference_text(const std::string& where, const std::string& a, const std::string& b) {
  return fmt::format("first difference: {}\n  A  {}\n  B  {}\n", where, a, b);
}

// The first difference of two arrays of one name, or "".
std::string difference(const std::string& where, const capture::Array& a, const capture::Array& b) {
  if (!capture::same_shape(a, b)) return difference_text(where, capture::shape_text(a), capture::shape_text(b));
  const auto found = capture::first_difference(a, b);
  if (!found) return "";
  return difference_text(fmt::format("{} ({}), {}", where, capture::shape_text(a), found->place), found->a, found->b) +
         fmt::format("  {} of {} elements of this buffer differ\n", found->count, found->of);
}

std::string difference(const std::string& where, const scene::UniformBlock& block, const std::vector<std::byte>& a,
                       const std::vector<std::byte>& b) {
  if (a.size() != b.size())
    return difference_text(fmt::format("{}, {}", where, block.name), fmt::format("{} bytes", a.size()), fmt::format("{} bytes", b.size()));
  for (const scene::Member& m : scene::with_padding(block)) {
    for (std::size_t at = m.offset; at < m.offset + m.size(); at += 4) {
      if (std::equal(&a[at], &a[at] + 4, &b[at])) continue;
      const std::string index = m.components == 1 ? "" : fmt::format("[{}]", (at - m.offset) / 4);
      return difference_text(fmt::format("{}, uniform {}{} of {}", where, m.name, index, block.name),
                             capture::scalar_text(&a[at], m.scalar), capture::scalar_text(&b[at], m.scalar));
    }
  }
  return "";
}

/// Compares the common runs, in the order of A, up to the first different value.
class Comparison {
 public:
  Comparison(const Pack& a, const Pack& b) : a_(a), b_(b), both_inputs_(a.with_inputs && b.with_inputs) {
    for (const PackCase& c : b.cases) in_b_[c.id] = &c;
  }

  /// The text about it, or "".
  std::string first_difference() {
    std::map<std::string, bool> in_a;
    Progress progress("diff", static_cast<int>(a_.cases.size()));
    std::string found;
    for (const PackCase& c : a_.cases) {
      in_a[c.id] = true;
      const auto other = in_b_.find(c.id);
      if (other == in_b_.end())
        findings.add(fmt::format("only in A: {}", run_text(c)));
      else if (found.empty())
        found = difference_of(c, *other->second);
      progress.advance();
    }
    for (const PackCase& c : b_.cases) {
      if (!in_a.contains(c.id)) findings.add(fmt::format("only in B: {}", run_text(c)));
    }
    return found;
  }

  Findings findings;
  int runs = 0, buffers = 0;

 private:
  std::string difference_of(const PackCase& entry_a, const PackCase& entry_b) {
    const capture::PassCase a = a_.read(entry_a), b = b_.read(entry_b);
    const std::string where = run_text(entry_a);
    ++runs;
    std::string found;
    if (both_inputs_) found = difference_of_all(a.inputs, b.inputs, where, "input");
    if (found.empty()) found = difference(where, a_.pass(a.pass).block, a.uniforms, b.uniforms);
    if (found.empty()) found = difference_of_all(a.outputs, b.outputs, where, "output");
    return found;
  }

  // A missing buffer is a finding, but the first different value is more useful.
  template <class All>
  std::string difference_of_all(const All& a, const All& b, const std::string& where, const char* kind) {
    const auto find = [](const All& all, const std::string& name) {
      return std::find_if(all.begin(), all.end(), [&](const auto& x) { return x.name == name; });
    };
    for (const auto& y : b) {
      if (find(a, y.name) == a.end()) findings.add(fmt::format("only in B: {}, {} {}", where, kind, y.name));
    }
    for (const auto& x : a) {
      const auto y = find(b, x.name);
      if (y == b.end()) {
        findings.add(fmt::format("only in A: {}, {} {}", where, kind, x.name));
        continue;
      }
      ++buffers;
      std::string found = difference(fmt::format("{}, {} {}", where, kind, x.name), x.array, y->array);
      if (!found.empty()) return found;
    }
    return "";
  }

  const Pack &a_, &b_;
  bool both_inputs_;
  std::map<std::string, const PackCase*> in_b_;
};

// Different keys of the configurations: they explain a difference, but are not one.
void print_configurations(const Pack& a, const Pack& b) {
  const std::map<std::string, std::string> in_a(a.config.begin(), a.config.end()), in_b(b.config.begin(), b.config.end());
  const auto value = [](const auto& all, const std::string& key) {
    const auto found = all.find(key);
    return found == all.end() ? std::string("absent") : found->second;
  };
  Findings notes;
  for (const auto& [key, text] : a.config) {
    if (value(in_b, key) != text) notes.add(fmt::format("configuration: {} is {} in A, {} in B", key, text, value(in_b, key)));
  }
  for (const auto& [key, text] : b.config) {
    if (!in_a.contains(key)) notes.add(fmt::format("configuration: {} is absent in A, {} in B", key, text));
  }
  if (a.golden_generation != b.golden_generation)
    notes.add(fmt::format("golden generation: {} in A, {} in B", a.golden_generation, b.golden_generation));
  if (a.golden_hash != b.golden_hash) {
    const auto hash = [](const Pack& pack) { return pack.golden_hash.empty() ? "absent" : pack.golden_hash; };
    notes.add(fmt::format("golden hash: {} in A, {} in B", hash(a), hash(b)));
  }
  notes.print();
}

}  // namespace

int diff(const std::filesystem::path& folder_a, const std::filesystem::path& folder_b) {
  const Pack a(folder_a), b(folder_b);
  for (const Pack* pack : {&a, &b})
    if (registry::find(pack->effect)) judge::check_pack(*pack);
  print_configurations(a, b);
  if (a.effect != b.effect || a.variant != b.variant) {
    say("different scenes: {} {} in A, {} {} in B\n", a.effect, a.variant, b.effect, b.variant);
    return static_cast<int>(ExitCode::fail);
  }
  Comparison comparison(a, b);
  const std::string found = comparison.first_difference();
  say("{}", found);
  comparison.findings.print();
  if (!found.empty() || !comparison.findings.lines.empty()) return static_cast<int>(ExitCode::fail);
  say("equal: {} of {}, {}\n", counted(static_cast<long long>(comparison.runs), "run"), comparison.runs == 1 ? "a pass" : "passes",
      counted(static_cast<long long>(comparison.buffers), "buffer"));
  return 0;
}

}  // namespace rainref::cli
