// A folder appears with its name when it is complete, and replaces only what it may.
#include "capture/new_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error_of.h"
#include "base/temporary_folder.h"

namespace rainref::capture {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::span<const std::byte> bytes(const std::string& text) { return std::as_bytes(std::span(text)); }
const NewFolder::MayReplace never = [](const std::filesystem::path&) { return "no"; };
const NewFolder::MayReplace always = [](const std::filesystem::path&) { return ""; };

TEST(NewFolder, AppearsWithItsNameOnlyWhenCommitted) {
  TemporaryFolder at;
  {
    NewFolder folder(at / "deep/pack", never);
    folder.write("a/b.txt", bytes("text"));
    EXPECT_FALSE(std::filesystem::exists(at / "deep/pack"));
    folder.commit();
    EXPECT_EQ(contents(at / "deep/pack/a/b.txt"), "text");
  }
  EXPECT_EQ(contents(at / "deep/pack/a/b.txt"), "text");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(at / "deep"), {}), 1);
}

TEST(NewFolder, WithoutACommitNothingStaysBehind) {
  TemporaryFolder at;
  {
    NewFolder folder(at / "deep/pack", never);
    folder.write("a.txt", bytes("text"));
  }
  EXPECT_THAT(at.names(), IsEmpty());
}

TEST(NewFolder, ReplacesWhatItMay) {
  TemporaryFolder at;
  std::filesystem::create_directories(at / "pack");
  {
    NewFolder empty(at / "pack", never);  // an empty folder is free
    empty.write("old", bytes("old"));
    empty.commit();
  }
  EXPECT_EQ(error_of([&] { NewFolder(at / "pack", never); }), "4 cannot write '" + (at / "pack").generic_string() + "': no");
  {
    NewFolder abandoned(at / "pack", always);
    abandoned.write("new", bytes("new"));
  }
  EXPECT_EQ(contents(at / "pack/old"), "old");
  NewFolder again((at / "pack").string() + "/", always);
  again.write("new", bytes("new"));
  again.commit();
  EXPECT_THAT(at.names(), ElementsAre("pack"));
  EXPECT_EQ(contents(at / "pack/new"), "new");
  EXPECT_FALSE(std::filesystem::exists(at / "pack/old"));
}

TEST(NewFolder, ALinkStaysAndWhatItNamesIsWritten) {
  TemporaryFolder at;
  std::filesystem::create_directories(at / "real/pack");
  put(at / "real/pack/old", "old");
  std::filesystem::create_symlink("real/pack", at / "link");
  std::filesystem::create_symlink("real/none", at / "dangling");
  for (const std::string name : {"link", "dangling"}) {
    NewFolder folder(at / name, always);
    folder.write("new", bytes("new"));
    folder.commit();
    EXPECT_TRUE(std::filesystem::is_symlink(at / name));
    EXPECT_EQ(contents(at / name / "new"), "new");
  }
  EXPECT_THAT(at.names(), ElementsAre("dangling", "link", "real"));
  EXPECT_FALSE(std::filesystem::exists(at / "real/pack/old"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(at / "real"), {}), 2);
  std::filesystem::create_symlink("circle", at / "circle");
  EXPECT_THAT(error_of([&] { NewFolder(at / "circle", always); }), testing::HasSubstr("Too many levels of symbolic links"));
}

TEST(NewFolder, WhatCameToLieThereMeanwhileIsNotReplaced) {
  TemporaryFolder at;
  NewFolder folder(at / "pack", never);
  folder.write("new", bytes("new"));
  std::filesystem::create_directory(at / "pack");
  put(at / "pack/mine", "mine");
  EXPECT_EQ(error_of([&] { folder.commit(); }), "4 cannot write '" + (at / "pack").generic_string() + "': no");
  EXPECT_EQ(contents(at / "pack/mine"), "mine");
}

TEST(NewFolder, WhoIsFirstGetsTheName) {
  TemporaryFolder at;
  {
    NewFolder first(at / "deep/pack", never), second(at / "deep/pack", never);
    first.write("a/b", bytes("first"));
    second.write("c", bytes("second"));
    put(second.path() / "d", "by another");
    EXPECT_TRUE(second.commit_if_first({at.path()}));
    EXPECT_FALSE(first.commit_if_first());
  }
  EXPECT_EQ(contents(at / "deep/pack/c"), "second");
  EXPECT_EQ(contents(at / "deep/pack/d"), "by another");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(at / "deep"), {}), 1);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(at / "deep/pack"), {}), 2);
  put(at / "file", "text");
  NewFolder third(at / "other", never);
  put(at / "other", "a file came");
  EXPECT_THAT(error_of([&] { third.commit_if_first(); }), testing::StartsWith("4 cannot write '" + (at / "other").generic_string()));
}

TEST(NewFolder, RefusesAFile) {
  TemporaryFolder at;
  put(at / "file", "text");
  EXPECT_EQ(error_of([&] { NewFolder(at / "file", always); }),
            "4 cannot write '" + (at / "file").generic_string() + "': a file of that name exists");
  EXPECT_THAT(error_of([&] { NewFolder(at / "file/pack", always); }),
              testing::StartsWith("4 cannot write '" + (at / "file/pack").generic_string()));
  EXPECT_THAT(at.names(), ElementsAre("file"));
}

TEST(NewFolder, AFileIsWrittenOnce) {
  TemporaryFolder at;
  NewFolder folder(at / "pack", never);
  folder.write("a", bytes("1"));
  EXPECT_THAT(error_of([&] { folder.write("a", bytes("2")); }), testing::HasSubstr("File exists"));
}

}  // namespace
}  // namespace rainref::capture
