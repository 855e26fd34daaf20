#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "faults/generators.h"
#include "faults/members.h"
#include "image/colour.h"
#include "math/scalar.h"

namespace rainref::faults {
namespace {

using capture::PassCase;
using scene::Member;
using scene::Scalar;
using Word = std::array<std::byte, 4>;

Word word_at(const std::vector<std::byte>& uniforms, const Member& m, int k) { return number_at<Word>(uniforms.data(), offset_of(m, k)); }
void put_word(PassCase& c, const Member& m, int k, Word w) { put_number(c.uniforms.data(), offset_of(m, k), w); }
bool same_value(const PassCase& c, const Member& a, const Member& b) {
  return std::memcmp(c.uniforms.data() + a.offset, c.uniforms.data() + b.offset, a.size()) == 0;
}
/// The members for which `wanted` returns true.
template <class Wanted>
std::vector<Member> those_of(const std::vector<Member>& all, const Wanted& wanted) {
  std::vector<Member> out;
  std::copy_if(all.begin(), all.end(), std::back_inserter(out), wanted);
  return out;
}

class UniformAdder {
 public:
  UniformAdder(std::vector<Fault>& out, const PassCase& c) : out_(out), c_(c) {}

  void exchanges(const std::vector<Member>& members) const {
    for (std::size_t i = 0; i < members.size(); ++i)
      for (std::size_t j = i + 1; j < members.size(); ++j) {
        const Member a = members[i], b = members[j];
        if (a.components != b.components || same_value(c_, a, b)) continue;
        // Replacing one by the other is the plainer mistake.
        for (const auto& [to, from] : {std::pair(a, b), std::pair(b, a)})
          add(Kind::uniform_is_another, {to.name, from.name}, [to = to, from = from](PassCase& altered) {
            std::memcpy(altered.uniforms.data() + to.offset, altered.uniforms.data() + from.offset, to.size());
          });
        add(Kind::uniforms_exchanged, {a.name, b.name}, [a, b](PassCase& altered) {
          std::swap_ranges(&altered.uniforms[a.offset], &altered.uniforms[a.offset] + a.size(), &altered.uniforms[b.offset]);
        });
      }
  }

  void permutations(const std::vector<Member>& vectors) const {
    for (const Member& m : vectors) {
      std::vector<int> order(static_cast<std::size_t>(m.components));
      std::iota(order.begin(), order.end(), 0);
      while (std::next_permutation(order.begin(), order.end())) {
        std::string swizzle;
        bool is_changed = false;
        for (std::size_t k = 0; k < order.size(); ++k) {
          swizzle += component_name(order[k]);
          is_changed |= word_at(c_.uniforms, m, order[k]) != word_at(c_.uniforms, m, static_cast<int>(k));
        }
        if (!is_changed) continue;
        add(Kind::uniform_permuted, {m.name, swizzle}, [m, order](PassCase& altered) {
          const std::vector<std::byte> right = altered.uniforms;
          for (std::size_t k = 0; k < order.size(); ++k) put_word(altered, m, static_cast<int>(k), word_at(right, m, order[k]));
        });
      }
      for (int from = 0; from < m.components; ++from)
        add(Kind::uniform_component_for_each, {m.name, component_name(from)}, [m, from](PassCase& altered) {
          for (int k = 0; k < m.components; ++k) put_word(altered, m, k, word_at(altered.uniforms, m, from));
        });
      add(Kind::uniform_of_other_sign, {m.name}, [m](PassCase& altered) {
        for (int k = 0; k < m.components; ++k) altered.uniforms[offset_of(m, k) + 3] ^= std::byte{0x80};
      });
      const auto each = [&](Kind kind, double (*change)(double)) {
        add(kind, {m.name}, [m, change](PassCase& altered) {
          std::byte* const all = altered.uniforms.data();
          for (int k = 0; k < m.components; ++k)
            put_number(all, offset_of(m, k), static_cast<float>(change(static_cast<double>(number_at<float>(all, offset_of(m, k))))));
        });
      };
      if (m.components < 3 || (m.range && m.range->low < 0)) continue;
      each(Kind::uniform_decoded, [](double v) { return v < 0 || v > 1 ? v : decode_srgb(v); });
      each(Kind::uniform_encoded, [](double v) { return v < 0 || v > 1 ? v : encode_srgb(v); });
      each(Kind::uniform_squared, [](double v) { return v * v; });
    }
  }

  /// Three vectors that may be the rows of a matrix.
  void transposes(const std::vector<Member>& rows) const {
    if (rows.size() > 8) return;
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (std::size_t j = i + 1; j < rows.size(); ++j)
        for (std::size_t k = j + 1; k < rows.size(); ++k) {
          const std::vector<Member> matrix{rows[i], rows[j], rows[k]};
          const auto row = [](int a) { return static_cast<std::size_t>(a); };
          bool is_symmetric = true;
          for (int a = 0; a < 3; ++a)
            for (int b = 0; b < a; ++b) is_symmetric &= word_at(c_.uniforms, matrix[row(a)], b) == word_at(c_.uniforms, matrix[row(b)], a);
          if (is_symmetric) continue;
          add(Kind::uniforms_transposed, {rows[i].name, rows[j].name, rows[k].name}, [matrix, row](PassCase& altered) {
            const std::vector<std::byte> right = altered.uniforms;
            for (int a = 0; a < 3; ++a)
              for (int b = 0; b < 3; ++b) put_word(altered, matrix[row(a)], b, word_at(right, matrix[row(b)], a));
          });
        }
  }

  /// Exchanges the same component of two or more vectors.
  void joint_components(const std::vector<Member>& vectors) const {
    constexpr std::size_t most = 6;
    for (const Member& m : vectors)
      if (m.components > 2) joint({m});
    if (vectors.size() > most) return;
    for (std::size_t i = 0; i < vectors.size(); ++i)
      for (std::size_t j = i + 1; j < vectors.size(); ++j)
        if (vectors[i].components == vectors[j].components) joint({vectors[i], vectors[j]});
  }

  /// change(value) for each float of a block, if the result differs; what(its name, other, now) describes it.
  template <class Change, class MakeWhat>
  void changed(const scene::UniformBlock& block, const Change& change, const MakeWhat& what) const {
    for (const Part& part : float_parts(block)) {
      const auto now = number_at<float>(c_.uniforms.data(), part.offset);
      const float other = change(now);
      if (other == now) continue;
      out_.emplace_back(what(part.name, other, now)).alter_case = [at = part.offset, other](PassCase& altered) {
        put_number(altered.uniforms.data(), at, other);
      };
    }
  }

 private:
  void add(Kind kind, std::vector<std::string> of, std::function<void(PassCase&)> alter) const {
    out_.emplace_back(What{kind, std::move(of)}).alter_case = std::move(alter);
  }
  void joint(const std::vector<Member>& of) const {
    std::string names;
    for (const Member& m : of) names += (names.empty() ? "" : " and ") + m.name;
    for (int to = 0; to < of[0].components; ++to)
      for (int from = 0; from < of[0].components; ++from) {
        const bool is_changed = std::all_of(of.begin(), of.end(),
                                            [&](const Member& m) { return word_at(c_.uniforms, m, from) != word_at(c_.uniforms, m, to); });
        if (from == to || !is_changed) continue;
        add(Kind::uniforms_by_component, {names, component_name(from), component_name(to)}, [of, from, to](PassCase& altered) {
          for (const Member& m : of) put_word(altered, m, to, word_at(altered.uniforms, m, from));
        });
      }
  }

  std::vector<Fault>& out_;
  const PassCase& c_;
};

What value_of(const std::string& name, float other, float now) {
  return {Kind::another_value, {name, fmt::format("{:.5g}", other), fmt::format("{}", now)}};
}

}  // namespace

void add_uniform_mixups(std::vector<Fault>& out, const Probed& p, const std::set<std::string>& used) {
  const std::vector<Member> members =
      those_of(p.pass.block.members, [&](const Member& m) { return m.scalar == Scalar::float32 && used.contains(m.name); });
  const std::vector<Member> vectors = those_of(members, [](const Member& m) { return m.components > 1; });
  const UniformAdder add(out, p.c);
  add.permutations(vectors);
  add.transposes(those_of(members, [](const Member& m) { return m.components == 3; }));
  add.joint_components(vectors);
  add.exchanges(members);
}

void add_whole_mixups(std::vector<Fault>& out, const Probed& p) {
  UniformAdder(out, p.c).exchanges(
      those_of(p.pass.block.members, [](const Member& m) { return m.scalar != Scalar::float32 && !is_padding(m); }));
}

void add_uniform_values(std::vector<Fault>& out, const Probed& p) {
  const auto as = [&](Kind kind, float (*change)(float)) {
    UniformAdder(out, p.c).changed(p.pass.block, change, [kind](const std::string& name, float other, float now) {
      return What{kind, {name, fmt::format("{}", other), fmt::format("{}", now)}};
    });
  };
  as(Kind::number_left_out_of_product, [](float) { return 1.0f; });
  as(Kind::number_doubled, [](float v) { return v * 2; });
  as(Kind::number_halved, [](float v) { return v / 2; });
  as(Kind::number_of_other_sign, [](float v) { return -v; });
}

void add_uniforms_of_values(std::vector<Fault>& out, const Probed& p, const std::vector<float>& values) {
  for (const float value : values)
    UniformAdder(out, p.c).changed(
        p.pass.block, [value](float) { return value; }, value_of);
}

namespace {

/// Adds a constant with other values.
class Replacer {
 public:
  Replacer(std::vector<Fault>& out, const Constant& constant) : out_(out), of_(constant) {}
  void operator()(float replacement, Kind kind) const {
    if (replacement == of_.value || !std::isfinite(replacement)) return;
    What what{kind, {of_.name, fmt::format("{}", replacement), fmt::format("{}", of_.value)}};
    what.head = of_.head;
    what.is_literal = of_.begins_as_literal;
    out_.push_back(replaced(std::move(what), of_.value, replacement));
  }

 private:
  std::vector<Fault>& out_;
  const Constant& of_;
};

/// True for a small literal that protects a division or root from zero. Not for a power of two, which is a scale. It is only left out,
/// because other errors in it do not occur.
bool is_guard(const Constant& constant) {
  int exponent = 0;
  return constant.begins_as_literal && std::abs(constant.value) <= 1e-4f && std::abs(std::frexp(constant.value, &exponent)) != 0.5f;
}

}  // namespace

void add_named_constants(std::vector<Fault>& out, const Constants& constants, bool literals) {
  for (const Constant& constant : constants) {
    const float value = constant.value;
    if (value == 0 || constant.is_literal != literals || constant.is_made) continue;  // a computed number is rarely left out alone
    const Replacer as(out, constant);
    as(0, Kind::number_left_out);
    if (is_guard(constant)) continue;
    as(1, Kind::number_left_out_of_product);
    as(-value, Kind::number_of_other_sign);
    as(value * 2, Kind::number_doubled);
    as(value / 2, Kind::number_halved);
    as(value * value, Kind::number_taken_twice);
    as(1 / value, Kind::number_inverted);
    as(1 - value, Kind::number_from_1);
  }
}
void add_odd_constants(std::vector<Fault>& out, const Probed& p, const Constants& constants) {
  const float aspect = p.model.height() > 0 ? static_cast<float>(p.model.width()) / static_cast<float>(p.model.height()) : 1.0f;
  constexpr float pi = std::numbers::pi_v<float>;
  using Number = scalar::Scalar<float>;
  for (const Constant& constant : constants) {
    const float value = constant.value;
    if (value == 0 || is_guard(constant)) continue;
    const Replacer as(out, constant);
    if (value > 0) as(std::sqrt(value), Kind::number_without_square);
    as(value * aspect, Kind::number_times_aspect);
    as(value / aspect, Kind::number_without_aspect);
    as(value * 4, Kind::number_quadrupled);
    as(value / 4, Kind::number_quartered);
    as(value + 1, Kind::number_one_more);
    as(value - 1, Kind::number_one_less);
    as(value * (pi / 180), Kind::number_in_degrees);
    as(value / (pi / 180), Kind::number_in_degrees_for_radians);
    // A number of stops, decibels or octaves used as a factor, or the reverse.
    if (std::abs(value) < 60) as(exp2(Number(value)).v, Kind::number_as_power_of_2);
    if (std::abs(value) < 60) as(exp(Number(value)).v, Kind::number_as_exponent);
    if (value > 0) as(log(Number(value)).v / std::numbers::ln2_v<float>, Kind::number_as_log2);
    if (value > 0) as(log(Number(value)).v, Kind::number_as_log);
    as(value * value * value, Kind::number_cubed);
    as(std::floor(value), Kind::number_cut);
    as(std::floor(value + 0.5f), Kind::number_rounded);
    as(value * pi, Kind::number_times_pi);
    as(value / pi, Kind::number_without_pi);
  }
}

}  // namespace rainref::faults
