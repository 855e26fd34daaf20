// What a mistake makes of the numbers in a finished list: of passes whose numbers cannot be followed.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <optional>

#include <fmt/format.h>

#include "faults/list_adder.h"
#include "faults/whole_faults.h"

namespace rainref::faults {
namespace {

using capture::PassCase;
using scene::Member;

/// A number of the uniform block, and what it is called.
struct Named {
  float value;
  std::string name;
};
std::vector<Named> numbers_of_block(const Probed& p) {
  std::vector<Named> out;
  for (const Member& m : p.pass.block.members) {
    if (m.name.starts_with("padding") || m.name == "seed" || m.name == "step") continue;
    for (int k = 0; k < m.components; ++k) {
      const std::byte* const at = p.c.uniforms.data() + m.offset + 4 * static_cast<std::size_t>(k);
      float value;
      std::int32_t whole;
      std::memcpy(&value, at, 4);
      std::memcpy(&whole, at, 4);
      if (m.scalar != scene::Scalar::float32) value = static_cast<float>(whole);
      if (value != 0 && std::isfinite(value)) out.push_back({value, m.components == 1 ? m.name : fmt::format("{}.{}", m.name, "xyzw"[k])});
    }
  }
  return out;
}

}  // namespace

void add_member_faults(std::vector<Fault>& out, const Probed& p, std::size_t output) {
  const scene::UniformBlock& layout = p.c.outputs[output].array.record;
  struct Part {
    std::size_t offset;
    std::string name;
  };
  std::vector<Part> parts;
  for (const Member& m : layout.members)
    for (int k = 0; m.scalar == scene::Scalar::float32 && !m.name.starts_with("padding") && k < m.components; ++k)
      parts.push_back({m.offset + 4 * static_cast<std::size_t>(k), m.components == 1 ? m.name : fmt::format("{}.{}", m.name, "xyzw"[k])});
  using Change = std::function<float(float, const std::vector<std::byte>&)>;
  const auto add = [&](const std::vector<Part>& of, std::string name, std::string sentence, const Change& change) {
    Fault d;
    d.name = std::move(name);
    d.sentence = std::move(sentence);
    d.list_output = static_cast<int>(output);
    d.alter_list = [of, change](const PassCase&, ListEdit& e) {
      for (auto& r : e.records) {
        const std::vector<std::byte> right = r;
        for (const Part& part : of) {
          const float v = change(float_at(right, part.offset), right);
          std::memcpy(&r[part.offset], &v, 4);
        }
      }
      return true;
    };
    d.for_diagnosis = true;
    out.push_back(std::move(d));
  };
  const std::vector<Named> numbers = numbers_of_block(p);
  const auto changes = [&](const std::vector<Part>& of, const std::string& name) {
    const auto one = [&](const char* what, const char* sentence, float (*change)(float)) {
      add(of, fmt::format("{} {}", name, what), fmt::format("{} {}", name, sentence),
          [change](float v, const std::vector<std::byte>&) { return change(v); });
    };
    one("negated", "has the other sign", [](float v) { return -v; });
    one("zero", "is 0", [](float) { return 0.0f; });
    one("twice as large", "is twice as large: a diameter for a radius, a factor 2", [](float v) { return 2 * v; });
    one("half as large", "is half as large: a radius for a diameter, a factor 1/2", [](float v) { return v / 2; });
    one("half more", "is 1/2 too large: half a texel", [](float v) { return v + 0.5f; });
    one("half less", "is 1/2 too small: half a texel", [](float v) { return v - 0.5f; });
    one("without its fraction", "is cut to a whole number", [](float v) { return std::floor(v); });
    one("rounded", "is rounded to a whole number", [](float v) { return std::floor(v + 0.5f); });
    one("from 1 down", "is taken from 1: 1 less what it should be", [](float v) { return 1 - v; });
    one("without its magnitude's sign", "has lost its sign", [](float v) { return std::abs(v); });
    one("squared", "is squared", [](float v) { return v * v; });
    for (const Named& n : numbers) {
      add(of, fmt::format("{} taken from {}", name, n.name),
          fmt::format("{0} is {1} - {0}: it runs the other way, from the opposite edge", name, n.name),
          [v = n.value](float x, const std::vector<std::byte>&) { return v - x; });
      add(of, fmt::format("{} times {}", name, n.name), fmt::format("{} is multiplied by {}", name, n.name),
          [v = n.value](float x, const std::vector<std::byte>&) { return x * v; });
      add(of, fmt::format("{} over {}", name, n.name), fmt::format("{} is divided by {}", name, n.name),
          [v = n.value](float x, const std::vector<std::byte>&) { return x / v; });
    }
    for (const float factor : {256.0f, 65536.0f, 16777216.0f, 255.0f})
      for (const bool is_over : {false, true})
        add(of, fmt::format("{} {} {}", name, is_over ? "over" : "times", factor),
            fmt::format("{} is {} what it should be: a conversion from bits of a word with another {}", name,
                        is_over ? fmt::format("1/{} of", factor) : fmt::format("{} times", factor), is_over ? "divisor" : "factor"),
            [factor, is_over](float x, const std::vector<std::byte>&) { return is_over ? x / factor : x * factor; });
  };
  for (const Part& part : parts) changes({part}, part.name);
  for (std::size_t k = 0; k + 1 < parts.size(); ++k) changes({parts[k], parts[k + 1]}, parts[k].name + " and " + parts[k + 1].name);
  for (const Part& to : parts)
    for (const Part& from : parts) {
      if (to.offset == from.offset) continue;
      add({to}, fmt::format("{} for {}", from.name, to.name), fmt::format("{} stands where {} is meant", from.name, to.name),
          [at = from.offset](float, const std::vector<std::byte>& right) { return float_at(right, at); });
      if (to.offset > from.offset) continue;
      Fault both = out.back();
      both.name = fmt::format("{} and {} exchanged", to.name, from.name);
      both.sentence = fmt::format("{} and {} stand in each other's place", to.name, from.name);
      both.alter_list = [a = to.offset, b = from.offset](const PassCase&, ListEdit& e) {
        for (auto& r : e.records) std::swap_ranges(&r[a], &r[a] + 4, &r[b]);
        return true;
      };
      out.push_back(std::move(both));
    }
  const auto of_list = [&](std::string name, std::string sentence, std::function<bool(const PassCase&, ListEdit&)> change) {
    Fault d;
    d.name = std::move(name);
    d.sentence = std::move(sentence);
    d.list_output = static_cast<int>(output);
    d.alter_list = std::move(change);
    d.for_diagnosis = true;
    out.push_back(std::move(d));
  };
  const std::string list = p.c.outputs[output].name;
  of_list(list + " in the reverse order", fmt::format("{} is written from the last record to the first", list),
          [](const PassCase&, ListEdit& e) { return std::reverse(e.records.begin(), e.records.end()), true; });
  of_list(list + " without its first record", fmt::format("the first record of {} is left out: a loop that begins at 1", list),
          [](const PassCase&, ListEdit& e) {
            if (!e.records.empty()) e.records.erase(e.records.begin());
            return true;
          });
  of_list(list + " without its last record", fmt::format("the last record of {} is left out: a loop that ends one early", list),
          [](const PassCase&, ListEdit& e) {
            if (!e.records.empty()) e.records.pop_back();
            return true;
          });
}

}  // namespace rainref::faults
