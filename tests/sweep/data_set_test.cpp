// Data sets: pairs of pictures that lie on one another, masks and lists of drops that say where they differ, a split that leaks nothing.
#include <cmath>
#include <map>
#include <set>

#include <nlohmann/json.hpp>

#include "base/npy.h"
#include "image_io/evidence.h"
#include "base/read_file.h"
#include "image_io/read.h"
#include "sweep/data_set.h"
#include "sweep/plans.h"

namespace rainref::sweep {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using Json = nlohmann::json;

/// A window before a picture of noise, so that a drop changes every pixel that it covers; 4.3 pixels per millimetre.
class DataSets : public Plans {
 protected:
  DataSets() {
    std::string noise;
    for (std::uint32_t i = 0, state = 1; i < 3 * 192 * 128; ++i) noise += static_cast<char>((state = state * 1664525u + 1013904223u) >> 24);
    put(folder / "noise.npy", npy("'|u1'", "(128, 192, 3)", noise));
    put(folder / "s.toml",
        "effect = 'screen_drops'\nvariant = 'corrected'\nrun.size = [192, 128]\nrun.frames = 1\nscene.image = 'noise.npy'\nflow.on = "
        "false\n"
        "glass.height = 0.03\ndrops.largest_radius = 3\nbackground.defocus = 0\npicture.layer = true\n");
    put(folder / "cases.csv", "name,drops.share\nclean,0\nrainy,0.15\nheavy,0.5\n");
  }
  static std::string text(const std::string& more = "", const std::string& seeds = "{from = 1, count = 4}",
                          const std::string& keep = "'picture', 'exr:drops.A', 'drops'", const std::string& cases = "cases.csv") {
    return fmt::format("verb='run'\nscene='s.toml'\nkeep=[{}]\n{}\n[axes]\nseed={}\ncases='{}'\n", keep, more, seeds, cases);
  }
  PairsAsked asked() const { return {.clean = "clean", .rainy = "rainy", .mask = "drops.A"}; }
  DataSetFigures write(const OpenedPlan& opened, const Store& at, const std::string& to, const PairsAsked& how) const {
    capture::NewFolder made(folder / to, [](const fs::path&) { return "it is there"; });
    const DataSetFigures figures = write_data_set(opened.cells, read_table(opened.cells, at), at, how, pairs_of(opened.cells, how), made);
    made.commit();
    return figures;
  }
  /// The lines of both sides, with "side" added.
  std::vector<Json> lines(const std::string& to) const {
    std::vector<Json> all;
    for (const std::string side : {"train", "test"}) {
      std::istringstream in(contents(folder / to / side / "data.jsonl"));
      for (std::string line; std::getline(in, line);) {
        all.push_back(Json::parse(line));
        all.back()["side"] = side;
      }
    }
    return all;
  }
  Image picture(const std::string& to, const Json& line, const char* which) const {
    return image_io::read(folder / to / line["side"].get<std::string>() / line[which].get<std::string>()).image;
  }
  std::map<std::string, std::string> files(const std::string& to) const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder / to))
      if (entry.is_regular_file()) all[fs::relative(entry.path(), folder / to).generic_string()] = contents(entry.path());
    return all;
  }
};

int code(const Image& image, int x, int y, int channel = 0) { return std::to_integer<int>(image.row_bytes(y)[4 * x + channel]); }

// Where no drop is part of a pixel, the pass copies the background, of the same bits in both cells: no code may differ. A pixel of two
// samples a side is wet if one of its samples is. Under the drops the noise is another.
TEST_F(DataSets, PicturesAgreeWhereTheMaskIsZero) {
  for (const int samples : {1, 2}) {
    const OpenedPlan opened(plan(text(fmt::format("set.run.supersample = {}", samples))));
    make(opened, store);
    const std::string to = fmt::format("set{}", samples);
    const DataSetFigures figures = write(opened, store, to, asked());
    EXPECT_EQ(figures.train + figures.test, 4);
    EXPECT_EQ(figures.dry_differing, 0);
    EXPECT_EQ(figures.dry_difference, 0);
    std::int64_t dry = 0, wet = 0, changed = 0, rims = 0;
    for (const Json& line : lines(to)) {
      const Image clean = picture(to, line, "clean"), rainy = picture(to, line, "rainy"), mask = picture(to, line, "mask");
      std::int64_t squares = 0, covered = 0;
      for (int y = 0; y < 128; ++y) {
        for (int x = 0; x < 192; ++x) {
          int difference = 0;
          for (int k = 0; k < 3; ++k) {
            const int off = code(clean, x, y, k) - code(rainy, x, y, k);
            squares += off * off;
            difference = std::max(difference, std::abs(off));
          }
          covered += code(mask, x, y);
          if (code(mask, x, y) == 0) {
            ++dry;
            ASSERT_EQ(difference, 0) << x << " " << y;
          } else if (code(mask, x, y) == 255) {
            ++wet;
            changed += difference > 0;
          } else {
            ++rims;
          }
        }
      }
      EXPECT_NEAR(line["psnr"].get<double>(), 10 * std::log10(255.0 * 255 * 3 * 192 * 128 / static_cast<double>(squares)), 1e-4);
      EXPECT_NEAR(line["mask_share"].get<double>(), static_cast<double>(covered) / (255 * 192 * 128), 1e-4);
    }
    EXPECT_EQ(dry, figures.dry);
    EXPECT_GT(dry, 20000);
    EXPECT_GT(wet, 1000);
    EXPECT_GT(rims, 500);
    EXPECT_GT(changed, wet * 95 / 100);
  }
}

// drops.A of a lone disc is saturate(r + 1/2 - d) at the pixels' centres, so its sum is pi (r^2 + 1/12) but for the lattice: by Poisson's
// sum the terms |k| = 1, sqrt 2, 2, sqrt 5 ... of rho J1(2 pi k rho) / k, averaged over r - 1/2 .. r + 1/2, are below 0.4 sqrt r together.
// Half a code at each pixel of the rim is .02 r. A drop too small for the list adds at most 0.4.
TEST_F(DataSets, TheListSaysWhereTheMaskIs) {
  const OpenedPlan opened(plan(text()));
  make(opened, store);
  write(opened, store, "set", asked());
  int lone = 0, largest = 0;
  for (const Json& line : lines("set")) {
    const Image mask = picture("set", line, "mask");
    const auto& drops = line["drops"];
    ASSERT_GT(drops.size(), 10u);
    const auto at = [&](std::size_t i, int k) { return drops[i][static_cast<std::size_t>(k)].get<double>(); };
    for (std::size_t i = 0; i < drops.size(); ++i) {
      const double x = at(i, 0), y = at(i, 1), r = at(i, 2);
      bool is_lone = r >= 1 && x > r + 1 && y > r + 1 && x < 191 - r && y < 127 - r;
      for (std::size_t j = 0; j < drops.size() && is_lone; ++j)
        is_lone = j == i || std::hypot(at(j, 0) - x, at(j, 1) - y) > r + at(j, 2) + 2;
      if (!is_lone) continue;
      ++lone;
      largest = std::max(largest, static_cast<int>(r));
      double sum = 0, sum_x = 0, sum_y = 0;
      for (int row = 0; row < 128; ++row) {
        for (int column = 0; column < 192; ++column) {
          if (std::hypot(column + 0.5 - x, row + 0.5 - y) > r + 1) continue;
          const double share = code(mask, column, row) / 255.0;
          sum += share;
          sum_x += share * (column + 0.5);
          sum_y += share * (row + 0.5);
        }
      }
      EXPECT_NEAR(sum, 3.14159265 * (r * r + 1.0 / 12), 0.4 * std::sqrt(r) + 0.02 * r + 0.4) << x << " " << y << " " << r;
      EXPECT_NEAR(sum_x / sum, x, 0.25);
      EXPECT_NEAR(sum_y / sum, y, 0.25);
    }
    // And no mask without a drop of the list; smaller ones cover 3/8 of a pixel at most.
    for (int row = 0; row < 128; ++row) {
      for (int column = 0; column < 192; ++column) {
        if (code(mask, column, row) < 192) continue;
        bool is_listed = false;
        for (std::size_t i = 0; i < drops.size(); ++i)
          is_listed = is_listed || std::hypot(at(i, 0) - (column + 0.5), at(i, 1) - (row + 0.5)) < at(i, 2) + 0.51;
        EXPECT_TRUE(is_listed) << column << " " << row;
      }
    }
  }
  EXPECT_GT(lone, 40);
  EXPECT_GE(largest, 5);
}

TEST_F(DataSets, ACodeOfZeroIsNoWaterAtAll) {
  EXPECT_EQ(mask_code(0), 0);
  EXPECT_EQ(mask_code(1e-9), 1);
  EXPECT_EQ(mask_code(0.5), 128);
  EXPECT_EQ(mask_code(1.5 / 255 - 1e-9), 1);
  EXPECT_EQ(mask_code(1), 255);
}

TEST_F(DataSets, AreTheSameBytesForAnyThreadsOrderAndResume) {
  const OpenedPlan opened(plan(text("frames=4\nchunk=2", "{from = 1, count = 4}", "'picture@all', 'exr:drops.A@all', 'drops@all'")));
  make(opened, store);
  write(opened, store, "one", asked());
  const Store other(folder / "other");
  const parallel::Executor two(2);
  const auto by_two = [&](std::int64_t k) {
    work(
        opened.cells, other, {{k, 5}, false},
        [&](const Cell& cell, Names& names) { return make_frames(opened.cells, cell, other, two, names, [](const std::string&) {}); },
        [](const Cell&, Outcome, const std::string&) {});
  };
  for (const std::int64_t k : {3, 0, 4, 1, 2}) by_two(k);
  write(opened, other, "two", asked());
  const auto one = files("one"), again = files("two");
  EXPECT_EQ(one.size(), 4u * 4 * 3 + 3);
  EXPECT_TRUE(one == again);
  // Frames of one film stay together.
  std::map<Json, std::set<std::string>> sides;
  for (const Json& line : lines("one")) sides[line["parameters"]["seed"]].insert(line["side"]);
  EXPECT_EQ(sides.size(), 4u);
  for (const auto& [seed, of] : sides) EXPECT_EQ(of.size(), 1u) << seed;
}

TEST_F(DataSets, EveryLineHasItsFilesParametersAndCamera) {
  const OpenedPlan opened(plan(text("size = '96x64'")));
  make(opened, store);
  PairsAsked half = asked();
  half.split = 0.5;
  write(opened, store, "set", half);
  std::set<std::int64_t> seeds;
  for (const Json& line : lines("set")) {
    for (const char* which : {"clean", "rainy", "mask"}) EXPECT_EQ(picture("set", line, which).width(), 96) << which;
    seeds.insert(line["parameters"]["seed"].get<std::int64_t>());
    EXPECT_EQ(line["parameters"]["drops.share"], 0.15);
    EXPECT_FALSE(line["parameters"].contains("scene.image"));
    EXPECT_EQ(line["clean_parameters"], (Json{{"drops.share", 0}}));
    EXPECT_TRUE(store.has(line["clean_cell"])) << line;
    EXPECT_TRUE(store.has(line["rainy_cell"]));
    // The camera looks at its target, which is in the middle; what is higher up is nearer to row 0; a degree is a degree.
    const auto& p = line["parameters"];
    const auto seen = [&](std::array<double, 3> at) {
      std::array<double, 3> eye{}, out{};
      for (std::size_t i = 0; i < 3; ++i) {
        eye[i] = line["camera"]["world_to_camera"][i][3];
        for (std::size_t k = 0; k < 3; ++k) eye[i] += line["camera"]["world_to_camera"][i][k].get<double>() * at[k];
      }
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) out[i] += line["camera"]["intrinsics"][i][k].get<double>() * eye[k];
      return std::array{out[0] / out[2], out[1] / out[2], eye[2]};
    };
    auto at = p["camera.target"].get<std::array<double, 3>>();
    const auto eye = p["camera.position"].get<std::array<double, 3>>();
    const double far = std::hypot(at[0] - eye[0], at[1] - eye[1], at[2] - eye[2]);
    const auto middle = seen(at);
    EXPECT_NEAR(middle[0], 48, 1e-9);
    EXPECT_NEAR(middle[1], 32, 1e-9);
    EXPECT_NEAR(middle[2], far, 1e-9);
    at[1] += 1;
    EXPECT_LT(seen(at)[1], 32);
    const double fov = p["camera.vertical_fov_deg"].get<double>() * 3.14159265358979 / 180;
    EXPECT_NEAR(line["camera"]["intrinsics"][0][0].get<double>(), 32 / std::tan(fov / 2), 1e-9);
  }
  EXPECT_EQ(seeds.size(), 4u);
  std::istringstream table(contents(folder / "set/table.csv"));
  std::string row;
  std::getline(table, row);
  EXPECT_EQ(row, "pair,split,frame,clean,rainy,mask,clean_cell,rainy_cell,scene,seed,drops.share,psnr,mask_share,drops");
  int rows = 0;
  for (; std::getline(table, row); ++rows) {
    std::vector<std::string> fields;
    std::istringstream in(row);
    for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
    for (std::size_t k : {3u, 4u, 5u}) EXPECT_TRUE(fs::is_regular_file(folder / "set" / fields.at(k))) << row;
  }
  EXPECT_EQ(rows, 4);
}

// The channel alone has the bits that it has in the whole file.
TEST_F(DataSets, AChannelOfAnExrIsThatOfTheWhole) {
  const OpenedPlan opened(plan(text("", "[1]", "'exr', 'exr:drops.A', 'exr:background.G'")));
  make(opened, store);
  const fs::path cell = store.cell(opened.cells.all()[1].id);
  for (const auto& [channel, layer, k] : {std::tuple("drops.A", "drops", 3), std::tuple("background.G", "background", 1)}) {
    const image_io::Evidence one = image_io::read_evidence("one", read_file(cell / fmt::format("{}.000000.exr", channel)));
    const Image all = image_io::read(cell / "picture.000000.exr", layer).image;
    ASSERT_EQ(one.channels.size(), 1u);
    EXPECT_EQ(one.channels[0].name, channel);
    ASSERT_EQ(one.texel_bytes, 2u);
    for (int y = 0; y < all.height(); ++y)
      for (int x = 0; x < all.width(); ++x)
        ASSERT_EQ(std::memcmp(one.texels.data() + 2 * (y * all.width() + x), all.row_bytes(y) + 8 * x + 2 * k, 2), 0);
  }
  EXPECT_LT(fs::file_size(cell / "drops.A.000000.exr"), fs::file_size(cell / "picture.000000.exr") / 5);
}

// A hash: n p films and a few standard deviations, and a film's side asks for no other film.
TEST_F(DataSets, TheSplitIsTheFilmsOwn) {
  constexpr int films = 20000;
  for (const double share : {0.1, 0.5, 0.9}) {
    int train = 0, moved = 0;
    for (int i = 0; i < films; ++i) {
      const std::string film = id_of(fmt::format("film {}", i));
      const bool here = is_train(film, share, 1);
      train += here;
      EXPECT_EQ(here, is_train(film, share, 1));
      EXPECT_TRUE(!here || is_train(film, share + 0.05, 1)) << "a larger share keeps what it had";
      moved += here != is_train(film, share, 2);
    }
    const double five_deviations = 5 * std::sqrt(films * share * (1 - share));
    EXPECT_NEAR(train, films * share, five_deviations);
    EXPECT_NEAR(moved, films * 2 * share * (1 - share), 5 * std::sqrt(films * 0.25)) << "another seed is another split";
  }
  EXPECT_FALSE(is_train("a", 0, 1));
  EXPECT_TRUE(is_train("a", 1, 1));
}

// The same seed has one clean cell: light and heavy rain before it are on its side, and stay there when more seeds come.
TEST_F(DataSets, OneStreetIsOnOneSide) {
  const OpenedPlan few(plan(text("", "{from = 3, count = 40}"), "few.toml")), many(plan(text("", "{from = 1, count = 80}"), "many.toml"));
  std::map<std::string, std::set<bool>> sides;
  std::set<bool> all;
  for (const OpenedPlan* p : {&few, &many}) {
    for (const char* rain : {"rainy", "heavy"}) {
      PairsAsked how = asked();
      how.rainy = rain;
      how.split = 0.5;
      for (const Pair& pair : pairs_of(p->cells, how)) {
        EXPECT_EQ(p->cells.values(p->cells.all()[pair.clean]).at(1), p->cells.values(p->cells.all()[pair.rainy]).at(1));
        sides[p->cells.values(p->cells.all()[pair.rainy]).at(1).second].insert(pair.is_train);
        all.insert(pair.is_train);
      }
    }
  }
  EXPECT_EQ(sides.size(), 80u);
  EXPECT_EQ(all.size(), 2u);
  for (const auto& [seed, of] : sides) EXPECT_EQ(of.size(), 1u) << seed;
}

TEST_F(DataSets, WhatDoesNotFitIsNamed) {
  const OpenedPlan opened(plan(text()));
  const auto said = [](const OpenedPlan& p, const PairsAsked& how) { return error_of([&] { pairs_of(p.cells, how); }); };
  PairsAsked how = asked();
  how.clean = "claen";
  EXPECT_EQ(said(opened, how),
            "2 --pairs: expected two labels of the plan, one of clean, rainy, heavy, found 'claen'; did you mean 'clean'?");
  how.clean = "rainy";
  EXPECT_EQ(said(opened, how), "2 --pairs: expected two labels, found 'rainy' twice");
  how = asked();
  how.mask = "drops.a";
  EXPECT_EQ(said(opened, how),
            "2 --mask: expected a channel that the plan keeps with 'exr:', one of drops.A, found 'drops.a'; did you mean 'drops.A'?");
  const OpenedPlan bare(plan("verb='run'\nscene='s.toml'\nkeep=['hash', 'picture']\n[axes]\nseed=[1]\ncases='cases.csv'\n", "bare.toml"));
  EXPECT_THAT(said(bare, asked()), HasSubstr("--mask: expected 'exr:drops.A' in keep of "));
  const OpenedPlan hashes(plan("verb='hash'\nscene='s.toml'\n[axes]\nseed=[1]\ncases='cases.csv'\n", "hashes.toml"));
  EXPECT_THAT(said(hashes, asked()), HasSubstr("--pairs: expected 'picture' in keep of "));
  const OpenedPlan unnamed(plan("verb='run'\nscene='s.toml'\nkeep=['picture','exr:drops.A']\n[axes]\nseed=[1, 2]\n", "unnamed.toml"));
  EXPECT_THAT(said(unnamed, asked()), HasSubstr("--pairs: expected a plan whose cases have a column 'name', found none in "));
  put(folder / "twice.csv", "name,drops.share\nclean,0\nclean,0.1\nrainy,0.5\n");
  const OpenedPlan twice(plan(text("", "[1, 2]", "'picture', 'exr:drops.A'", "twice.csv"), "twice.toml"));
  EXPECT_EQ(said(twice, asked()), "2 --pairs: expected one case with the label 'clean', found several");
  put(folder / "frames.csv", "name,drops.share,run.frames\nclean,0,2\nrainy,0.5,1\n");
  const OpenedPlan frames(plan(text("", "[1, 2]", "'picture', 'exr:drops.A'", "frames.csv"), "frames.toml"));
  EXPECT_THAT(said(frames, asked()),
              HasSubstr("--pairs: expected a cell 'clean' with the same frames for scene s.toml, seed 1, name rainy"));
  // What a plan keeps.
  EXPECT_THAT(refusal(text("set.picture.layer = false")),
              HasSubstr("plan.toml:3:18: keep: expected picture.layer = true for 'exr:drops.A', found false"));
  const auto failure = [&](const std::string& keep) {
    const OpenedPlan p(plan("verb='run'\nscene='s.toml'\nkeep=['" + keep + "']\n", "k.toml"));
    make(p, store);
    return store.failure(p.cells.all()[0].id).value_or(Failure{}).sentence;
  };
  EXPECT_THAT(failure("exr:drops.B1"), HasSubstr("k.toml:3:7: keep: expected a channel of the picture's EXR, one of R, G, B, "));
  EXPECT_THAT(failure("exr:backgruond.G"), HasSubstr("found 'backgruond.G'; did you mean 'background.G'?"));
  put(folder / "s.toml", scene("puddle", "corrected"));
  EXPECT_THAT(failure("drops"),
              HasSubstr("k.toml:3:7: keep: expected an effect with a list of round drops for 'drops', which screen_drops"));
}

}  // namespace
}  // namespace rainref::sweep
