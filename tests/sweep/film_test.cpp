// A film cut into chunks is the film: every picture and every hash, whatever order its chunks are made in and wherever they begin.
#include "sweep/plans.h"

#include <map>

#include "scene/value_text.h"
#include "simulation/every_state.h"
#include "sweep/table.h"

namespace rainref::sweep {
namespace {

constexpr int frames = 8;

/// Pictures by name, and all hash lines.
struct Results {
  std::map<std::string, std::string> pictures;
  std::string lines, scene_hash;
  bool operator==(const Results&) const = default;
  friend void PrintTo(const Results& r, std::ostream* out) {
    *out << r.pictures.size() << " pictures, " << r.scene_hash << "\n" << r.lines;
  }
};

class Film : public testing::TestWithParam<StateScene> {
 protected:
  Film() { put(folder / "a.toml", text_of(scene::parse(GetParam().text, simulation::effect_table()))); }

  /// What the scene says itself: defaults beside some keys are refused where they are said.
  static std::string text_of(const scene::Config& config) {
    std::string text;
    for (const scene::Config::Entry& e : config.entries())
      if (config.given(e.parameter.key)) text += fmt::format("{} = {}\n", e.parameter.key, scene::value_text(e.value));
    return text;
  }
  OpenedPlan plan(const std::string& more) const {
    put(folder / "plan.toml", fmt::format("verb='run'\nscene='a.toml'\nframes={}\nkeep=['picture@all','hash']\n{}", frames, more));
    return OpenedPlan(folder / "plan.toml");
  }
  Made make(const OpenedPlan& p, const Store& store, const Cell& cell) const {
    Names names;
    store.make();
    return make_frames(p.cells, cell, store, executor, names, [](const std::string&) {});
  }
  static Results results(const OpenedPlan& p, const Store& store) {
    Results r;
    const Table table = read_table(p.cells, store);
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      EXPECT_EQ(table.rows[i].state, State::done) << table.rows[i].sentence;
      const std::filesystem::path cell = store.cell(p.cells.all()[i].id);
      for (const KeptFile& f : table.rows[i].files)
        if (f.path.starts_with("picture")) r.pictures[f.path] = contents(cell / f.path);
      r.lines += contents(cell / "hashes.txt");
    }
    EXPECT_EQ(table.films.size(), 1u);
    r.scene_hash = table.films.at(0).scene_hash;
    return r;
  }

  TemporaryFolder folder;
  parallel::Executor executor{1};
};

TEST_P(Film, OfChunksIsThatOfOneRun) {
  // One run, as `rainref hash` makes it.
  const auto running = open(GetParam(), executor);
  capture::HashRecorder hashes;
  std::string lines;
  for (int frame = 0; frame < frames; ++frame) {
    running->next_frame(&hashes);
    for (const capture::HashLine& line : hashes.take_lines()) lines += line.text() + "\n";
  }
  const OpenedPlan whole = plan("");
  const Store one(folder / "one");
  make(whole, one, whole.cells.all().at(0));
  const Results expected = results(whole, one);
  EXPECT_EQ(expected.pictures.size(), static_cast<std::size_t>(frames));
  EXPECT_EQ(expected.lines, lines);
  EXPECT_EQ(expected.scene_hash, hashes.scene_hash().text());

  // In order: each chunk begins with the state that the one before it left.
  const OpenedPlan chunks = plan("chunk=3\n");
  ASSERT_EQ(chunks.cells.all().size(), 3u);
  const Store in_order(folder / "in_order");
  for (const Cell& cell : chunks.cells.all()) EXPECT_EQ(make(chunks, in_order, cell).begun_at, cell.first);
  EXPECT_EQ(results(chunks, in_order), expected);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Film, testing::ValuesIn(state_scenes()), [](const auto& tested) { return tested.param.name; });

/// What is said of files and not of an effect: of a scene of each.
class FilmOfFiles : public Film {};

TEST_P(FilmOfFiles, IsTheSameBackwards) {
  const OpenedPlan whole = plan("");
  const Store one(folder / "one");
  make(whole, one, whole.cells.all().at(0));
  const Results expected = results(whole, one);
  // Backwards: from the beginning, but for what states lie there.
  const Store backwards(folder / "backwards");
  const OpenedPlan with_states = plan("chunk=3\nstate_every=2\n");
  std::vector<std::int64_t> begun;
  for (auto cell = with_states.cells.all().rbegin(); cell != with_states.cells.all().rend(); ++cell)
    begun.push_back(make(with_states, backwards, *cell).begun_at);
  EXPECT_EQ(begun, (std::vector<std::int64_t>{0, 2, 0}));
  EXPECT_EQ(results(with_states, backwards), expected);
}

TEST_P(FilmOfFiles, PassesOverADamagedState) {
  const OpenedPlan whole = plan(""), chunks = plan("chunk=3\n");
  const Store one(folder / "one"), damaged(folder / "damaged");
  make(whole, one, whole.cells.all().at(0));
  make(chunks, damaged, chunks.cells.all()[0]);
  put(damaged.state(chunks.cells.all()[0].film, 3), "rainref-state");
  EXPECT_EQ(make(chunks, damaged, chunks.cells.all()[1]).begun_at, 0);
  make(chunks, damaged, chunks.cells.all()[2]);
  EXPECT_EQ(results(chunks, damaged), results(whole, one));
}

// A wrong restore, a script that renumbers: the state says itself which frame it is of.
TEST_P(FilmOfFiles, PassesOverAStateOfAnotherFrame) {
  const OpenedPlan whole = plan(""), chunks = plan("chunk=3\n");
  const Store one(folder / "one"), renamed(folder / "renamed");
  make(whole, one, whole.cells.all().at(0));
  const std::vector<Cell>& cells = chunks.cells.all();
  make(chunks, renamed, cells[0]);
  make(chunks, renamed, cells[1]);
  const std::filesystem::path third = renamed.state(cells[0].film, 3), sixth = renamed.state(cells[0].film, 6);
  const std::string right = contents(sixth);
  put(sixth, contents(third));
  EXPECT_EQ(make(chunks, renamed, cells[2]).begun_at, 3);
  EXPECT_EQ(results(chunks, renamed), results(whole, one));
  EXPECT_EQ(contents(sixth), right) << "made anew on the way";
}

std::vector<StateScene> one_of_each_effect() {
  std::vector<StateScene> some;
  for (const StateScene& scene : state_scenes()) {
    const auto effect = [](const StateScene& s) { return s.name.substr(0, s.name.find("_c")); };
    if (scene.name.find("_corrected") != std::string::npos && (some.empty() || effect(some.back()) != effect(scene))) some.push_back(scene);
  }
  return some;
}
INSTANTIATE_TEST_SUITE_P(Scenes, FilmOfFiles, testing::ValuesIn(one_of_each_effect()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace rainref::sweep
