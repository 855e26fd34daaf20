// A uniform block takes offsets from its struct; what some language would lay out otherwise is refused.
#include "scene/uniform_block.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include <glm/vec2.hpp>
#include <nlohmann/json.hpp>

#include "scene/example_effect.h"
#include "scene/json.h"

namespace rainref::scene {
namespace {

struct CameraPart {
  std::array<float, 3> position;
  float pixel_scale;
};

struct Example {
  CameraPart camera;
  glm::vec2 texel;
  std::int32_t drop_count;
  std::uint32_t seed_bits;
  float right[3];
  float padding0;
};

std::vector<Member> camera_members() {
  return {member<&CameraPart::position>("m", {-10, 10}, "Where it is."),
          member<&CameraPart::pixel_scale>("1", share, "Height of a pixel at distance 1.")};
}

Member at(std::size_t offset, int components, const std::string& name = "height") {
  return {name, Scalar::float32, components, offset, "m", "A height.", share};
}

std::string broken(std::size_t size, std::vector<Member> members, const std::string& name = "Block") {
  return error_of([&] { validate({name, size, std::move(members)}); });
}

TEST(UniformBlock, TakesNameTypeAndOffsetFromTheStruct) {
  const Member texel = member<&Example::texel>("1", "One texel.");
  EXPECT_EQ(texel.name, "texel");
  EXPECT_EQ(texel.offset, offsetof(Example, texel));
  EXPECT_EQ(texel.components, 2);
  EXPECT_EQ(texel.scalar, Scalar::float32);
  const Member count = member<&Example::drop_count>("1", "Drops.");
  EXPECT_EQ(count.offset, offsetof(Example, drop_count));
  EXPECT_EQ(count.components, 1);
  EXPECT_EQ(count.scalar, Scalar::int32);
  EXPECT_EQ(member<&Example::seed_bits>("1", "Bits.").scalar, Scalar::uint32);
  const Member right = member<&Example::right>("1", "Right.");
  EXPECT_EQ(right.offset, offsetof(Example, right));
  EXPECT_EQ(right.components, 3);
  EXPECT_EQ(member<&CameraPart::position>("m", "Where.").components, 3);
}

TEST(UniformBlock, ANestedStructGivesItsMembers) {
  struct Outer {
    float first[4];
    CameraPart camera;
  };
  const std::vector<Member> members = nested<&Outer::camera>("camera", camera_members());
  ASSERT_EQ(members.size(), 2u);
  EXPECT_EQ(members[0].name, "camera_position");
  EXPECT_EQ(members[0].offset, 16u);
  EXPECT_EQ(members[1].name, "camera_pixel_scale");
  EXPECT_EQ(members[1].offset, 28u);
}

TEST(UniformBlock, HasTheSizeOfItsStruct) {
  const UniformBlock block = uniform_block<Example>(nested<&Example::camera>("camera", camera_members()));
  EXPECT_EQ(block.size, sizeof(Example));
  EXPECT_EQ(block.name, "Example");
}

TEST(UniformBlock, GapsBecomePadding) {
  const UniformBlock block{"Block", 48, {at(4, 1, "a"), at(16, 3, "b"), at(32, 2, "c")}};
  std::vector<std::pair<std::string, std::size_t>> got;
  std::size_t end = 0;
  for (const Member& m : with_padding(block)) {
    EXPECT_EQ(m.offset, end) << "no byte is left out";
    end = m.offset + m.size();
    got.emplace_back(m.name, m.offset);
  }
  EXPECT_EQ(end, 48u);
  using Pair = std::pair<std::string, std::size_t>;
  EXPECT_THAT(got, testing::ElementsAre(Pair("padding_0", 0), Pair("a", 4), Pair("padding_1", 8), Pair("padding_2", 12), Pair("b", 16),
                                        Pair("padding_3", 28), Pair("c", 32), Pair("padding_4", 40), Pair("padding_5", 44)));
}

TEST(UniformBlock, WithoutGapsThereIsNoPadding) { EXPECT_EQ(with_padding({"Block", 16, {at(0, 3, "a"), at(12, 1, "b")}}).size(), 2u); }

TEST(ValidateBlock, RefusesMembersOutOfOrderOrOverlapping) {
  EXPECT_EQ(broken(16, {at(4, 1, "a"), at(0, 1, "b")}), "5 layout Block: 'b' at 0 begins before the member before it ends, at 8");
  EXPECT_EQ(broken(16, {at(0, 3, "a"), at(8, 1, "b")}), "5 layout Block: 'b' at 8 begins before the member before it ends, at 12");
}

TEST(ValidateBlock, RefusesMembersThatStraddleARowOrAreMisaligned) {
  EXPECT_EQ(broken(32, {at(12, 2)}), "5 layout Block: 'height' at 12 is not aligned to 8");
  EXPECT_EQ(broken(32, {at(4, 3)}), "5 layout Block: 'height' at 4 is not aligned to 16");
  EXPECT_EQ(broken(32, {at(8, 4)}), "5 layout Block: 'height' at 8 is not aligned to 16");
  EXPECT_EQ(broken(32, {at(2, 1)}), "5 layout Block: 'height' at 2 is not aligned to 4");
  EXPECT_EQ(broken(32, {at(8, 2, "a"), at(16, 4, "b")}), "none");
}

TEST(ValidateBlock, RefusesSizesThatAreNoRowsOrTooSmall) {
  EXPECT_EQ(broken(20, {at(0, 1)}), "5 layout Block: size 20 is not a multiple of 16");
  EXPECT_EQ(broken(16, {at(16, 1)}), "5 layout Block: members end at 20, beyond the size 16");
  EXPECT_EQ(broken(0, {}), "5 layout Block: no members");
}

TEST(ValidateBlock, RefusesVectorsOfOtherLengths) {
  EXPECT_EQ(broken(32, {at(0, 5)}), "5 layout Block: 'height' has 5 components");
  EXPECT_EQ(broken(32, {at(0, 0)}), "5 layout Block: 'height' has 0 components");
}

TEST(ValidateBlock, RefusesNamesThatSomeLanguageCannotUse) {
  for (const char* name : {"", "Height", "height__m", "1st", "_height", "he-ight"}) {
    EXPECT_EQ(broken(16, {at(0, 1, name)}), std::string("5 layout Block: '") + name + "' is no snake_case name");
  }
  // one each of C++, GLSL, HLSL, WGSL, and the first and last of the sorted list
  for (const char* name : {"union", "sample", "point", "target", "abstract", "yield", "xor_eq", "float3"}) {
    EXPECT_EQ(broken(16, {at(0, 1, name)}), std::string("5 layout Block: '") + name + "' is a reserved word of a shading language");
  }
  EXPECT_EQ(broken(16, {at(0, 1, "padding0")}), "5 layout Block: 'padding0': padding is not listed");
  EXPECT_EQ(broken(16, {at(0, 1), at(4, 1)}), "5 layout Block: 'height' is listed twice");
  EXPECT_EQ(broken(16, {at(0, 1)}, "block"), "5 layout block: the name must be UpperCamel");
  EXPECT_EQ(broken(16, {at(0, 1)}, "My_Block"), "5 layout My_Block: the name must be UpperCamel");
}

TEST(ValidateBlock, RefusesAMemberWithoutUnitOrSentence) {
  Member m = at(0, 1);
  m.unit = "";
  EXPECT_EQ(broken(16, {m}), "5 layout Block: 'height' has no unit");
  m = at(0, 1);
  m.sentence = "Two\nlines.";
  EXPECT_EQ(broken(16, {m}), "5 layout Block: 'height' has no sentence");
}

TEST(ValidateBlock, RefusesAMemberWithoutARange) {
  Member m = at(0, 1);
  m.range = std::nullopt;
  EXPECT_EQ(broken(16, {m}), "5 layout Block: 'height' has no range");
  m.range = Range{1, 0};
  EXPECT_EQ(broken(16, {m}), "5 layout Block: 'height' has an empty range");
}

struct Values {
  float share = 0.5f, steps = 3;
  std::int32_t count = 2;
  float free = 0;
};
std::string fault(const Values& values, std::optional<Range> free = std::nullopt) {
  const UniformBlock block{"Values",
                           16,
                           {member<&Values::share>("1", share, "S."), member<&Values::steps>("1", whole(1, 8), "S."),
                            member<&Values::count>("1", {0, 10}, "C."), member<&Values::free>("1", "F.")}};
  UniformBlock own = block;
  own.members.back().range = free;
  return value_fault(own, reinterpret_cast<const std::byte*>(&values));
}

TEST(ValueFault, NamesTheFirstValueOutOfItsRange) {
  EXPECT_EQ(fault({}), "");
  EXPECT_EQ(fault({.share = 0, .steps = 8, .count = 10}), "");
  EXPECT_EQ(fault({.share = 1.5f}), "share is 1.5, expected 0 to 1");
  EXPECT_EQ(fault({.share = -1e-30f}), "share is -1.0000000031710769e-30, expected 0 to 1");
  EXPECT_EQ(fault({.steps = 2.5f}), "steps is 2.5, expected a whole number from 1 to 8");
  EXPECT_EQ(fault({.count = -1}), "count is -1, expected 0 to 10");
  EXPECT_EQ(fault({.count = INT32_MIN}), "count is -2147483648, expected 0 to 10");
}

TEST(ValueFault, WhatIsNoFiniteNumberIsInNoRange) {
  const float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(fault({.share = nan}), "share is nan, expected 0 to 1");
  EXPECT_EQ(fault({.free = nan}), "free is nan, expected a finite number");
  EXPECT_EQ(fault({.free = -infinity}), "free is -inf, expected a finite number");
  EXPECT_EQ(fault({.free = 3.4e38f}), "");
}

// A tenth as a float is above a tenth: what a scene may say at an end of its range is no fault.
TEST(ValueFault, EndsAreRoundedAsTheValuesAre) {
  EXPECT_EQ(fault({.free = 0.1f}, Range{0, 0.1}), "");
  EXPECT_NE(fault({.free = std::nextafterf(0.1f, 1)}, Range{0, 0.1}), "");
}

TEST(ValidateRecord, NeedsWholeAlignmentsNotWholeRows) {
  const auto error = [](std::size_t size, const Member& m) { return error_of([&] { validate_record({"Drop", size, {m}}); }); };
  EXPECT_EQ(error(12, at(0, 1)), "none");
  EXPECT_EQ(error(12, at(0, 2)), "5 layout Drop: size 12 is not a multiple of 8");
  EXPECT_EQ(error(24, at(0, 3)), "5 layout Drop: size 24 is not a multiple of 16");
  EXPECT_EQ(error(24, at(8, 2)), "none");
}

TEST(UniformBlock, DeclaringABadOneThrows) {
  struct Bad {
    float a;
    float b[3];
  };
  EXPECT_EQ(error_of([] { uniform_block<Bad>({member<&Bad::b>("1", share, "B.")}); }), "5 layout Bad: 'b' at 4 is not aligned to 16");
  struct Short {
    float a, b;
  };
  EXPECT_EQ(error_of([] { uniform_block<Short>({member<&Short::a>("1", share, "A.")}); }),
            "5 layout Short: size 8 is not a multiple of 16");
  EXPECT_EQ(record<Short>({member<&Short::b>("1", "B.")}).members[0].offset, 4u);
}

TEST(UniformBlock, JsonHasEachMembersPlace) {
  EXPECT_EQ(uniform_block_json({"Block", 16, {at(0, 3)}}).dump(),
            R"({"name":"Block","size":16,"members":[{"name":"height","type":"float","components":3,"offset":0,)"
            R"("unit":"m","sentence":"A height."}]})");
}

}  // namespace
}  // namespace rainref::scene
