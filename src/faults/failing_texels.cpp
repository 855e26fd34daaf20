#include "faults/failing_texels.h"

#include <algorithm>

namespace rainref::faults {

std::vector<Texel> failing_texels(const judge::CaseJudgement& j) {
  std::vector<Texel> all;
  for (const judge::OutputJudgement& o : j.outputs)
    for (std::size_t i = 0; i < o.map.size(); ++i)
      if (o.map[i] == 3) all.push_back({static_cast<int>(i) % o.width, static_cast<int>(i) / o.width});
  std::sort(all.begin(), all.end(), [](Texel a, Texel b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
  all.erase(std::unique(all.begin(), all.end(), [](Texel a, Texel b) { return a.x == b.x && a.y == b.y; }), all.end());
  return all;
}
std::vector<Texel> spread(const std::vector<Texel>& all, std::size_t most) {
  if (all.size() <= most) return all;
  std::vector<Texel> some;
  for (std::size_t k = 0; k < most; ++k) some.push_back(all[k * all.size() / most]);
  return some;
}

}  // namespace rainref::faults
