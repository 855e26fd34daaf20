// Slots, ids and records.
#include <gtest/gtest.h>

#include "base/error_of.h"
#include "rainref/error.h"
#include "support.h"

namespace rainref::drops {
namespace {

using test::drop;

std::vector<Drop> gathered(const DropArrays& a) {
  const parallel::Executor executor(2);
  std::vector<Drop> out;
  a.gather(out, executor);
  return out;
}
std::vector<std::uint32_t> ids_of(const std::vector<Drop>& drops) {
  std::vector<std::uint32_t> out;
  for (const Drop& d : drops) out.push_back(d.id);
  return out;
}

TEST(DropArrays, FreeSlotsAreFilledLowestFirst) {
  DropArrays a = test::arrays_of({drop(0, 0, 1, 0), drop(0, 0, 1, 1), drop(0, 0, 1, 2), drop(0, 0, 1, 3)}, 6);
  a.life()[1] = 0;
  a.life()[2] = -0.5f;
  EXPECT_EQ(a.live(), 2);
  EXPECT_EQ(a.free_slots(), 4);
  EXPECT_EQ(a.place(std::vector<Drop>{drop(0, 0, 1, 4), drop(0, 0, 1, 5), drop(0, 0, 1, 6)}), 3u);
  EXPECT_EQ(ids_of(gathered(a)), (std::vector<std::uint32_t>{0, 4, 5, 3, 6}));
  EXPECT_EQ(a.extent(), 5);
  EXPECT_EQ(a.next_id(), 7u);
}

TEST(DropArrays, FullArraysTakeNoMoreAndIdsGoOn) {
  DropArrays a = test::arrays_of({drop(0, 0, 1, 0), drop(0, 0, 1, 1)}, 3);
  EXPECT_EQ(a.place(std::vector<Drop>{drop(0, 0, 1, 2), drop(0, 0, 1, 3), drop(0, 0, 1, 4)}), 1u);
  EXPECT_EQ(a.live(), 3);
  EXPECT_EQ(a.next_id(), 5u);
}

TEST(DropArrays, RecordsComeBackAsTheyWere) {
  const std::vector<Drop> records = test::random_drops(40000, 3, 1e6f);  // three chunks
  const DropArrays a = test::arrays_of(records);
  std::vector<Drop> live;
  for (const Drop& d : records) {
    if (d.life > 0) live.push_back(d);
  }
  const std::vector<Drop> back = gathered(a);
  ASSERT_EQ(back.size(), live.size());
  EXPECT_EQ(std::memcmp(back.data(), live.data(), live.size() * sizeof(Drop)), 0);
  EXPECT_EQ(a.next_id(), 40000u);
  EXPECT_EQ(gathered(test::arrays_of(back)).size(), live.size());
}

TEST(DropArrays, RefusesWhatCannotBe) {
  EXPECT_EQ(error_of([] { DropArrays a(0); }), "2 capacity for drops: expected a number from 1 to 100000000, found 0");
  EXPECT_EQ(error_of([] { DropArrays a(100'000'001); })[0], '2');
  DropArrays a(1);
  EXPECT_EQ(error_of([&] { a.assign(std::vector<Drop>(2, drop(0, 0, 1, 0))); }), "3 drops: expected at most 1 records, found 2");
  EXPECT_EQ(error_of([&] { a.assign(std::vector<Drop>{drop(0, std::nanf(""), 1, 7)}); }),
            "3 drops: expected finite numbers, found nan in record 0 (id 7)");
  EXPECT_EQ(a.live(), 0);
}

TEST(DropArrays, TenMillionSlots) {
  constexpr std::int64_t count = 10'000'000;
  DropArrays a(count);
  std::vector<Drop> records(static_cast<std::size_t>(count), drop(0.5f, 0.5f, 3, 0));
  for (std::size_t i = 0; i < records.size(); ++i) records[i].id = static_cast<std::uint32_t>(i);
  EXPECT_EQ(a.place(records), static_cast<std::size_t>(count));
  EXPECT_EQ(a.free_slots(), 0);
  EXPECT_EQ(a.water(), 3 * count);
  a.life()[static_cast<std::size_t>(count) - 1] = 0;
  EXPECT_EQ(a.place(std::vector<Drop>{drop(0.25f, 0, 1, 10'000'000), drop(0, 0, 1, 10'000'001)}), 1u);
  EXPECT_EQ(a.get(count - 1).id, 10'000'000u);
}

}  // namespace
}  // namespace rainref::drops
