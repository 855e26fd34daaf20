// The fuzzers' targets without a fuzzer: the seeds as they are, cut off at every byte, and changed in a fixed random
// way. A seed whose name starts with "refused" must be refused, each other must be accepted.
#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/temporary_folder.h"
#include "base/words.h"
#include "fuzz/targets.h"
#include "source_folder.h"

namespace {
// The largest block that was asked for by operator new, of this whole program.
std::atomic<std::size_t> largest_block = 0;

void* allocate(std::size_t size) {
  if (size > largest_block) largest_block = size;
  return std::malloc(std::max<std::size_t>(size, 1));
}
}  // namespace

// Not inlined: GCC would see malloc on one side and delete on the other, and warn.
__attribute__((noinline)) void* operator new(std::size_t size) {
  if (void* block = allocate(size)) return block;
  throw std::bad_alloc();
}
// The standard library takes a temporary buffer by this one; a sanitizer's own would not go with the delete below.
__attribute__((noinline)) void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return allocate(size); }
__attribute__((noinline)) void operator delete(void* block) noexcept { std::free(block); }
__attribute__((noinline)) void operator delete(void* block, std::size_t) noexcept { std::free(block); }

namespace rainref::fuzz {
namespace {

// A file of a few kilobytes is no reason to ask for more.
constexpr std::size_t most_memory = std::size_t{64} << 20;
constexpr int changes = 4000;

struct Seed {
  std::string name, bytes;
};
std::vector<Seed> seeds_of(const Target& target) {
  std::vector<Seed> out;
  const std::filesystem::path folder = std::filesystem::path(rainref::test::source_folder()) / "tests/fuzz/seeds" / target.name;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) out.push_back({entry.path().filename(), contents(entry.path())});
  std::ranges::sort(out, {}, &Seed::name);
  return out;
}

bool run(const Target& target, const std::string& bytes) {
  // A copy of the exact size, so that a sanitizer sees a read behind its end.
  const std::vector<char> exact(bytes.begin(), bytes.end());
  return target.accepts(std::as_bytes(std::span(exact)));
}

std::string changed(const std::vector<Seed>& seeds, rainref::test::Words& random) {
  const auto below = [&](std::size_t limit) { return static_cast<std::size_t>(random() % limit); };
  std::string bytes = seeds[below(seeds.size())].bytes;
  for (std::size_t step = below(4); step < 4 && !bytes.empty(); ++step) {
    const std::size_t at = below(bytes.size()), count = std::min(1 + below(8), bytes.size() - at);
    const std::string& other = seeds[below(seeds.size())].bytes;
    switch (below(7)) {
      case 0:
        bytes[at] = static_cast<char>(bytes[at] ^ 1 << below(8));
        break;
      case 1:
        bytes[at] = static_cast<char>(random());
        break;
      case 2:  // a size at its limits
        bytes.replace(at, count, count, below(2) ? '\xff' : '\0');
        break;
      case 3:
        bytes.erase(at, count);
        break;
      case 4:
        bytes.insert(at, bytes, below(bytes.size()), 1 + below(16));
        break;
      case 5:
        bytes.insert(at, std::to_string(random() >> below(64)));
        break;
      case 6:  // the beginning of one seed, the end of another
        bytes = bytes.substr(0, at) + other.substr(std::min(at, other.size()));
        break;
    }
  }
  return bytes;
}

class Replay : public ::testing::TestWithParam<Target> {
 protected:
  void SetUp() override { largest_block = 0; }
  void TearDown() override { EXPECT_LT(largest_block, most_memory); }
};
INSTANTIATE_TEST_SUITE_P(Targets, Replay, ::testing::ValuesIn(targets), [](const auto& param) { return std::string(param.param.name); });

TEST_P(Replay, SeedsAreAcceptedOrRefusedAsNamed) {
  int accepted = 0;
  for (const Seed& seed : seeds_of(GetParam())) {
    const bool is_good = !seed.name.starts_with("refused");
    EXPECT_EQ(run(GetParam(), seed.bytes), is_good) << seed.name;
    accepted += is_good;
  }
  EXPECT_GT(accepted, 1);
}

TEST_P(Replay, EveryTruncation) {
  for (const Seed& seed : seeds_of(GetParam())) {
    for (std::size_t size = 0; size < seed.bytes.size(); ++size) run(GetParam(), seed.bytes.substr(0, size));
  }
}

TEST_P(Replay, ChangedSeeds) {
  const std::vector<Seed> seeds = seeds_of(GetParam());
  rainref::test::Words random(2026);
  int refused = 0;
  for (int i = 0; i < changes; ++i) refused += !run(GetParam(), changed(seeds, random));
  EXPECT_GT(refused, changes / 10);  // the changes reach what is checked
}

// What fuzzers found in pictures, each refused now. tile_offset: OpenImageIO read before the file's bytes, which a sanitizer sees.
TEST(ReplayFound, PicturesAreRefused) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(rainref::test::source_folder() + "/tests/fuzz/found")) {
    const std::string bytes = contents(entry.path());
    EXPECT_FALSE(picture(std::as_bytes(std::span(bytes)))) << entry.path();
    ++files;
  }
  EXPECT_GT(files, 0);
}

// The guard above must be able to fail.
TEST(ReplayGuard, SeesLargeBlocks) {
  largest_block = 0;
  // Kept from the optimizer, which may drop an allocation that nothing uses.
  volatile std::size_t size = most_memory + 1;
  ::operator delete(::operator new(size));
  EXPECT_GT(largest_block, most_memory);
}

}  // namespace
}  // namespace rainref::fuzz
