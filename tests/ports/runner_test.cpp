// port_runner says what it is, and refuses what it cannot run: the file, the key, what it expected and what it found.
#include <functional>

#include "ports/support.h"

namespace rainref {
namespace {

using namespace ports;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(PortRunner, NamesTheFileAndWhatItExpected) {
  const TemporaryFolder folder;
  const fs::path pack = folder / "pack";
  fs::copy(pack_of("corrected"), pack, fs::copy_options::recursive);
  const fs::path wave = pack / "puddle.wave_step/0011.0/in.wave.npy";
  fs::copy_file(pack / "puddle.display/0011.0/out.picture.npy", wave, fs::copy_options::overwrite_existing);
  EXPECT_THAT(run_port(pack, folder / "out", "--only wave_step").text,
              HasSubstr("in.wave.npy: expected '<f2' (19, 29, 2), found '|u1' (21, 35, 4)"));
  fs::remove(wave);
  EXPECT_THAT(run_port(pack, folder / "out", "--only wave_step").text, HasSubstr("in.wave.npy: cannot be read"));
  put(pack / "puddle.display/0011.0/uniforms.bin", "short");
  EXPECT_THAT(run_port(pack, folder / "out", "--only display").text, HasSubstr("uniforms.bin: expected 16 bytes, found 5"));
  put(pack / "manifest.json", R"({"format": "rainref.pack", "version": 2})");
  EXPECT_THAT(run_port(pack, folder / "out").text, HasSubstr("this runner knows version 1, the pack has 2"));
}
TEST(PortRunner, RefusesUnknownOptionsDevicesAndPasses) {
  const TemporaryFolder folder;
  EXPECT_THAT(run_port(pack_of("corrected"), folder.path(), "--sped 0=1").text, HasSubstr("--sped: unknown"));
  EXPECT_THAT(run_port(pack_of("corrected"), folder.path(), "--spec 0").text, HasSubstr("--spec: expected ID=VALUE, found '0'"));
  EXPECT_THAT(run_port(pack_of("corrected"), folder.path(), "--device 99").text, HasSubstr("--device 99: expected cpu or a number below"));
  EXPECT_THAT(run_port(pack_of("corrected"), folder.path(), "--only sheen").text, HasSubstr("no case of this pass has a program"));
  EXPECT_THAT(call(RAINREF_PORT_RUNNER " --list").text, HasSubstr("llvmpipe"));
}
TEST(PortRunner, HelpSaysEveryOptionAndExitCode) {
  for (const char* option : {"--help", "-h", "--pack x --help"}) {
    const Outcome help = call(RAINREF_PORT_RUNNER " " + std::string(option));
    EXPECT_EQ(help.code, 0) << help.text;
    for (const char* word : {"usage: port_runner", "--pack", "--spirv", "--out", "--only", "--device", "--spec", "--repeat", "--time",
                             "--list", "Exit codes: 0 every case ran"})
      EXPECT_THAT(help.text, HasSubstr(word));
  }
}
TEST(PortRunner, WrongOptionsExitWithTheCodeOfUsage) {
  const TemporaryFolder folder;
  const std::string pack = pack_of("corrected");
  for (const char* wrong :
       {"--time 0", "--time x", "--repeat 0", "--repeat x", "--spec 0", "--device 99", "--only sheen", "--sped 0=1", "--spec"})
    EXPECT_EQ(run_port(pack, folder.path(), wrong).code, 2) << wrong;
  EXPECT_EQ(call(RAINREF_PORT_RUNNER).code, 2);
  EXPECT_THAT(run_port(pack, folder.path(), "--repaet 3").text, HasSubstr("--repaet: unknown; did you mean '--repeat'?\nusage: "));
  EXPECT_THAT(run_port(pack, folder.path(), "--only shad").text, HasSubstr("; did you mean 'shade'?"));
}

TEST(PortRunner, TimesCasesOfImagesAndLeavesTheirOutputsAlone) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_port(pack_of("corrected"), folder / "plain", "--only display").code, 0);
  const Outcome o = run_port(pack_of("corrected"), folder / "timed", "--only display --time 1");
  ASSERT_EQ(o.code, 0) << o.text;
  EXPECT_FALSE(fs::exists(folder / "plain/times.json"));
  const json times = json::parse(contents(folder / "timed/times.json"));
  ASSERT_FALSE(times.empty());
  for (const json& t : times) {
    EXPECT_EQ(t.at("formula"), "puddle.display.corrected/1");
    EXPECT_EQ(t.at("width"), 35);
    EXPECT_EQ(t.at("height"), 21);
    EXPECT_GE(t.at("seconds").size(), 3u);
    for (const json& s : t.at("seconds")) EXPECT_GT(s.get<double>(), 0);
    const std::string out = t.at("case").get<std::string>() + "/out.picture.npy";
    EXPECT_EQ(contents(folder / "timed" / out), contents(folder / "plain" / out)) << out;
  }
  // A list would grow from one dispatch to the next.
  ASSERT_EQ(run_port(pack_of("corrected"), folder / "list", "--only raindrops --time 1").code, 0);
  EXPECT_EQ(json::parse(contents(folder / "list/times.json")), json::array());
}

// ---- bindings.json -------------------------------------------------------------------------------------------------
const std::string display = "puddle.display.corrected/1", wave_step = "puddle.wave_step.corrected/2";

/// What the runner says of the puddle's bindings after a change to them; the shaders are there.
Outcome with_bindings(const std::function<void(json&)>& change, const std::string& pass = "display") {
  const TemporaryFolder folder;
  fs::create_directory(folder / "port");
  for (const auto& file : fs::directory_iterator(spirv + "/puddle"))
    if (file.path().extension() == ".spv") fs::copy_file(file.path(), folder / "port" / file.path().filename());
  json all = json::parse(contents(spirv + "/puddle/bindings.json"));
  change(all);
  put(folder / "port/bindings.json", all.dump(2));
  return call(quiet + RAINREF_PORT_RUNNER " --device cpu --pack '" + pack_of("corrected") + "' --spirv '" + (folder / "port").string() +
              "' --out '" + (folder / "out").string() + "' --only " + pass);
}
void expect_refused(const std::string& message, const std::function<void(json&)>& change, const std::string& pass = "display") {
  const Outcome run = with_bindings(change, pass);
  EXPECT_EQ(run.code, 3) << run.text;
  EXPECT_THAT(run.text, HasSubstr("/port/bindings.json: " + message));
  EXPECT_THAT(run.text, Not(HasSubstr("json.exception")));
}

TEST(Bindings, MissingKeysAreNamed) {
  expect_refused("the key 'programs' is missing", [](json& all) { all.erase("programs"); });
  for (const char* key : {"spirv", "inputs", "outputs"}) {
    expect_refused("programs / " + display + ": the key '" + key + "' is missing", [&](json& all) { all["programs"][display].erase(key); });
  }
  expect_refused("programs / " + wave_step + " / constants / 1: the key 'input' is missing",
                 [](json& all) { all["programs"][wave_step]["constants"][1].erase("input"); });
}
TEST(Bindings, UnknownKeysGetTheNearestOne) {
  expect_refused("unknown key 'program', expected one of programs; did you mean 'programs'?", [](json& all) { all["program"] = 1; });
  expect_refused(
      "programs / " + display +
          ": unknown key 'one_gruop', expected one of spirv, inputs, outputs, constants, lists, one_group, group, capacity; did you "
          "mean 'one_group'?",
      [](json& all) { all["programs"][display]["one_gruop"] = true; });
}
TEST(Bindings, EachKeyIsDocumented) {
  const std::string readme = contents(examples + "/README.md");
  for (const char* key : {"spirv", "inputs", "outputs", "constants", "lists", "one_group", "group", "capacity"})
    EXPECT_THAT(readme, HasSubstr("\n| `" + std::string(key) + "` | "));
}
TEST(Bindings, IllTypedValuesAreShown) {
  const auto refused = [](const char* key, const json& value, const std::string& message) {
    expect_refused("programs / " + display + " / " + message, [&](json& all) { all["programs"][display][key] = value; });
  };
  refused("spirv", 7, "spirv: expected a text, found 7");
  refused("inputs", "colour", "inputs: expected a list of texts, found \"colour\"");
  refused("inputs", json::array({1}), "inputs: expected a list of texts, found [1]");
  refused("outputs", json::array(), "outputs: expected at least one output, found []");
  refused("constants", 1, "constants: expected a list of constants, found 1");
  refused("one_group", "yes", "one_group: expected true or false, found \"yes\"");
  refused("group", 8, "group: expected two whole numbers, such as [8, 8], found 8");
  refused("group", json::array({8, 0}), "group / 1: expected a whole number from 1 to 1024, found 0");
  refused("group", json::array({8, 8.5}), "group / 1: expected a whole number from 1 to 1024, found 8.5");
  refused("capacity", -1, "capacity: expected a whole number from 1 to 16777216, found -1");
  expect_refused("expected an object, found [1]", [](json& all) { all = json::array({1}); });
  expect_refused("programs: expected an object, found 3", [](json& all) { all["programs"] = 3; });
  expect_refused("programs / " + display + ": expected an object, found null", [](json& all) { all["programs"][display] = nullptr; });
}
TEST(Bindings, NamesThatNothingHasGetTheNearestOne) {
  const auto constant = [](const char* key, const char* value) {
    return [=](json& all) { all["programs"][wave_step]["constants"][0][key] = value; };
  };
  const std::string first = "programs / " + wave_step + " / constants / 0 / ";
  expect_refused(first + "key: expected one of address_u, address_v, present, found \"adress_u\"; did you mean 'address_u'?",
                 constant("key", "adress_u"));
  expect_refused(first + "input: expected one of the program's inputs, wave, drops, shore, found \"wvae\"; did you mean 'wave'?",
                 constant("input", "wvae"));
  expect_refused("programs / " + display + " / inputs: expected what the pass reads, colour, found 'color'; did you mean 'colour'?",
                 [](json& all) { all["programs"][display]["inputs"] = json::array({"color"}); });
  expect_refused("programs / " + display + " / lists: expected some of the program's inputs, colour, found ",
                 [](json& all) { all["programs"][display]["lists"] = json::array({"color"}); });
  expect_refused("programs / " + display + " / outputs: expected what the pass writes, picture, found 'image'",
                 [](json& all) { all["programs"][display]["outputs"] = json::array({"image"}); });
}
TEST(Bindings, ListsNeedTheirKeys) {
  const std::string raindrops = "puddle.raindrops.corrected/2", at = "programs / " + raindrops + " / ";
  const auto without = [&](const char* key) { return [=](json& all) { all["programs"][raindrops].erase(key); }; };
  expect_refused(at + "capacity: expected a number of records for the output drops, found none", without("capacity"), "raindrops");
  expect_refused(at + "one_group: expected true, because the first output, drops, is no image", without("one_group"), "raindrops");
  expect_refused(
      at + "group: expected none beside one_group",
      [&](json& all) {
        all["programs"][raindrops]["group"] = json::array({8, 8});
      },
      "raindrops");
}
TEST(Bindings, GroupSaysHowManyGroupsThereAre) {
  // Groups said to be half as wide are twice as many; the shader's own bounds hold.
  const Outcome narrow = with_bindings([](json& all) { all["programs"][display]["group"] = json::array({4, 8}); });
  EXPECT_EQ(narrow.code, 0) << narrow.text;
}
TEST(Bindings, AMissingShaderIsNamedByKeyAndFile) {
  expect_refused("programs / " + display + " / spirv: no such file: ",
                 [](json& all) { all["programs"][display]["spirv"] = "display.spv"; });
}
TEST(Bindings, MalformedJsonIsNamedByLineAndColumn) {
  const TemporaryFolder folder;
  put(folder / "bindings.json", "{\n  \"programs\": {,}\n}\n");
  const Outcome run = call(RAINREF_PORT_RUNNER " --pack '" + pack_of("corrected") + "' --spirv '" + folder.path().string() + "' --out '" +
                           (folder / "out").string() + "'");
  EXPECT_EQ(run.code, 3);
  EXPECT_THAT(run.text, AllOf(HasSubstr("/bindings.json: expected JSON: parse error at line 2, column 16"), Not(HasSubstr("exception"))));
  const Outcome none = run_port(pack_of("corrected"), folder / "out", "", "nowhere");
  EXPECT_EQ(none.code, 3);
  EXPECT_THAT(none.text, HasSubstr("/nowhere/bindings.json: cannot be read"));
}

}  // namespace
}  // namespace rainref
