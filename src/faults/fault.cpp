#include "faults/fault.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <set>

#include <fmt/format.h>

#include "faults/list_faults.h"
#include "faults/output_faults.h"
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

/// What a GPU may do without being wrong: still the best explanation of a difference.
bool is_legal(perturbed::Fault s) {
  using perturbed::Fault;
  return s == Fault::fused || s == Fault::reciprocal_division || s == Fault::root_by_inverse || s == Fault::flushed ||
         s == Fault::mix_by_difference || s == Fault::sum_backwards || s == Fault::sum_otherwise_paired ||
         s == Fault::division_by_estimate || s == Fault::weights_of_8_bits;
}

void add_faults(std::vector<Fault>& out) {
  for (const perturbed::FaultInfo& s : perturbed::faults()) {
    Fault d;
    d.name = s.name;
    d.sentence = s.sentence;
    d.behaviour.fault = s.fault;
    d.legal = is_legal(s.fault);
    out.push_back(std::move(d));
  }
}

/// A device that rounds its stores to halves the other way. Legal where a profile leaves it open.
void add_stores(std::vector<Fault>& out, const PassCase& c) {
  const std::vector<Slot> slots = slots_of(c);
  if (std::none_of(slots.begin(), slots.end(), [](const Slot& s) { return s.kind == FormatInfo::float16; })) return;
  for (const HalfMode mode : {HalfMode::rtz, HalfMode::rne}) {
    Fault d;
    d.name = mode == HalfMode::rtz ? "half stores toward zero" : "half stores to nearest";
    d.sentence = mode == HalfMode::rtz ? "stores to binary16 truncate; port.json or the profile say that they round to nearest"
                                       : "stores to binary16 round to nearest; port.json or the profile say that they truncate";
    d.stores = mode;
    d.legal = true;
    out.push_back(std::move(d));
  }
}

/// Every literal and uniform that the pass meets all over the picture, as another number. What only some rows meet comes
/// from their own index.
void add_constants(std::vector<Fault>& out, const PassCase& c, const capture::PassModel& model) {
  std::map<float, int> values;
  std::vector<float> met;
  constexpr int probes = 8;
  if (model.width() > 0) {
    perturbed::Behaviour collecting;
    collecting.constants = &met;
    const perturbed::Scope scope(collecting);
    std::vector<perturbed::Perturbed> unused(static_cast<std::size_t>(model.values()));
    for (int j = 0; j < probes; ++j)
      for (int i = 0; i < probes; ++i) {
        model.evaluate(i * (model.width() - 1) / (probes - 1), j * (model.height() - 1) / (probes - 1), unused.data());
        for (const float v : std::set<float>(met.begin(), met.end())) ++values[v];
        met.clear();
      }
  }
  for (const float v : constants_of_lists(model, c)) values[v] = probes * probes;
  for (const auto& [v, places] : values) {
    if (places < probes * probes / 2 || v == 0 || !(v > -1e30f && v < 1e30f)) continue;
    const auto add = [&, value = v](float replacement, const char* what, bool for_diagnosis) {
      Fault d;
      d.name = fmt::format("constant {} {}", value, what);
      d.sentence = fmt::format("a literal or uniform of value {} is {}", value, replacement);
      d.behaviour.fault = perturbed::Fault::constant;
      d.behaviour.constant = value;
      d.behaviour.replacement = replacement;
      d.for_diagnosis = for_diagnosis;
      out.push_back(std::move(d));
    };
    add(v * 1.01f, "off by 1 %", false);
    add(v * (1 + 0x1p-10f), "off by 2^-10", false);
    add(0, "missing", true);
    add(-v, "negated", true);
    add(v * 2, "doubled", true);
    add(v / 2, "halved", true);
    add(v * v, "taken twice", true);
    add(1 / v, "inverted", true);
  }
}

template <class T>
void set_member(PassCase& c, std::size_t offset, T value) {
  std::memcpy(c.uniforms.data() + offset, &value, sizeof value);
}

void add_uniforms(std::vector<Fault>& out, const capture::PackPass& pass, const PassCase* before) {
  for (const scene::Member& m : pass.block.members) {
    if (m.name.starts_with("padding")) continue;
    const auto add = [&](std::string what, std::string sentence, std::function<void(PassCase&)> alter) {
      Fault d;
      d.name = fmt::format("uniform {} {}", m.name, what);
      d.sentence = std::move(sentence);
      d.alter_case = std::move(alter);
      out.push_back(std::move(d));
    };
    if (m.scalar == scene::Scalar::int32 && m.components == 1) {
      add("the other way", fmt::format("the choice that {} makes is inverted, or {} is not set", m.name, m.name), [m](PassCase& c) {
        std::int32_t v;
        std::memcpy(&v, c.uniforms.data() + m.offset, 4);
        if (v == 0 || v == 1) set_member(c, m.offset, 1 - v);  // else it is no flag
      });
      out.back().for_diagnosis = true;
    }
    add("is zero", fmt::format("{} is not set", m.name), [m](PassCase& c) { std::memset(c.uniforms.data() + m.offset, 0, m.size()); });
    if (m.components > 1) {
      add("reversed", fmt::format("the components of {} are in reverse order", m.name), [m](PassCase& c) {
        auto* words = reinterpret_cast<std::array<std::byte, 4>*>(c.uniforms.data() + m.offset);
        std::reverse(words, words + m.components);
      });
    }
    for (int k = 0; m.scalar == scene::Scalar::float32 && k < m.components; ++k) {
      const std::string part = m.components == 1 ? "" : fmt::format("{} ", "xyzw"[k]);
      add(part + "negated", fmt::format("{} {}has the other sign", m.name, part),
          [m, k](PassCase& c) { c.uniforms[m.offset + 4 * static_cast<std::size_t>(k) + 3] ^= std::byte{0x80}; });
      out.back().for_diagnosis = true;
    }
    if (m.scalar != scene::Scalar::float32 && m.components == 1) {
      for (const int by : {-1, 1}) {
        add(by < 0 ? "one less" : "one more", fmt::format("{} is off by one", m.name), [m, by](PassCase& c) {
          std::int32_t v;
          std::memcpy(&v, c.uniforms.data() + m.offset, 4);
          set_member(c, m.offset, std::max(0, v + by));
        });
        out.back().for_diagnosis = m.scalar != scene::Scalar::int32;
      }
    }
    if (before && before->uniforms.size() >= m.offset + m.size()) {
      const std::vector<std::byte> old(before->uniforms.begin() + static_cast<std::ptrdiff_t>(m.offset),
                                       before->uniforms.begin() + static_cast<std::ptrdiff_t>(m.offset + m.size()));
      add("stale", fmt::format("{} is that of the run before", m.name),
          [m, old](PassCase& c) { std::copy(old.begin(), old.end(), c.uniforms.begin() + static_cast<std::ptrdiff_t>(m.offset)); });
    }
  }
  // Members of one kind that are easily taken for each other: a missing aspect ratio, width for height.
  const auto family = [](const scene::Member& m) { return m.name.substr(0, m.name.find_last_of('_') + 1) + m.unit; };
  for (const scene::Member& m : pass.block.members) {
    for (const scene::Member& other : pass.block.members) {
      if (&m == &other || m.scalar != scene::Scalar::float32 || other.scalar != m.scalar || m.components != 1 || other.components != 1 ||
          family(m) != family(other))
        continue;
      Fault d;
      d.name = fmt::format("uniform {} is {}", m.name, other.name);
      d.sentence = fmt::format("{} has the value of {}", m.name, other.name);
      d.alter_case = [m, other](PassCase& c) { std::memcpy(c.uniforms.data() + m.offset, c.uniforms.data() + other.offset, m.size()); };
      d.for_diagnosis = true;
      out.push_back(d);
      if (m.offset > other.offset) continue;
      d.name = fmt::format("uniforms {} and {} exchanged", m.name, other.name);
      d.sentence = fmt::format("{} and {} have each other's value", m.name, other.name);
      d.alter_case = [m, other](PassCase& c) {
        std::swap_ranges(&c.uniforms[m.offset], &c.uniforms[m.offset] + m.size(), &c.uniforms[other.offset]);
      };
      out.push_back(std::move(d));
    }
  }
  Fault shifted;
  shifted.name = "uniform block shifted by 4 bytes";
  shifted.sentence = "the uniform block's padding differs (std140 against a tight layout)";
  shifted.alter_case = [](PassCase& c) { std::rotate(c.uniforms.begin(), c.uniforms.begin() + 4, c.uniforms.end()); };
  out.push_back(std::move(shifted));
}

CaseInput* input_of(PassCase& c, const std::string& name) {
  for (CaseInput& i : c.inputs)
    if (i.name == name) return &i;
  return nullptr;
}

void add_inputs(std::vector<Fault>& out, const PassCase& c, const PassCase* before) {
  for (const CaseInput& i : c.inputs) {
    const std::string name = i.name;
    const auto add = [&](std::string what, std::string sentence, std::function<void(Array&)> alter) {
      Fault d;
      d.name = fmt::format("input {} {}", name, what);
      d.sentence = std::move(sentence);
      d.alter_case = [name, alter](PassCase& altered) { alter(input_of(altered, name)->array); };
      out.push_back(std::move(d));
    };
    if (i.array.is_records) {
      add("without its first record", fmt::format("the first of {} is left out", name), [](Array& a) {
        if (a.width == 0) return;
        a.levels[0].erase(a.levels[0].begin(), a.levels[0].begin() + static_cast<std::ptrdiff_t>(a.record.size));
        --a.width;
      });
      add("without its last record", fmt::format("the last of {} is left out", name), [](Array& a) {
        if (a.width == 0) return;
        a.levels[0].resize(a.levels[0].size() - a.record.size);
        --a.width;
      });
    } else {
      add("upside down", fmt::format("row 0 of {} is v = 1", name), [](Array& a) { flip_rows(a); });
      add("mirrored", fmt::format("{} is mirrored left to right", name), [](Array& a) { flip_columns(a); });
      if (info(i.array.format).channels > 1) {
        add("with its first two channels swapped", fmt::format("the first two channels of {} are swapped (ping-pong order)", name),
            [](Array& a) { swap_channels(a, 0, 1); });
      }
      if (info(i.array.format).channels == 2) {
        for (const int from : {0, 1}) {
          add(from == 0 ? "with its first channel for both" : "with its second channel for both",
              fmt::format("of {0} the {1} channel is read for both: {0}.{2} where {0}.{3} is meant", name, from == 0 ? "first" : "second",
                          "xy"[from], "yx"[from]),
              [from](Array& a) { copy_channel(a, from, 1 - from); });
          out.back().for_diagnosis = true;
        }
      }
      if (info(i.array.format).channels >= 3) {
        add("as BGRA", fmt::format("{} is read in the order BGRA", name), [](Array& a) { swap_channels(a, 0, 2); });
      }
      if (i.array.levels.size() > 1) {
        add("without mip levels", fmt::format("{} has its first level only, or is read at level 0", name),
            [](Array& a) { a.levels.resize(1); });
      }
    }
    const CaseInput* old = before ? before->input(name) : nullptr;
    if (old && old->array.levels != i.array.levels) {
      const Array stale = old->array;
      add("stale", fmt::format("{} is that of the run before", name), [stale](Array& a) { a = stale; });
    }
  }
}

}  // namespace

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

FaultyPass::FaultyPass(const Fault& fault, const PassCase& c, Bind bind, const capture::PassModel& model, HalfMode mode,
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

void FaultyPass::store(Texel at, std::vector<Array>& out) const {
  if (!finished_.empty()) {
    for (const Slot& s : slots_) {
      const std::size_t o = static_cast<std::size_t>(s.output), offset = s.offset(at.x, at.y);
      std::memcpy(out[o].levels[0].data() + offset, finished_[o].levels[0].data() + offset, static_cast<std::size_t>(s.channel_bytes));
    }
    return;
  }
  store(values(at), at, mode_, out);
}

std::vector<perturbed::Perturbed> FaultyPass::values(Texel at) const {
  perturbed::Behaviour behaviour = fault_.behaviour;
  std::vector<float> loads;
  perturbed::Trace trace;
  if (fault_.rewrites) behaviour.trace = &trace;
  perturbed::Substitutions substitutions{fault_.substitutions};
  if (!substitutions.all.empty()) behaviour.substitutions = &substitutions, substitutions.start();
  if (fault_.at_texel) fault_.at_texel(at, behaviour, loads);
  const random::DrawsScope drawing(fault_.draws.value_or(random::Draws()));
  const perturbed::RewriteScope rewriting(fault_.rewrites.value_or(perturbed::Rewrites()));
  const perturbed::Scope scope(behaviour);
  std::vector<perturbed::Perturbed> values(slots_.size());
  const auto evaluate = [&] { (altered_model_ ? *altered_model_ : model_).evaluate(at.x, at.y, values.data()); };
  substitutions.look_ahead(evaluate);
  evaluate();
  return values;
}

void FaultyPass::store(const std::vector<perturbed::Perturbed>& values, Texel at, HalfMode mode, std::vector<Array>& out) const {
  for (std::size_t v = 0; v < slots_.size(); ++v) {
    const Slot& s = slots_[v];
    const float value = fault_.alter_value ? fault_.alter_value(values[v].v, s) : values[v].v;
    store_value(s, value, rounding_of(s, fault_.stores.value_or(mode)),
                out[static_cast<std::size_t>(s.output)].levels[0].data() + s.offset(at.x, at.y));
  }
}

}  // namespace rainref::faults
