// The lines of a port's shader that a cause refers to.
#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "faults/diagnose.h"
#include "faults/replay.h"

namespace rainref::faults {

using judge::Cause;

namespace {
constexpr std::size_t most_lines = 3;
/// Adds a line of the port's shader to those of a cause.
void add_line(Cause& to, const Replay& run, const FoundLine& found) {
  if (const std::optional<judge::ShaderLine> line = run.line(found);
      line && to.lines.size() < most_lines && std::find(to.lines.begin(), to.lines.end(), *line) == to.lines.end())
    to.lines.push_back(*line);
}
/// Where the port's shader departs from the reference.
std::vector<FoundLine> departures_of(const Replay& run) {
  std::vector<Followed> failing, passing;
  run.follow_right(failing, passing);
  return failing.empty() ? std::vector<FoundLine>() : departures(failing, passing);
}
}  // namespace

std::optional<Cause> unknown_cause(const Replay& run, bool of_records) {
  What unknown;
  unknown.kind = Kind::unknown;
  Tried out(std::move(unknown), {"", "", 0, 0, 0, of_records});
  for (const FoundLine& found : departures_of(run)) add_line(out, run, found);
  return out.lines.empty() ? std::nullopt : std::optional<Cause>(out);
}

void add_lines(const Replay& run, const Replay* other, std::vector<Tried>& best, const std::vector<Tried>& causes,
               const std::set<std::string>& alike) {
  constexpr std::size_t most_causes = 8;
  Tried& first = best.front();
  const auto add_all = [&](const std::vector<FoundLine>& all) {
    for (const FoundLine& found : all) add_line(first, run, found);
  };
  std::vector<FoundLine> functions_and_calls;
  const auto add_lines_of = [&](const Tried& c) {
    std::vector<Followed> followed;
    run.follow(*c.fault, followed);
    if (other && c.other_fault && !followed.empty()) other->follow(*c.other_fault, followed);
    if (followed.empty()) return;
    const FoundLines found = lines_of_mistake(followed, c.what.is_of_function());
    add_all(found.lines);
    functions_and_calls.insert(functions_and_calls.end(), found.function_and_call.begin(), found.function_and_call.end());
  };
  const auto explains_much = [](const Tried& c) { return c.inside * 3 >= c.of; };
  std::vector<const Tried*> asked;
  for (const Tried& c : causes)
    if (c.fault && (c.name == first.name || alike.contains(c.name)) && explains_much(first) && explains_much(c)) asked.push_back(&c);
  std::stable_sort(asked.begin(), asked.end(), [&](const Tried* a, const Tried* b) {
    if ((a->name == first.name) != (b->name == first.name)) return a->name == first.name;
    return far_fetched(*a) < far_fetched(*b);
  });
  asked.resize(std::min(asked.size(), most_causes));
  for (const Tried* c : asked) {
    if (first.lines.size() >= most_lines) break;
    add_lines_of(*c);
  }
  if (first.is_likely) return;
  for (std::size_t k = 1; k < best.size() && first.lines.size() < most_lines; ++k)
    if (best[k].fault && explains_much(best[k])) add_lines_of(best[k]);
  add_all(functions_and_calls);
  if (first.lines.size() < most_lines) add_all(departures_of(run));
}

}  // namespace rainref::faults
