// Mistakes in a list that is judged by bits: in the hash, and in the numbers of its records.
#include "faults/bits_replay.h"

#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "faults/diagnosis.h"
#include "judge/evaluations.h"
#include "judge/support.h"
#include "random/draws.h"

namespace rainref::faults {
namespace {

using namespace judge;
using namespace judge::test;
using testing::HasSubstr;
using testing::StartsWith;

/// What is said first of the craters of a pack where a port stores change(right).
class Craters : public testing::Test {
 protected:
  Craters() : pack_(pack_folder("puddle-corrected")), pass_(pack_.pass("raindrops")) {
    for (const capture::PackCase& entry : pack_.cases)
      if (entry.pass == "raindrops" && pack_.read(entry).outputs[0].array.width > 2) c_ = pack_.read(entry);
    evaluations_ = evaluations_of(c_.effect, c_.pass);
  }
  judge::Cause first(const capture::Array& port) const {
    const parallel::Executor two(2);
    BitsReplay run(pass_, c_, nullptr, *evaluations_, port, 0, two);
    const std::vector<Cause> causes = diagnosed(run, nullptr);
    return causes.empty() ? Cause{"none", "", 0, 0} : causes[0];
  }
  capture::Array drawn(const random::Draws& d) const {
    const random::DrawsScope scope(d);
    return evaluations_->recompute(c_)[0];
  }

  capture::Pack pack_;
  capture::PackPass pass_;
  capture::PassCase c_;
  const capture::PassEvaluations* evaluations_ = nullptr;
};

TEST_F(Craters, AnotherOperatorOfTheHash) {
  random::Draws added;
  added.mixing.emplace();
  added.mixing->keyed_by = random::Join::sum;
  EXPECT_EQ(first(drawn(added)).name, "random key added");
  random::Draws shifted;
  shifted.mixing.emplace();
  shifted.mixing->shift = 15;
  EXPECT_EQ(first(drawn(shifted)).name, "pcg4d with a shift of 15");
}
TEST_F(Craters, AnotherProductInTheHash) {
  random::Draws stirred;
  stirred.mixing.emplace();
  stirred.mixing->factors[2] = {0, 3};
  const judge::Cause cause = first(drawn(stirred));
  EXPECT_EQ(cause.name, "pcg4d with z += x w for z += x y");
  EXPECT_TRUE(cause.is_likely);
}
TEST_F(Craters, OtherBitsOfAWord) {
  random::Draws low;
  low.is_choice_of_low_bits = true;
  EXPECT_EQ(first(drawn(low)).name, "class from low bits");
  EXPECT_TRUE(first(drawn(low)).is_likely);
}
TEST_F(Craters, ANumberOfTheRecordsRunsTheOtherWay) {
  capture::Array port = c_.outputs[0].array;
  std::int32_t rows = 0;
  for (const scene::Member& m : pass_.block.members)
    if (m.name == "rows") std::memcpy(&rows, c_.uniforms.data() + m.offset, 4);
  const std::size_t y = 4;
  for (std::size_t at = y; at < port.levels[0].size(); at += port.record.size) {
    float v;
    std::memcpy(&v, port.levels[0].data() + at, 4);
    v = static_cast<float>(rows) - v;
    std::memcpy(port.levels[0].edit().data() + at, &v, 4);
  }
  EXPECT_EQ(first(port).name, "y taken from rows");
}

}  // namespace
}  // namespace rainref::faults
