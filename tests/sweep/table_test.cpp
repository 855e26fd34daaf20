// Tables: the same bytes in whatever order and wherever cells were made.
#include "sweep/plans.h"

#include <sqlite3.h>

#include "base/hash.h"
#include "image_io/read.h"
#include "image_io/write.h"
#include "sweep/database.h"
#include "sweep/sheet.h"
#include "sweep/table.h"

namespace rainref::sweep {
namespace {

using testing::HasSubstr;

class Tables : public Plans {
 protected:
  Tables() : opened(plan("verb='run'\nscene='a.toml'\nframes=30\nkeep=['picture','hash']\n[axes]\n'rain.rate'=[2.5,30]\nseed=[1,2]\n")) {}

  std::string database(const Table& table, const std::string& name) const {
    write_database(folder / name, opened.cells, table);
    return contents(folder / name);
  }
  static std::string asked(const std::filesystem::path& file, const char* sql) {
    sqlite3* handle = nullptr;
    sqlite3_open_v2(file.c_str(), &handle, SQLITE_OPEN_READONLY, nullptr);
    std::string out;
    const auto row = [](void* to, int count, char** values, char**) {
      for (int i = 0; i < count; ++i)
        *static_cast<std::string*>(to) += std::string(values[i] ? values[i] : "-") + (i + 1 < count ? "|" : ";");
      return 0;
    };
    EXPECT_EQ(sqlite3_exec(handle, sql, row, &out, nullptr), SQLITE_OK) << sqlite3_errmsg(handle);
    sqlite3_close(handle);
    return out;
  }

  OpenedPlan opened;
};

TEST_F(Tables, AreTheSameWhoeverMadeTheCells) {
  make(opened, store);
  const Store other(folder / "other");
  for (const std::int64_t k : {2, 0, 1}) make(opened, other, {{k, 3}, false});
  const Table one = read_table(opened.cells, store), two = read_table(opened.cells, other);
  EXPECT_EQ(table_csv(opened.cells, one), table_csv(opened.cells, two));
  EXPECT_EQ(films_csv(one), films_csv(two));
  const std::string bytes = database(one, "a.sqlite");
  EXPECT_EQ(bytes, database(two, "b.sqlite"));
  EXPECT_EQ(bytes, database(one, "a.sqlite"));  // again, in its own place
  EXPECT_THAT(table_csv(opened.cells, one), HasSubstr("cell,id,state,sentence,first,end,scene,rain.rate,seed,raindrops.drops,"));
  EXPECT_EQ(asked(folder / "a.sqlite", "SELECT cell, typeof(value), value FROM parameters WHERE key = 'rain.rate' ORDER BY cell"),
            "0|real|2.5;1|real|2.5;2|integer|30;3|integer|30;");
  EXPECT_EQ(asked(folder / "a.sqlite", "SELECT state, count(*) FROM cells GROUP BY state"), "done|4;");
  EXPECT_EQ(asked(folder / "a.sqlite", "SELECT count(DISTINCT hash) FROM hashes WHERE pass = 'wave_step' AND buffer = 'wave'"), "4;");
  EXPECT_EQ(asked(folder / "a.sqlite", "SELECT path FROM files WHERE cell = 0"), "hashes.txt;picture.000029.png;");
}

TEST_F(Tables, SayWhatIsNotDone) {
  for (const std::int64_t k : {0, 2}) make(opened, store, {{k, 4}, false});
  store.record(opened.cells.all()[1].id, "x", {2, "a comma, a \"quote\""});
  put(store.cell(opened.cells.all()[2].id) / "hashes.txt", "changed");
  const Table table = read_table(opened.cells, store);
  EXPECT_EQ(table.count(State::done), 1);
  EXPECT_EQ(table.count(State::missing), 1);
  EXPECT_EQ(table.count(State::refused), 1);
  EXPECT_EQ(table.count(State::damaged), 1);
  EXPECT_THAT(table_csv(opened.cells, table), HasSubstr(",refused,\"a comma, a \"\"quote\"\"\",0,30,a.toml,2.5,2,"));
  EXPECT_THAT(table.rows[2].sentence, HasSubstr("hashes.txt: expected hash "));
  EXPECT_EQ(table.films.size(), 1u);
}

// 2x2 cells of 33x21, shrunk by 2 to 16x10: the mean of four codes, rounded to nearest.
TEST_F(Tables, TheSheetShowsEachPictureSmall) {
  make(opened, store);
  const Table table = read_table(opened.cells, store);
  const Image sheet = contact_sheet(opened.cells, table, store, 400, 17);
  ASSERT_EQ(sheet.width(), 2 * 16 + 2);
  ASSERT_EQ(sheet.height(), 2 * 10 + 2);
  for (int k = 0; k < 4; ++k) {
    const Image picture = image_io::read(store.cell(opened.cells.all()[k].id) / "picture.000029.png").image;
    for (int y = 0; y < 10; ++y) {
      for (int x = 0; x < 16; ++x) {
        for (int c = 0; c < 3; ++c) {
          const auto code = [&](int dx, int dy) { return std::to_integer<int>(picture.row_bytes(2 * y + dy)[4 * (2 * x + dx) + c]); };
          const int expected = (code(0, 0) + code(1, 0) + code(0, 1) + code(1, 1) + 2) / 4;
          ASSERT_EQ(std::to_integer<int>(sheet.row_bytes(k / 2 * 12 + y)[4 * (k % 2 * 18 + x) + c]), expected);
        }
      }
    }
  }
  EXPECT_EQ(contact_sheet(opened.cells, table, store, 1, 17).width(), 16);
  EXPECT_TRUE(contact_sheet(opened.cells, read_table(opened.cells, Store(folder / "none")), store).empty());
}

}  // namespace
}  // namespace rainref::sweep
