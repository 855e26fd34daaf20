// Hypotheses tried for lists matched by id: which single mistake gives the records that a port stored.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <map>
#include <set>

#include "faults/diagnose.h"
#include "faults/list_faults.h"
#include "judge/evaluations.h"
#include "judge/keyed.h"
#include "math/path_enumeration.h"
#include "rainref/error.h"

namespace rainref::faults {
namespace {

using capture::Array;
using judge::Cause;
using judge::evaluations_of;
using judge::extents_of;
using judge::judge_keyed;
using judge::keyed_outputs;
using judge::KeyedJudgement;
using scene::UniformBlock;
using ById = std::map<std::uint32_t, Records>;

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

/// The reference's records in the order in which the port has their ids: a slot's neighbour is the one that the port saw.
/// Those that it lost follow.
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

/// Words of a record that count: not the id, not padding.
struct Word {
  std::size_t offset;
  bool is_float;
  double leeway = 0;  ///< how far a conforming device may be from the reference, roughly
};
std::vector<Word> words_of(const UniformBlock& layout) {
  std::vector<Word> out;
  for (const bool floats : {true, false})
    for (const scene::Member& m : layout.members) {
      if (m.name == "id" || m.name.starts_with("padding") || (m.scalar == scene::Scalar::float32) != floats) continue;
      for (int k = 0; k < m.components; ++k) out.push_back({m.offset + 4 * static_cast<std::size_t>(k), floats});
    }
  return out;
}
/// The widest envelope of each float, among those that are a bound.
void set_leeway(std::vector<Word>& words, const capture::KeyedModel* model, const UniformBlock& record, const enclosed::Profile& profile) {
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
              r.lives && !r.floats[k].is_vacuous() && width < std::max(extents[k], r.floats[k].magnitude()) / 64)
            words[k].leeway = std::max(words[k].leeway, width);
    });
  }
}

/// How the records of an id under a mistake compare with the port's.
struct Match {
  bool exact = true;  ///< the same bits
  bool near = true;   ///< within the leeway
};
Match compare(const Records& guess, const Records& got, const std::vector<Word>& words) {
  if (guess.size() != got.size()) return {false, false};
  Match m;
  for (std::size_t i = 0; i < got.size(); ++i) {
    for (const Word& w : words) {
      if (std::memcmp(&guess[i][w.offset], &got[i][w.offset], 4) == 0) continue;
      float a, b;
      std::memcpy(&a, &guess[i][w.offset], 4);
      std::memcpy(&b, &got[i][w.offset], 4);
      if (w.is_float && a == b) continue;  // zeros
      m.exact = false;
      m.near &= w.is_float && std::abs(static_cast<double>(a) - b) <= w.leeway;
    }
  }
  return m;
}

}  // namespace

std::vector<Cause> diagnose_lists(const capture::PackPass& pass, const capture::PassCase& c, const capture::PassCase* before,
                                  const capture::PassModel* model, const std::vector<Array>& port, const enclosed::Profile& profile,
                                  const parallel::Executor& executor) {
  const capture::PassEvaluations* evaluations = evaluations_of(c.effect, c.pass);
  if (!evaluations) return {};
  const capture::ListPass no_model("", nullptr);
  if (!model) model = &no_model;
  std::vector<Cause> found;
  for (const std::size_t o : keyed_outputs(c)) {
    const capture::CaseOutput& expected = c.outputs[o];
    const capture::KeyedModel* keyed = model->keyed(expected.name);
    const KeyedJudgement judged = judge_keyed(expected, port[o], keyed, profile);
    std::set<std::uint32_t> failing;
    for (const auto* ids : {&judged.events.missing, &judged.events.extra, &judged.events.duplicate, &judged.events.outside})
      failing.insert(ids->begin(), ids->end());
    if (failing.empty()) continue;
    const std::vector<std::uint32_t> at(failing.begin(), failing.end());
    const Array reference = in_order_of(port[o], expected.array);
    const ById got = by_id(port[o]), right = by_id(reference);
    const Records stored = records_of(port[o]);
    std::vector<Word> words = words_of(expected.array.record);
    set_leeway(words, keyed, expected.array.record, profile);

    std::vector<Fault> all = faults_of(pass, c, *model, before);
    std::vector<Cause> causes(all.size());
    executor.for_range(static_cast<std::int64_t>(all.size()), 1, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t k = begin; k < end; ++k) {
        const Fault& d = all[static_cast<std::size_t>(k)];
        Cause& cause = causes[static_cast<std::size_t>(k)];
        cause = {d.name, d.sentence, 0, static_cast<std::int64_t>(at.size()), 0, true};
        try {
          const std::optional<Array> list = faulty_list(d, c, o, *evaluations, model, reference, at, &stored);
          if (!list) continue;
          const ById guess = by_id(*list);
          for (const std::uint32_t id : at) {
            const Match with = compare(of(guess, id), of(got, id), words), without = compare(of(right, id), of(got, id), words);
            cause.explained += with.exact && !without.exact;
            cause.inside += with.near && !without.near;
          }
          // A cause must not break about as many records as it explains.
          std::int64_t broken = 0;
          for (const auto* ids : {&got, &guess})
            for (const auto& [id, records] : *ids) {
              if (failing.contains(id) || (ids == &guess && got.contains(id))) continue;
              broken += !compare(of(guess, id), of(right, id), words).near;
            }
          if (broken * 4 > cause.of) cause.explained = cause.inside = 0;
          cause.is_likely = cause.inside * 10 >= cause.of * 9;
        } catch (const Error&) {
          cause.explained = cause.inside = 0;  // the altered case is none that the pass can run
        }
      }
    });
    found.insert(found.end(), std::make_move_iterator(causes.begin()), std::make_move_iterator(causes.end()));
  }
  return best_causes(std::move(found));
}

}  // namespace rainref::faults
