// What was prepared is given again to whoever reads the same, and the store keeps what was used last.
#include "cache/prepared.h"

#include <array>
#include <atomic>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

#include "base/error_of.h"
#include "image/images.h"

namespace rainref::cache {
namespace {

/// 33 bytes that say which number they were made of.
struct Thing {
  int number;
  std::size_t size = 33;
  std::size_t bytes() const { return size; }
};
std::atomic<int> made = 0;
Thing thing_of(const int&, const int& number) {
  ++made;
  return {number};
}

class Prepared : public testing::Test {
 protected:
  Prepared() {
    remember(100);
    made = 0;
  }
  ~Prepared() override { remember(0); }
  static std::shared_ptr<const Thing> get(int number) { return prepared("thing", 0, thing_of, number); }
  /// Which of the numbers 1 to 4 are made when they are asked for; asking changes what the store holds.
  static std::string made_now(std::initializer_list<int> numbers) {
    std::string all;
    for (const int number : numbers) {
      const int before = made;
      EXPECT_EQ(get(number)->number, number);
      if (made != before) all += static_cast<char>('0' + number);
    }
    return all;
  }
};

TEST_F(Prepared, IsMadeOnceOfTheSameReads) {
  const auto first = get(1);
  EXPECT_EQ(get(1), first);
  EXPECT_NE(get(2), first);
  EXPECT_EQ(made, 2);
  EXPECT_EQ(prepared("other", 0, thing_of, 1)->number, 1);
  EXPECT_EQ(made, 3) << "another maker";
  EXPECT_EQ(prepared("other", 1, thing_of, 1)->number, 1);
  EXPECT_EQ(made, 3) << "who does the work is no matter";
}
TEST_F(Prepared, NothingIsRememberedUnlessItIsSaid) {
  remember(0);
  EXPECT_EQ(made_now({1, 1}), "11");
}
TEST_F(Prepared, ThoseUsedLongestAgoGiveWayAndStayWithWhoUsesThem) {
  EXPECT_EQ(made_now({1, 2, 3}), "123");
  const auto used = get(2);
  EXPECT_EQ(made_now({1, 4}), "4");  // 3 goes: used longest ago
  EXPECT_EQ(made_now({2, 1, 4}), "");
  EXPECT_EQ(made_now({3}), "3");  // 2 goes
  EXPECT_EQ(used->number, 2);
  EXPECT_NE(get(2), used);
}
TEST_F(Prepared, WhatIsLargerThanTheLimitIsNotHeldAndPushesNothingOut) {
  constexpr auto large = +[](const int&, const std::size_t& size) { return Thing{7, size}; };
  get(1);
  const auto one = prepared("large", 0, large, 101);
  EXPECT_NE(prepared("large", 0, large, 101), one);
  EXPECT_EQ(made_now({1}), "");
  const auto all = prepared("large", 0, large, 100);
  EXPECT_EQ(prepared("large", 0, large, 100), all);
  EXPECT_EQ(made_now({1}), "1");
}
TEST_F(Prepared, ASmallerLimitAndForgettingLetGo) {
  made_now({1, 2, 3});
  remember(66);
  EXPECT_EQ(made_now({3, 2, 1}), "1");
  forget();
  EXPECT_EQ(made_now({1, 2}), "12");
}
TEST_F(Prepared, WhatCannotBeMadeIsTriedAgain) {
  static bool is_possible = false;
  constexpr auto make = +[](const int&, const int& number) {
    if (!is_possible) throw std::runtime_error("not yet");
    return Thing{number};
  };
  EXPECT_THROW(prepared("late", 0, make, 1), std::runtime_error);
  is_possible = true;
  EXPECT_EQ(prepared("late", 0, make, 1)->number, 1);
}
TEST_F(Prepared, ThreadsGetOneAndTheSame) {
  for (int round = 0; round < 50; ++round) {
    forget();
    std::array<std::shared_ptr<const Thing>, 8> got;
    std::vector<std::thread> threads;
    for (std::size_t k = 0; k < got.size(); ++k)
      threads.emplace_back([&got, k] {
        for (int n = 0; n < 20; ++n) got[k] = get(1 + n % 5);
      });
    for (std::thread& thread : threads) thread.join();
    for (const auto& each : got) EXPECT_EQ(each->number, 5);
  }
  // While it is held by somebody, nobody gets another one.
  remember(1000);
  const auto first = get(1);
  std::vector<std::thread> threads;
  for (int k = 0; k < 8; ++k)
    threads.emplace_back([&first] {
      for (int n = 0; n < 100; ++n) EXPECT_EQ(get(1), first);
    });
  for (std::thread& thread : threads) thread.join();
}

Image pattern(const int&, const int& shift) {
  Image image(Format::rgba8, 5, 3);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 20; ++x) image.row_bytes(y)[x] = static_cast<std::byte>(x * 5 + y * 3 + shift);
  return image;
}

TEST_F(Prepared, AnImageIsSharedAndNobodyMayChangeIt) {
  remember(1 << 20);
  Image a = prepared("pattern", 0, pattern, 1)->shared();
  const Image b = prepared("pattern", 0, pattern, 1)->shared();
  EXPECT_TRUE(same(a, pattern(0, 1)));
  EXPECT_EQ(std::as_const(a).row_bytes(0), b.row_bytes(0)) << "one memory";
  EXPECT_EQ(error_of([&] { a.row_bytes(0)[0] = std::byte{1}; }).substr(0, 1), "5") << "an internal error";
}

// A recipe is another one where anything that was read is.
TEST(Recipe, NamesWhatIsRead) {
  struct Plain {
    float x, y;
  };
  struct Keys {
    int first = 1, second = 2;
    std::vector<int> list;
  };
  const auto text = [](const auto&... reads) {
    Recipe recipe("a");
    (recipe.add_read(reads), ...);
    return recipe.text();
  };
  const std::vector<std::string> all{text(),
                                     text(0),
                                     text(1),
                                     text(0.0),
                                     text(-0.0),
                                     text(1.0),
                                     text(1, 2),
                                     text(2, 1),
                                     text(std::string("ab")),
                                     text(std::string("a"), std::string("b")),
                                     text(std::array{1, 2}),
                                     text(std::vector{1, 2}, std::vector<int>{}),
                                     text(std::vector{1}, std::vector{2}),
                                     text(Plain{1, 2}),
                                     text(Plain{2, 1}),
                                     text(pattern(0, 1)),
                                     text(pattern(0, 2)),
                                     text(Image()),
                                     text(Image(Format::rgba8, 5, 3)),
                                     text(Image(Format::rgba8, 3, 5)),
                                     text(Image(Format::r32f, 5, 3))};
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (i == 3 && j == 1) continue;  // the bits of 0 and 0.0 are the same; a maker's types do not change
      EXPECT_NE(all[i], all[j]) << i << ' ' << j;
    }
  EXPECT_NE(Recipe("a").text(), Recipe("b").text());
  EXPECT_EQ(Recipe("maker").add(1).what(), "maker");

  // Of a struct what is named is read, and a maker sees nothing else.
  using Second = Only<&Keys::second, &Keys::list>;
  const Keys keys{5, 6, {7}}, other_first{8, 6, {7}}, other_second{5, 9, {7}}, other_list{5, 6, {}};
  EXPECT_EQ(text(Second(keys)), text(Second(other_first)));
  EXPECT_NE(text(Second(keys)), text(Second(other_second)));
  EXPECT_NE(text(Second(keys)), text(Second(other_list)));
  EXPECT_EQ(Second(keys).of.first, 1);
  EXPECT_EQ(Second(keys).of.second, 6);
}

}  // namespace
}  // namespace rainref::cache
