// Programs with a pipe to or from this one.
#include "base/piped_program.h"

#include <chrono>
#include <span>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/program_path.h"

namespace rainref {
namespace {

using testing::ElementsAre;

PipedProgram shell(const std::string& script) { return {program_in_path("sh"), {"-c", script}, PipedProgram::Pipe::from_output}; }
std::string read(PipedProgram& program, std::size_t most) {
  std::string text(most, '\0');
  text.resize(program.read(std::as_writable_bytes(std::span(text))));
  return text;
}

TEST(PipedProgram, ItsOutputIsReadAndItsErrorsAreKept) {
  PipedProgram program = shell("printf abc; sleep 0.05; printf defg; echo why >&2; exit 3");
  EXPECT_EQ(read(program, 5), "abcde");  // waits for all that was asked for
  EXPECT_EQ(read(program, 5), "fg");
  EXPECT_EQ(read(program, 5), "");
  const CommandEnd end = program.end("sh");
  EXPECT_EQ(end.failure, "sh ended with exit code 3");
  EXPECT_THAT(end.last_lines, ElementsAre("why"));
}
TEST(PipedProgram, OneThatWritesReadsNothing) {
  PipedProgram program = shell("cat; echo done");
  EXPECT_EQ(read(program, 100), "done\n");
  EXPECT_EQ(program.end("sh").failure, "");
}
TEST(PipedProgram, MoreThanAPipeHoldsArrivesWhole) {
  PipedProgram program = shell("head -c 3000000 /dev/zero | tr '\\0' x");
  EXPECT_EQ(read(program, 4000000), std::string(3000000, 'x'));
  EXPECT_EQ(program.end("sh").failure, "");
}
TEST(PipedProgram, OneThatNobodyReadsAnyMoreIsStopped) {
  const auto begin = std::chrono::steady_clock::now();
  { PipedProgram program = shell("sleep 600"); }
  PipedProgram endless = shell("while :; do echo y; done");
  EXPECT_EQ(read(endless, 4), "y\ny\n");
  endless.end("sh");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(60));
}

}  // namespace
}  // namespace rainref
