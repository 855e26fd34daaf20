#include "math/trace.h"

#include <utility>

namespace rainref::perturbed {

std::size_t ShapeCounts::place_of(std::uint32_t shape) const {
  const std::size_t last = entries_.size() - 1;
  std::size_t at = shape & last;
  while (entries_[at].round == round_ && entries_[at].shape != shape) at = (at + 1) & last;
  return at;
}
std::int32_t ShapeCounts::add(std::uint32_t shape, std::int32_t node) {
  std::size_t at = place_of(shape);
  if (entries_[at].round == round_) {
    ++entries_[at].count;
    return std::exchange(entries_[at].last, node);
  }
  if (2 * ++used_ > entries_.size()) {
    std::vector<Entry> old(2 * entries_.size());
    std::swap(old, entries_);
    for (const Entry& e : old)
      if (e.round == round_) entries_[place_of(e.shape)] = e;
    at = place_of(shape);
  }
  entries_[at] = {shape, round_, 1, node};
  return -1;
}
std::int32_t ShapeCounts::at(std::uint32_t shape) const {
  const Entry& e = entries_[place_of(shape)];
  return e.round == round_ ? e.count : 0;
}
std::int32_t ShapeCounts::last(std::uint32_t shape) const {
  const Entry& e = entries_[place_of(shape)];
  return e.round == round_ ? e.last : -1;
}
void ShapeCounts::clear() {
  used_ = 0;
  if (++round_ == 0) {
    entries_.assign(entries_.size(), Entry());
    round_ = 1;
  }
}

Trace::Node& Trace::add(Op op, float value, std::uint32_t shape) {
  const std::int32_t alike = met.add(shape, static_cast<std::int32_t>(nodes.size()));
  const std::int32_t occurrence = alike < 0 ? 0 : nodes[static_cast<std::size_t>(alike)].occurrence + 1;
  Node& node = nodes.emplace_back();
  node.op = op;
  node.value = value;
  node.shape = shape;
  node.occurrence = occurrence;
  node.alike = alike;
  return node;
}
const float* Trace::value_met(std::uint32_t shape, std::int32_t back, std::size_t before) const {
  for (std::int32_t at = met.last(shape); at >= 0; at = nodes[static_cast<std::size_t>(at)].alike)
    if (static_cast<std::size_t>(at) < before && --back == 0) return &nodes[static_cast<std::size_t>(at)].value;
  return nullptr;
}

}  // namespace rainref::perturbed
