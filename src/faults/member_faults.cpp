// Mistakes in the numbers of a finished list, for passes that cannot be traced.
#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "faults/generators.h"
#include "faults/list_faults.h"
#include "faults/members.h"

namespace rainref::faults {
namespace {

using capture::PassCase;
using scene::Member;

/// A number of the uniform block, and its name.
struct Named {
  float value;
  std::string name;
};
std::vector<Named> numbers_of_block(const Probed& p) {
  std::vector<Named> out;
  for (const Member& m : p.pass.block.members) {
    if (is_padding(m) || m.name == "seed" || m.name == "step") continue;
    for (int k = 0; k < m.components; ++k) {
      const std::byte* const all = p.c.uniforms.data();
      const float value = m.scalar == scene::Scalar::float32 ? number_at<float>(all, offset_of(m, k))
                                                             : static_cast<float>(number_at<std::int32_t>(all, offset_of(m, k)));
      if (value != 0 && std::isfinite(value)) out.push_back({value, part_name(m, k)});
    }
  }
  return out;
}

}  // namespace

void add_member_faults(std::vector<Fault>& out, const Probed& p, std::size_t output) {
  const std::vector<Part> parts = float_parts(p.c.outputs[output].array.record);
  using Change = std::function<float(float, const std::vector<std::byte>&)>;
  const auto add = [&](What what, std::function<bool(const PassCase&, ListEdit&)> change) {
    Fault& d = out.emplace_back(std::move(what));
    d.list_output = static_cast<int>(output);
    d.alter_list = std::move(change);
  };
  const auto each = [&](const std::vector<Part>& of, What what, const Change& change) {
    add(std::move(what), [of, change](const PassCase&, ListEdit& e) {
      for (auto& r : e.records) {
        const std::vector<std::byte> right = r;
        for (const Part& part : of) put_number(r.data(), part.offset, change(float_at(right, part.offset), right));
      }
      return true;
    });
  };
  const std::vector<Named> numbers = numbers_of_block(p);
  const auto changes = [&](const std::vector<Part>& of, const std::string& name) {
    const auto what = [&](Kind kind, const std::string& number = "") {
      What made{kind, {name, number}};
      made.head = of[0].name;
      return made;
    };
    const auto one = [&](Kind kind, float (*change)(float)) {
      each(of, what(kind), [change](float v, const std::vector<std::byte>&) { return change(v); });
    };
    one(Kind::member_negated, [](float v) { return -v; });
    one(Kind::member_zero, [](float) { return 0.0f; });
    one(Kind::member_doubled, [](float v) { return 2 * v; });
    one(Kind::member_halved, [](float v) { return v / 2; });
    one(Kind::member_half_more, [](float v) { return v + 0.5f; });
    one(Kind::member_half_less, [](float v) { return v - 0.5f; });
    one(Kind::member_cut, [](float v) { return std::floor(v); });
    one(Kind::member_rounded, [](float v) { return std::floor(v + 0.5f); });
    one(Kind::member_from_1, [](float v) { return 1 - v; });
    one(Kind::member_without_sign, [](float v) { return std::abs(v); });
    one(Kind::member_squared, [](float v) { return v * v; });
    for (const Named& n : numbers) {
      const auto with = [&](Kind kind, float (*change)(float, float)) {
        each(of, what(kind, n.name), [v = n.value, change](float x, const std::vector<std::byte>&) { return change(x, v); });
      };
      with(Kind::member_from_number, [](float x, float v) { return v - x; });
      with(Kind::member_times_number, [](float x, float v) { return x * v; });
      with(Kind::member_over_number, [](float x, float v) { return x / v; });
    }
    for (const float factor : {256.0f, 65536.0f, 16777216.0f, 255.0f})
      for (const bool is_over : {false, true})
        each(of, what(is_over ? Kind::member_over_factor : Kind::member_times_factor, fmt::format("{}", factor)),
             [factor, is_over](float x, const std::vector<std::byte>&) { return is_over ? x / factor : x * factor; });
  };
  for (const Part& part : parts) changes({part}, part.name);
  for (std::size_t k = 0; k + 1 < parts.size(); ++k) changes({parts[k], parts[k + 1]}, parts[k].name + " and " + parts[k + 1].name);
  for (const Part& to : parts)
    for (const Part& from : parts) {
      if (to.offset == from.offset) continue;
      each({to}, {Kind::member_for_another, {from.name, to.name}},
           [at = from.offset](float, const std::vector<std::byte>& right) { return float_at(right, at); });
      if (to.offset > from.offset) continue;
      add({Kind::members_exchanged, {to.name, from.name}}, [a = to.offset, b = from.offset](const PassCase&, ListEdit& e) {
        for (auto& r : e.records) std::swap_ranges(&r[a], &r[a] + 4, &r[b]);
        return true;
      });
    }
  const std::string list = p.c.outputs[output].name;
  add({Kind::list_reversed, {list}}, [](const PassCase&, ListEdit& e) { return std::reverse(e.records.begin(), e.records.end()), true; });
  add({Kind::list_from_second, {list}}, [](const PassCase&, ListEdit& e) {
    if (!e.records.empty()) e.records.erase(e.records.begin());
    return true;
  });
  add({Kind::list_to_last_but_one, {list}}, [](const PassCase&, ListEdit& e) {
    if (!e.records.empty()) e.records.pop_back();
    return true;
  });
}

}  // namespace rainref::faults
