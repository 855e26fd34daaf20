// A port's file is found by its name in one of the accepted kinds, or the refusal says why.
#include "port_dump/dump_file.h"

#include "port_dump/support.h"

namespace rainref::port_dump {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const capture::Array r8 = image(Format::r8, 1, 1);

TEST(DumpFile, MissingFilesNameTheNearest) {
  Dump dump;
  EXPECT_THAT(dump.refusal(r8),
              AllOf(HasSubstr(dump.path().string()), HasSubstr("no 'out.b' as .npy, .exr, .dds, .png or .bin with .json")));
  EXPECT_THAT(dump.refusal(r8), Not(HasSubstr("did you mean")));
  dump.file("out.d.npy", "");
  EXPECT_THAT(dump.refusal(r8), HasSubstr("did you mean 'out.d.npy'?"));
  EXPECT_THAT(error_of([&] { find_dump_file(dump.path() / "puddle.wave_step", "out.b"); }),
              AllOf(StartsWith("3 "), HasSubstr("no folder '"), HasSubstr("puddle.wave_step'")));
}

TEST(DumpFile, SeveralAreRefused) {
  Dump dump;
  dump.file("out.b.npy", "").file("out.b.exr", "");
  EXPECT_THAT(dump.refusal(r8), HasSubstr("out.b.npy and out.b.exr hold the same buffer; keep one"));
}

TEST(DumpFile, RawBytesAndSidecarBelongTogether) {
  EXPECT_THAT(Dump().file("out.b.bin", "x").refusal(r8),
              HasSubstr("raw bytes need 'out.b.json' beside them with format, width and height"));
  EXPECT_THAT(Dump().file("out.b.json", "{}").refusal(r8), HasSubstr("'out.b.bin' is missing"));
  EXPECT_THAT(Dump().file("out.b.json", "{}").file("out.b.npy", npy("'|u1'", "(1, 1)", "x")).refusal(r8),
              HasSubstr("describes raw bytes, but the buffer is"));
}

TEST(DumpFile, LossyKindsAreRefusedWithTheReason) {
  EXPECT_THAT(Dump().file("out.b.jpg", "x").refusal(r8), HasSubstr("out.b.jpg': JPEG is lossy: no evidence of a buffer's values"));
  EXPECT_THAT(Dump().file("out.b.hdr", "x").refusal(r8), HasSubstr("8 bits and a shared exponent"));
  EXPECT_THAT(Dump().file("out.b.bmp", "x").refusal(r8), HasSubstr("RenderDoc makes RGB of R8"));
}

TEST(DumpFile, AFolderInThePlaceOfAFileIsThePorts) {
  Dump dump;
  std::filesystem::create_directory(dump.path() / "out.b.npy");
  EXPECT_THAT(dump.refusal(r8), HasSubstr("out.b.npy': expected a file, found a folder"));
}

}  // namespace
}  // namespace rainref::port_dump
