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
    EXPECT_THAT(text, HasSubstr("sweep collect '/data/a plan.toml' -o '/data/$out'"));
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
