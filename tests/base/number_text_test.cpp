// Text becomes the nearest number, or nothing, whatever the locale and the caller's rounding.
#include "base/number_text.h"

#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <clocale>
#include <limits>
#include <random>
#include <string>

#include <fmt/format.h>

#include "base/hostile_state.h"

namespace rainref {
namespace {

TEST(NumberText, ReadsWhatANumberIs) {
  EXPECT_EQ(number_from<double>("0"), 0.0);
  EXPECT_EQ(number_from<double>("12"), 12.0);
  EXPECT_EQ(number_from<double>("-1.5"), -1.5);
  EXPECT_EQ(number_from<double>(".5"), 0.5);
  EXPECT_EQ(number_from<double>("5."), 5.0);
  EXPECT_EQ(number_from<double>("25e-2"), 0.25);
  EXPECT_EQ(number_from<double>("1E+3"), 1000.0);
  EXPECT_EQ(number_from<double>("0e999"), 0.0);
  EXPECT_TRUE(std::signbit(*number_from<double>("-0")));
  EXPECT_EQ(number_from<float>("0.1"), 0.1f);
}

TEST(NumberText, ReadsNothingElse) {
  for (const char* text : {"",    " 1",   "1 ",  "+1",  "-",    ".",   "-.",       "e5",  "1e", "1e+",  "1e5.", "1.2.3",
                           "--1", "0x10", "1p3", "inf", "-inf", "nan", "infinity", "1,5", "1f", "1e5 ", "12a"}) {
    EXPECT_EQ(number_from<double>(text), std::nullopt) << "'" << text << "'";
    EXPECT_EQ(number_from<float>(text), std::nullopt) << "'" << text << "'";
  }
  EXPECT_EQ(number_from<double>(std::string_view("1\0", 2)), std::nullopt);
  EXPECT_EQ(number_from<double>(std::string_view("15", 1)), 1.0) << "not beyond the end";
}

TEST(NumberText, RefusesWhatTheTypeCannotHold) {
  EXPECT_EQ(number_from<double>("1.7976931348623157e308"), std::numeric_limits<double>::max());
  EXPECT_EQ(number_from<double>("1.8e308"), std::nullopt);
  EXPECT_EQ(number_from<double>("-1e999999999999"), std::nullopt);
  EXPECT_EQ(number_from<double>("4.9406564584124654e-324"), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(number_from<double>("1e-400"), std::nullopt);
  EXPECT_EQ(number_from<float>("1e39"), std::nullopt);
  EXPECT_EQ(number_from<float>("1e-45"), std::numeric_limits<float>::denorm_min());
}

// Exactly between two doubles, and one digit far behind that decides.
TEST(NumberText, RoundsOnceToTheNearestTiesToEven) {
  EXPECT_EQ(number_from<double>("9007199254740993"), 9007199254740992.0);  // 2^53 + 1
  EXPECT_EQ(number_from<double>("9007199254740995"), 9007199254740996.0);  // 2^53 + 3
  EXPECT_EQ(number_from<double>("9007199254740993." + std::string(1000, '0') + "1"), 9007199254740994.0);
  // Rounded to double first this would lie between two floats, and then go to the even one, which is not the nearest.
  EXPECT_EQ(number_from<float>("1.000000059604644776"), 0x1.000002p0f);
}

// 17 digits tell every double and 9 every float; the library's own reader is the second opinion.
TEST(NumberText, GivesEveryDoubleBack) {
  std::mt19937_64 draw(1);
  for (int i = 0; i < 200000; ++i) {
    const double x = std::bit_cast<double>(draw());
    const float f = std::bit_cast<float>(static_cast<std::uint32_t>(draw()));
    if (std::isfinite(x)) {
      ASSERT_EQ(number_from<double>(fmt::format("{:.17g}", x)), x);
      ASSERT_EQ(number_from<double>(fmt::format("{}", x)), x);
    }
    if (std::isfinite(f)) {
      ASSERT_EQ(number_from<float>(fmt::format("{:.9g}", f)), f);
    }
#ifdef __cpp_lib_to_chars
    const std::string text = fmt::format("{}.{}e{}", draw() % 1000, draw(), static_cast<int>(draw() % 640) - 320);
    double other = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), other);
    ASSERT_EQ(number_from<double>(text), error == std::errc() ? std::optional(other) : std::nullopt) << text;
#endif
  }
}

// A host program that speaks German reads "0,5".
TEST(NumberText, NoLocaleAndNoRoundingOfTheCallerBearOnIt) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  bool has_comma = false;
  for (const char* name : {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8", "C.UTF-8"}) {
    if (!std::setlocale(LC_ALL, name)) continue;
    has_comma = has_comma || *std::localeconv()->decimal_point == ',';
    EXPECT_EQ(number_from<double>("0.5"), 0.5) << name;
    EXPECT_EQ(number_from<double>("0,5"), std::nullopt) << name;
  }
  std::setlocale(LC_ALL, before.c_str());
  RecordProperty("has_comma", has_comma);
  for (const test::HostileState& state : test::hostile_states()) {
    const test::KeepFloatingPoint keep;
    set_floating_point_control(state.control);
    const std::optional<double> found = number_from<double>("0.1"), smallest = number_from<double>("1e-310");
    set_floating_point_control(pinned_floating_point_control);
    EXPECT_EQ(found, 0.1) << state.name;
    EXPECT_EQ(smallest, 1e-310) << state.name;
  }
}

TEST(WholeText, ReadsWhatTheTypeHoldsAndNothingElse) {
  EXPECT_EQ(whole_from<int>("0"), 0);
  EXPECT_EQ(whole_from<int>("007"), 7);
  EXPECT_EQ(whole_from<int>("-12"), -12);
  EXPECT_EQ(whole_from<std::int64_t>("9223372036854775807"), INT64_MAX);
  EXPECT_EQ(whole_from<std::uint32_t>("ffffffff", 16), 0xffffffffu);
  EXPECT_EQ(whole_from<int>(std::string_view("15", 1)), 1) << "not beyond the end";
  // The library's reader comes to the end of a number that is too large, too.
  for (const char* text : {"9223372036854775808", "99999999999999999999", "-9223372036854775809"})
    EXPECT_EQ(whole_from<std::int64_t>(text), std::nullopt) << text;
  EXPECT_EQ(whole_from<std::uint32_t>("100000000", 16), std::nullopt);
  for (const char* text : {"", "-", "+1", " 1", "1 ", "1x", "0x10", "1.0", "1e3", "--1"})
    EXPECT_EQ(whole_from<int>(text), std::nullopt) << text;
  EXPECT_EQ(whole_from<unsigned>("-1"), std::nullopt);
}

}  // namespace
}  // namespace rainref
