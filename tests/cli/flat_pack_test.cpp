// `rainref pack --flat`: raw bytes with one JSON, from which a client that reads no NPY runs the cases.
#include <nlohmann/json.hpp>

#include "capture/flat_pack.h"
#include "cli/support.h"
#include "shipped_packs.h"

namespace rainref::cli {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class FlatPack : public CommandLine {
 protected:
  static std::string text_of(const std::vector<std::vector<std::byte>>& levels) {
    std::string out;
    for (const std::vector<std::byte>& level : levels) out.append(reinterpret_cast<const char*>(level.data()), level.size());
    return out;
  }
  std::string bytes(const json& entry) const { return contents(folder / "flat" / entry["file"].get<std::string>()); }
  std::set<std::string> files() const {
    std::set<std::string> out;
    for (const auto& e : std::filesystem::recursive_directory_iterator(folder / "flat"))
      if (e.is_regular_file()) out.insert(std::filesystem::relative(e.path(), folder / "flat"));
    return out;
  }
  json flat() const { return json::parse(contents(folder / "flat/flat.json")); }
};

TEST_F(FlatPack, HoldsWhatThePackHoldsAndNoExpectedOutput) {
  for (const rainref::test::PackPasses& p : rainref::test::shipped_packs()) {
    const capture::Pack pack(rainref::test::pack_folder(p.name));
    const capture::PackWriter::Total total = capture::write_flat(pack, folder / "flat");
    const json made = flat();
    std::set<std::string> named{"flat.json"};
    ASSERT_EQ(made["cases"].size(), pack.cases.size());
    for (std::size_t i = 0; i < pack.cases.size(); ++i) {
      const capture::PassCase c = pack.read(pack.cases[i]);
      const json& one = made["cases"][i];
      EXPECT_EQ(one["id"], pack.cases[i].id);
      EXPECT_EQ(bytes(one["uniforms"]), text_of({c.uniforms})) << one["id"];
      named.insert(one["uniforms"]["file"]);
      for (std::size_t k = 0; k < c.inputs.size(); ++k) {
        const json& input = one["inputs"][k];
        const capture::CaseInput& expected = c.inputs[k];
        EXPECT_EQ(input["name"], expected.name);
        std::vector<std::vector<std::byte>> levels(expected.array.levels.begin(), expected.array.levels.end());
        EXPECT_EQ(bytes(input), text_of(levels)) << one["id"] << ' ' << expected.name;
        EXPECT_EQ(input["bytes"], bytes(input).size());
        named.insert(input["file"]);
        if (expected.array.is_records) {
          EXPECT_EQ(input["count"].get<std::size_t>() * input["struct_stride"].get<std::size_t>(), bytes(input).size());
        } else {
          EXPECT_EQ(input["levels"], levels.size());
          EXPECT_EQ(input["address_u"], name(expected.address_u));
          EXPECT_EQ(input["filter"], name(expected.filter));
        }
      }
      std::size_t outputs = 0;
      for (const capture::CaseOutput& o : c.outputs) outputs += o.array.levels.size();
      EXPECT_EQ(one["outputs"].size(), outputs);
    }
    EXPECT_EQ(files(), named) << p.name;
    EXPECT_EQ(total.files, static_cast<int>(named.size()));
    EXPECT_FALSE(std::any_of(named.begin(), named.end(), [](const std::string& n) { return n.find("/out.") != std::string::npos; }));
  }
}

// A client that knows flat.json alone: its files are accepted, and judged as the values that it wrote.
TEST_F(FlatPack, AClientOfItIsJudged) {
  for (const std::string& effect : rainref::test::packed_effects()) {
    const std::filesystem::path pack_folder = rainref::test::pack_folder(effect + "-corrected");
    const capture::Pack pack(pack_folder);
    const Outcome made = good(copied({"pack", "--flat", pack_folder.string(), "-o", "flat"}));
    EXPECT_THAT(made.out, testing::StartsWith(fmt::format("{} cases in ", pack.cases.size())));
    std::filesystem::remove_all(folder / "port");
    const json described = flat();
    for (std::size_t i = 0; i < pack.cases.size(); ++i) {
      const json& one = described["cases"][i];
      std::map<std::string, int> level;
      const capture::PassCase c = pack.read(pack.cases[i]);
      for (const json& o : one["outputs"]) {
        const capture::Array& expected = c.output(o["name"].get<std::string>())->array;
        const std::vector<std::byte>& data = expected.levels[static_cast<std::size_t>(level[o["name"]]++)];
        json sidecar{{"format", o["format"]}, {"width", expected.width}};
        for (const char* key : {"width", "height", "struct_stride"})
          if (o.contains(key)) sidecar[key] = o[key];
        const std::filesystem::path file = folder / "port" / o["file"].get<std::string>();
        std::filesystem::create_directories(file.parent_path());
        put(file, text_of({data}));
        put(std::filesystem::path(file).replace_extension(".json"), sidecar.dump());
      }
    }
    const Outcome judged = copied({"validate", pack_folder.string(), "--port", "port", "--profile", "ieee"});
    EXPECT_EQ(judged.code, 0) << judged.out << judged.err;
  }
}

TEST_F(FlatPack, IsReplacedAndNothingElseIs) {
  const std::string pack = rainref::test::pack_folder("puddle-corrected").string();
  good(copied({"pack", "--flat", pack, "-o", "flat"}));
  const std::set<std::string> first = files();
  good(copied({"pack", "--flat", pack, "-o", "flat"}));
  EXPECT_EQ(files(), first);
  put(folder / "flat/mine.txt", "mine");
  before = folder.names();
  expect_refusal({"pack", "--flat", pack, "-o", "flat"}, 4, HasSubstr("'mine.txt' is no part of it"));
  expect_refusal({"pack", "--flat", pack, "-o", pack}, 4, HasSubstr("no flat pack of rainref"));
  expect_refusal({"pack", "--flat", "none", "-o", "f"}, 4, HasSubstr("none"));
  expect_refusal({"pack", "--flat", pack, "-o", "f", "--passes", "shade"}, 2, HasSubstr("--flat: expected none of --at"));
  expect_refusal({"pack", "--flat", pack, "--inputs", "run", "-o", "f"}, 2, "--inputs: only beside --spirv");
}

}  // namespace
}  // namespace rainref::cli
