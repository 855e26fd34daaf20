// A file that another program holds open, without the rights of sharing that rainref itself gives.
#include <windows.h>

#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/atomic_file.h"
#include "base/error_of.h"
#include "base/read_file.h"
#include "base/temporary_folder.h"

namespace rainref {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class HeldFile : public testing::Test {
 protected:
  HeldFile() {
    put(path, "old");
    holder = ::CreateFileW(path.c_str(), GENERIC_READ, 0, nullptr, OPEN_EXISTING, 0, nullptr);
  }
  ~HeldFile() override { ::CloseHandle(holder); }

  const TemporaryFolder at;
  const std::filesystem::path path = at / "held.txt";
  HANDLE holder;
};

TEST_F(HeldFile, IsNotReplacedAndTheErrorSaysWhy) {
  ASSERT_NE(holder, INVALID_HANDLE_VALUE);
  EXPECT_THAT(error_of([&] { write_file(path, "new"); }), HasSubstr("another program holds it open"));
  EXPECT_THAT(at.names(), ElementsAre("held.txt"));
  ::CloseHandle(std::exchange(holder, INVALID_HANDLE_VALUE));
  EXPECT_EQ(contents(path), "old");
  write_file(path, "new");
  EXPECT_EQ(contents(path), "new");
}

TEST_F(HeldFile, IsNotReadAndTheErrorSaysWhy) {
  EXPECT_THAT(error_of([&] { read_file(path); }), HasSubstr("another program holds it open"));
}

}  // namespace
}  // namespace rainref
