// A list whose records have no id: record i is invocation i. The drops of the puddle as published.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "judge/mini_port.h"
#include "judge/profiles.h"
#include "reports/html.h"
#include "reports/source.h"

namespace rainref::judge {
namespace {

using capture::Array;
using capture::PassCase;
using testing::HasSubstr;

class PlacedList : public testing::Test {
 protected:
  MiniPort port{"puddle-as-published"};

  PassJudgement judged(const std::string& profile = "vulkan") {
    ValidateOptions options;
    options.profile = profile;
    options.only = {"raindrops"};
    options.explain = faults::diagnose;
    return pass_of(judge::judged(port, options), "raindrops");
  }
  /// A change of the port's drops in every case.
  void change(const std::function<void(Array&)>& how) {
    port.after = [how](const PassCase& c, std::vector<Array>& out) {
      if (c.pass == "raindrops") how(out[0]);
    };
  }
  static float field(const Array& a, int i, int k) {
    float f;
    std::memcpy(&f, a.levels[0].data() + 16 * i + 4 * k, 4);
    return f;
  }
  static void set_field(Array& a, int i, int k, float f) { std::memcpy(a.levels[0].edit().data() + 16 * i + 4 * k, &f, 4); }
};

TEST_F(PlacedList, TheReferencePassesUnderEveryProfile) {
  for (const std::string& profile : profile_names()) {
    const PassJudgement p = judged(profile);
    EXPECT_EQ(p.status, Status::pass) << profile << ' ' << p.reason;
    ASSERT_EQ(p.cases.size(), 2u);
    const OutputJudgement& o = p.cases[0].outputs.at(0);
    EXPECT_EQ(o.counted, Counted::fields);
    EXPECT_EQ(o.elements, 40);
    EXPECT_EQ(o.differing, 0);
    ASSERT_EQ(o.quantities.size(), 4u);
    EXPECT_EQ(o.quantities[0].name, "x");
    EXPECT_EQ(o.quantities[2].name, "amplitude");
    EXPECT_GT(o.quantities[0].extent, 10);  // the wave's columns, not the declared 0 to 1
  }
}

// What a GPU may be off by lies inside, ten times as much does not.
TEST_F(PlacedList, AnEnvelopeHoldsEachField) {
  const PassJudgement exact = judged();
  const double width = exact.cases[0].outputs[0].quantities[0].p99_width;
  ASSERT_GT(width, 0.01);
  ASSERT_LT(width, 2);
  for (const int k : {0, 1, 2, 3}) {
    change([&](Array& a) {
      for (int i = 0; i < a.width; ++i) set_field(a, i, k, field(a, i, k) + static_cast<float>(10 * width));
    });
    const PassJudgement p = judged();
    EXPECT_EQ(p.status, Status::fail) << k;
    const OutputJudgement& o = p.cases[0].outputs[0];
    EXPECT_EQ(o.failing, 10) << k;
    ASSERT_FALSE(o.worst.empty());
    EXPECT_EQ(o.worst[0].field, (std::array{"x", "y", "amplitude", "radius"})[static_cast<std::size_t>(k)]);
    EXPECT_EQ(o.quantities[static_cast<std::size_t>(k)].failing, 10);
  }
  change([](Array& a) { set_field(a, 3, 1, std::numeric_limits<float>::quiet_NaN()); });
  EXPECT_EQ(judged().cases[0].outputs[0].failing, 1);
}

TEST_F(PlacedList, ThePlaceIsTheKey) {
  change([](Array& a) {
    std::vector<std::byte>& records = a.levels[0].edit();
    std::rotate(records.begin(), records.begin() + 16, records.end());
  });
  const PassJudgement p = judged();
  EXPECT_EQ(p.status, Status::fail);
  ASSERT_FALSE(p.causes.empty());
  EXPECT_THAT(p.causes[0].name, HasSubstr("one column off"));
}

TEST_F(PlacedList, AnotherNumberOfRecordsFails) {
  for (const int by : {-1, 1}) {
    change([by](Array& a) {
      a.width += by;
      a.levels[0].edit().resize(16 * static_cast<std::size_t>(a.width));
    });
    const TemporaryFolder folder;
    port.run(folder.path());
    ValidateOptions options;
    options.only = {"raindrops"};
    options.executor = &test_executor();
    const PortJudgement j = validate(port.pack, folder.path(), options);
    EXPECT_TRUE(j.files.empty()) << "a file that can be read";
    const PassJudgement& drops = pass_of(j, "raindrops");
    EXPECT_EQ(drops.status, Status::fail);
    EXPECT_EQ(drops.reason, by < 0 ? "out.drops: expected 10 records, found 9" : "out.drops: expected 10 records, found 11");
  }
}

TEST_F(PlacedList, AMistakeIsNamed) {
  for (const auto& [k, name] : {std::pair{0, "first two channels swapped"}, std::pair{2, "without its z"}}) {
    change([&](Array& a) {
      for (int i = 0; i < a.width; ++i) {
        const float x = field(a, i, 0);
        if (k == 0) set_field(a, i, 0, field(a, i, 1)), set_field(a, i, 1, x);
        if (k == 2) set_field(a, i, 2, 0);
      }
    });
    const PassJudgement p = judged();
    EXPECT_EQ(p.status, Status::fail);
    ASSERT_FALSE(p.causes.empty()) << name;
    EXPECT_THAT(p.causes[0].name, HasSubstr(name));
  }
}

// Fields by their names, records by their place.
TEST_F(PlacedList, ThePageShowsItsFields) {
  change([](Array& a) { set_field(a, 7, 1, field(a, 7, 1) + 9); });
  const TemporaryFolder folder;
  port.run(folder.path());
  ValidateOptions options;
  options.only = {"raindrops"};
  options.executor = &test_executor();
  const PortJudgement j = validate(port.pack, folder.path(), options);
  const std::string page =
      reports::report_html(j, 1, reports::page_source(std::make_shared<const capture::Pack>(port.pack.folder()), folder.path()));
  EXPECT_THAT(page, HasSubstr("\"more\": 0,\n\"rows\": [\n[\n\"7\",\n\"y\",\n"));
}

}  // namespace
}  // namespace rainref::judge
