// The patterns of samples: as many as the scene key allows, of the size that was asked for, within the pixel.
#include "compositor/picture.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "rainref/error.h"

namespace rainref::compositor {
namespace {

TEST(Samples, HaveAPatternForTheCountsThatAreListedAndNoOther) {
  for (int count = -1; count <= 32; ++count) {
    if (std::find(sample_counts.begin(), sample_counts.end(), count) == sample_counts.end()) {
      EXPECT_THROW(samples(count), Error) << count;
      continue;
    }
    EXPECT_EQ(samples(count).size(), static_cast<std::size_t>(count));
    for (const Sample& s : samples(count)) {
      EXPECT_GE(std::min(s.x, s.y), -0.5);
      EXPECT_LT(std::max(s.x, s.y), 0.5);
    }
  }
}

}  // namespace
}  // namespace rainref::compositor
