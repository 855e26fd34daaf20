// What engines are handed: a shell accepts it, whatever files are called, and it names every shard once.
#include "sweep/script.h"

#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error_of.h"
#include "base/temporary_folder.h"

namespace rainref::sweep {
namespace {

using testing::HasSubstr;

TEST(Script, IsTextOfAShell) {
  const TemporaryFolder folder;
  for (const std::string engine : {"slurm", "parallel", "sge"}) {
    const std::string text = script({engine, "/opt/it's/rainref", "/data/a plan.toml", "/data/$out", 8, 2, ""});
    put(folder / "script", text);
    EXPECT_EQ(std::system(("sh -n '" + (folder / "script").string() + "'").c_str()), 0) << text;
    // A job's command is one word of the script, so its own quotes are quoted again.
    EXPECT_THAT(text, HasSubstr(engine == "parallel" ? "sweep collect '/data/a plan.toml' -o '/data/$out'"
                                                     : R"(sweep collect '\''/data/a plan.toml'\'' -o '\''/data/$out'\'')"));
    EXPECT_THAT(text, HasSubstr("--threads 2"));
  }
  EXPECT_THAT(script({"slurm", "/r", "/p", "/o", 8, 1, ""}), HasSubstr("--array=0-7"));
  EXPECT_THAT(script({"sge", "/r", "/p", "/o", 8, 1, ""}), HasSubstr("-t 1-8"));
  EXPECT_THAT(script({"kubernetes", "/r", "/p", "/o", 8, 1, "img"}), HasSubstr("completions: 8"));
  EXPECT_THAT(script({"kubernetes", "/r", "/p", "/o", 8, 1, "img"}),
              HasSubstr("exec '/r' sweep run '/p' -o '/o' --shard auto/8 --threads 1"));
  EXPECT_EQ(error_of([] {
              script({"slrum", "/r", "/p", "/o", 8, 1, ""});
            }),
            "2 --engine: expected one of slurm, parallel, sge, kubernetes, found 'slrum'; did you mean 'slurm'?");
}

// No path is taken for a line of the script, nor for another key of the manifest.
TEST(Script, PathsAreNoCommands) {
  const std::string evil = "/data/a\nJOB\ntouch PWNED\n#.toml";
  for (const std::string& engine : engines()) {
    for (int which = 0; which < 3; ++which) {
      ScriptAsked asked{engine, "/r", "/p", "/o", 8, 1, "img"};
      (which == 0 ? asked.program : which == 1 ? asked.plan : asked.out) = evil;
      EXPECT_THAT(error_of([&] { script(asked); }),
                  HasSubstr("expected a text without line ends and other control characters, found \"/data/a\\nJOB\\n"))
          << engine;
    }
    if (engine == "kubernetes") continue;
    EXPECT_THAT(script({engine, "/r", "/p", "/o", 8, 1, ""}), testing::Not(HasSubstr("<<"))) << "a here-document ends at any line";
  }
  EXPECT_THAT(error_of([] {
                script({"kubernetes", "/r", "/p", "/o", 8, 1, "x\n        securityContext: {privileged: true}"});
              }),
              HasSubstr("--image: expected a text without line ends"));
  EXPECT_THAT(script({"kubernetes", "/r", "/p", "/o\"", 8, 1, "host:5000/img # {a: b}"}),
              testing::AllOf(HasSubstr("image: \"host:5000/img # {a: b}\"\n"), HasSubstr("mountPath: \"/o\\\"\"}")));
  EXPECT_THAT(error_of([] { script({"kubernetes", "/r", "/p\xff", "/o", 8, 1, "i"}); }), HasSubstr("PLAN: expected a text in UTF-8"));
  EXPECT_THAT(error_of([] { script({"parallel", "/r", "/a{/}b", "/o", 8, 1, ""}); }), HasSubstr("PLAN: expected a text without braces"));
}

// A job's script is one word of the one that submits it, whatever its paths hold.
TEST(Script, JobsSurviveTwoShells) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "bin");
  const std::string submit = "#!/bin/sh\nsh >>'" + (folder / "said").string() + "'\necho 7\n";
  for (const char* program : {"bin/sbatch", "bin/qsub"}) put(folder / program, submit);
  put(folder / "it's", "#!/bin/sh\nprintf '[%s]' \"$@\"\n");
  for (const char* file : {"bin/sbatch", "bin/qsub", "it's"})
    std::filesystem::permissions(folder / file, std::filesystem::perms::owner_all);
  for (const std::string engine : {"slurm", "sge"}) {
    std::filesystem::remove(folder / "said");
    const std::string out = (folder / "o $ut%s").string();
    put(folder / "script", script({engine, folder / "it's", "/data/a plan\\n.toml", out, 3, 1, ""}));
    EXPECT_EQ(std::system(("PATH='" + (folder / "bin").string() + "':$PATH sh '" + (folder / "script").string() + "' >/dev/null").c_str()),
              0);
    EXPECT_EQ(contents(folder / "said"), "[sweep][run][/data/a plan\\n.toml][-o][" + out +
                                             "][--shard][auto][--threads][1][sweep][collect][/data/a plan\\n.toml][-o][" + out + "]")
        << engine;
  }
}

// As parallel's own shell would run it: the text after its options is one word, which a second shell takes apart.
TEST(Script, ParallelsCommandSurvivesTwoShells) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "bin");
  put(folder / "bin/parallel", "#!/bin/sh\nfor word; do last=$word; done\nread k\neval \"$(printf '%s' \"$last\" | sed \"s/{}/$k/\")\"\n");
  put(folder / "it's", "#!/bin/sh\nprintf '[%s]' \"$@\" >> '" + (folder / "said").string() + "'\n");
  for (const char* file : {"bin/parallel", "it's"}) std::filesystem::permissions(folder / file, std::filesystem::perms::owner_all);
  put(folder / "script", script({"parallel", folder / "it's", "/data/a plan.toml", folder / "o ut", 3, 1, ""}));
  EXPECT_EQ(std::system(("PATH='" + (folder / "bin").string() + "':$PATH sh '" + (folder / "script").string() + "'").c_str()), 0);
  EXPECT_EQ(contents(folder / "said"), "[sweep][run][/data/a plan.toml][-o][" + (folder / "o ut").string() +
                                           "][--shard][0/3][--threads][1][sweep][collect][/data/a plan.toml][-o][" +
                                           (folder / "o ut").string() + "]");
}

}  // namespace
}  // namespace rainref::sweep
