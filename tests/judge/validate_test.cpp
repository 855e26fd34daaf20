// A port judged against a pack: what passes, what fails and is named, what is refused.
#include "judge/mini_port.h"
#include "judge/port_files.h"
#include "judge/profiles.h"
#include "reports/source.h"

#include <cstring>
#include <limits>
#include <tuple>

#include <gmock/gmock.h>

namespace rainref::judge {
namespace {

using capture::Array;
using capture::PassCase;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

/// A stored value from its ordered code.
void put_code(const Slot& s, std::int64_t code, std::byte* at) {
  const auto magnitude = static_cast<std::uint32_t>(code < 0 ? -code : code);
  if (s.kind == FormatInfo::unorm8) {
    const auto byte = static_cast<std::uint8_t>(code);
    std::memcpy(at, &byte, 1);
  } else if (s.kind == FormatInfo::float16) {
    const auto half = static_cast<std::uint16_t>(magnitude | (code < 0 ? 0x8000u : 0u));
    std::memcpy(at, &half, 2);
  } else {
    const std::uint32_t word = magnitude | (code < 0 ? 0x80000000u : 0u);
    std::memcpy(at, &word, 4);
  }
}

/// One element of one output of one pass, and what is put there.
struct Moved {
  const char *pack, *pass, *output, *profile;
  int x, y, channel;

  friend void PrintTo(const Moved& m, std::ostream* out) {
    *out << m.pack << '/' << m.pass << '/' << m.output << '(' << m.x << ',' << m.y << ')';
  }
};
class OneElement : public testing::TestWithParam<Moved> {
 protected:
  const PassJudgement& put_there(std::int64_t code, bool bits_of_infinity = false, bool bits_of_nan = false) {
    const Moved& m = GetParam();
    MiniPort port(m.pack);
    bool done = false;
    port.after = [&](const PassCase& c, std::vector<Array>& out) {
      if (c.pass != m.pass || done) return;
      for (const Slot& s : slots_of(c)) {
        if (c.outputs[static_cast<std::size_t>(s.output)].name != m.output || s.channel != m.channel) continue;
        std::byte* at = out[static_cast<std::size_t>(s.output)].levels[0].edit().data() + s.offset(m.x, m.y);
        const std::int64_t infinity = s.kind == FormatInfo::float16 ? 0x7c00 : 0x7f800000;
        put_code(s, bits_of_nan ? infinity + 1 : bits_of_infinity ? infinity : code, at);
        done = true;
      }
    };
    last_ = judge::judged(port, m.profile);
    EXPECT_TRUE(done);
    return pass_of(last_, m.pass);
  }
  void expect_named(const PassJudgement& p, Failure& named) const {
    const Moved& m = GetParam();
    ASSERT_EQ(p.status, Status::fail) << why(last_);
    EXPECT_EQ(last_.first_bad_pass, m.pass);
    const auto& output = *std::find_if(p.cases.front().outputs.begin(), p.cases.front().outputs.end(),
                                       [&](const OutputJudgement& o) { return o.name == m.output; });
    EXPECT_EQ(output.failing, 1);
    ASSERT_EQ(output.worst.size(), 1u);
    named = output.worst.front();
    EXPECT_EQ(std::tuple(named.x, named.y, named.channel), std::tuple(m.x, m.y, m.channel));
    for (const PassJudgement& other : last_.passes) {
      EXPECT_EQ(other.status == Status::fail, other.pass == p.pass) << other.pass;  // every case stands alone
    }
  }
  PortJudgement last_;
};

TEST_P(OneElement, TwoCodesBeyondTheRangeFailsAndIsNamed) {
  Failure far, near;
  expect_named(put_there(GetParam().output == std::string("picture") ? 250 : 0x5555), far);  // shows the range
  expect_named(put_there(far.high + 2), near);
  EXPECT_EQ(near.distance, 2u);
  EXPECT_EQ(near.high, far.high);
  expect_named(put_there(far.low - 2), near);
  EXPECT_EQ(near.distance, 2u);
  EXPECT_NE(put_there(far.high).status, Status::fail) << why(last_);
  EXPECT_NE(put_there(far.low).status, Status::fail) << why(last_);
}

/// Not of a picture: 8-bit codes hold neither.
class OneFloat : public OneElement {};
TEST_P(OneFloat, NaNAndInfinityFailAndAreNamed) {
  Failure named;
  expect_named(put_there(0, true), named);
  EXPECT_FALSE(named.not_a_number);
  expect_named(put_there(0, false, true), named);
  EXPECT_TRUE(named.not_a_number);
}

std::string name_of(const testing::TestParamInfo<Moved>& tested) {
  std::string name = std::string(tested.param.pack) + "_" + tested.param.pass + "_" + tested.param.profile;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}
const Moved floats[] = {{"puddle-corrected", "wave_step", "wave", "vulkan", 5, 7, 0},
                        {"puddle-corrected", "wave_step", "wave", "ieee", 28, 18, 1},
                        {"puddle-as-published", "wave_step", "wave", "webgpu", 34, 20, 0},
                        {"puddle-corrected", "shade", "colour", "cuda", 0, 0, 2},
                        {"puddle-as-published", "shade", "colour", "d3d", 17, 3, 1}};
const Moved codes[] = {{"puddle-corrected", "display", "picture", "metal", 9, 20, 0},
                       {"puddle-as-published", "display", "picture", "vulkan", 34, 0, 2}};
INSTANTIATE_TEST_SUITE_P(Floats, OneElement, testing::ValuesIn(floats), name_of);
INSTANTIATE_TEST_SUITE_P(Pictures, OneElement, testing::ValuesIn(codes), name_of);
INSTANTIATE_TEST_SUITE_P(Floats, OneFloat, testing::ValuesIn(floats), name_of);

// What a march gives is held to the gap at its end; beyond any doubt it fails too.
TEST(SurfaceHit, ANormalThatIsNotANumberIsNamed) {
  MiniPort port("puddle-corrected");
  port.after = [](const PassCase& c, std::vector<Array>& out) {
    if (c.folder() != "puddle.surface_hit/0012.0") return;
    const std::uint16_t nan = 0x7e00;
    std::memcpy(out[1].levels[0].edit().data() + 8 * (3 * 35 + 30), &nan, 2);
  };
  const PortJudgement j = judged(port);
  const OutputJudgement& normal = pass_of(j, "surface_hit").cases.at(1).outputs.at(1);
  ASSERT_EQ(normal.failing, 1) << why(j);
  EXPECT_EQ(std::tuple(normal.worst[0].x, normal.worst[0].y, normal.worst[0].not_a_number), std::tuple(30, 3, true));
}

// The steps of the corrected march are free, but a count: finite, and of a march that the pass may make.
TEST(SurfaceHit, StepsThatNoMarchHasFail) {
  for (const float steps : {-7.0f, 1e30f, std::numeric_limits<float>::infinity()}) {
    MiniPort port("puddle-corrected");
    port.after = [&](const PassCase& c, std::vector<Array>& out) {
      if (c.folder() == "puddle.surface_hit/0012.0") std::memcpy(out[0].levels[0].edit().data() + 16 * (3 * 35 + 30) + 12, &steps, 4);
    };
    const PortJudgement j = judged(port);
    EXPECT_EQ(j.first_bad_pass, "surface_hit") << steps << why(j);
    const OutputJudgement& hit = pass_of(j, "surface_hit").cases.at(1).outputs.at(0);
    ASSERT_EQ(hit.failing, 1) << steps;
    EXPECT_EQ(std::tuple(hit.worst[0].x, hit.worst[0].y, hit.worst[0].channel), std::tuple(30, 3, 3)) << steps;
  }
}

// Each judged output stands once in a judgement, in the case's order, whatever rule judges it.
TEST(Outputs, EachIsListedOnce) {
  for (const char* pack : {"windshield-corrected", "puddle-corrected", "rainy_glass-corrected"}) {
    const MiniPort port(pack);
    const PortJudgement j = judged(port);
    for (const capture::PackCase& entry : port.pack.cases) {
      const PassJudgement& pass = pass_of(j, entry.pass);
      const auto found = std::find_if(pass.cases.begin(), pass.cases.end(), [&](const CaseJudgement& c) { return c.id == entry.id; });
      ASSERT_NE(found, pass.cases.end());
      std::vector<std::string> judged, listed;
      for (const capture::PackOutput& o : entry.outputs)
        if (o.rules.judge != capture::Judge::input_only) judged.push_back(o.name);
      for (const OutputJudgement& o : found->outputs) listed.push_back(o.name);
      EXPECT_EQ(listed, judged) << entry.id;
    }
  }
}

// The figures of channels and fields add up to those of their output.
TEST(Outputs, QuantitiesAddUp) {
  for (const char* pack : {"windshield-corrected", "puddle-corrected", "puddle-as-published"}) {
    MiniPort port(pack);
    port.after = [](const PassCase& c, std::vector<Array>& out) {
      // A byte in every 97 of each output is wrong: of halves and floats, of integers and of lists.
      for (std::size_t o = 0; o < out.size(); ++o)
        for (std::size_t i = 0; i < out[o].levels[0].size(); i += 97) {
          const bool is_id = c.outputs[o].judge == capture::Judge::keyed;
          if (!is_id) out[o].levels[0].edit()[i] ^= std::byte{0x55};
        }
    };
    const PortJudgement j = judged(port);
    int outputs = 0;
    for (const PassJudgement& p : j.passes) {
      for (const CaseJudgement& c : p.cases) {
        for (const OutputJudgement& o : c.outputs) {
          ++outputs;
          QuantityJudgement sum;
          double widest = 0;
          for (const QuantityJudgement& q : o.quantities) {
            EXPECT_FALSE(q.name.empty() || q.unit.empty()) << c.id << ' ' << o.name;
            sum.elements += q.elements;
            sum.failing += q.failing;
            sum.vacuous += q.vacuous;
            sum.loose += q.loose;
            sum.free += q.free;
            widest = std::max(widest, q.median_codes);
            EXPECT_EQ(q.failing > 0, q.farthest > 0) << c.id << ' ' << o.name << ' ' << q.name;
          }
          EXPECT_GE(widest, o.median_width) << c.id << ' ' << o.name;
          EXPECT_EQ(std::tuple(sum.vacuous, sum.loose, sum.free), std::tuple(o.vacuous, o.loose, o.free)) << c.id << ' ' << o.name;
          if (o.counted == Counted::values || o.counted == Counted::fields) {
            EXPECT_EQ(std::tuple(sum.elements, sum.failing), std::tuple(o.elements, o.failing)) << c.id << ' ' << o.name;
          } else {
            EXPECT_GE(sum.failing, o.failing) << c.id << ' ' << o.name;  // of a texel or record one or more
          }
        }
      }
    }
    EXPECT_GT(outputs, 5);
    EXPECT_EQ(j.status, Status::fail);
  }
}

class Files : public testing::Test {
 protected:
  Files() { port.run(folder.path()); }
  /// What is refused before anything is judged, or what is wrong with files.
  std::string refusal() const {
    return error_of([&] {
      if (const PortJudgement j = judge(port.pack, folder.path()); !j.files.empty()) throw files_error(j.files);
    });
  }
  PortJudgement judged(const std::vector<std::string>& only = {}, bool partial = false) const {
    ValidateOptions options;
    options.executor = &test_executor();
    options.only = only;
    options.partial = partial;
    return validate(port.pack, folder.path(), options);
  }
  static std::string statuses(const PortJudgement& j) {
    std::string out;
    for (const PassJudgement& p : j.passes) out += p.pass + " " + name(p.status) + "\n";
    return out;
  }
  std::filesystem::path file(const std::string& name) const { return folder / name; }
  const MiniPort port{"puddle-corrected"};
  TemporaryFolder folder;
};

TEST_F(Files, AllThatAreMissingAreNamedAtOnce) {
  std::filesystem::remove(file("puddle.shade/0011.0/out.colour.npy"));
  EXPECT_THAT(refusal(), AllOf(StartsWith("3 "), HasSubstr("puddle.shade/0011.0")));
  std::filesystem::remove(file("puddle.wave_step/0012.1/out.wave.npy"));
  std::filesystem::remove_all(file("puddle.display/0012.0"));
  EXPECT_THAT(refusal(), AllOf(StartsWith("3 3 files are missing or cannot be used"), HasSubstr("puddle.wave_step/0012.1"),
                               HasSubstr("puddle.shade/0011.0"), HasSubstr("puddle.display/0012.0")));
}

TEST_F(Files, WrongShapeTypeAndLengthAreRefused) {
  const std::filesystem::path path = file("puddle.display/0011.0/out.picture.npy");
  const std::string whole = contents(path);
  put(path, whole.substr(0, whole.size() - 1));
  EXPECT_THAT(refusal(), StartsWith("3 "));
  Array picture;
  picture.format = Format::rgba8;
  picture.width = 34;
  picture.height = 21;
  picture.levels = {std::vector<std::byte>(34 * 21 * 4)};
  put_array(path.parent_path(), "out.picture", picture);
  EXPECT_THAT(refusal(), HasSubstr("34x21"));
  picture.format = Format::rgba16f;
  picture.width = 35;
  picture.levels = {std::vector<std::byte>(35 * 21 * 8)};
  put_array(path.parent_path(), "out.picture", picture);
  EXPECT_THAT(refusal(), StartsWith("3 "));
}

// A hard link and a symbolic one are the pack's file; a copy is the port's own, whatever is in it.
TEST_F(Files, ThePacksOwnAreRefused) {
  EXPECT_THAT(error_of([&] { judge(port.pack, port.pack.folder()); }), StartsWith("2 "));
  const std::filesystem::path path = file("puddle.shade/0011.0/out.colour.npy"),
                              own = port.pack.folder() / "puddle.shade/0011.0/out.colour.npy";
  EXPECT_EQ(refusal(), "none");
  std::filesystem::remove(path);
  std::filesystem::create_symlink(own, path);
  EXPECT_THAT(refusal(), StartsWith("3 "));
}

// Every way in which a file can be bad, at once: each is named, and what does not need them is judged as ever.
TEST_F(Files, OneThatIsBadHidesNoVerdict) {
  put(file("puddle.wave_step/0011.0/out.wave.npy"), "not an array");
  const std::string half = contents(file("puddle.surface_hit/0011.0/out.hit.npy"));
  put(file("puddle.surface_hit/0011.0/out.hit.npy"), half.substr(0, half.size() / 2));
  std::filesystem::remove(file("puddle.surface_hit/0011.0/out.normal.npy"));
  std::filesystem::rename(file("puddle.shade/0011.0/out.colour.npy"), file("puddle.shade/0011.0/out.colour.jpg"));
  // And a real failure beside them, in the same pass.
  const std::filesystem::path path = file("puddle.wave_step/0012.1/out.wave.npy");
  std::string bytes = contents(path);
  bytes[bytes.size() - 2] = 0x55;
  bytes[bytes.size() - 1] = 0x55;
  put(path, bytes);
  const PortJudgement j = judged();
  EXPECT_EQ(statuses(j), "raindrops PASS\nwave_step FAIL\nsurface_hit NOT JUDGED\nshade NOT JUDGED\ndisplay PASS\n") << why(j);
  EXPECT_EQ(j.status, Status::fail);
  EXPECT_EQ(j.first_bad_pass, "wave_step");
  std::vector<std::string> named;
  for (const FileFault& f : j.files) named.push_back(f.pass + " " + f.id + "/" + f.output);
  EXPECT_EQ(named, (std::vector<std::string>{"wave_step puddle.wave_step/0011.0/out.wave", "surface_hit puddle.surface_hit/0011.0/out.hit",
                                             "surface_hit puddle.surface_hit/0011.0/out.normal", "shade puddle.shade/0011.0/out.colour"}));
  EXPECT_THAT(j.files[3].text, HasSubstr("JPEG is lossy"));
  EXPECT_EQ(files_error(j.files).code(), ExitCode::port_files);
  // Case by case: what is whole was judged.
  for (const PassJudgement& p : j.passes) {
    for (const CaseJudgement& c : p.cases) {
      const bool is_bad = std::any_of(j.files.begin(), j.files.end(), [&](const FileFault& f) { return f.id == c.id; });
      EXPECT_EQ(c.status == Status::not_judged, is_bad) << c.id;
      EXPECT_EQ(c.outputs.empty(), is_bad) << c.id;
    }
  }
  EXPECT_EQ(pass_of(j, "surface_hit").cases.at(0).reason, "out.hit, out.normal: missing, or cannot be used");
  EXPECT_TRUE(judged({"display", "raindrops"}).files.empty());
}

TEST_F(Files, OnlyTheNamedPassesAreJudged) {
  std::filesystem::remove_all(file("puddle.wave_step"));
  const PortJudgement j = judged({"display", "shade", "display"});
  EXPECT_EQ(statuses(j), "shade PASS\ndisplay PASS\n") << why(j);
  EXPECT_EQ(j.status, Status::pass);
  EXPECT_THAT(error_of([&] { judged({"shade", "shad"}); }), HasSubstr("found 'shad'; did you mean 'shade'?"));
}

// A port in progress: what it does not have yet is not missing, what it has a part of is.
TEST_F(Files, OfAPartialPortPassesWithoutFilesAreNotJudged) {
  std::filesystem::remove_all(file("puddle.surface_hit"));
  std::filesystem::remove(file("puddle.shade/0011.0/out.colour.npy"));  // the harness made the folders
  std::filesystem::remove(file("puddle.shade/0012.0/out.colour.npy"));
  put(file("puddle.shade/0012.0/in.hit.npy"), "an input that it copied");
  PortJudgement j = judged({}, true);
  EXPECT_EQ(statuses(j), "raindrops PASS\nwave_step PASS\nsurface_hit NOT JUDGED\nshade NOT JUDGED\ndisplay PASS\n") << why(j);
  EXPECT_TRUE(j.files.empty());
  EXPECT_EQ(j.status, Status::untested);
  EXPECT_EQ(pass_of(j, "shade").reason, "the port has no files of this pass");
  EXPECT_EQ(judged().files.size(), 6u);  // without --partial: hit and normal, colour, of two frames

  put(file("puddle.shade/0012.0/out.color.npy"), "by another name");
  j = judged({}, true);
  EXPECT_EQ(pass_of(j, "surface_hit").status, Status::not_judged);
  ASSERT_EQ(j.files.size(), 2u);
  EXPECT_THAT(j.files[1].text, HasSubstr("did you mean 'out.color.npy'?"));
  EXPECT_EQ(statuses(judged({"surface_hit", "display"}, true)), "surface_hit NOT JUDGED\ndisplay PASS\n");
  EXPECT_EQ(judged({"surface_hit"}, true).status, Status::untested);

  // Of an empty folder nothing is in progress: it is the wrong one.
  for (const char* pass : {"raindrops", "wave_step", "shade", "display"}) std::filesystem::remove_all(file(std::string("puddle.") + pass));
  EXPECT_THAT(error_of([&] { judged({}, true); }),
              AllOf(StartsWith("3 "), HasSubstr("expected folders such as puddle.raindrops/0011.0 with the port's outputs, found none")));
}

// Whoever looks again, for a port that does nothing or for the page's pictures, finds what was read.
TEST_F(Files, EachIsReadOnce) {
  ValidateOptions options;
  options.executor = &test_executor();
  options.buffers = std::make_shared<ReadBuffers>();
  options.progress = [&](int done, int of) {
    if (done < of) return;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path()))
      if (entry.path().extension() == ".npy") put(entry.path(), "read again");
  };
  const PortJudgement j = validate(port.pack, folder.path(), options);
  EXPECT_TRUE(j.files.empty()) << why(j);
  EXPECT_EQ(pass_of(j, "display").status, Status::pass) << why(j);
  const auto page = reports::page_source(std::make_shared<const capture::Pack>(port.pack.folder()), folder.path(), options.buffers);
  const auto shown = page.read("puddle.display/0011.0", "picture");
  ASSERT_TRUE(shown);
  EXPECT_EQ(shown->port.levels.at(0).size(), std::size_t{35} * 21 * 4);
}

// A port that ran under another API than the profile's is judged, and the report says so.
TEST_F(Files, AnotherApiThanTheProfilesIsANote) {
  const auto notes = [&](const std::string& api, const std::string& profile) {
    put(folder / "port.json", R"({"api": ")" + api + "\"}");
    ValidateOptions options;
    options.profile = profile;
    options.only = {"display"};
    options.executor = &test_executor();
    return validate(port.pack, folder.path(), options).notes;
  };
  for (const auto& [api, profile] :
       {std::pair{"Vulkan 1.3", "vulkan"}, {"GLES 3.2", "gles"}, {"OpenCL", "ieee"}, {"CPU", "vulkan"}, {"", "d3d"}})
    EXPECT_THAT(notes(api, profile), testing::IsEmpty()) << api << ' ' << profile;
  EXPECT_THAT(notes("OpenGL ES 3.2", "vulkan"),
              testing::ElementsAre("port.json names OpenGL ES, whose profile is gles; this is judged under vulkan"));
}

// A wave with its two heights in files of their own, and an encoding of no buffer.
TEST_F(Files, AnEncodingIsReadAndItsBufferMustExist) {
  for (const capture::PackCase& entry : port.pack.cases) {
    if (entry.pass != "wave_step") continue;
    const Array both = port.pack.read(entry).outputs.at(0).array;
    const std::filesystem::path run = folder.path() / entry.id;
    std::filesystem::remove(run / "out.wave.npy");
    for (const std::size_t channel : {0, 1}) {
      Array one = both;
      one.format = Format::r16f;
      std::vector<std::byte> bytes;
      for (std::size_t at = 2 * channel; at < both.levels[0].size(); at += 4)
        bytes.insert(bytes.end(), both.levels[0].begin() + static_cast<std::ptrdiff_t>(at),
                     both.levels[0].begin() + static_cast<std::ptrdiff_t>(at) + 2);
      one.levels = {capture::Bytes(bytes)};
      put_array(run, channel == 0 ? "out.newest" : "out.previous", one);
    }
  }
  put(folder / "port.json", R"({"encodings": {"wave": ["newest.x", "previous.x"]}})");
  EXPECT_EQ(statuses(judged({"wave_step"})), "wave_step PASS\n") << why(judged({"wave_step"}));
  put(folder / "port.json", R"({"encodings": {"wave": ["previous.x", "newest.x"]}})");
  EXPECT_EQ(judged({"wave_step"}).status, Status::fail);
  put(folder / "port.json", R"({"encodings": {"wav": ["x", "y"]}})");
  EXPECT_THAT(error_of([&] { judged({"wave_step"}); }),
              AllOf(StartsWith("3 "), HasSubstr("encodings: expected a buffer of puddle, found 'wav'; did you mean 'wave'?")));
}

// A folder in the place of a file is the port's, as a missing file is.
TEST_F(Files, AFolderInThePlaceOfAFileIsRefusedAsAMissingOne) {
  std::filesystem::remove(file("puddle.shade/0011.0/out.colour.npy"));
  const std::filesystem::path path = file("puddle.wave_step/0012.1/out.wave.npy");
  std::filesystem::remove(path);
  std::filesystem::create_directory(path);
  EXPECT_THAT(refusal(), StartsWith("3 "));
}

// Under webgpu a store may flush a subnormal half, and no known device does: a warning. Its cause is asked for, and told where it is
// likely.
TEST(Validate, ACauseIsSoughtOfAWarningToo) {
  MiniPort port("puddle-corrected");
  port.after = [](const capture::PassCase& c, std::vector<Array>& out) {
    if (c.pass != "wave_step") return;
    for (std::size_t at = 0; at < out[0].levels[0].size(); at += 2) {
      std::uint16_t bits;
      std::memcpy(&bits, &out[0].levels[0][at], 2);
      if ((bits & 0x7c00u) == 0) std::memset(&out[0].levels[0].edit()[at], 0, 2);
    }
  };
  ValidateOptions options;
  options.profile = "webgpu";
  options.only = {"wave_step"};
  int asked = 0;
  options.explain = [&](const FailedRun& f) {
    ++asked;
    EXPECT_TRUE(f.is_warned);
    EXPECT_GT(f.judgement.failing, 0);
    EXPECT_EQ(std::count(f.judgement.outputs[0].map.begin(), f.judgement.outputs[0].map.end(), 2), 0);
    EXPECT_EQ(std::count(f.judgement.outputs[0].map.begin(), f.judgement.outputs[0].map.end(), 3), f.judgement.failing);
    return Explanation{{{"flushed", "subnormal halves are 0", 9, 9, 9, false, true}, {"another", "what may be", 9, 9, 9}}, "somewhere"};
  };
  const PassJudgement j = pass_of(judge::judged(port, options), "wave_step");
  EXPECT_EQ(j.status, Status::warn) << j.reason;
  EXPECT_EQ(asked, 1);
  ASSERT_EQ(j.causes.size(), 1u);
  EXPECT_EQ(j.causes[0].name, "flushed");
  EXPECT_EQ(j.where, "");
  EXPECT_EQ(std::count(j.cases[0].outputs[0].map.begin(), j.cases[0].outputs[0].map.end(), 3), 0);  // it stays a warning
}

}  // namespace
}  // namespace rainref::judge
