// What the small packs exercise of the pass texts: what their manifests say, for every number of threads.
#include "judge/coverage.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "base/temporary_folder.h"
#include "judge/support.h"

namespace rainref::judge {
namespace {

perturbed::Coverage coverage_of_pass(const capture::Pack& pack, const std::string& pass, const parallel::Executor& executor) {
  perturbed::Coverage all;
  for (const capture::PackCase& entry : pack.cases) {
    if (entry.pass != pass) continue;
    const capture::PassCase c = pack.read(entry);
    const std::unique_ptr<capture::PassModel> model = bound(pass, binder(pack.effect, pass), c);
    all.add(coverage_of(c, model.get(), executor));
  }
  return all;
}

class PackCoverage : public testing::TestWithParam<std::string> {};

TEST_P(PackCoverage, IsTheManifestsForEveryNumberOfThreads) {
  const capture::Pack pack(test::pack_folder(GetParam()));
  const auto manifest = nlohmann::json::parse(contents(test::pack_folder(GetParam()) / "manifest.json"));
  for (const nlohmann::json& pass : manifest["passes"]) {
    for (const int threads : {1, 2, 3, 8}) {
      const PassCoverage c = summary(coverage_of_pass(pack, pass["name"], parallel::Executor(threads)));
      if (c.alternatives == 0) {
        EXPECT_FALSE(pass.contains("coverage")) << pass["name"];
        continue;
      }
      EXPECT_EQ(pass["coverage"]["exercised"], c.taken) << pass["name"];
      EXPECT_EQ(pass["coverage"]["alternatives"], c.alternatives) << pass["name"];
      EXPECT_EQ(pass["coverage"]["never"].get<std::vector<std::string>>(), c.never) << pass["name"];
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Packs, PackCoverage, testing::ValuesIn(test::packs), [](const auto& named) {
  std::string name = named.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace rainref::judge
