#include "math/uncertain.h"

#include <functional>
#include <map>
#include <mutex>
#include <shared_mutex>
#include <utility>

#include "math/enclosure.h"

namespace rainref::enclosed {

std::atomic<int> detail::uncertain_arrays = 0;

namespace {

struct Arrays {
  std::shared_mutex mutex;
  std::map<const float*, std::shared_ptr<const Uncertain>, std::less<>> by_first;
};
Arrays& arrays() {
  static Arrays& all = *new Arrays;  // outlives every model
  return all;
}

}  // namespace

UncertainValues::UncertainValues(const float* first, std::shared_ptr<const Uncertain> of) : first_(first) {
  const std::unique_lock lock(arrays().mutex);
  arrays().by_first[first] = std::move(of);
  ++detail::uncertain_arrays;
}
UncertainValues::~UncertainValues() {
  const std::unique_lock lock(arrays().mutex);
  arrays().by_first.erase(first_);
  --detail::uncertain_arrays;
}

Enclosure detail::loaded(const float* p) {
  const std::shared_lock lock(arrays().mutex);
  const auto after = arrays().by_first.upper_bound(p);
  if (after == arrays().by_first.begin()) return Enclosure(*p);
  const auto& [first, values] = *std::prev(after);
  const auto k = static_cast<std::size_t>(p - first);
  if (k >= values->low.size()) return Enclosure(*p);
  return Enclosure::checked(values->low[k], values->high[k]);
}

}  // namespace rainref::enclosed
