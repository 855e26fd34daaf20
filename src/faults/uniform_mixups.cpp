#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "faults/case_adder.h"
#include "faults/whole_faults.h"
#include "image/colour.h"
#include "math/scalar.h"

namespace rainref::faults {
namespace {

using capture::PassCase;
using scene::Member;
using scene::Scalar;
using Word = std::array<std::byte, 4>;

Word word_at(const PassCase& c, const Member& m, int k) {
  Word w;
  std::memcpy(w.data(), c.uniforms.data() + m.offset + 4 * static_cast<std::size_t>(k), 4);
  return w;
}
void put_word(PassCase& c, const Member& m, int k, Word w) {
  std::memcpy(c.uniforms.data() + m.offset + 4 * static_cast<std::size_t>(k), w.data(), 4);
}
std::vector<Member> floats_of(const capture::PackPass& pass, const std::set<std::string>& used) {
  std::vector<Member> out;
  std::copy_if(pass.block.members.begin(), pass.block.members.end(), std::back_inserter(out),
               [&](const Member& m) { return m.scalar == Scalar::float32 && used.contains(m.name); });
  return out;
}
std::vector<Member> whole_of(const capture::PackPass& pass) {
  std::vector<Member> out;
  std::copy_if(pass.block.members.begin(), pass.block.members.end(), std::back_inserter(out),
               [](const Member& m) { return m.scalar != Scalar::float32 && !m.name.starts_with("padding"); });
  return out;
}
bool same_value(const PassCase& c, const Member& a, const Member& b) {
  return std::memcmp(c.uniforms.data() + a.offset, c.uniforms.data() + b.offset, a.size()) == 0;
}

void add_exchanges(CaseAdder& add, const PassCase& c, const std::vector<Member>& members) {
  for (std::size_t i = 0; i < members.size(); ++i)
    for (std::size_t j = i + 1; j < members.size(); ++j) {
      const Member a = members[i], b = members[j];
      if (a.components != b.components || same_value(c, a, b)) continue;
      // One in place of another is the plainer mistake.
      for (const auto& [to, from] : {std::pair(a, b), std::pair(b, a)})
        add(fmt::format("uniform {} is {}", to.name, from.name), fmt::format("{} stands where {} is meant", from.name, to.name),
            [to = to, from = from](PassCase& altered) {
              std::memcpy(altered.uniforms.data() + to.offset, altered.uniforms.data() + from.offset, to.size());
            });
      add(fmt::format("uniforms {} and {} exchanged", a.name, b.name), fmt::format("{} and {} have each other's value", a.name, b.name),
          [a, b](PassCase& altered) {
            std::swap_ranges(&altered.uniforms[a.offset], &altered.uniforms[a.offset] + a.size(), &altered.uniforms[b.offset]);
          });
    }
}

void add_permutations(CaseAdder& add, const PassCase& c, const std::vector<Member>& members) {
  for (const Member& m : members) {
    if (m.components < 2) continue;
    std::vector<int> order(static_cast<std::size_t>(m.components));
    for (int k = 0; k < m.components; ++k) order[static_cast<std::size_t>(k)] = k;
    while (std::next_permutation(order.begin(), order.end())) {
      std::string swizzle;
      bool changes = false;
      for (std::size_t k = 0; k < order.size(); ++k) {
        swizzle += "xyzw"[order[k]];
        changes |= word_at(c, m, order[k]) != word_at(c, m, static_cast<int>(k));
      }
      if (!changes) continue;
      add(fmt::format("uniform {}.{}", m.name, swizzle), fmt::format("the components of {} are taken in the order {}", m.name, swizzle),
          [m, order](PassCase& altered) {
            const PassCase right = altered;
            for (std::size_t k = 0; k < order.size(); ++k) put_word(altered, m, static_cast<int>(k), word_at(right, m, order[k]));
          });
    }
    for (int from = 0; from < m.components; ++from)
      add(fmt::format("uniform {}.{} for each component", m.name, "xyzw"[from]),
          fmt::format("{}.{} is taken for every component of {}", m.name, "xyzw"[from], m.name), [m, from](PassCase& altered) {
            for (int k = 0; k < m.components; ++k) put_word(altered, m, k, word_at(altered, m, from));
          });
    add(fmt::format("uniform {} with the other sign", m.name), fmt::format("{} points the other way", m.name), [m](PassCase& altered) {
      for (int k = 0; k < m.components; ++k) altered.uniforms[m.offset + 4 * static_cast<std::size_t>(k) + 3] ^= std::byte{0x80};
    });
    const auto each = [&](const char* what, const char* sentence, auto change) {
      add(fmt::format("uniform {} {}", m.name, what), fmt::format("{} {}", m.name, sentence), [m, change](PassCase& altered) {
        for (int k = 0; k < m.components; ++k) {
          Word w = word_at(altered, m, k);
          float v;
          std::memcpy(&v, w.data(), 4);
          v = static_cast<float>(change(static_cast<double>(v)));
          std::memcpy(w.data(), &v, 4);
          put_word(altered, m, k, w);
        }
      });
    };
    if (m.components < 3 || (m.range && m.range->low < 0)) continue;
    each("decoded once more", "is taken for sRGB and decoded", [](double v) { return v < 0 || v > 1 ? v : decode_srgb(v); });
    each("still encoded", "is not decoded: sRGB is taken for linear", [](double v) { return v < 0 || v > 1 ? v : encode_srgb(v); });
    each("squared", "is taken twice", [](double v) { return v * v; });
  }
}

/// The same component of two vectors or more: one is taken for the other in all of them.
void add_joint_components(CaseAdder& add, const PassCase& c, const std::vector<Member>& members) {
  std::vector<Member> vectors;
  std::copy_if(members.begin(), members.end(), std::back_inserter(vectors), [](const Member& m) { return m.components > 1; });
  constexpr std::size_t most = 6;
  const auto joint = [&](const std::vector<Member>& of) {
    std::string names;
    for (const Member& m : of) names += (names.empty() ? "" : " and ") + m.name;
    for (int to = 0; to < of[0].components; ++to)
      for (int from = 0; from < of[0].components; ++from) {
        const bool changes = std::all_of(of.begin(), of.end(), [&](const Member& m) { return word_at(c, m, from) != word_at(c, m, to); });
        if (from == to || !changes) continue;
        add(fmt::format("uniforms {} with {} for {}", names, "xyzw"[from], "xyzw"[to]),
            fmt::format("{} is taken for {} of {}", "xyzw"[from], "xyzw"[to], names), [of, from, to](PassCase& altered) {
              for (const Member& m : of) put_word(altered, m, to, word_at(altered, m, from));
            });
      }
  };
  for (const Member& m : vectors)
    if (m.components > 2) joint({m});
  if (vectors.size() > most) return;
  for (std::size_t i = 0; i < vectors.size(); ++i)
    for (std::size_t j = i + 1; j < vectors.size(); ++j)
      if (vectors[i].components == vectors[j].components) joint({vectors[i], vectors[j]});
}

/// Three vectors that may be the rows of a matrix.
void add_transposes(CaseAdder& add, const PassCase& c, const std::vector<Member>& members) {
  std::vector<Member> rows;
  std::copy_if(members.begin(), members.end(), std::back_inserter(rows), [](const Member& m) { return m.components == 3; });
  if (rows.size() > 8) return;
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = i + 1; j < rows.size(); ++j)
      for (std::size_t k = j + 1; k < rows.size(); ++k) {
        const std::array<Member, 3> matrix{rows[i], rows[j], rows[k]};
        const auto symmetric = [&] {
          for (int a = 0; a < 3; ++a)
            for (int b = 0; b < a; ++b)
              if (word_at(c, matrix[static_cast<std::size_t>(a)], b) != word_at(c, matrix[static_cast<std::size_t>(b)], a)) return false;
          return true;
        };
        if (symmetric()) continue;
        add(fmt::format("matrix {}, {}, {} transposed", rows[i].name, rows[j].name, rows[k].name),
            fmt::format("the matrix of rows {}, {}, {} is transposed", rows[i].name, rows[j].name, rows[k].name),
            [matrix](PassCase& altered) {
              const PassCase right = altered;
              for (int a = 0; a < 3; ++a)
                for (int b = 0; b < 3; ++b)
                  put_word(altered, matrix[static_cast<std::size_t>(a)], b, word_at(right, matrix[static_cast<std::size_t>(b)], a));
            });
      }
}

/// Constants with another value.
class Replacer {
 public:
  Replacer(std::vector<Fault>& out, float value, std::string name) : out_(out), value_(value), name_(std::move(name)) {}
  void operator()(float replacement, const char* what) const {
    if (replacement == value_ || !std::isfinite(replacement)) return;
    Fault d;
    d.name = fmt::format("{} {}", name_, what);
    d.sentence = fmt::format("{} {}: it is {} in place of {}", name_, what, replacement, value_);
    d.behaviour.fault = perturbed::Fault::constant;
    d.behaviour.constant = value_;
    d.behaviour.replacement = replacement;
    d.for_diagnosis = true;
    out_.push_back(std::move(d));
  }

 private:
  std::vector<Fault>& out_;
  float value_;
  std::string name_;
};

}  // namespace

void add_uniform_mixups(std::vector<Fault>& out, const Probed& p, const std::set<std::string>& used) {
  const std::vector<Member> members = floats_of(p.pass, used);
  CaseAdder add(out);

  add_permutations(add, p.c, members);
  add_transposes(add, p.c, members);
  add_joint_components(add, p.c, members);
  add_exchanges(add, p.c, members);
}

void add_whole_mixups(std::vector<Fault>& out, const Probed& p) {
  CaseAdder add(out);
  add_exchanges(add, p.c, whole_of(p.pass));
}

namespace {

/// change(value) of each float of the uniforms, where that is another; `words` gives the name and the sentence of its part.
template <class Change, class Words>
void add_changed_uniforms(std::vector<Fault>& out, const Probed& p, Change change, Words words) {
  CaseAdder add(out);
  for (const Member& m : p.pass.block.members)
    for (int k = 0; m.scalar == Scalar::float32 && !m.name.starts_with("padding") && k < m.components; ++k) {
      float now;
      const Word w = word_at(p.c, m, k);
      std::memcpy(&now, w.data(), 4);
      const float other = change(now);
      if (other == now) continue;
      const auto [name, sentence] = words(m.components == 1 ? m.name : fmt::format("{}.{}", m.name, "xyzw"[k]), now, other);
      add(name, sentence, [m, k, other](PassCase& altered) {
        Word to;
        std::memcpy(to.data(), &other, 4);
        put_word(altered, m, k, to);
      });
    }
}

}  // namespace

void add_uniform_values(std::vector<Fault>& out, const Probed& p) {
  const auto as = [&](const char* what, auto change) {
    add_changed_uniforms(out, p, change, [what](const std::string& name, float now, float other) {
      return std::pair(fmt::format("{} {}", name, what), fmt::format("{} {}: it is {} in place of {}", name, what, other, now));
    });
  };
  as("left out of a product", [](float) { return 1.0f; });
  as("doubled", [](float v) { return v * 2; });
  as("halved", [](float v) { return v / 2; });
  as("with the other sign", [](float v) { return -v; });
}

void add_uniforms_of_values(std::vector<Fault>& out, const Probed& p, const std::vector<float>& values) {
  for (const float value : values)
    add_changed_uniforms(
        out, p, [value](float) { return value; },
        [](const std::string& name, float now, float other) {
          return std::pair(fmt::format("another value of {}", name),
                           fmt::format("{} is about {:.5g} in the port, {} in the reference", name, other, now));
        });
}

void add_named_constants(std::vector<Fault>& out, const Constants& constants, bool literals) {
  for (const auto& [value, name, is_literal] : constants) {
    if (value == 0 || is_literal != literals || name.starts_with("f(")) continue;  // a made number is rarely left out by itself
    const Replacer as(out, value, name);
    as(1, "left out of a product");
    as(0, "left out");
    as(-value, "with the other sign");
    as(value * 2, "doubled");
    as(value / 2, "halved");
    as(value * value, "taken twice, or squared");
    as(1 / value, "inverted");
    as(1 - value, "taken from 1");
  }
}
void add_odd_constants(std::vector<Fault>& out, const Probed& p, const Constants& constants) {
  const float aspect = p.model.height() > 0 ? static_cast<float>(p.model.width()) / static_cast<float>(p.model.height()) : 1.0f;
  constexpr float pi = std::numbers::pi_v<float>;
  using Number = scalar::Scalar<float>;
  for (const auto& [value, name, is_literal] : constants) {
    if (value == 0) continue;
    const Replacer as(out, value, name);
    if (value > 0) as(std::sqrt(value), "without its square");
    as(value * aspect, "times the aspect ratio");
    as(value / aspect, "without the aspect ratio");
    as(value * 4, "four times as large");
    as(value / 4, "a quarter of itself");
    as(value + 1, "one more");
    as(value - 1, "one less");
    as(value * (pi / 180), "in degrees");
    as(value / (pi / 180), "in degrees for radians");
    // A number of stops, decibels or octaves is taken for a factor, or the reverse.
    if (std::abs(value) < 60) as(exp2(Number(value)).v, "as a power of two");
    if (std::abs(value) < 60) as(exp(Number(value)).v, "as an exponent of e");
    if (value > 0) as(log(Number(value)).v / std::numbers::ln2_v<float>, "as its logarithm to base two");
    if (value > 0) as(log(Number(value)).v, "as its logarithm");
    as(value * value * value, "cubed");
    as(std::floor(value), "cut to a whole number");
    as(std::floor(value + 0.5f), "rounded to a whole number");
    as(value * pi, "times pi");
    as(value / pi, "without pi");
  }
}

}  // namespace rainref::faults
