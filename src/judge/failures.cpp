#include "judge/failures.h"

#include <algorithm>

#include "judge/alternatives.h"
#include "judge/bits.h"

namespace rainref::judge {
namespace {

bool better(const Failure& a, const Failure& b) {
  if (a.distance != b.distance) return a.distance > b.distance;
  if (a.y != b.y) return a.y < b.y;
  return a.x != b.x ? a.x < b.x : a.channel < b.channel;
}

}  // namespace

void keep_worst(std::vector<Failure>& worst) {
  std::sort(worst.begin(), worst.end(), better);
  if (worst.size() > OutputJudgement::max_failures) worst.resize(OutputJudgement::max_failures);
}

Failure failure_of(const Slot& slot, int x, int y, const capture::Array& want, const capture::Array& have,
                   const enclosed::CodeRange* accepted) {
  Failure f;
  f.x = x;
  f.y = y;
  f.channel = slot.channel;
  set_unequal(slot.kind, slot.at(want, x, y), slot.at(have, x, y), f);
  if (!accepted) return f;
  f.low = accepted->lo;
  f.high = accepted->hi;
  if (!f.not_a_number) f.distance = distance(f.got, *accepted);
  return f;
}

}  // namespace rainref::judge
