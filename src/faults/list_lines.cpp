// Traces failing records in the port's own shader, to find its lines.
#include <algorithm>
#include <cmath>

#include "faults/list_faults.h"
#include "faults/list_replay.h"
#include "faults/members.h"
#include "judge/keyed.h"
#include "rainref/error.h"

namespace rainref::faults {

using capture::Array;
using capture::PassCase;

namespace {

/// True if two records are equal up to the rounding of different implementations.
bool is_near(const std::vector<std::byte>& a, const std::vector<std::byte>& b, const std::vector<Word>& words) {
  return std::all_of(words.begin(), words.end(), [&](const Word& w) {
    const auto x = number_at<float>(a.data(), w.offset), y = number_at<float>(b.data(), w.offset);
    const double few = 64 * 0x1p-23 * std::max(std::abs(static_cast<double>(x)), std::abs(static_cast<double>(y)));
    return std::memcmp(&a[w.offset], &b[w.offset], 4) == 0 || (w.is_float && std::abs(static_cast<double>(x) - y) <= few);
  });
}

/// True if one of the lists has this record alone.
bool stores(const std::vector<Array>& lists, const std::vector<std::byte>& record, const std::vector<Word>& words) {
  return std::any_of(lists.begin(), lists.end(), [&](const Array& list) {
    return list.is_records && list.record.size == record.size() && list.width == 1 && is_near(list.levels.at(0), record, words);
  });
}

}  // namespace

void ListReplay::follow(const Fault& d, std::vector<Followed>& out) const try {
  if (!program_ || !d.is_evaluated()) return;
  const std::string& name = c_.outputs[output_].name;
  for (const std::shared_ptr<Alone>& one : alone_) {
    PassCase altered;
    std::unique_ptr<capture::PassModel> of_altered;
    if (d.alter_case) {
      altered = one->c;
      d.alter_case(altered);
      of_altered = evaluations_->bind(altered);
    }
    const capture::KeyedModel *right = one->model->keyed(name), *wrong = of_altered ? of_altered->keyed(name) : right;
    Followed followed;
    Fault none;
    none.behaviour = without_mistake(d, {-1, -1});
    const auto with = wrong ? evaluated(d, *wrong, &followed.wrong) : std::nullopt;
    if (!with || with->size() != one->right.size() || is_near(*with, one->right, words_)) continue;
    evaluated(none, *right, &followed.right);
    // The record must be the mistake's, independent of the device.
    if (!stores(program_->trace(one->c, followed.port), *with, words_)) continue;
    for (std::size_t k = 0; k < followed.port.outputs.size(); ++k) followed.outputs.push_back(static_cast<int>(k));
    out.push_back(std::move(followed));
  }
} catch (const Error&) {
  out.clear();  // the program uses something unsupported
}

void ListReplay::follow_right(std::vector<Followed>& failing, std::vector<Followed>&) const try {
  if (!program_) return;
  Fault none;
  none.behaviour = without_mistake(none, {-1, -1});
  for (const std::shared_ptr<Alone>& one : alone_) {
    const capture::KeyedModel* const keyed = one->model->keyed(c_.outputs[output_].name);
    Followed followed;
    if (!keyed || !evaluated(none, *keyed, &followed.right) || stores(program_->trace(one->c, followed.port), one->right, words_)) continue;
    followed.wrong = followed.right;
    for (std::size_t k = 0; k < followed.port.outputs.size(); ++k) followed.outputs.push_back(static_cast<int>(k));
    failing.push_back(std::move(followed));
  }
} catch (const Error&) {
  failing.clear();
}

}  // namespace rainref::faults
