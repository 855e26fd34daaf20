#include "judge/part.h"

#include <algorithm>

#include "judge/beyond.h"
#include "judge/failures.h"

namespace rainref::judge {

Part::Part(const capture::PassCase& c) : widths(c.outputs.size()), rearranged(c.outputs.size()), beyond(c.outputs.size()) {
  counts.id = c.folder();
  for (const capture::CaseOutput& out : c.outputs) {
    OutputJudgement& o = counts.outputs.emplace_back();
    o.name = out.name;
    o.format = out.array.format;
    o.records = out.array.is_records;
    o.counted = o.records ? Counted::fields : Counted::values;
    o.width = out.array.width;
    o.height = out.array.height;
  }
}

void Part::add(const Part& other) {
  for (auto counter :
       {&CaseJudgement::invocations, &CaseJudgement::failing, &CaseJudgement::ambiguous, &CaseJudgement::other_branch,
        &CaseJudgement::gave_up, &CaseJudgement::rearranged, &CaseJudgement::expanded, &CaseJudgement::beyond, &CaseJudgement::undecided})
    counts.*counter += other.counts.*counter;
  counts.rearranged_distance = std::max(counts.rearranged_distance, other.counts.rearranged_distance);
  const auto add_worst = [](std::vector<Failure>& to, const std::vector<Failure>& from) {
    to.insert(to.end(), from.begin(), from.end());
    keep_worst(to);
  };
  for (std::size_t o = 0; o < counts.outputs.size(); ++o) {
    OutputJudgement& to = counts.outputs[o];
    const OutputJudgement& from = other.counts.outputs[o];
    for (auto counter : {&OutputJudgement::elements, &OutputJudgement::failing, &OutputJudgement::differing, &OutputJudgement::vacuous,
                         &OutputJudgement::loose, &OutputJudgement::atypical, &OutputJudgement::typical, &OutputJudgement::unbounded,
                         &OutputJudgement::rearranged, &OutputJudgement::free, &OutputJudgement::open, &OutputJudgement::beyond,
                         &OutputJudgement::unsampled})
      to.*counter += from.*counter;
    add_worst(to.worst, from.worst);
    widths[o].append(other.widths[o]);
    rearranged[o].insert(rearranged[o].end(), other.rearranged[o].begin(), other.rearranged[o].end());
    add_worst(beyond[o].worst, other.beyond[o].worst);
    beyond[o].farthest.append(other.beyond[o].farthest);
  }
}

bool Part::is_gross() const {
  std::int64_t count = 0, open = 0;
  for (const OutputJudgement& o : counts.outputs) count += o.beyond, open += o.open;
  return judge::is_gross(count, open);
}
bool Part::may_be_gross() const {
  std::int64_t count = 0, most_open = 0;
  for (const OutputJudgement& o : counts.outputs) count += o.beyond, most_open += o.elements - o.free;
  return judge::is_gross(count, most_open);
}

void Part::settle_beyond() {
  const bool fails = is_gross();
  if (fails) {
    counts.failing += counts.beyond;
  } else {
    if (counts.undecided > 0) counts.undecided += counts.beyond;
    counts.beyond = 0;
  }
  for (std::size_t o = 0; o < counts.outputs.size(); ++o) {
    OutputJudgement& out = counts.outputs[o];
    std::replace(out.map.begin(), out.map.end(), beyond_mark, static_cast<std::uint8_t>(fails ? 3 : 2));
    if (!fails) continue;
    out.failing += out.beyond;
    out.atypical = std::max<std::int64_t>(0, out.atypical - out.beyond);
    out.worst.insert(out.worst.end(), beyond[o].worst.begin(), beyond[o].worst.end());
    keep_worst(out.worst);
    widths[o].append(beyond[o].farthest);
  }
}

void Part::summarize() {
  for (std::size_t o = 0; o < counts.outputs.size(); ++o) {
    OutputJudgement& out = counts.outputs[o];
    widths[o].summarize(out);
    if (rearranged[o].empty()) continue;
    out.rearranged_median_width = quantile(rearranged[o], 0.5);
    out.rearranged_p99_width = quantile(rearranged[o], 0.99);
  }
}

}  // namespace rainref::judge
