// A state as bytes: what is written is read, and nothing else is taken for it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>

#include <fmt/format.h>

#include "base/error_of.h"
#include "base/hash.h"
#include "rainref/error.h"
#include "rainref/version.h"
#include "state/file.h"

namespace rainref::state {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using Bytes = std::vector<std::byte>;

/// One item of each kind.
struct Held {
  std::int32_t frame = 7;
  std::int64_t sum = -5;
  std::uint32_t next = 0xfffffffe;
  bool flag = true;
  double moved[3] = {1.5, -2, 1e-300};
  Image image{Format::rg16f, 3, 2};
  std::vector<float> mass{1, 2, 3, 4, 5};
  std::vector<std::uint32_t> id{9, 8, 7, 6, 5};
  int finished = 0;

  Held() {
    for (int y = 0; y < 2; ++y)
      for (int i = 0; i < 6; ++i) image.row<std::uint16_t>(y)[i] = static_cast<std::uint16_t>(0x3c00 + 16 * y + i);
  }
  Items items() {
    Items all;
    all.number("frame", frame, frames);
    all.number("sum", sum, sums);
    all.number("next", next);
    all.flag("flag", flag);
    all.numbers("moved", moved, finite());
    all.begin_names_with("list.");
    all.image("image", image);
    const auto length = std::make_shared<Length>(Length{mass.size(), 6, [this](std::uint64_t n) {
                                                          mass.assign(n, 0);
                                                          id.assign(n, 0);
                                                        }});
    all.array("mass", Type::f32, {0, 100}, length, [this] { return mass.data(); });
    all.array("id", Type::u32, finite(), length, [this] { return id.data(); });
    all.then([this] { ++finished; });
    return all;
  }
  Bytes save(const Texts& texts = {"a = 1\n", "scene.image 00\n", "mine"}) {
    Bytes bytes;
    write(texts, items(), [&](std::span<const std::byte> more) { bytes.insert(bytes.end(), more.begin(), more.end()); });
    return bytes;
  }
};

/// What another program could have written: the checksum fits.
Bytes sealed(Bytes bytes) {
  Hasher hasher(0);
  hasher.add(std::span(bytes).first(bytes.size() - 16));
  const Hash128 hash = hasher.finish();
  std::memcpy(bytes.data() + bytes.size() - 16, &hash.low, 8);
  std::memcpy(bytes.data() + bytes.size() - 8, &hash.high, 8);
  return bytes;
}
/// With bytes at a place replaced, or with others in between, size and checksum right.
Bytes changed(Bytes bytes, std::size_t at, const Bytes& put) {
  std::copy(put.begin(), put.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at));
  return sealed(std::move(bytes));
}
template <class T>
Bytes raw(T value) {
  Bytes bytes(sizeof value);
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}
std::size_t place_of(const Bytes& bytes, std::string_view text) {
  const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  EXPECT_NE(all.find(text), std::string_view::npos) << text;
  return all.find(text);
}

std::string refusal(const Bytes& bytes, Held& held) {
  const Bytes before = held.save();
  const std::string error = error_of([&] { require_fit(Saved(bytes, "x.state"), held.items()); });
  EXPECT_TRUE(error == "none" || error.starts_with("2 x.state: ")) << error;
  EXPECT_EQ(held.save(), before);
  return error;
}

TEST(StateFile, GivesBackWhatWasSaved) {
  Held full;
  const Bytes bytes = full.save();
  Held other;
  other.frame = 1, other.sum = 2, other.next = 3, other.flag = false, other.moved[2] = 0;
  other.image = Image(Format::rg16f, 3, 2);
  other.mass = {1}, other.id = {2};
  const Saved saved(bytes, "x.state");
  EXPECT_EQ(saved.scene(), "a = 1\n");
  EXPECT_EQ(saved.inputs(), "scene.image 00\n");
  EXPECT_EQ(saved.note(), "mine");
  const Items items = other.items();
  require_fit(saved, items);
  EXPECT_EQ(other.frame, 1);
  load(saved, items);
  EXPECT_EQ(other.finished, 1);
  EXPECT_EQ(other.save(), bytes);
  EXPECT_EQ(other.mass, full.mass);
}

// Known bytes: the layout of docs/notes/state.md, on any machine.
TEST(StateFile, HasTheDocumentedLayout) {
  std::int32_t frame = 0x01020304;
  Items items;
  items.number("f", frame, finite());
  std::string bytes;
  write({"s", "", ""}, items,
        [&](std::span<const std::byte> more) { bytes.append(reinterpret_cast<const char*>(more.data()), more.size()); });
  using namespace std::string_literals;
  const std::string body = "rainref-state\r\n\x1a"s + "\1\0\0\0"s + std::string(1, golden_generation) + "\0\0\0"s +
                           std::string(1, static_cast<char>(bytes.size())) + "\0\0\0\0\0\0\0"s + "\1\0\0\0\0\0\0\0s"s +
                           "\0\0\0\0\0\0\0\0"s + "\0\0\0\0\0\0\0\0"s + "\1\0\0\0"s + "\1\0\0\0\0\0\0\0f"s + "\2\0"s + "\4\3\2\1"s;
  ASSERT_EQ(bytes.size(), body.size() + 16);
  EXPECT_EQ(bytes.substr(0, body.size()), body);
}

TEST(StateFile, CutShortOrDamagedIsRefused) {
  Held held;
  const Bytes bytes = held.save();
  EXPECT_EQ(refusal(bytes, held), "none");
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_THAT(refusal({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length)}, held),
                testing::AnyOf(HasSubstr("expected a state that rainref saved"), HasSubstr("cut short")));
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    Bytes other = bytes;
    other[at] ^= std::byte{0x10};
    EXPECT_NE(refusal(other, held), "none") << at;
  }
  Bytes longer = bytes;
  longer.push_back(std::byte{0});
  EXPECT_THAT(refusal(longer, held), HasSubstr("lengthened"));
  EXPECT_THAT(refusal(Bytes(100, std::byte{'x'}), held), HasSubstr("found other bytes"));
}

TEST(StateFile, OtherVersionsAreNamed) {
  Held held;
  const Bytes bytes = held.save();
  EXPECT_THAT(refusal(changed(bytes, 16, raw(std::uint32_t{2})), held), HasSubstr("expected a state of format 1, found 2"));
  EXPECT_THAT(refusal(changed(bytes, 20, raw(std::uint32_t{77})), held),
              HasSubstr(fmt::format("golden generation {}, found 77", golden_generation)));
}

// Counts of a file that somebody made are not believed.
TEST(StateFile, CraftedCountsAreRefused) {
  Held held;
  const Bytes bytes = held.save();
  const std::size_t scene = 32, name = place_of(bytes, "list.mass") - 8, shape = name + 8 + 9 + 2;
  for (const std::uint64_t count : {std::uint64_t{1} << 40, std::uint64_t{1} << 63, ~std::uint64_t{0}, ~std::uint64_t{0} - 7}) {
    for (const std::size_t at : {scene, name, shape})
      EXPECT_THAT(refusal(changed(bytes, at, raw(count)), held), HasSubstr("beyond its end"));
  }
  const std::size_t items = place_of(bytes, "frame") - 8 - 4;
  EXPECT_THAT(refusal(changed(bytes, items, raw(~std::uint32_t{0})), held), HasSubstr("beyond its end"));
  EXPECT_THAT(refusal(changed(bytes, items, raw(std::uint32_t{3})), held), HasSubstr("bytes follow"));
  EXPECT_THAT(refusal(changed(bytes, shape - 2, raw(std::uint8_t{200})), held), HasSubstr("type 200"));
  EXPECT_THAT(refusal(changed(bytes, shape - 1, raw(std::uint8_t{200})), held), HasSubstr("200 dimensions"));
}

TEST(StateFile, WhatDoesNotFitIsNamed) {
  Held held, other;
  const auto refused = [&](const std::function<void(Held&)>& change) {
    Held made;
    change(made);
    return refusal(made.save(), held);
  };
  EXPECT_THAT(refused([](Held& h) { h.image = Image(Format::rg16f, 4, 2); }),
              HasSubstr("expected list.image f16 [2, 3, 2], found list.image f16 [2, 4, 2]"));
  EXPECT_THAT(refused([](Held& h) { h.image = Image(Format::rg32f, 3, 2); }), HasSubstr("found list.image f32 [2, 3, 2]"));
  EXPECT_THAT(refused([](Held& h) { h.frame = -1; }), HasSubstr("frame: expected numbers from 0 to 10000000, found -1"));
  EXPECT_THAT(refused([](Held& h) { h.sum = std::numeric_limits<std::int64_t>::max(); }), HasSubstr("sum: expected numbers"));
  EXPECT_THAT(refused([](Held& h) { h.moved[1] = std::numeric_limits<double>::quiet_NaN(); }), HasSubstr("moved: expected numbers"));
  EXPECT_THAT(refused([](Held& h) { h.image.row<std::uint16_t>(1)[5] = 0x7c00; }), HasSubstr("list.image: expected numbers"));
  EXPECT_THAT(refused([](Held& h) { h.mass[4] = 101; }), HasSubstr("list.mass: expected numbers from 0 to 100, found 101"));
  EXPECT_THAT(refused([](Held& h) { h.mass.assign(7, 1), h.id.assign(7, 1); }), HasSubstr("up to 6"));
  const Bytes bytes = held.save();
  EXPECT_THAT(refusal(changed(bytes, place_of(bytes, "flag") + 6, raw(std::uint8_t{2})), held),
              HasSubstr("flag: expected numbers from 0 to 1"));
  EXPECT_THAT(refusal(changed(bytes, place_of(bytes, "next"), raw('m')), held), HasSubstr("expected next u32 [], found mext u32 []"));
  // Neighbours of another length: the last mass becomes part of the next item's name, so a list of its own is made here.
  Items uneven;
  std::vector<float> mass(3, 1);
  std::vector<std::uint32_t> id(2, 1);
  const auto length = [](std::uint64_t n) { return std::make_shared<Length>(Length{n, 6, [](std::uint64_t) {}}); };
  uneven.array("mass", Type::f32, finite(), length(3), [&] { return mass.data(); });
  uneven.array("id", Type::u32, finite(), length(2), [&] { return id.data(); });
  Bytes made;
  write({}, uneven, [&](std::span<const std::byte> more) { made.insert(made.end(), more.begin(), more.end()); });
  Items even;
  const auto same = length(3);
  even.array("mass", Type::f32, finite(), same, [&] { return mass.data(); });
  even.array("id", Type::u32, finite(), same, [&] { return id.data(); });
  const Saved saved(made, "x.state");
  EXPECT_THROW(require_fit(saved, even), Error);
}

}  // namespace
}  // namespace rainref::state
