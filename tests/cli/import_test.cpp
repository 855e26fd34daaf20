// `rainref import`: what a debugger or an engine saved becomes a dump that is judged.
#include "capture/pack_read.h"
#include "cli/support.h"
#include "shipped_packs.h"

namespace rainref::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class Import : public CommandLine {
 protected:
  Import() : pack(rainref::test::pack_folder("puddle-corrected")) {}
  /// The expected values of an output, rows of `pitch` bytes, the last one first if asked.
  std::string rows(const std::string& id, const std::string& output, std::size_t pitch, bool bottom_up = false) const {
    for (const capture::PackCase& entry : pack.cases) {
      if (entry.id != id) continue;
      const capture::PassCase c = pack.read(entry);
      const capture::Array& a = c.output(output)->array;
      const std::vector<std::byte>& bytes = a.levels[0];
      const std::size_t row = bytes.size() / static_cast<std::size_t>(a.height);
      std::string out;
      for (int y = 0; y < a.height; ++y) {
        const int at = bottom_up ? a.height - 1 - y : y;
        std::string one(reinterpret_cast<const char*>(bytes.data()) + static_cast<std::size_t>(at) * row, row);
        one.resize(std::max(pitch, row), '\5');
        out += one;
      }
      return out;
    }
    throw std::runtime_error("no case " + id);
  }
  Outcome import(const std::string& file, const std::string& as, const std::vector<std::string>& more = {}) const {
    return copied(joined({"import", file, "--as", as, "--pack", pack.folder().string(), "-o", "port"}, more));
  }
  capture::Pack pack;
};

// Each output of the two last passes from a buffer of Direct3D 12, one frame turned over: all pass.
TEST_F(Import, APortOfImportedFilesPasses) {
  for (const capture::PackCase& c : pack.cases) {
    if (c.pass != "display" && c.pass != "shade") continue;
    const std::string output = c.outputs.at(0).name;
    put(folder / "file", rows(c.id, output, 1024, c.frame == 12));
    const Outcome o = good(import("file", c.id + "/out." + output));
    EXPECT_THAT(o.out, AllOf(HasSubstr("row_pitch 1024"), HasSubstr(c.frame == 12 ? "origin bottom-left" : "origin top-left"),
                             HasSubstr("in port/" + c.id + "/out." + output + ".npy\n")));
  }
  EXPECT_EQ(copied({"validate", pack.folder().string(), "--port", "port", "--profile", "ieee", "--only", "display,shade"}).code, 0);
}
// The rows are written as the port's own port.json says.
TEST_F(Import, TheOriginOfThePortIsKept) {
  std::filesystem::create_directory(folder / "port");
  put(folder / "port/port.json", R"({"origin": "bottom-left"})");
  for (const capture::PackCase& c : pack.cases) {
    if (c.pass != "display") continue;
    put(folder / "file", rows(c.id, "picture", 0));
    good(import("file", c.id + "/out.picture"));
  }
  EXPECT_EQ(copied({"validate", pack.folder().string(), "--port", "port", "--profile", "ieee", "--only", "display"}).code, 0);
}
TEST_F(Import, Refusals) {
  const std::string id = "puddle.display/0012.0";
  put(folder / "file", rows(id, "picture", 0));
  before = folder.names();
  const auto refused = [&](const std::string& as, int code, const auto& message, const std::vector<std::string>& more = {}) {
    expect_refusal(joined({"import", "file", "--as", as, "--pack", pack.folder().string(), "-o", "port"}, more), code, message);
  };
  refused("puddle.display/0012.0", 2, HasSubstr("--as: expected CASE/out.BUFFER"));
  refused("puddle.display/0012.1/out.picture", 2, HasSubstr("expected a case of the pack, found 'puddle.display/0012.1'; did you mean '"));
  refused(id + "/out.pictur", 2, HasSubstr("expected an output of " + id + ", found 'pictur'; did you mean 'picture'?"));
  refused(id + "/out.picture.L1", 2, HasSubstr("expected a level below 1 of picture, found 1"));
  refused("puddle.raindrops/0012.0/out.drops", 2, HasSubstr("drops is a list"));
  refused(id + "/out.picture", 2, HasSubstr("--origin: expected top-left or bottom-left, found 'up'"), {"--origin", "up"});
  refused(id + "/out.picture", 2, HasSubstr("--row-pitch: expected a whole number"), {"--row-pitch", "0"});
  put(folder / "file", "short");
  refused(id + "/out.picture", 3, HasSubstr("raw bytes: expected"));
  put(folder / "file", rows(id, "picture", 0));
  std::filesystem::create_directories(folder / "port" / id);
  put(folder / "port" / id / "out.picture.dds", "another");
  before = folder.names();
  refused(id + "/out.picture", 3, HasSubstr("out.picture.dds' holds the same buffer; remove it first"));
  std::filesystem::remove(folder / "file");
  std::filesystem::remove_all(folder / "port");
  before = folder.names();
  refused(id + "/out.picture", 4, HasSubstr("file"));
}

}  // namespace
}  // namespace rainref::cli
