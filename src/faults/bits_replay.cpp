#include "faults/bits_replay.h"

#include <algorithm>

#include "faults/draw_faults.h"
#include "faults/generators.h"
#include "faults/list_faults.h"

namespace rainref::faults {
namespace {

/// Record k; nothing if the list is shorter.
std::vector<std::byte> at(const Records& list, std::size_t k) { return k < list.size() ? list[k] : std::vector<std::byte>(); }

}  // namespace

BitsReplay::BitsReplay(const capture::PackPass& pass, const capture::PassCase& c, const capture::PassCase* before,
                       const capture::PassEvaluations& evaluations, const capture::Array& port, std::size_t output,
                       const parallel::Executor& executor)
    : pass_(pass),
      c_(c),
      before_(before),
      evaluations_(evaluations),
      output_(output),
      executor_(executor),
      port_(records_of(port)),
      right_(records_of(c.outputs[output].array)) {
  for (std::size_t k = 0; k < std::max(port_.size(), right_.size()); ++k)
    if (at(port_, k) != at(right_, k)) failing_.push_back(k);
}

std::vector<Fault> BitsReplay::plain() {
  const Probed p{pass_, c_, nullptr, no_model()};
  std::vector<Fault> all = faults_of(pass_, c_, no_model(), before_);
  std::erase_if(all, [](const Fault& d) { return !d.alter_case; });
  add_draw_faults(all, purposes_drawn([&] { static_cast<void>(evaluations_.recompute(c_)); }));
  add_counter_faults(all, pass_, c_);
  add_whole_mixups(all, p);
  add_input_mixups(all, p, false);
  add_member_faults(all, p, output_);
  return all;
}

std::vector<Tried> BitsReplay::causes(const std::vector<Fault>& all) const {
  const auto of = static_cast<std::int64_t>(failing_.size());
  return tried(*this, executor_, all, failing_.size(), true, [&](const Fault& d) {
    Tried cause = untried(d, failing_.size(), true);
    capture::PassCase altered = c_;
    if (d.alter_case) d.alter_case(altered);
    const random::DrawsScope scope(d.draws.value_or(random::Draws()));
    ListEdit edit{right_, {}, nullptr};
    const Records guess = d.alter_list ? (static_cast<void>(d.alter_list(c_, edit)), std::move(edit.records))
                                       : records_of(evaluations_.recompute(altered)[output_]);
    for (const std::size_t k : failing_) cause.explained += at(guess, k) == at(port_, k);
    // The other records must not change.
    std::int64_t broken = 0;
    for (std::size_t k = 0; k < std::max(guess.size(), right_.size()); ++k)
      broken += at(guess, k) != at(right_, k) && !std::binary_search(failing_.begin(), failing_.end(), k);
    if (broken * 4 > of) cause.explained = 0;
    cause.inside = cause.explained;
    cause.is_likely = cause.explained * 10 >= of * 9;
    return cause;
  });
}

}  // namespace rainref::faults
