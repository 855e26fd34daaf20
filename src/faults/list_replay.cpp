#include "faults/list_replay.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

#include "faults/generators.h"
#include "faults/hypotheses.h"
#include "faults/list_faults.h"
#include "faults/members.h"
#include "faults/place_faults.h"
#include "judge/evaluations.h"
#include "judge/keyed.h"
#include "math/path_enumeration.h"
#include "rainref/error.h"

namespace rainref::faults {

using capture::Array;
using capture::PassCase;
using judge::Cause;
using judge::extents_of;
using judge::judge_keyed;
using judge::KeyedJudgement;
using scene::UniformBlock;

namespace {

/// The reference's records in the port's order of ids, so that a slot has the same neighbour as in the port. Records that the port lost
/// follow.
Array in_order_of(const Array& port, const Array& reference) {
  Records out;
  ById left = by_id(reference);
  for (const auto& r : records_of(port)) {
    const auto found = left.find(id_of(r, port.record));
    if (found == left.end()) continue;
    out.insert(out.end(), found->second.begin(), found->second.end());
    left.erase(found);
  }
  for (const auto& r : records_of(reference))
    if (left.contains(id_of(r, reference.record))) out.push_back(r);
  return array_of(out, reference);
}

/// Words that count: without id and padding.
std::vector<Word> words_of(const UniformBlock& layout) {
  std::vector<Word> out;
  for (const bool floats : {true, false})
    for (const scene::Member& m : layout.members) {
      if (m.name == "id" || is_padding(m) || (m.scalar == scene::Scalar::float32) != floats) continue;
      for (int k = 0; k < m.components; ++k) out.push_back({offset_of(m, k), floats});
    }
  return out;
}
/// Sets the widest useful envelope of each float, and those of each record by id.
void set_leeway(std::vector<Word>& words, std::map<std::uint32_t, std::vector<double>>& own, const capture::KeyedModel* model,
                const UniformBlock& record, const enclosed::Profile& profile) {
  if (!model) return;
  const std::vector<double> extents = extents_of(record, *model);
  const enclosed::ProfileScope scope(profile);
  for (int group = 0; group < model->groups(); ++group) {
    enclosed::PathEnumeration paths;
    std::vector<capture::KeyedRecord> records;
    paths.for_each_alternative([&] {
      records.clear();
      model->enclose(group, records);
      for (const capture::KeyedRecord& r : records)
        for (std::size_t k = 0; k < r.floats.size() && k < words.size(); ++k)
          if (const double width = static_cast<double>(r.floats[k].hi) - r.floats[k].lo;
              r.lives && !r.floats[k].is_vacuous() && width < std::max(extents[k], r.floats[k].magnitude()) / 64) {
            words[k].leeway = std::max(words[k].leeway, width);
            double& widest = own.try_emplace(r.id, std::vector<double>(words.size(), 0.0)).first->second[k];
            widest = std::max(widest, width);
          }
    });
  }
}

/// Compares the records of an id under a mistake with the port's.
struct Match {
  bool exact = true;  ///< equal bits
  bool near = true;   ///< within the tolerance
  double off = 0;     ///< total difference, in tolerances
};
/// True if a mistake comes near and the reference does not, or if it comes much nearer: a port may miss the envelope by less than the
/// tolerance.
bool is_nearer(const Match& with, const Match& without) {
  return with.near && !without.exact && (!without.near || 4 * with.off <= without.off);
}
/// `own`: tolerances of this record, or null.
Match compare(const Records& guess, const Records& got, const std::vector<Word>& words, const std::vector<double>* own) {
  if (guess.size() != got.size()) return {false, false};
  Match m;
  for (std::size_t i = 0; i < got.size(); ++i) {
    for (std::size_t k = 0; k < words.size(); ++k) {
      const Word& w = words[k];
      if (std::memcmp(&guess[i][w.offset], &got[i][w.offset], 4) == 0) continue;
      const auto a = number_at<float>(guess[i].data(), w.offset), b = number_at<float>(got[i].data(), w.offset);
      if (w.is_float && a == b) continue;  // zeros
      m.exact = false;
      const double leeway = own && (*own)[k] > 0 ? (*own)[k] : w.leeway, off = std::abs(static_cast<double>(a) - b);
      m.near &= w.is_float && off <= leeway;
      m.off += off / std::max(leeway, 1e-30);
    }
  }
  return m;
}

}  // namespace

ListReplay::ListReplay(const capture::PackPass& pass, const capture::PassCase& c, const capture::PassCase* before,
                       const capture::PassModel* model, const Array& port, std::size_t output, const enclosed::Profile& profile,
                       const parallel::Executor& executor)
    : pass_(pass),
      c_(c),
      before_(before),
      evaluations_(judge::evaluations_of(c.effect, c.pass)),
      model_(model ? model : &no_model()),
      output_(output),
      executor_(executor),
      reference_(in_order_of(port, c.outputs[output].array)),
      stored_(records_of(port)),
      got_(by_id(port)),
      right_(by_id(reference_)),
      words_(words_of(reference_.record)) {
  if (!evaluations_) return;
  const capture::CaseOutput& expected = c.outputs[output];
  const capture::KeyedModel* keyed = model_->keyed(expected.name);
  const KeyedJudgement judged = judge_keyed(expected, port, keyed, profile);
  std::set<std::uint32_t> failing;
  for (const auto* ids : {&judged.events.missing, &judged.events.extra, &judged.events.duplicate, &judged.events.outside})
    failing.insert(ids->begin(), ids->end());
  failing_.assign(failing.begin(), failing.end());
  if (!fails()) return;
  set_leeway(words_, own_leeway_, keyed, expected.array.record, profile);
  find_alone();
}

std::vector<Fault> ListReplay::plain() { return plain_list_hypotheses({pass_, c_, evaluations_->bind, *model_}, before_); }

std::vector<Fault> ListReplay::deeper() {
  std::vector<Probed> alone;
  for (const std::shared_ptr<Alone>& one : alone_) alone.push_back({pass_, one->c, evaluations_->bind, *one->model});
  Hypotheses all = list_hypotheses({pass_, c_, evaluations_->bind, *model_}, c_.outputs[output_].name, alone);
  constants_ = std::move(all.constants);
  return std::move(all.faults);
}

std::vector<Fault> ListReplay::uniforms_read_off() const {
  std::vector<float> stored;
  constexpr std::size_t most = 8;
  for (const std::uint32_t id : failing_) {
    const Records &port = of(got_, id), &right = of(right_, id);
    if (port.size() != 1 || right.size() != 1 || stored.size() > most) continue;
    for (const Word& w : words_) {
      const auto v = number_at<float>(port[0].data(), w.offset);
      const bool differs = w.is_float && std::memcmp(&port[0][w.offset], &right[0][w.offset], 4) != 0;
      if (differs && std::find(stored.begin(), stored.end(), v) == stored.end()) stored.push_back(v);
    }
  }
  std::vector<Fault> out;
  add_uniforms_of_values(out, {pass_, c_, nullptr, *model_}, stored);
  for (const scene::Member& m : reference_.record.members) add_scale(out, m);
  return out;
}

std::vector<Fault> ListReplay::fitted() {
  const capture::KeyedModel* keyed = model_->keyed(c_.outputs[output_].name);
  if (!keyed) return uniforms_read_off();
  std::vector<std::size_t> floats;
  for (const Word& w : words_)
    if (w.is_float) floats.push_back(w.offset);
  std::vector<Wanted> wanted;
  const auto number = [](const std::vector<std::byte>& record, std::size_t at) { return number_at<float>(record.data(), at); };
  constexpr std::size_t most = 12;
  for (std::size_t k = 0; k < failing_.size() && wanted.size() < most; ++k) {
    const Records &port = of(got_, failing_[k]), &right = of(right_, failing_[k]);
    if (port.size() != 1 || right.size() != 1) continue;
    Wanted& w = wanted.emplace_back(Wanted{{static_cast<int>(failing_[k]), 0}, {}, {}, {}});
    for (const std::size_t at : floats) {
      w.port.push_back(number(port[0], at));
      w.reference.push_back(number(right[0], at));
      w.step.push_back(std::abs(w.port.back()) * 0x1p-22f + 0x1p-30f);
    }
  }
  // All records are evaluated at once: the results for one number are kept until another number is used.
  std::map<float, ById> lists;
  float of_constant = 0;
  const auto evaluate = [&](const Wanted& w, std::size_t slot, float constant, float replacement) {
    if (constant != of_constant) lists.clear(), of_constant = constant;
    const auto [at, is_new] = lists.try_emplace(replacement);
    if (is_new) {
      const perturbed::Scope scope(perturbed::replacing(constant, replacement));
      Array list = reference_;
      list.levels = {keyed->perturbed().value_or(std::vector<std::byte>())};
      at->second = by_id(list);
    }
    const Records& there = of(at->second, static_cast<std::uint32_t>(w.at.x));
    return there.size() == 1 ? number(there[0], floats[slot]) : std::nanf("");
  };
  std::vector<Fault> out;
  add_fitted_constants(out, evaluate, constants_, wanted);
  return out;
}

const std::vector<double>* ListReplay::own_leeway(std::uint32_t id) const {
  const auto found = own_leeway_.find(id);
  return found == own_leeway_.end() ? nullptr : &found->second;
}

bool ListReplay::is_none_alone(const Fault& d) const {
  if (!d.is_evaluated() || d.alter_case || d.alter_outputs || alone_.empty()) return false;
  for (const std::shared_ptr<Alone>& one : alone_) {
    const std::optional<Array> list = faulty_list(d, one->c, output_, *evaluations_, one->model.get(), array_of({one->right}, reference_));
    if (!list) return false;
    const Match with = compare(of(by_id(*list), one->id), {one->port}, words_, own_leeway(one->id)),
                without = compare({one->right}, {one->port}, words_, own_leeway(one->id));
    if ((with.exact && !without.exact) || is_nearer(with, without)) return false;
  }
  return true;
}

Tried ListReplay::cause(const Fault& d) const {
  Tried cause = untried(d, failing_.size(), true);
  if (is_none_alone(d)) return cause;
  const std::optional<Array> list = faulty_list(d, c_, output_, *evaluations_, model_, reference_, failing_, &stored_);
  if (!list) return cause;
  const ById guess = by_id(*list);
  bool are_same_ids = true;
  for (const std::uint32_t id : failing_) {
    are_same_ids &= of(guess, id).size() == of(got_, id).size();
    const Match with = compare(of(guess, id), of(got_, id), words_, own_leeway(id)),
                without = compare(of(right_, id), of(got_, id), words_, own_leeway(id));
    cause.explained += with.exact && !without.exact;
    cause.inside += is_nearer(with, without);
  }
  // A cause must not break about as many records as it explains.
  std::int64_t broken = 0;
  for (const auto* ids : {&got_, &guess})
    for (const auto& [id, records] : *ids) {
      if (std::binary_search(failing_.begin(), failing_.end(), id) || (ids == &guess && got_.contains(id))) continue;
      broken += !compare(of(guess, id), of(right_, id), words_, nullptr).near;
    }
  if (broken * 4 > cause.of) cause.explained = cause.inside = 0;
  // An empty list is not the cause if a record exists.
  cause.is_likely = are_same_ids && cause.inside * 10 >= cause.of * 9;
  return cause;
}

std::vector<Tried> ListReplay::causes(const std::vector<Fault>& all) const {
  return tried(*this, executor_, all, failing_.size(), true, [&](const Fault& d) { return cause(d); });
}

ListReplay::ListReplay(const ListReplay& of, const capture::PassCase& c, const capture::PassModel& model)
    : pass_(of.pass_),
      c_(c),
      before_(of.before_),
      evaluations_(of.evaluations_),
      model_(&model),
      output_(of.output_),
      executor_(of.executor_),
      reference_(of.reference_),
      stored_(of.stored_),
      failing_(of.failing_),
      words_(of.words_) {}

std::unique_ptr<Replay> ListReplay::elsewhere() const {
  if (!evaluations_->bind) return nullptr;
  try {
    auto c = std::make_unique<capture::PassCase>(varied(pass_, c_));
    std::unique_ptr<capture::PassModel> model = evaluations_->bind(*c);
    if (!model->keyed(c_.outputs[output_].name)) return nullptr;
    auto out = std::make_unique<OwnReplay<ListReplay>>(*this, std::move(c), std::move(model));
    ListReplay& there = *out;
    // A mistake in the finished list is applied to the pass's output there.
    if (const std::optional<Array> own = faulty_list(Fault{}, there.c_, output_, *evaluations_, there.model_, reference_))
      there.reference_ = *own;
    return out;
  } catch (const Error&) {
    return nullptr;  // the pass rejects such numbers
  }
}

std::vector<float> ListReplay::given(const Fault& d) const {
  std::vector<float> out;
  try {
    const std::optional<Array> list = faulty_list(d, c_, output_, *evaluations_, model_, reference_);
    if (!list) return out;
    for (const auto& [id, records] : by_id(*list))
      for (const auto& r : records) {
        out.push_back(static_cast<float>(id));
        for (const Word& w : words_) out.push_back(number_at<float>(r.data(), w.offset));
      }
  } catch (const Error&) {
    out.clear();
  }
  return out;
}

}  // namespace rainref::faults
