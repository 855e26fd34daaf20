// Causes for a list from solving for what a port stored: in the pass text, each record separately, and the scale of a field.
#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "faults/generators.h"
#include "faults/list_faults.h"
#include "faults/list_replay.h"
#include "faults/members.h"
#include "faults/solver.h"
#include "judge/evaluations.h"
#include "rainref/error.h"

namespace rainref::faults {

using capture::Array;
using capture::PassCase;

ById by_id(const Array& list) {
  ById out;
  for (std::vector<std::byte>& r : records_of(list)) out[id_of(r, list.record)].push_back(std::move(r));
  return out;
}
const Records& of(const ById& list, std::uint32_t id) {
  static const Records none;
  const auto found = list.find(id);
  return found == list.end() ? none : found->second;
}

void ListReplay::find_alone() {
  const std::string& name = c_.outputs[output_].name;
  if (!evaluations_->bind || !model_->keyed(name)) return;
  const capture::CaseInput* taken = c_.input(name);
  const ById before = taken ? by_id(taken->array) : ById();
  constexpr std::size_t most = 6;
  for (std::size_t k = 0; k < failing_.size() && alone_.size() < most; k += std::max<std::size_t>(1, failing_.size() / (2 * most))) {
    const std::uint32_t id = failing_[k];
    const Records &port = of(got_, id), &right = of(right_, id), &old = of(before, id);
    if (port.size() != 1 || right.size() != 1 || (taken && old.size() != 1)) continue;
    auto one = std::make_shared<Alone>(Alone{c_, nullptr, id, port[0], right[0]});
    for (capture::CaseInput& input : one->c.inputs)
      if (taken && input.name == name) input.array = array_of(old, input.array);
    try {
      one->model = evaluations_->bind(one->c);
    } catch (const Error&) {
      continue;  // it cannot be evaluated alone
    }
    const capture::KeyedModel* keyed = one->model->keyed(name);
    const auto bytes = keyed ? keyed->reference() : std::nullopt;
    if (bytes && *bytes == right[0]) alone_.push_back(std::move(one));
  }
}

std::vector<Fault> ListReplay::solved() {
  const std::string& name = c_.outputs[output_].name;
  const std::vector<float> known = constants_of_lists(*model_, c_);
  std::vector<std::unique_ptr<Probe>> probes;
  std::vector<Solvable> texels;
  for (const std::shared_ptr<Alone>& one : alone_) {
    const Probed p{pass_, one->c, evaluations_->bind, *one->model};
    probes.push_back(std::make_unique<Probe>(std::move(probes_of_list(p, name, known)[0])));
    Solvable& s = texels.emplace_back(Solvable{*probes.back(), {}, {}, {}});
    const std::vector<double>* const own = own_leeway(one->id);
    std::vector<std::size_t> floats;
    for (std::size_t k = 0; k < words_.size(); ++k) {
      if (!words_[k].is_float) continue;
      float v;
      std::memcpy(&v, &one->port[words_[k].offset], 4);
      floats.push_back(words_[k].offset);
      s.port.push_back(v);
      s.leeway.push_back(
          std::max(own && (*own)[k] > 0 ? (*own)[k] : words_[k].leeway, std::abs(static_cast<double>(v)) * 0x1p-21 + 0x1p-40));
    }
    s.evaluate = [keyed = one->model->keyed(name), floats] {
      const auto given = keyed->perturbed();
      std::vector<float> numbers;
      for (const std::size_t at : floats)
        if (given && at + 4 <= given->size()) std::memcpy(&numbers.emplace_back(), given->data() + at, 4);
      return numbers;
    };
  }
  std::vector<Fault> out;
  add_solved_substitutions(out, {pass_, c_, evaluations_->bind, *model_}, texels, known, {executor_, [this] { return is_time_over(); }});
  return out;
}

/// A field that is scaled by one factor in most records.
void ListReplay::add_scale(std::vector<Fault>& out, const scene::Member& m) const {
  if (m.scalar != scene::Scalar::float32 || is_padding(m)) return;
  std::vector<double> ratios;
  for (const std::uint32_t id : failing_) {
    const Records &port = of(got_, id), &right = of(right_, id);
    if (port.size() != 1 || right.size() != 1) continue;
    for (int k = 0; k < m.components; ++k) {
      const auto a = number_at<float>(port[0].data(), offset_of(m, k)), b = number_at<float>(right[0].data(), offset_of(m, k));
      if (b != 0 && std::isfinite(a)) ratios.push_back(static_cast<double>(a) / b);
    }
  }
  if (ratios.size() < 4) return;
  std::nth_element(ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2), ratios.end());
  const double ratio = ratios[ratios.size() / 2];
  if (ratio == 1 || ratio == 0) return;
  const bool is_part = std::abs(ratio) < 1;
  const auto nice = static_cast<float>(is_part ? 1 / (std::round(64 / ratio) / 64) : std::round(ratio * 64) / 64);
  const std::string words = is_part ? fmt::format("1/{:.5g}", 1 / nice) : fmt::format("{:.5g}", nice);
  Fault& d = out.emplace_back(What{Kind::another_scale, {m.name, words}});
  d.list_output = static_cast<int>(output_);
  d.alter_list = [m, nice, layout = reference_.record](const PassCase&, ListEdit& e) {
    for (auto& r : e.records) {
      if (!e.at.empty() && !std::binary_search(e.at.begin(), e.at.end(), id_of(r, layout))) continue;
      for (int k = 0; k < m.components; ++k) {
        put_number(r.data(), offset_of(m, k), number_at<float>(r.data(), offset_of(m, k)) * nice);
      }
    }
    return true;
  };
}

}  // namespace rainref::faults
