// A list that is too short or too long: its pass fails, and every other pass is judged. In every pack, for every list that a pass gives,
// and, where a port dumps what it takes, for every list that a pass takes.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "judge/mini_port.h"
#include "judge/shadow.h"

namespace rainref::judge {
namespace {

using capture::Array;
using capture::PassCase;

void set_length(Array& list, int records) {
  const std::size_t size = list.element_bytes();
  if (records > list.width)  // copies of the last record
    while (list.width < records) {
      const std::vector<std::byte> last(list.levels[0].end() - static_cast<std::ptrdiff_t>(size), list.levels[0].end());
      std::vector<std::byte>& all = list.levels[0].edit();
      all.insert(all.end(), last.begin(), last.end());
      ++list.width;
    }
  list.width = records;
  list.levels[0].edit().resize(size * static_cast<std::size_t>(records));
}

struct Length {
  const char* name;
  int (*of)(int records);
};
constexpr Length lengths[] = {
    {"empty", [](int) { return 0; }}, {"short", [](int n) { return n - 1; }}, {"long", [](int n) { return n + 1; }}};

class ListLengths : public testing::TestWithParam<test::PackPasses> {};

TEST_P(ListLengths, AnotherLengthFailsThePassAndEndsNothing) {
  for (const Length& length : lengths) {
    MiniPort port(GetParam().name);
    std::set<std::string> wrong, judged;
    port.after = [&](const PassCase& c, std::vector<Array>& out) {
      for (std::size_t o = 0; o < out.size(); ++o) {
        if (c.outputs[o].judge == capture::Judge::input_only) continue;
        judged.insert(c.pass);
        if (!out[o].is_records || out[o].width == 0) continue;
        set_length(out[o], length.of(out[o].width));
        wrong.insert(c.pass);
      }
    };
    const PortJudgement j = judge::judged(port);
    EXPECT_TRUE(j.files.empty()) << length.name << ": " << j.files.front().text;
    for (const std::string& pass : judged)
      EXPECT_EQ(pass_of(j, pass).status == Status::fail, wrong.contains(pass)) << length.name << ' ' << pass << '\n' << why(j);
  }
}

TEST_P(ListLengths, WhatAPortTookEndsNothingEither) {
  static std::set<std::string> tried;  // what another pack of the variant has tried is the same here
  std::set<std::string> lists;
  const capture::Pack pack(small_packs / GetParam().name);
  for (const capture::PackCase& entry : pack.cases)
    for (const PassCase c = pack.read(entry); const auto& in : c.inputs)
      if (in.array.is_records && tried.insert(GetParam().effect_and_variant() + ' ' + c.pass + ' ' + in.name).second) lists.insert(in.name);
  for (const std::string& list : lists) {
    for (const Length& length : lengths) {
      std::set<std::string> passes, wrong;
      const TemporaryFolder folder;
      for (const capture::PackCase& entry : pack.cases) {
        PassCase c = pack.read(entry);
        for (const capture::CaseOutput& out : c.outputs) put_array(folder / entry.id, "out." + out.name, out.array);
        put_bytes(folder / entry.id / "uniforms.bin", c.uniforms);
        for (capture::CaseInput& in : c.inputs) {
          if (in.name == list) {
            passes.insert(c.pass);
            if (in.array.width > 0) {
              set_length(in.array, length.of(in.array.width));
              wrong.insert(c.pass);
            }
          }
          put_array(folder / entry.id, "in." + in.name, in.array);
        }
      }
      const ShadowPlan plan = ShadowPlan::of_manifest(pack, false);
      std::vector<std::string> all;
      for (const capture::PackPass& p : plan.passes) all.push_back(p.name);
      ValidateOptions options;
      options.executor = &test_executor();
      options.only.assign(passes.begin(), passes.end());
      const PortJudgement j = shadow(plan, folder.path(), dumped_runs(folder.path(), plan.effect, all), options);
      for (const std::string& pass : passes)
        EXPECT_EQ(pass_of(j, pass).status == Status::fail, wrong.contains(pass)) << list << ' ' << length.name << ' ' << pass << '\n'
                                                                                 << why(j);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, ListLengths, testing::ValuesIn(test::shipped_packs()), [](const auto& about) {
  std::string name = about.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace rainref::judge
