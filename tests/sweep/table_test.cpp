// Tables: the same bytes in whatever order and wherever cells were made.
#include "sweep/plans.h"

#include <sqlite3.h>

#include <functional>

#include <nlohmann/json.hpp>

#include "base/hash.h"
#include "image_io/read.h"
#include "image_io/write.h"
#include "sweep/database.h"
#include "sweep/rubbish.h"
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

// Joins by name need the name.
TEST_F(Tables, LabelsStayText) {
  put(folder / "cases.csv", "name,seed\n99999999999999999999,1\n007,2\nnan,3\n1e3,4\n");
  const OpenedPlan labelled(plan("verb='hash'\nscene='a.toml'\nframes=1\n[axes]\ncases='cases.csv'\n"));
  write_database(folder / "l.sqlite", labelled.cells, read_table(labelled.cells, store));
  EXPECT_EQ(asked(folder / "l.sqlite", "SELECT typeof(value), value FROM parameters WHERE key = 'name' ORDER BY cell"),
            "text|99999999999999999999;text|007;text|nan;text|1e3;");
  EXPECT_EQ(asked(folder / "l.sqlite", "SELECT typeof(value), value FROM parameters WHERE key = 'seed' ORDER BY cell"),
            "integer|1;integer|2;integer|3;integer|4;");
}

// Its hash is right, as whoever writes there may have it: it is one damaged cell, and the others have their rows.
TEST_F(Tables, ARecordOfTheWrongShapeIsADamagedCell) {
  make(opened, store);
  const std::filesystem::path cell = store.cell(opened.cells.all()[1].id), record = cell / "cell.json";
  const std::string whole = contents(record);
  const auto forged = [&](const std::function<void(nlohmann::ordered_json&)>& change) {
    nlohmann::ordered_json json = nlohmann::ordered_json::parse(whole);
    json.erase("xxh3");
    change(json);
    const std::string body = json.dump(1).substr(2) + "\n";
    put(record, "{ \"xxh3\": \"" + file_hash(std::as_bytes(std::span(body))).text() + "\",\n" + body);
    const Table table = read_table(opened.cells, store);
    EXPECT_EQ(table.count(State::done), 3);
    EXPECT_EQ(table.count(State::damaged), 1);
    write_database(folder / "t.sqlite", opened.cells, table);
    std::vector<Cells> plans{opened.cells};
    EXPECT_EQ(rubbish_of(store, plans, true).size(), 1u);
    return table.rows[1].sentence.substr(std::min(table.rows[1].sentence.size(), record.string().size() + 2));
  };
  EXPECT_EQ(forged([](auto& j) { j.erase("files"); }), "'files' is missing");
  EXPECT_EQ(forged([](auto& j) { j["files"] = "x"; }), "files: expected an array, found \"x\"");
  EXPECT_EQ(forged([](auto& j) { j["files"][0]["bytes"] = -1; }),
            "files[0].bytes: expected a whole number from 0 to 9223372036854775807, found -1");
  EXPECT_EQ(forged([](auto& j) { j["files"][0]["path"] = "../../../precious"; }),
            "files[0].path: expected a path in the cell's folder, found \"../../../precious\"");
  EXPECT_EQ(forged([](auto& j) { j["files"].push_back(j["files"][0]); }), "files[2]: 'picture.000029.png' is there twice");
  EXPECT_EQ(forged([](auto& j) { j["verdict"] = 3; }), "verdict: expected a text, found 3");
  EXPECT_EQ(forged([](auto& j) { j["last_frame"].push_back(3); }).substr(0, 11), "last_frame[");
  EXPECT_EQ(forged([](auto& j) { j["last_frame"].push_back(j["last_frame"][0]); }).substr(0, 11), "last_frame[");
  // Frames of another state: docs/notes/sweeps.md says that states only save time.
  EXPECT_EQ(forged([](auto& j) { j["last_frame"][0]["frame"] = 28; }),
            "last_frame[0].frame: expected 29, the one before its end, found 28");
  EXPECT_EQ(forged([](auto& j) { j["cell"] = std::string(32, 'a'); }).substr(0, 15), "cell: expected ");
  put(record, "{ \"xxh3\": " + std::string(300000, '['));
  EXPECT_EQ(read_table(opened.cells, store).rows[1].sentence, record.string() + ": nested deeper than 16");
  put(record, whole);
  EXPECT_EQ(read_table(opened.cells, store).count(State::done), 4);
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
