// Ports that keep a buffer in another scale, in other quantities, with fewer bits or without the id of its records: what is exact passes
// under the reference's own profile, and one mistake in it fails.
#include "image/code_range.h"
#include "judge/mini_port.h"

#include <array>
#include <cmath>
#include <cstring>
#include <tuple>

#include <gmock/gmock.h>

#include "math/half.h"
#include "math/unorm.h"

namespace rainref::judge {
namespace {

using capture::Array;
using capture::PassCase;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using Kind = FormatInfo::Kind;
using Texel = std::array<double, 4>;

void put_channel(Kind kind, double value, std::byte* to) {
  const auto number = static_cast<float>(value);
  const Half half = to_half(number);
  const Unorm8 code = to_unorm8(number);
  if (kind == Kind::float32) std::memcpy(to, &number, sizeof number);
  if (kind == Kind::float16) std::memcpy(to, &half, sizeof half);
  if (kind == Kind::unorm8) std::memcpy(to, &code, sizeof code);
}
/// The image in another format, with other values: `change(x, y, texel)`.
template <class Change>
Array kept_as(const Array& image, Format format, const Change& change) {
  Array out = image;
  out.format = format;
  const FormatInfo &from = info(image.format), &to = info(format);
  std::vector<std::byte> bytes(static_cast<std::size_t>(image.width * image.height * to.texel_bytes()));
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const auto at = static_cast<std::size_t>(y * image.width + x);
      Texel texel{};
      for (int c = 0; c < from.channels; ++c)
        texel[static_cast<std::size_t>(c)] =
            enclosed::code_value(from.kind, enclosed::ordered_code(from.kind, image.levels[0].data() + at * image.element_bytes() +
                                                                                  static_cast<std::size_t>(c * from.channel_bytes)));
      change(x, y, texel);
      for (int c = 0; c < to.channels; ++c)
        put_channel(to.kind, texel[static_cast<std::size_t>(c)],
                    bytes.data() + at * static_cast<std::size_t>(to.texel_bytes()) + static_cast<std::size_t>(c * to.channel_bytes));
    }
  out.levels = {capture::Bytes(std::move(bytes))};
  return out;
}

/// A port that keeps one output of one pass in its own way.
template <class Keep>
PortJudgement judged_of(const std::string& pack, const std::string& pass, std::size_t output, const std::string& encodings,
                        const std::string& profile, const Keep& keep) {
  MiniPort port(pack);
  port.after = [&](const PassCase& c, std::vector<Array>& out) {
    if (c.pass == pass) out[output] = keep(c, out[output]);
  };
  const TemporaryFolder folder;
  port.run(folder.path());
  put(folder / "port.json", R"({"encodings": )" + encodings + "}");
  ValidateOptions options;
  options.profile = profile;
  options.only = {pass};
  options.executor = &test_executor();
  return validate(port.pack, folder.path(), options);
}
int failing(const PortJudgement& j) {
  int count = 0;
  for (const PassJudgement& p : j.passes)
    for (const CaseJudgement& c : p.cases) count += static_cast<int>(c.failing);
  return count;
}

// ---- the published wave, with heights around 0 -----------------------------------------------------------------------
const char* const unbiased = R"({"wave": ["0.5*x + 0.5", "0.5*y + 0.5"]})";
PortJudgement unbiased_wave(const std::string& profile, Format format, const char* encodings = unbiased, double mistake = 0) {
  return judged_of("puddle-as-published", "wave_step", 0, encodings, profile, [&](const PassCase& c, const Array& wave) {
    return kept_as(wave, format, [&](int x, int y, Texel& t) {
      for (const std::size_t k : {0, 1}) t[k] = 2 * (t[k] - 0.5);
      if (c.frame == 12 && x == 5 && y == 7) t[0] += mistake;
    });
  });
}
TEST(Encodings, UnbiasedHeightsPassByTheBits) {
  for (const Format format : {Format::rg16f, Format::rg32f})
    for (const char* profile : {"ieee", "vulkan", "cuda"}) {
      const PortJudgement j = unbiased_wave(profile, format);
      EXPECT_EQ(j.status, Status::pass) << info(format).name << ' ' << profile << '\n' << why(j);
      EXPECT_THAT(j.notes, Contains(HasSubstr("encodings.wave: the port's own form rounds, so its envelopes are wider, by at most ")));
    }
}
TEST(Encodings, OneHeightOffFailsAlone) {
  for (const char* profile : {"ieee", "vulkan"}) {
    const PortJudgement j = unbiased_wave(profile, Format::rg16f, unbiased, 0.01);
    EXPECT_EQ(j.status, Status::fail) << profile;
    EXPECT_EQ(failing(j), 1) << profile;
  }
}
TEST(Encodings, AWrongNumberFails) {
  EXPECT_EQ(unbiased_wave("vulkan", Format::rg16f, R"({"wave": ["0.5*x + 0.49", "0.5*y + 0.5"]})").status, Status::fail);
  EXPECT_EQ(unbiased_wave("vulkan", Format::rg16f, R"({"wave": ["0.49*x + 0.5", "0.5*y + 0.5"]})").status, Status::fail);
}

// ---- height and velocity ---------------------------------------------------------------------------------------------
PortJudgement moving_wave(const std::string& profile, Format format, const char* encodings, double sign = 1) {
  return judged_of("puddle-corrected", "wave_step", 0, encodings, profile, [&](const PassCase&, const Array& wave) {
    return kept_as(wave, format, [&](int, int, Texel& t) { t[1] = sign * (t[0] - t[1]); });
  });
}
TEST(Encodings, AVelocityGivesThePreviousHeight) {
  for (const char* profile : {"ieee", "vulkan"}) {
    const PortJudgement halves = moving_wave(profile, Format::rg16f, R"({"wave": ["x", "x-y"]})");
    EXPECT_EQ(halves.status, Status::pass) << profile << '\n' << why(halves);
    const PortJudgement floats = moving_wave(profile, Format::rg32f, R"({"wave": ["1*x", "x-y"]})");
    EXPECT_EQ(floats.status, Status::pass) << profile << '\n' << why(floats);
    EXPECT_EQ(moving_wave(profile, Format::rg16f, R"({"wave": ["x", "x+y"]})").status, Status::fail) << profile;
    EXPECT_EQ(moving_wave(profile, Format::rg16f, R"({"wave": ["x", "x-y"]})", -1).status, Status::fail) << profile;
    EXPECT_EQ(moving_wave(profile, Format::rg16f, R"({"wave": ["x", "x-1.5*y"]})").status, Status::fail) << profile;
  }
}

// ---- a normal in 8 bits ----------------------------------------------------------------------------------------------
PortJudgement coded_normal(const std::string& profile, double mistake = 0) {
  return judged_of("puddle-corrected", "surface_hit", 1, R"({"normal": ["2*r-1", "2*g-1", "2*b-1", "1*a"]})", profile,
                   [&](const PassCase& c, const Array& normal) {
                     return kept_as(normal, Format::rgba8, [&](int x, int y, Texel& t) {
                       for (const std::size_t k : {0, 1, 2}) t[k] = t[k] / 2 + 0.5;
                       if (c.frame == 12 && x == 20 && y == 3) t[1] -= mistake;
                     });
                   });
}
TEST(Encodings, CodesForHalvesPassWithinTheirStep) {
  for (const char* profile : {"ieee", "vulkan"}) {
    const PortJudgement j = coded_normal(profile);
    EXPECT_EQ(j.status, Status::pass) << profile << '\n' << why(j);
    EXPECT_EQ(coded_normal(profile, 0.02).status, Status::fail) << profile;
  }
  // The report shows what that costs: without it the envelope of the normal is a few halves wide.
  const auto width = [](const PortJudgement& j) { return j.passes.at(0).cases.at(0).outputs.at(1).quantities.at(0).median_width; };
  EXPECT_GT(width(coded_normal("vulkan")), 2 * 2 * 0.6 / 255 * 0.99);
  MiniPort own("puddle-corrected");
  ValidateOptions options;
  options.only = {"surface_hit"};
  EXPECT_LT(width(judged(own, options)), 0.002);
}
// What bounds nothing is no proof.
TEST(Encodings, AFormThatHoldsNothingIsUntested) {
  const PortJudgement j = judged_of("puddle-corrected", "wave_step", 0, R"({"wave": ["100*x-50", "100*y-50"]})", "vulkan",
                                    [&](const PassCase&, const Array& wave) {
                                      return kept_as(wave, Format::rg8, [](int, int, Texel& t) {
                                        for (const std::size_t k : {0, 1}) t[k] = (t[k] + 50) / 100;
                                      });
                                    });
  EXPECT_EQ(j.status, Status::untested) << why(j);
}

// ---- what is exact ---------------------------------------------------------------------------------------------------
PortJudgement doubled_colour(const std::string& profile, const char* encodings) {
  return judged_of("puddle-corrected", "shade", 0, encodings, profile, [&](const PassCase&, const Array& colour) {
    return kept_as(colour, Format::rgba16f, [](int, int, Texel& t) {
      for (const std::size_t k : {0, 1, 2}) t[k] *= 2;
    });
  });
}
TEST(Encodings, APowerOfTwoWidensNothing) {
  const char* const exact = R"({"colour": ["0.5*x", "0.5*y", "0.5*z", "w"]})";
  for (const char* profile : {"ieee", "vulkan"}) {
    const PortJudgement j = doubled_colour(profile, exact);
    EXPECT_EQ(j.status, Status::pass) << profile << '\n' << why(j);
    EXPECT_THAT(j.notes, Not(Contains(HasSubstr("encodings.colour")))) << profile;
  }
  EXPECT_EQ(doubled_colour("vulkan", R"({"colour": ["0.51*x", "0.51*y", "0.51*z", "w"]})").status, Status::fail);
}

// ---- the article's drop ----------------------------------------------------------------------------------------------
const char* const drop_members = R"({"drops": {"members": ["position", "velocity", "mass", "life"]}})";
/// The records without their id: 24 bytes each.
Array without_ids(const Array& list) {
  Array out = list;
  out.record.members.resize(4);
  out.record.size = 24;
  std::vector<std::byte> bytes;
  for (int i = 0; i < list.width; ++i) {
    const std::byte* record = list.levels[0].data() + static_cast<std::size_t>(i) * list.element_bytes();
    bytes.insert(bytes.end(), record, record + 24);
  }
  out.levels = {capture::Bytes(std::move(bytes))};
  return out;
}
/// `change` gets the bytes of the second case, and their records' number.
template <class Change>
PortJudgement judged_drops(const std::string& profile, const char* members, const Change& change) {
  return judged_of("windshield-as-published", "integrate", 0, members, profile, [&](const PassCase& c, const Array& list) {
    Array out = without_ids(list);
    if (c.frame > 0) change(out);
    return out;
  });
}
const auto unchanged = [](Array&) {};

TEST(Encodings, RecordsWithoutAnIdAreMatchedByTheirPlace) {
  for (const char* profile : {"ieee", "vulkan"}) {
    const PortJudgement j = judged_drops(profile, drop_members, unchanged);
    EXPECT_EQ(j.status, Status::pass) << profile << '\n' << why(j);
    EXPECT_THAT(j.notes, Contains("encodings.drops: without id: record i is judged as the pack's record i"));
  }
}
TEST(Encodings, RecordsInAnotherOrderFail) {
  const PortJudgement j = judged_drops("vulkan", drop_members, [](Array& list) {
    std::vector<std::byte>& bytes = list.levels[0].edit();
    ASSERT_GE(list.width, 2);
    std::swap_ranges(bytes.begin(), bytes.begin() + 24, bytes.begin() + 24);
  });
  EXPECT_EQ(j.status, Status::fail);
}
TEST(Encodings, OneWrongMemberFails) {
  const PortJudgement j = judged_drops("vulkan", drop_members, [](Array& list) {
    change_at<float>(list.levels[0].edit().data() + 24 + 8, [](float velocity) { return velocity * 1.001f + 1e-4f; });
  });
  EXPECT_EQ(j.status, Status::fail);
  EXPECT_EQ(pass_of(j, "integrate").cases.back().outputs.at(0).worst.at(0).field, "velocity.x");
}
TEST(Encodings, AnotherNumberOfRecordsFails) {
  const PortJudgement j = judged_drops("vulkan", drop_members, [](Array& list) {
    --list.width;
    list.levels[0].edit().resize(static_cast<std::size_t>(list.width) * 24);
  });
  EXPECT_EQ(j.status, Status::fail);
  EXPECT_THAT(pass_of(j, "integrate").cases.back().reason, AllOf(HasSubstr("out.drops: expected "), HasSubstr(" records, found ")));
}
TEST(Encodings, AMemberThatIsJudgedMayNotBeMissing) {
  const auto refusal = [](const char* members) {
    const PortJudgement j = judged_drops("vulkan", members, unchanged);
    EXPECT_THAT(j.files, Not(IsEmpty()));
    return j.files.empty() ? "" : j.files.front().text;
  };
  EXPECT_THAT(refusal(R"({"drops": {"members": ["position", "velocity", "mass"]}})"),
              HasSubstr("encodings.drops: members: 'life' is missing; expected every member but an id, and those that are 0 everywhere"));
  EXPECT_THAT(refusal(R"({"drops": {"members": ["position", "vel", "mass", "life"]}})"),
              HasSubstr("expected members of Drop, found 'vel'"));
}

}  // namespace
}  // namespace rainref::judge
