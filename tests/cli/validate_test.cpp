// `rainref validate`: exit codes, a port's own command, races, shadows.
#include <csignal>

#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/port_command.h"
#include "cli/running.h"
#include "shipped_packs.h"

namespace rainref::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const std::string pack = rainref::test::pack_folder("puddle-corrected");
const std::string published = rainref::test::pack_folder("puddle-as-published");

class Validate : public CommandLine {
 protected:
  /// A copy of the pack as a port's folder.
  void copy_to(const std::string& name, const std::string& from = pack) const {
    std::filesystem::copy(from, folder / name, std::filesystem::copy_options::recursive);
  }
  Outcome validate(const std::vector<std::string>& arguments) const { return rainref(joined({"validate"}, arguments)); }
  Outcome exec(const std::string& command, const std::vector<std::string>& more = {}) const {
    return validate(joined({pack, "--exec", command}, more));
  }
};

TEST_F(Validate, ExitCodes) {
  copy_to("port");
  EXPECT_EQ(validate({pack, "--port", "port"}).code, 0);
  put(folder / "port/puddle.display/0011.0/out.picture.npy", contents(folder / "port/puddle.display/0012.0/out.picture.npy"));
  expect(validate({pack, "--port", "port"}), 1, AllOf(HasSubstr("display"), HasSubstr("FAIL")));
  EXPECT_EQ(validate({pack, "--port", "port", "--only", "shade"}).code, 0);
  EXPECT_EQ(validate({pack, "--port", "port", "--allow-untested"}).code, 1);

  before = folder.names();
  expect_refusal({"validate", pack}, 2, HasSubstr("expected --port DIR, or --exec COMMAND"));
  expect_refusal({"validate", "--port", "port"}, 2, HasSubstr("expected the folder of a PACK, or --shadow DIR"));
  expect_refusal({"validate", pack, "--port", pack}, 2, HasSubstr("judged by themselves"));
  expect_refusal({"validate", pack, "--port", "port", "--profile", "vulcan"}, 2, HasSubstr("did you mean 'vulkan'?"));
  expect_refusal({"validate", pack, "--port", "port", "--profile", "typical"}, 2,
                 AllOf(HasSubstr("expected one of cuda, d3d, gles, ieee, metal, opencl, opengl, vulkan, webgl, webgpu, found 'typical'"),
                       HasSubstr("no rule")));
  expect_refusal({"mutate", pack, "--profile", "typical"}, 2, HasSubstr("found 'typical'"));
  expect_refusal({"validate", pack, "--port", "port", "--only", "shad"}, 2, HasSubstr("did you mean 'shade'?"));
  expect_refusal({"validate", pack, "--port", "port", "--repeat", "2"}, 2, "--repeat: goes with --exec only");
  expect_refusal({"validate", pack, "--port", "port", "--set", "rain.rate=2"}, 2, HasSubstr("go with --shadow and a scene only"));
  expect_refusal({"validate", pack, "--exec", "true"}, 2, HasSubstr("expected {out} or $RAINREF_OUT in the command"));
  expect_refusal({"validate", pack, "--exec", ""}, 2, "--exec: expected a command, found ''");
  expect_refusal({"validate", pack, "--exec", "true {out}", "--timeout", "0"}, 2, HasSubstr("--timeout: expected a whole number from 1"));
  expect_refusal({"validate", pack, "--port", "port", "--causes-within", "0"}, 2,
                 HasSubstr("--causes-within: expected a whole number from 1"));
  expect_refusal({"validate", pack, "--port", "port", "--causes-within", "5", "--no-causes"}, 2, HasSubstr("which looks for none"));
  expect_refusal({"validate", pack, "--port", "port", "--spirv", ""}, 2, "--spirv: expected a folder, found ''");
  expect_refusal({"validate", pack, "--exec", "true {out}", "--spirv", "none"}, 4, HasSubstr("none/bindings.json"));
  expect_refusal({"validate", pack, "--exec", "true {out}", "--port", "port"}, 2, HasSubstr("expected a new or empty folder"));
  expect_refusal({"validate", pack, "--port", "none"}, 3, HasSubstr("none: expected a folder of a port, found none"));
  expect_refusal({"validate", "none", "--port", "none"}, 4, HasSubstr("no such folder"));
  expect_refusal({"validate", "none", "--port", "none", "--profile", "none"}, 4, HasSubstr("no such folder"));
}

// A port in progress says which passes it has.
TEST_F(Validate, SomePassesAlone) {
  copy_to("port");
  std::filesystem::remove_all(folder / "port/puddle.wave_step");
  for (const std::vector<std::string>& only : {std::vector<std::string>{"--only", "shade,display"},
                                               {"--only", "shade", "--only", "display"},
                                               {"--only=display", "--only=shade"}}) {
    expect(validate(joined({pack, "--port", "port"}, only)), 0, AllOf(HasSubstr("(2 PASS)"), Not(HasSubstr("raindrops"))));
  }
  EXPECT_EQ(validate({"--only", "shade", pack, "--port", "port"}).code, 0);  // it takes no PACK for a pass
  before = folder.names();
  expect_refusal({"validate", pack, "--port", "port", "--only", "shade,shad"}, 2, HasSubstr("found 'shad'; did you mean 'shade'?"));
  expect_refusal({"validate", pack, "--port", "port", "--only", "shade,"}, 2, HasSubstr("found ''"));
  expect_refusal({"mutate", pack, "--only", "shade", "--only", "shad"}, 2, HasSubstr("found 'shad'"));
}

TEST_F(Validate, WhatAPartialPortHasNotIsNotJudged) {
  copy_to("port");
  for (const char* pass : {"shade", "display"}) std::filesystem::remove_all(folder / "port" / (std::string("puddle.") + pass));
  EXPECT_EQ(validate({pack, "--port", "port"}).code, 3);
  expect(validate({pack, "--port", "port", "--partial"}), 1,
         AllOf(HasSubstr("(2 NOT JUDGED, 3 PASS)\n  not judged: shade, display\n"), HasSubstr("\nUNTESTED: port against")), "");
  EXPECT_EQ(validate({pack, "--port", "port", "--partial", "--allow-untested"}).code, 0);
  // Not what is missing or wrong beside it, and not without a PASS.
  EXPECT_EQ(validate({pack, "--port", "port", "--partial", "--allow-untested", "--only", "shade,display"}).code, 1);
  std::filesystem::remove(folder / "port/puddle.surface_hit/0011.0/out.hit.npy");
  EXPECT_EQ(validate({pack, "--port", "port", "--partial", "--allow-untested"}).code, 3);
  // The command of a port in progress, run twice.
  expect(exec("cp -r {pack}/. {out}; rm -r {out}/puddle.shade", {"--partial", "--allow-untested", "--repeat", "2"}), 0);
}

// Whatever is wrong with files, what can be judged is, and is told; the exit code is that of the files.
TEST_F(Validate, ABadFileHidesNoVerdict) {
  copy_to("port");
  put(folder / "port/puddle.wave_step/0011.0/out.wave.npy", "no array");
  std::filesystem::remove(folder / "port/puddle.shade/0012.0/out.colour.npy");
  expect(validate({pack, "--port", "port", "--allow-untested", "--json", "r.json"}), 3,
         AllOf(HasSubstr("PASS        display"), HasSubstr("NOT JUDGED  wave_step"),
               HasSubstr("\nmissing, or cannot be used:\n  'port/puddle.wave_step/0011.0/out.wave.npy'"),
               HasSubstr("(2 NOT JUDGED, 3 PASS)\n  not judged: wave_step, shade\n")),
         AllOf(StartsWith("rainref: 2 files are missing or cannot be used: 'port/puddle.wave_step/0011.0/out.wave.npy'"),
               HasSubstr("no 'out.colour' as .npy")));
  EXPECT_THAT(contents(folder / "r.json"), AllOf(HasSubstr("\"exit_code\": 3"), HasSubstr("\"status\": \"PASS\"")));
  put(folder / "port/puddle.display/0011.0/out.picture.npy", contents(folder / "port/puddle.display/0012.0/out.picture.npy"));
  expect(validate({pack, "--port", "port"}), 3, AllOf(HasSubstr("FAIL        display"), HasSubstr("FAIL: port against")));
  // Of the second run of a port, too.
  expect(exec("cp -r {pack}/. {out}; case {out} in *run.2) rm {out}/puddle.shade/0012.0/out.*;; esac; echo said", {"--repeat", "2"}), 3,
         AllOf(HasSubstr("(5 PASS)"), HasSubstr("ended with exit code 0 and printed last: said")));
}

// Nothing is judged of the article's march where its rays have no bound: not 0 unless that is forgiven, beside a PASS.
TEST_F(Validate, UntestedIsForgivenOnlyBesideAPass) {
  copy_to("port");
  std::filesystem::remove_all(folder / "port/puddle.display");
  EXPECT_EQ(validate({"--shadow", "port"}).code, 1);
  EXPECT_EQ(validate({"--shadow", "port", "--allow-untested"}).code, 0);
  EXPECT_EQ(validate({"--shadow", "port", "--allow-untested", "--only", "display"}).code, 1);
}

// The article's noise comes from a hash that no GPU reproduces. It is no PASS, and alone it is nothing.
TEST_F(Validate, WhatIsTakenAsDataIsNotJudged) {
  copy_to("port", published);
  expect(validate({published, "--port", "port", "--allow-untested"}), 0,
         AllOf(HasSubstr("DATA  ground_noise  nothing judged"), HasSubstr("(5 PASS, 1 DATA)")));
  for (const bool forgiving : {false, true}) {
    std::vector<std::string> arguments{published, "--port", "port", "--only", "ground_noise"};
    if (forgiving) arguments.push_back("--allow-untested");
    expect(validate(arguments), 1, HasSubstr("(1 DATA)\n  nothing was judged: all is taken as data\n"));
  }
}

TEST_F(Validate, ADamagedPackIsRefused) {
  copy_to("port");
  copy_to("bad");
  before = folder.names();
  std::string text = contents(folder / "bad/manifest.json");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    changed.replace(changed.find(from), from.size(), to);
    put(folder / "bad/manifest.json", changed);
  };
  with("\"version\": 1", "\"version\": 2");
  expect_refusal({"validate", "bad", "--port", "port"}, 3, HasSubstr("version 2 is newer"));
  with("\"file\":\"puddle.shade/0011.0/out", "\"file\":\"../port/puddle.shade/0011.0/out");
  expect_refusal({"validate", "bad", "--port", "port"}, 3, HasSubstr("the path of a file below the pack's folder"));
  with("\"formula\": \"puddle.shade.corrected/", "\"formula\": \"puddle.shade.corrected/9");
  expect_refusal({"validate", "bad", "--port", "port"}, 3,
                 AllOf(HasSubstr("expected the formula 'puddle.shade.corrected/"), HasSubstr("found 'puddle.shade.corrected/9"),
                       HasSubstr("make it again")));
}

TEST_F(Validate, APortsCommandIsRunAndJudged) {
  expect(exec("cp -r {pack}/. {out}"), 0);
  EXPECT_EQ(folder.names(), before);
  // Into a folder that stays, of a name that a shell would split.
  EXPECT_EQ(exec("cp -r \"{pack}\"/. \"{out}\"", {"--port", "it's a $HOME"}).code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "it's a $HOME/puddle.shade"));
  EXPECT_EQ(validate({pack, "--port", "it's a $HOME"}).code, 0);
}

// However deeply shells are nested, and whatever the paths hold.
TEST(PortCommand, PathsAreOneWordEverywhere) {
  TemporaryFolder folder;
  for (const std::string name : {"plain", "a 'b' \"c\" $d `e` \\f $(touch g) *;&|\n\x1b h", "-x", "\xc3\xa4"}) {
    const std::filesystem::path odd = folder / name;
    std::filesystem::create_directory(odd);
    const std::string real = std::filesystem::canonical(odd).string();
    const PortFolders folders(folder / "pack", odd);
    for (const std::string to : {"{out}/f", "\"{out}/f\"", "'{out}'/f", "\"$RAINREF_OUT\"/f"}) {
      for (const std::string& command :
           {"cat > " + to, "sh -c 'cat > \"$0\"' " + to, "eval 'cat > " + (to[0] == '\'' ? "{out}/f" : to) + "'",
            "cat << E > /dev/null; cat > " + to + "\n{out}\nE\n"}) {
        const CommandEnd told =
            run_command(folders.filled_in("printf text | { " + command + "\n}"), std::chrono::seconds(20), folders.environment());
        EXPECT_EQ(told.failure, "") << command;
        EXPECT_EQ(contents(odd / "f"), "text") << command;
        std::filesystem::remove(odd / "f");
      }
    }
    for (const std::string command : {"sh -c 'sh -c \"cd {out} && pwd -P\"'", "bash -c 'cd {out}; eval \"cd '{out}' && pwd -P\"'",
                                      "sh << 'E'\ncd \"{out}\" && pwd -P\nE", "cd \"$RAINREF_OUT\" && pwd -P"}) {
      const CommandEnd end = run_command(folders.filled_in("cd / && { " + command + "\n} > " + (folder / "said").string()),
                                         std::chrono::seconds(20), folders.environment());
      EXPECT_EQ(end.failure, "") << command;
      EXPECT_EQ(contents(folder / "said"), real + "\n") << command;
    }
  }
  EXPECT_EQ(folder.names().size(), 5u);
}

// What runs is read from files of processes, other programs' too, that may end meanwhile.
TEST(PortCommand, ProcessesOfOthersMayEndAtAnyTime) {
  const pid_t other = ::fork();
  if (other == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    for (;;) {
      const pid_t brief = ::fork();
      if (brief == 0) ::_exit(0);
      ::waitpid(brief, nullptr, 0);
    }
  }
  for (int k = 0; k < 200; ++k) EXPECT_EQ(run_command("true", std::chrono::seconds(20)).failure, "");
  ::kill(other, SIGKILL);
  ::waitpid(other, nullptr, 0);
}

TEST(PortCommand, WhoeverItStartsEndsWithIt) {
  TemporaryFolder folder;
  const auto daemon = [&] { return std::atoi(contents(folder / "daemon").c_str()); };
  const std::string start =
      "cd " + folder.path().string() + "; setsid sh -c 'echo $$ > daemon; (sleep 600 &) ; sleep 600' & while [ ! -s daemon ]; do :; done; ";
  EXPECT_EQ(run_command(start, std::chrono::seconds(20)).failure, "");
  EXPECT_GT(daemon(), 0);
  EXPECT_FALSE(is_running(daemon()));
  std::filesystem::remove(folder / "daemon");
  EXPECT_THAT(run_command(start + "sleep 600", std::chrono::seconds(1)).failure, HasSubstr("was ended after 1 s"));
  EXPECT_GT(daemon(), 0);
  EXPECT_FALSE(is_running(daemon()));
}

// A child that this process had before is none of the port's.
TEST(PortCommand, NobodyElseIsEnded) {
  ChildProcess other([] { return sleep_for_ever(); });
  EXPECT_EQ(run_command("true", std::chrono::seconds(20)).failure, "");
  EXPECT_TRUE(is_running(other.id()));
  EXPECT_EQ(other.end(SIGTERM), -SIGTERM);
}

TEST(PortCommand, TheLastLinesAreKept) {
  const CommandEnd end =
      run_command("i=0; while [ $i -lt 5000 ]; do i=$((i+1)); echo line $i; done; echo end >&2; exit 3", std::chrono::seconds(60));
  EXPECT_EQ(end.failure, "the port's command ended with exit code 3");
  ASSERT_EQ(end.last_lines.size(), 20u);
  EXPECT_EQ(end.last_lines.back(), "end");
  EXPECT_EQ(end.last_lines.front(), "line 4982");
}

TEST_F(Validate, ACommandThatFailsIsReported) {
  expect(exec("echo first; echo last >&2; exit 3; : {out}"), 1,
         AllOf(HasSubstr("FAIL"), HasSubstr("the port's command ended with exit code 3"), HasSubstr("the port printed: last")));
  expect(exec("kill -9 $$; : {out}"), 1, HasSubstr("ended by signal 9"));
  Outcome o = exec("sh -c 'kill -11 $$'; exit $? {out}");
  EXPECT_THAT(o.out, HasSubstr("exit code 139: signal 11"));
  expect(exec("no-such-port {pack} {out}"), 1, HasSubstr("exit code 127: there is no such program"));
  // It succeeds and writes nothing.
  expect(exec("true {out}"), 3, testing::_,
         AllOf(HasSubstr(": expected folders such as puddle.raindrops/0011.0 with the port's outputs, found none\n"),
               Not(HasSubstr("printed"))));
  expect(exec("echo no device; : {out}"), 3, testing::_,
         HasSubstr("found none; the port's command ended with exit code 0 and printed last: no device\n"));
  EXPECT_EQ(folder.names(), before);
}

TEST_F(Validate, ACommandThatTakesTooLongIsEndedWithItsWholeGroup) {
  const auto start = std::chrono::steady_clock::now();
  expect(exec("(sleep 60; echo > late) & echo $! > child; sleep 60; : {out}", {"--timeout", "1"}), 1,
         HasSubstr("the port's command was ended after 1 s (--timeout)"));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
  // Reparented to whoever reaps here; a dead process may be left as a zombie, which runs nothing.
  const std::string status = contents("/proc/" + std::to_string(std::stoi(contents(folder / "child"))) + "/stat");
  EXPECT_TRUE(status.empty() || status.find(") Z ") != std::string::npos) << status;
}

// What a command leaves running is ended too: it could go on writing.
TEST_F(Validate, NothingIsLeftRunning) {
  const auto start = std::chrono::steady_clock::now();
  expect(exec("cp -r {pack}/. {out}; sleep 60 &"), 0);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
}

TEST_F(Validate, APortWhoseFolderWasReplacedIsRefused) {
  expect(exec("rm -r {out}; mkdir {out}", {"--port", "an odd name"}), 3, testing::_,
         AllOf(HasSubstr("the command removed {out}, which was a link to '"), HasSubstr("an odd name'")));
  EXPECT_EQ(exec("cp -r \"$RAINREF_PACK/.\" \"$RAINREF_OUT\"", {"--port", "another odd name"}).code, 0);
}

TEST_F(Validate, ARaceIsFoundAndNamed) {
  // The second run differs in the last byte of a file, an alpha of a picture.
  const std::string command =
      "cp -r {pack}/. {out}; case {out} in *run.2) cd {out}/puddle.display/0012.0; n=$(($(wc -c < out.picture.npy) - 2)); "
      "printf '\\001' | dd of=out.picture.npy bs=1 seek=$n conv=notrunc status=none;; esac";
  EXPECT_EQ(exec(command).code, 0);
  expect(exec(command, {"--repeat", "3"}), 1,
         AllOf(HasSubstr("race: puddle.display/0012.0/out.picture differs between runs 1 and 2 on the same inputs, first\n    "
                         "at (34, 20).z, 1 of 2940 elements\n"),
               HasSubstr("the port ran 3 times"), Not(HasSubstr("outside the as-written envelope"))));
  expect(exec(command, {"--repeat", "2", "--port", "kept"}), 1);
  EXPECT_TRUE(std::filesystem::exists(folder / "kept/run.2/puddle.display"));
  EXPECT_EQ(exec("cp -r {pack}/. {out}", {"--repeat", "2"}).code, 0);
}

TEST_F(Validate, TheReferencesOwnRunPassesAsAShadow) {
  for (const std::string scene : {"corrected", "published"}) {
    ASSERT_EQ(rainref({"run", scene + ".toml", "--frames", "3", "--every", "1", "--capture", "all", "--set", "puddle.drop_intensity=3",
                       "-o", scene})
                  .code,
              0);
    const std::string dump = scene + "/capture";
    const std::vector<std::string> forgiving =
        scene == "published" ? std::vector<std::string>{"--allow-untested"} : std::vector<std::string>{};
    for (const bool with_scene : {false, true}) {
      std::vector<std::string> arguments = joined({"--shadow", dump}, forgiving);
      if (with_scene) arguments.insert(arguments.end(), {scene + ".toml", "--set", "puddle.drop_intensity=3"});
      const Outcome o = validate(arguments);
      EXPECT_EQ(o.code, 0) << o.out << o.err;
      EXPECT_THAT(o.out, Not(HasSubstr("note:"))) << scene;  // every input and uniform is the scene's
      EXPECT_THAT(o.out, Not(HasSubstr("FAIL")));
    }
  }
  // Another scene's uniforms fail, and so say the reports; a host that chose them is forgiven.
  std::vector<std::string> other{"--shadow", "corrected/capture",  "corrected.toml", "--set", "puddle.drop_intensity=3",
                                 "--set",    "display.exposure=1", "--junit",        "j.xml"};
  expect(validate(other), 1, AllOf(HasSubstr("FAIL display"), HasSubstr("uniform exposure is "), HasSubstr("--foreign-host")));
  EXPECT_THAT(contents(folder / "j.xml"),
              AllOf(HasSubstr("failures=\"3\""), HasSubstr("<failure type=\"broken\" message=\"uniform exposure is ")));
  other.push_back("--foreign-host");
  expect(validate(other), 0, HasSubstr("uniform exposure of display is not the scene's in 3 runs"));
}

// Mistakes that only a shadow sees, each in a run that is consistent: the whole scene was run so.
TEST_F(Validate, AHostThatRunsAnotherSceneFails) {
  for (const char* set : {"puddle.damping=0.9", "camera.target=[0.5, 0, 0]"}) {
    ASSERT_EQ(rainref({"run", "corrected.toml", "--frames", "2", "--every", "1", "--capture", "all", "--image", "none", "--set", set, "-o",
                       "own"})
                  .code,
              0)
        << set;
    const Outcome o = validate({"--shadow", "own/capture", "corrected.toml", "--no-causes"});
    EXPECT_EQ(o.code, 1) << set << o.out << o.err;
    EXPECT_THAT(o.out, HasSubstr("--foreign-host")) << set;
    std::filesystem::remove_all(folder / "own");
  }
  EXPECT_EQ(validate({pack, "--port", "port", "--foreign-host"}).code, 2);
}

// A warning is a failure where that is asked for: in the exit code, in the verdict, in the reports.
TEST_F(Validate, StrictFailsWarnings) {
  copy_to("port");
  // rainref rounds halves to nearest, and Direct3D asks for truncation.
  const std::vector<std::string> arguments{pack, "--port", "port", "--profile", "d3d", "--junit", "j.xml"};
  expect(validate(arguments), 0, HasSubstr("WARN"));
  EXPECT_THAT(contents(folder / "j.xml"), HasSubstr("failures=\"0\""));
  std::vector<std::string> strict = arguments;
  strict.push_back("--strict");
  expect(validate(strict), 1,
         AllOf(HasSubstr("a warning, which is to fail: stores to binary16"), HasSubstr("\nFAIL: port against"), Not(HasSubstr("WARN"))));
  EXPECT_THAT(contents(folder / "j.xml"), HasSubstr("<failure type=\"broken\" message=\"a warning, which is to fail: stores to binary16"));
  EXPECT_EQ(validate({pack, "--port", "port", "--strict"}).code, 0);
}

// Lines of our source are for who asks.
TEST_F(Validate, VerboseSaysMore) {
  copy_to("port");
  Outcome o = validate({pack, "--port", "port"});
  EXPECT_THAT(o.out, AllOf(Not(HasSubstr("never:")), Not(HasSubstr("stores to half")), Not(HasSubstr(".pass.h"))));
  expect(validate({pack, "--port", "port", "--verbose"}), 0,
         AllOf(HasSubstr("exercises "), HasSubstr("never:"), HasSubstr("stores to half")));
}

// A whole run of each effect: lists of drops, and mip levels that are shared between the runs of a capture.
TEST_F(Validate, TheReferencesOwnRunOfEachEffectPassesAsAShadow) {
  for (const std::string effect : {"windshield", "screen_drops", "rainy_glass", "edge_splash"}) {
    for (const std::string variant : {"as-published", "corrected"}) {
      const std::string name = effect + "-" + variant, scene = rainref::test::pack_scene(name);
      ASSERT_EQ(rainref({"run", scene, "--frames", "3", "--every", "1", "--capture", "all", "--image", "none", "-o", name}).code, 0);
      for (const bool with_scene : {false, true}) {
        std::vector<std::string> arguments{"--shadow", name + "/capture"};
        if (with_scene) arguments.push_back(scene);
        const Outcome o = validate(arguments);
        EXPECT_EQ(o.code, 0) << name << o.out << o.err;
        EXPECT_THAT(o.out, AllOf(Not(HasSubstr("note:")), Not(HasSubstr("FAIL")))) << name;
      }
    }
  }
}

TEST_F(Validate, ALostDropIsNamed) {
  const std::string windshield = rainref::test::pack_folder("windshield-corrected"), list = "windshield.merge/0012.0/out.drops.npy";
  copy_to("port", windshield);
  // The last record of 32 bytes; the header's length of the list stays as long as it is.
  std::string bytes = contents(folder / "port" / list);
  const std::size_t shape = bytes.find("(", bytes.find("'shape'")) + 1;
  const int count = std::stoi(bytes.substr(shape));
  const std::string was = std::to_string(count), is = std::to_string(count - 1);
  ASSERT_EQ(was.size(), is.size());
  bytes.replace(shape, was.size(), is);
  put(folder / "port" / list, bytes.substr(0, bytes.size() - 32));
  const Outcome o = validate({windshield, "--port", "port", "--only", "merge"});
  EXPECT_EQ(o.code, 1) << o.out;
  // A short dispatch, a lost append and a short input give the same list here, so none is called likely.
  EXPECT_THAT(o.out, AllOf(HasSubstr("drops, missing: "), HasSubstr("may be: drops without its last record"),
                           HasSubstr("(gives 1 of 1 failing records bit for bit")));
}

// A port's file that cannot be used is the port's, whatever it is: docs/reports.md. The rest is judged and reported.
TEST_F(Validate, AnyKindOfUnusableFileIsThePorts) {
  namespace fs = std::filesystem;
  copy_to("pk");
  copy_to("port");
  const std::string name = "puddle.display/0011.0/out.picture.npy";
  const fs::path file = folder / "port" / name, info = folder / "port/port.json";
  const auto judged = [&](const std::string& what, const std::string& said) {
    const Outcome o = validate({"pk", "--port", "port", "--only", "display"});
    EXPECT_EQ(o.code, 3) << what << o.out << o.err;
    EXPECT_THAT(o.err, HasSubstr(said)) << what;
    return o.out;
  };
  const auto each = [&](const fs::path& at) {
    std::vector<std::string> reports;
    fs::remove(at);
    ASSERT_EQ(::mkfifo(at.c_str(), 0600), 0);
    reports.push_back(judged("pipe", "expected a file, found a pipe"));
    fs::remove(at);
    fs::create_directory(at);
    reports.push_back(judged("folder", "expected a file, found a folder"));
    fs::remove(at);
    fs::create_symlink("/dev/null", at);
    reports.push_back(judged("device", "expected a file, found a device"));
    fs::remove(at);
    const int listening = ::socket(AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const fs::path current = fs::current_path();
    fs::current_path(at.parent_path());  // a socket's path is short
    at.filename().string().copy(address.sun_path, sizeof address.sun_path - 1);
    EXPECT_EQ(::bind(listening, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    fs::current_path(current);
    reports.push_back(judged("socket", "expected a file, found a socket"));
    ::close(listening);
    fs::remove(at);
    if (at != file) return;
    for (const std::string& report : reports) EXPECT_THAT(report, HasSubstr("NOT JUDGED"));
  };
  each(file);
  for (const bool is_hard : {false, true}) {
    is_hard ? fs::create_hard_link(folder / "pk" / name, file) : fs::create_symlink(folder / "pk" / name, file);
    judged(is_hard ? "hard link" : "link", "would be judged by themselves");
    fs::remove(file);
  }
  fs::create_symlink("nowhere", file);
  judged("a link that leads nowhere", "no 'out.picture' as .npy");
  fs::remove(file);
  put(file, contents(folder / "pk" / name));
  each(info);
  put(info, "");
  fs::resize_file(info, std::uintmax_t{1} << 40);  // costs the port nothing
  judged("a long port.json", "'port/port.json': 1099511627776 bytes; expected at most 1048576");
  fs::remove(info);
  EXPECT_EQ(validate({"pk", "--port", "port", "--only", "display"}).code, 0);
}

// Causes may take minutes.
TEST_F(Validate, ATerminalSaysWhatCausesAreSoughtIn) {
  copy_to("port");
  put(folder / "port/puddle.display/0011.0/out.picture.npy", contents(folder / "port/puddle.display/0012.0/out.picture.npy"));
  const std::vector<std::string> arguments{"validate", pack, "--port", "port", "--only", "display"};
  Circumstances terminal;
  terminal.terminal_error = true;
  const Outcome shown = run_rainref(folder.path(), arguments, terminal), piped = run_rainref(folder.path(), arguments);
  EXPECT_THAT(shown.err, AllOf(HasSubstr("judging ["), HasSubstr("\rseeking the cause in display\033[K"), testing::EndsWith("\r\033[K")));
  EXPECT_EQ(piped.err, "");
  EXPECT_EQ(shown.out, piped.out);
}

TEST_F(Validate, ShadowsThatCannotBeJudgedAreRefused) {
  std::filesystem::create_directories(folder / "dump/puddle.shade/0000.0");
  std::filesystem::create_directories(folder / "empty");
  before = folder.names();
  expect_refusal({"validate", "--shadow", "dump"}, 2, HasSubstr("expected a manifest.json there, or the scene that the port ran"));
  expect_refusal({"validate", "--shadow", "none"}, 3, HasSubstr("found none"));
  expect_refusal({"validate", "--shadow", "empty", "corrected.toml"}, 3,
                 HasSubstr("expected folders such as puddle.raindrops/0000.0, found none"));
  expect(validate({"--shadow", "dump", "corrected.toml"}), 3, HasSubstr("(5 NOT JUDGED)"),
         AllOf(HasSubstr("uniforms.bin' is missing"), HasSubstr("in.hit"), HasSubstr("out.colour")));
  expect_refusal({"validate", "--shadow", "dump", "corrected.toml", "--only", "shde"}, 2, HasSubstr("did you mean 'shade'?"));
  expect_refusal({"validate", pack, "--shadow", "dump"}, 2,
                 HasSubstr("--shadow: expected the scene that the port ran, found the folder '" + pack));
  expect_refusal({"validate", "--shadow", "dump", "none.toml"}, 4, HasSubstr("none.toml"));
  expect_refusal({"validate", "--shadow", "dump", "--port", "x"}, 2, "--port: does not go with --shadow");
  expect_refusal({"validate", "--shadow", "dump", "--spirv", "x"}, 2, "--spirv: does not go with --shadow");
  std::filesystem::create_directories(folder / "dump/puddle.shade/0000.7");
  expect_refusal({"validate", "--shadow", "dump", "corrected.toml"}, 3, HasSubstr("corrected.toml runs shade 1 time in frame 0"));
  // A folder's name had 10^8 frames simulated.
  std::filesystem::create_directories(folder / "late/puddle.shade/99999999.0");
  before = folder.names();
  expect_refusal({"validate", "--shadow", "late", "corrected.toml"}, 3,
                 HasSubstr("late: expected frames below 3600, found 99999999; where the port ran longer, --set run.frames says so"));
}

}  // namespace
}  // namespace rainref::cli
