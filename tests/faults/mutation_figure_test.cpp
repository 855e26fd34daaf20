// The figure of docs/conformance.md for what a small pack catches is what `rainref mutate` counts.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include <fmt/format.h>

#include "faults/mutate.h"
#include "judge/support.h"
#include "reports/text.h"
#include "source_folder.h"

namespace rainref::faults {
namespace {

// Forty seconds of a core: scripts/full/mistakes asks for it.
TEST(MutationFigure, IsThatOfTheDocument) {
  if (!std::getenv("RAINREF_MISTAKES")) GTEST_SKIP() << "RAINREF_MISTAKES=1 counts";
  std::ostringstream document;
  document << std::ifstream(std::filesystem::path(rainref::test::source_folder()) / "docs/conformance.md").rdbuf();
  const std::string text = document.str();
  std::smatch said;
  ASSERT_TRUE(std::regex_search(text, said, std::regex("`puddle-corrected` under\\s+`vulkan` it catches ([0-9]+ of [0-9]+)")));
  const parallel::Executor executor(0);
  judge::ValidateOptions options;
  options.profile = "vulkan";
  options.executor = &executor;
  const MutationReport report = mutate(capture::Pack(judge::test::pack_folder("puddle-corrected")), options);
  const std::string counted = reports::report_text(report, false);
  EXPECT_NE(counted.find("\n" + said[1].str() + " faults that change something"), std::string::npos)
      << "docs/conformance.md says " << said[1] << "; rainref mutate:\n"
      << counted.substr(counted.rfind('\n', counted.size() - 2) + 1);
}

}  // namespace
}  // namespace rainref::faults
