// A build without OpenImageIO and Embree: this program is linked with the files that stand in their place. What needs them alone is
// refused with a sentence.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "base/error_of.h"
#include "base/temporary_folder.h"
#include "rainref/error.h"
#include "rainref/simulation.h"

namespace rainref {
namespace {

using testing::HasSubstr;

const std::string street = "environment.width=64";  // coarse: it is not what is tested

Simulation opened(std::vector<std::string> set) {
  static const parallel::Executor executor;
  set.insert(set.end(), {"run.size=[32, 18]"});
  return Simulation(SceneText{"", std::move(set)}, executor);
}

void expect_refused(const std::function<void()>& call, ExitCode code, const std::string& why) {
  EXPECT_THAT(error_of(call), testing::AllOf(testing::StartsWith(std::to_string(static_cast<int>(code)) + " "), HasSubstr(why)));
}

TEST(LeftOut, AConfigurationOfEmbreeIsRefusedWithoutIt) {
  expect_refused(
      [] {
        opened({"effect=\"puddle\"", "compositor.picture=\"traced\"", "compositor.embree_config=\"isa=sse2\"", street}).next_frame();
      },
      ExitCode::usage, "compositor.embree_config = \"isa=sse2\": this build of rainref traces rays without Embree");
}

TEST(LeftOut, OfPicturesInFilesPngAloneIsWrittenWithoutOpenImageIO) {
  const TemporaryFolder folder;
  Simulation puddle = opened({"effect=\"puddle\"", street});
  puddle.next_frame();
  EXPECT_FALSE(puddle.picture().empty());
  puddle.write_png(folder.path() / "a.png");
  EXPECT_GT(std::filesystem::file_size(folder.path() / "a.png"), 100u);
  expect_refused([&] { puddle.write_exr(folder.path() / "a.exr"); }, ExitCode::io, "made without libraries for pictures");
}

}  // namespace
}  // namespace rainref
