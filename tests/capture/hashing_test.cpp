// A buffer's hash is that of its texels alone, and the recorder writes a line for each frame, pass and buffer.
#include "capture/hashing.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

namespace rainref::capture {
namespace {

/// Values from 0 to 250, so that a planted 255 always differs.
Image noise(Format format, int width, int height) {
  Image image(format, width, height);
  std::mt19937 random(1);
  for (int y = 0; y < height; ++y) {
    for (int i = 0; i < width * info(format).texel_bytes(); ++i) image.row_bytes(y)[i] = static_cast<std::byte>(random() % 251);
  }
  return image;
}

Hash128 hash_of_bytes(std::span<const std::byte> bytes) {
  Hasher hasher;
  hasher.add(bytes);
  return hasher.finish();
}

TEST(HashOf, IsThatOfTheRowsWithoutPadding) {
  for (const Format format : {Format::r8, Format::rg16f, Format::rgba32f}) {
    for (const int width : {1, 7, 64, 65}) {
      const Image image = noise(format, width, 5);
      std::vector<std::byte> bytes;
      for (int y = 0; y < 5; ++y) bytes.insert(bytes.end(), image.row_bytes(y), image.row_bytes(y) + width * info(format).texel_bytes());
      EXPECT_EQ(hash_of(image), hash_of_bytes(bytes)) << info(format).name << ' ' << width;
    }
  }
}

TEST(HashOf, DoesNotSeeTheMargins) {
  Image image = noise(Format::r16f, 9, 4);
  const Hash128 before = hash_of(image);
  for (int y = 0; y < 4; ++y) {
    for (int k = 1; k <= Image::left_margin; ++k) image.row<Half>(y)[-k] = {0x1234};
    for (int k = 0; k < Image::right_margin; ++k) image.row<Half>(y)[9 + k] = {0x4321};
  }
  EXPECT_EQ(hash_of(image), before);
  image.row<Half>(3)[8].bits ^= 1;
  EXPECT_NE(hash_of(image), before);
}

TEST(HashOf, PlanesHashAsTheInterleavedBuffer) {
  const Image a = noise(Format::r16f, 21, 3);
  Image both(Format::rg16f, 21, 3);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 21; ++x) both.row<Half>(y)[2 * x] = a.row<Half>(y)[x];
  EXPECT_EQ(hash_of(BufferView(Format::rg16f, {&a})), hash_of(both));
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 21; ++x) both.row<Half>(y)[2 * x + 1] = a.row<Half>(y)[x];
  EXPECT_EQ(hash_of(BufferView(Format::rg16f, {&a, &a})), hash_of(both));
}

void record(HashRecorder& recorder, int frame, int step, std::string_view pass, const std::vector<PassOutput>& outputs,
            double seconds = 0.5) {
  recorder.pass({frame, step, pass, outputs, seconds});
}

TEST(HashRecorder, WritesALineForEachFramePassAndBufferInTheirOrder) {
  const Image a = noise(Format::r8, 4, 4), b = noise(Format::rg8, 4, 4);
  HashRecorder recorder;
  record(recorder, 3, 0, "wave", {{"height", BufferView(a)}, {"speed", BufferView(b)}});
  record(recorder, 3, 0, "shade", {{"height", BufferView(b)}});
  const std::vector<HashLine> lines = recorder.take_lines();
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0].text(), "3 wave height " + hash_of(a).text());
  EXPECT_EQ(lines[1].text(), "3 wave speed " + hash_of(b).text());
  EXPECT_EQ(lines[2].text(), "3 shade height " + hash_of(b).text());
}

TEST(HashRecorder, RunsTheSubstepsOfAFrameIntoOneHash) {
  const Image a = noise(Format::r8, 4, 4);
  Image b = noise(Format::r8, 4, 4);
  b.row_bytes(0)[0] = std::byte{255};
  HashRecorder recorder;
  record(recorder, 1, 0, "wave", {{"height", BufferView(a)}});
  record(recorder, 1, 1, "wave", {{"height", BufferView(b)}});
  record(recorder, 2, 0, "wave", {{"height", BufferView(a)}});
  const std::vector<HashLine> lines = recorder.take_lines();
  ASSERT_EQ(lines.size(), 2u);
  std::vector<std::byte> both(32);
  for (int y = 0; y < 4; ++y) {
    std::memcpy(&both[static_cast<std::size_t>(4 * y)], a.row_bytes(y), 4);
    std::memcpy(&both[static_cast<std::size_t>(16 + 4 * y)], b.row_bytes(y), 4);
  }
  EXPECT_EQ(lines[0].hash, hash_of_bytes(both));
  EXPECT_EQ(lines[1].hash, hash_of(a));
}

TEST(HashRecorder, HashesRecordsByTheirBytes) {
  const float drops[] = {1, 2, 3, 4};
  HashRecorder recorder;
  record(recorder, 0, 0, "rain", {{"drops", RecordView{drops, 2, 8}}, {"none", RecordView{nullptr, 0, 8}}});
  const std::vector<HashLine> lines = recorder.take_lines();
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].hash, hash_of_bytes(std::as_bytes(std::span(drops))));
  EXPECT_EQ(lines[1].hash, Hasher().finish());
}

TEST(HashRecorder, ForgetsLinesOnceTakenAndKeepsTheirHash) {
  const Image a = noise(Format::r8, 4, 4);
  HashRecorder recorder, at_once;
  EXPECT_EQ(recorder.scene_hash(), Hasher().finish());
  std::string text;
  for (int frame = 0; frame < 3; ++frame) {
    record(recorder, frame, 0, "wave", {{"height", BufferView(a)}});
    record(at_once, frame, 0, "wave", {{"height", BufferView(a)}});
    for (const HashLine& line : recorder.take_lines()) text += line.text() + "\n";
    EXPECT_TRUE(recorder.take_lines().empty());
  }
  at_once.take_lines();
  EXPECT_EQ(recorder.scene_hash(), at_once.scene_hash());
  EXPECT_EQ(recorder.scene_hash(), hash_of_bytes(std::as_bytes(std::span(text))));
}

TEST(HashRecorder, AddsUpTheTimesOfEachPassEvenWithoutHashing) {
  const Image a = noise(Format::r8, 4, 4);
  for (const bool hashing : {true, false}) {
    HashRecorder recorder(hashing);
    for (int step = 0; step < 3; ++step) record(recorder, 0, step, "wave", {{"height", BufferView(a)}}, 0.25);
    record(recorder, 0, 0, "shade", {}, 2);
    ASSERT_EQ(recorder.times().size(), 2u);
    EXPECT_EQ(recorder.times()[0].pass, "wave");
    EXPECT_EQ(recorder.times()[0].seconds, 0.75);
    EXPECT_EQ(recorder.times()[0].calls, 3);
    EXPECT_EQ(recorder.times()[1].seconds, 2);
    EXPECT_EQ(recorder.take_lines().size(), hashing ? 1u : 0u);
  }
}

}  // namespace
}  // namespace rainref::capture
