// `rainref view` of a build without cpp-httplib.
#include "cli/support.h"

namespace rainref::cli {
namespace {

class ViewWithoutServer : public CommandLine {};

TEST_F(ViewWithoutServer, IsRefusedInOneSentence) {
  expect_refusal({"view", "corrected.toml"}, 2, testing::HasSubstr("made without cpp-httplib"));
}

}  // namespace
}  // namespace rainref::cli
