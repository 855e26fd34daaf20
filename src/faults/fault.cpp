#include "faults/fault.h"

#include <algorithm>
#include <cstring>
#include <map>

#include <fmt/format.h>

#include "faults/generators.h"
#include "faults/list_faults.h"
#include "faults/members.h"
#include "faults/probe.h"
#include "judge/rearrange.h"
#include "rainref/error.h"

namespace rainref::faults {
namespace {

using capture::Array;
using capture::CaseInput;
using capture::PassCase;
using judge::Bind;
using judge::copy_channel;
using judge::flip_columns;
using judge::flip_rows;
using judge::HalfMode;
using judge::rounding_of;
using judge::Slot;
using judge::slots_of;
using judge::store_value;
using judge::swap_channels;

/// True for differences that a conforming GPU may have; they may still be the best explanation.
bool is_legal(perturbed::Fault s) {
  using perturbed::Fault;
  return s == Fault::fused || s == Fault::reciprocal_division || s == Fault::root_by_inverse || s == Fault::flushed ||
         s == Fault::mix_by_difference || s == Fault::sum_backwards || s == Fault::sum_otherwise_paired ||
         s == Fault::division_by_estimate || s == Fault::weights_of_8_bits;
}

void add_faults(std::vector<Fault>& out) {
  for (const perturbed::Fault s : perturbed::faults()) {
    Fault& d = out.emplace_back(What{behind(Kind::fused, static_cast<int>(s) - static_cast<int>(perturbed::Fault::fused))}, false);
    d.behaviour.fault = s;
    d.legal = is_legal(s);
  }
}

/// A device that rounds half stores the other way. Legal if a profile leaves it open.
void add_stores(std::vector<Fault>& out, const PassCase& c) {
  const std::vector<Slot> slots = slots_of(c);
  if (std::none_of(slots.begin(), slots.end(), [](const Slot& s) { return s.kind == FormatInfo::float16; })) return;
  for (const HalfMode mode : {HalfMode::rtz, HalfMode::rne}) {
    Fault& d = out.emplace_back(What{mode == HalfMode::rtz ? Kind::half_stores_toward_zero : Kind::half_stores_to_nearest}, false);
    d.stores = mode;
    d.legal = true;
  }
}

/// Replaces every literal and uniform that the pass uses all over the picture by another number. Numbers that only some rows use come from
/// the row index.
void add_constants(std::vector<Fault>& out, const PassCase& c, const capture::PassModel& model) {
  constexpr int all = 64;
  std::map<float, int> values = constants_met(model);
  for (const float v : constants_of_lists(model, c)) values[v] = all;
  for (const auto& [v, places] : values) {
    if (places < all / 2 || v == 0 || !(v > -1e30f && v < 1e30f)) continue;
    const auto add = [&, value = v](Kind kind, float replacement, bool for_diagnosis = true) {
      out.push_back(replaced({kind, {fmt::format("{}", value), fmt::format("{}", replacement)}}, value, replacement, for_diagnosis));
    };
    add(Kind::constant_off_by_a_hundredth, v * 1.01f, false);
    add(Kind::constant_off_by_a_bit, v * (1 + 0x1p-10f), false);
    add(Kind::constant_missing, 0);
    add(Kind::constant_negated, -v);
    add(Kind::constant_doubled, v * 2);
    add(Kind::constant_halved, v / 2);
    add(Kind::constant_taken_twice, v * v);
    add(Kind::constant_inverted, 1 / v);
  }
}

void add_uniforms(std::vector<Fault>& out, const capture::PackPass& pass, const PassCase* before) {
  const auto add = [&](Kind kind, std::vector<std::string> of, std::function<void(PassCase&)> alter, bool for_diagnosis = false) {
    out.emplace_back(What{kind, std::move(of)}, for_diagnosis).alter_case = std::move(alter);
  };
  for (const scene::Member& m : pass.block.members) {
    if (is_padding(m)) continue;
    if (m.scalar == scene::Scalar::int32 && m.components == 1) {
      const auto inverted = [at = m.offset](PassCase& c) {
        const auto v = number_at<std::int32_t>(c.uniforms.data(), at);
        if (v == 0 || v == 1) put_number(c.uniforms.data(), at, 1 - v);  // else it is not a flag
      };
      add(Kind::uniform_the_other_way, {m.name}, inverted, true);
    }
    add(Kind::uniform_is_zero, {m.name}, [m](PassCase& c) { std::memset(c.uniforms.data() + m.offset, 0, m.size()); });
    if (m.components > 1)
      add(Kind::uniform_reversed, {m.name}, [m](PassCase& c) {
        auto* words = reinterpret_cast<std::array<std::byte, 4>*>(c.uniforms.data() + m.offset);
        std::reverse(words, words + m.components);
      });
    for (int k = 0; m.scalar == scene::Scalar::float32 && k < m.components; ++k)
      add(
          Kind::uniform_negated, {m.components == 1 ? m.name : m.name + " " + component_name(k)},
          [at = offset_of(m, k)](PassCase& c) { c.uniforms[at + 3] ^= std::byte{0x80}; }, true);
    if (m.scalar != scene::Scalar::float32 && m.components == 1)
      for (const int by : {-1, 1}) {
        const auto moved = [at = m.offset, by](PassCase& c) {
          put_number(c.uniforms.data(), at, std::max(0, number_at<std::int32_t>(c.uniforms.data(), at) + by));
        };
        add(by < 0 ? Kind::uniform_one_less : Kind::uniform_one_more, {m.name}, moved, m.scalar != scene::Scalar::int32);
      }
    if (before && before->uniforms.size() >= m.offset + m.size()) {
      const std::vector<std::byte> old(before->uniforms.begin() + static_cast<std::ptrdiff_t>(m.offset),
                                       before->uniforms.begin() + static_cast<std::ptrdiff_t>(m.offset + m.size()));
      add(Kind::uniform_stale, {m.name},
          [m, old](PassCase& c) { std::copy(old.begin(), old.end(), c.uniforms.begin() + static_cast<std::ptrdiff_t>(m.offset)); });
    }
  }
  // Members of one kind that are easily confused: a missing aspect ratio, width for height.
  for (const scene::Member& m : pass.block.members)
    for (const scene::Member& other : pass.block.members) {
      if (&m == &other || m.scalar != scene::Scalar::float32 || other.scalar != m.scalar || m.components != 1 || other.components != 1 ||
          family(m) != family(other))
        continue;
      const auto taken = [m, other](PassCase& c) { std::memcpy(c.uniforms.data() + m.offset, c.uniforms.data() + other.offset, m.size()); };
      add(Kind::uniform_has_value, {m.name, other.name}, taken, true);
      if (m.offset > other.offset) continue;
      const auto exchanged = [m, other](PassCase& c) {
        std::swap_ranges(&c.uniforms[m.offset], &c.uniforms[m.offset] + m.size(), &c.uniforms[other.offset]);
      };
      add(Kind::uniforms_exchanged, {m.name, other.name}, exchanged, true);
    }
  add(Kind::uniform_block_shifted, {}, [](PassCase& c) { std::rotate(c.uniforms.begin(), c.uniforms.begin() + 4, c.uniforms.end()); });
}

CaseInput* input_of(PassCase& c, const std::string& name) {
  for (CaseInput& i : c.inputs)
    if (i.name == name) return &i;
  return nullptr;
}

void add_inputs(std::vector<Fault>& out, const PassCase& c, const PassCase* before) {
  for (const CaseInput& i : c.inputs) {
    const std::string name = i.name;
    const auto add = [&](Kind kind, std::function<void(Array&)> alter, bool for_diagnosis = false) {
      out.emplace_back(What{kind, {name}}, for_diagnosis).alter_case = [name, alter](PassCase& altered) {
        alter(input_of(altered, name)->array);
      };
    };
    if (i.array.is_records) {
      add(Kind::input_without_first, [](Array& a) {
        if (a.width == 0) return;
        std::vector<std::byte>& records = a.levels[0].edit();
        records.erase(records.begin(), records.begin() + static_cast<std::ptrdiff_t>(a.record.size));
        --a.width;
      });
      add(Kind::input_without_last, [](Array& a) {
        if (a.width == 0) return;
        a.levels[0].edit().resize(a.levels[0].size() - a.record.size);
        --a.width;
      });
    } else {
      const int channels = info(i.array.format).channels;
      add(Kind::input_upside_down, flip_rows);
      add(Kind::input_mirrored, flip_columns);
      if (channels > 1) add(Kind::input_pair_swapped, [](Array& a) { swap_channels(a, 0, 1); });
      if (channels == 2)
        for (const int from : {0, 1})
          add(
              from == 0 ? Kind::input_first_for_both : Kind::input_second_for_both, [from](Array& a) { copy_channel(a, from, 1 - from); },
              true);
      if (channels >= 3) add(Kind::input_as_bgra, [](Array& a) { swap_channels(a, 0, 2); });
      if (i.array.levels.size() > 1) add(Kind::input_without_levels, [](Array& a) { a.levels.resize(1); });
    }
    const CaseInput* old = before ? before->input(name) : nullptr;
    if (old && old->array.levels != i.array.levels) add(Kind::input_stale, [stale = old->array](Array& a) { a = stale; });
  }
}

}  // namespace

Fault replaced(What what, float value, float by, bool is_asked_by_diagnosis_alone) {
  Fault d(std::move(what), is_asked_by_diagnosis_alone);
  d.behaviour = perturbed::replacing(value, by);
  return d;
}
perturbed::Behaviour without_mistake(const Fault& d, Texel at) {
  perturbed::Behaviour with, out;
  std::vector<float> unused;
  if (d.at_texel) d.at_texel(at, with, unused);
  out.known = with.known;
  return out;
}
void tell_places_by(Fault& d, std::shared_ptr<const std::vector<float>> known) {
  d.at_texel = [known = std::move(known)](Texel, perturbed::Behaviour& b, std::vector<float>&) { b.known = known.get(); };
}

std::vector<Fault> faults_of(const capture::PackPass& pass, const PassCase& c, const capture::PassModel& model, const PassCase* before) {
  std::vector<Fault> all;
  add_output_faults(all, c, before);
  add_list_faults(all, c, before);
  add_stores(all, c);
  add_faults(all);
  add_inputs(all, c, before);
  add_uniforms(all, pass, before);
  add_constants(all, c, model);
  return all;
}

FaultyPass::FaultyPass(const Fault& fault, const PassCase& c, const Bind& bind, const capture::PassModel& model, HalfMode mode,
                       const std::vector<Array>& finished)
    : fault_(fault), model_(model), mode_(mode), slots_(slots_of(c)) {
  if (fault.alter_outputs) {
    finished_ = finished;
    applies_ = fault.alter_outputs(c, finished_);
  } else if (fault.alter_case) {
    altered_ = c;
    fault.alter_case(altered_);
    altered_model_ = bind(altered_);
    applies_ = altered_model_->width() == model.width() && altered_model_->height() == model.height() &&
               altered_model_->values() == model.values();
  }
}

void FaultyPass::store(Texel at, StoredTexel& out) const {
  if (finished_.empty()) return store(values(at), mode_, out);
  out.resize(slots_.size());
  for (std::size_t v = 0; v < slots_.size(); ++v) {
    const Slot& s = slots_[v];
    std::memcpy(out[v].data(), s.at(finished_[static_cast<std::size_t>(s.output)], at.x, at.y), static_cast<std::size_t>(s.channel_bytes));
  }
}

std::vector<perturbed::Perturbed> FaultyPass::values(Texel at) const {
  static thread_local perturbed::Trace trace;  // its memory is kept, because thousands of faults come here at many texels each
  return evaluated(at, fault_.rewrites ? &trace : nullptr, false);
}
void FaultyPass::trace(Texel at, perturbed::Trace& right, perturbed::Trace& wrong) const {
  evaluated(at, &right, true);
  evaluated(at, &wrong, false);
}
std::vector<perturbed::Perturbed> FaultyPass::evaluated(Texel at, perturbed::Trace* trace, bool is_right) const {
  perturbed::Behaviour behaviour = is_right ? without_mistake(fault_, at) : fault_.behaviour;
  std::vector<float> loads;
  behaviour.trace = trace;
  if (is_right) {
    const perturbed::Scope scope(behaviour);
    std::vector<perturbed::Perturbed> values(slots_.size());
    model_.evaluate(at.x, at.y, values.data());
    return values;
  }
  perturbed::Substitutions substitutions{fault_.substitutions};
  if (!substitutions.all.empty()) behaviour.substitutions = &substitutions, substitutions.start();
  if (fault_.at_texel) fault_.at_texel(at, behaviour, loads);
  const random::DrawsScope drawing(fault_.draws.value_or(random::Draws()));
  const perturbed::RewriteScope rewriting(fault_.rewrites.value_or(perturbed::Rewrites()));
  const perturbed::Scope scope(behaviour);
  std::vector<perturbed::Perturbed> values(slots_.size());
  const auto evaluate = [&] {
    if (trace) trace->clear();
    (altered_model_ ? *altered_model_ : model_).evaluate(at.x, at.y, values.data());
  };
  substitutions.look_ahead(evaluate);
  evaluate();
  return values;
}

void FaultyPass::store(const std::vector<perturbed::Perturbed>& values, HalfMode mode, StoredTexel& out) const {
  out.resize(slots_.size());
  for (std::size_t v = 0; v < slots_.size(); ++v) {
    const Slot& s = slots_[v];
    const float value = fault_.alter_value ? fault_.alter_value(values[v].v, s) : values[v].v;
    store_value(s, value, rounding_of(s, fault_.stores.value_or(mode)), out[v].data());
  }
}

}  // namespace rainref::faults
