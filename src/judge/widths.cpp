#include "judge/widths.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace rainref::judge {
namespace {

template <class T>
double quantile_of(std::vector<T>& values, double share) {
  if (values.empty()) return 0;
  const auto k = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + k, values.end());
  return static_cast<double>(values[static_cast<std::size_t>(k)]);
}

void add_counts(QuantityJudgement& to, const QuantityJudgement& from) {
  for (auto counter : {&QuantityJudgement::elements, &QuantityJudgement::failing, &QuantityJudgement::vacuous, &QuantityJudgement::loose,
                       &QuantityJudgement::free, &QuantityJudgement::unsampled})
    to.*counter += from.*counter;
  to.farthest = std::max(to.farthest, from.farthest);
}

}  // namespace

std::uint32_t width_of(const enclosed::CodeRange& range) {
  constexpr double none = 4e9;
  const double codes = range.is_vacuous() ? none : static_cast<double>(range.hi) - static_cast<double>(range.lo);
  return static_cast<std::uint32_t>(std::min(codes, none));
}
double quantile(std::vector<std::uint32_t>& widths, double share) { return quantile_of(widths, share); }

Widths::Quantity& Widths::at(int quantity) {
  const auto k = static_cast<std::size_t>(quantity);
  if (quantities_.size() <= k) quantities_.resize(k + 1);
  return quantities_[k];
}

void Widths::add(int quantity, const enclosed::CodeRange& range, double width, bool is_vacuous, bool is_loose) {
  Quantity& q = at(quantity);
  ++q.counts.elements;
  q.counts.vacuous += is_vacuous;
  q.counts.loose += is_vacuous || is_loose;
  q.codes.push_back(width_of(range));
  q.widths.push_back(range.is_vacuous() ? std::numeric_limits<float>::infinity() : static_cast<float>(width));
}
void Widths::add_unbounded(int quantity) {
  Quantity& q = at(quantity);
  ++q.counts.elements;
  ++q.counts.vacuous;
  ++q.counts.loose;
}
void Widths::add_unsampled(int quantity, std::int64_t count) {
  Quantity& q = at(quantity);
  q.counts.elements += count;
  q.counts.unsampled += count;
}
void Widths::add_free(int quantity, std::int64_t count) {
  Quantity& q = at(quantity);
  q.counts.elements += count;
  q.counts.free += count;
}
void Widths::add_failing(int quantity, double distance) {
  Quantity& q = at(quantity);
  ++q.counts.failing;
  q.counts.farthest = std::max(q.counts.farthest, distance);
}

void Widths::append(const Widths& more) {
  for (std::size_t k = 0; k < more.quantities_.size(); ++k) {
    Quantity& to = at(static_cast<int>(k));
    const Quantity& from = more.quantities_[k];
    add_counts(to.counts, from.counts);
    to.codes.insert(to.codes.end(), from.codes.begin(), from.codes.end());
    to.widths.insert(to.widths.end(), from.widths.begin(), from.widths.end());
  }
}

void Widths::summarize(OutputJudgement& out) {
  if (out.quantities.size() < quantities_.size()) out.quantities.resize(quantities_.size());
  std::vector<std::uint32_t> all;
  for (std::size_t k = 0; k < quantities_.size(); ++k) {
    Quantity& q = quantities_[k];
    QuantityJudgement& to = out.quantities[k];
    add_counts(to, q.counts);
    to.median_codes = quantile_of(q.codes, 0.5);
    to.p99_codes = quantile_of(q.codes, 0.99);
    to.median_width = quantile_of(q.widths, 0.5);
    to.p99_width = quantile_of(q.widths, 0.99);
    all.insert(all.end(), q.codes.begin(), q.codes.end());
  }
  if (all.empty()) return;
  out.median_width = quantile_of(all, 0.5);
  out.p99_width = quantile_of(all, 0.99);
}

}  // namespace rainref::judge
