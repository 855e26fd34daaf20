// Effects that are none of rainref's own: what their shaders say of themselves, packs of them, and ports judged by those.
#include "judging/foreign_pack.h"

#include <cmath>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/hash.h"
#include "faults/mutate.h"
#include "foreign/draft.h"
#include "foreign/reference.h"
#include "judging/foreign_effect.h"
#include "judging/judge_folder.h"
#include "rainref/error.h"
#include "spirv/interface.h"

namespace rainref::judging {
namespace {

using nlohmann::ordered_json;
using testing::Contains, testing::HasSubstr, testing::IsEmpty, testing::Not;

class ForeignPacks : public testing::Test {
 protected:
  void SetUp() override {
    if (!spirv::has_compiler()) GTEST_SKIP() << "needs glslangValidator";
    effect_ = std::make_unique<ForeignEffect>();
  }
  ForeignPack make(const std::string& name = "pack", int threads = 2) const {
    const parallel::Executor executor(threads);
    return make_foreign_pack({effect_->file(), effect_->run(), *effect_ / name}, executor);
  }
  /// What is said of a description or a run that cannot be a pack.
  std::string refusal() const {
    try {
      make();
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::port_files) << e.what();
      EXPECT_FALSE(fs::exists(*effect_ / "pack")) << "half of a pack";
      return e.what();
    }
    return "";
  }
  /// What shaders of a folder with bindings.json store for the pack, as a port's dumps.
  void run_port(const std::string& shaders, const std::string& out) const {
    const capture::Pack pack(*effect_ / "pack");
    const auto programs = spirv::read_programs(*effect_ / shaders);
    for (const capture::PackCase& entry : pack.cases) {
      const capture::PassCase c = pack.read(entry);
      const spirv::Program& program = programs.at(pack.pass(c.pass).formula);
      const std::vector<capture::Array> stored = spirv::execute(c, program, spirv::read_spirv(program), "'port.spv'");
      for (std::size_t o = 0; o < stored.size(); ++o)
        effect_->write(out + "/" + entry.id + "/out." + c.outputs[o].name + ".npy", capture::npy_bytes(stored[o], 0));
    }
  }
  Judged judged(const std::string& port, const std::string& shaders = "") const {
    const parallel::Executor executor(2);
    FolderOptions options;
    options.executor = &executor;
    if (!shaders.empty()) options.spirv = *effect_ / shaders;
    return judge_folder(std::make_shared<const capture::Pack>(*effect_ / "pack"), {*effect_ / port}, options);
  }
  /// The effect's shaders with a change in one, beside a bindings.json.
  void write_port(const std::string& folder, const std::string& shader, const std::string& from, const std::string& to) const {
    effect_->write_bindings();
    fs::create_directories(*effect_ / folder);
    fs::copy_file(*effect_ / "bindings.json", *effect_ / (folder + "/bindings.json"));
    for (const auto& [name, text] : std::map<std::string, std::string>{{"grow", grow_shader}, {"show", show_shader}}) {
      std::string changed = text;
      if (name == shader) {
        const std::size_t at = changed.find(from);
        ASSERT_NE(at, std::string::npos) << from;
        changed.replace(at, from.size(), to);
      }
      effect_->write(folder + "/" + name + ".spv", spirv::compiled(changed, "-g"));
    }
  }
  std::unique_ptr<ForeignEffect> effect_;
};

TEST_F(ForeignPacks, ADraftSaysWhatTheShadersSay) {
  const ordered_json draft = ordered_json::parse(foreign::draft_of({*effect_ / "grow.spv", *effect_ / "show.spv"}));
  const ordered_json grow = draft["passes"][0], show = draft["passes"][1];
  // The description that the tests use was written by hand from the text of the shaders.
  const ordered_json said = ForeignEffect::description()["passes"];
  const auto layout = [](const ordered_json& block) {
    std::string text = block["size"].dump();
    for (const auto& m : block["members"]) text += " " + m["name"].dump() + m["type"].dump() + m["components"].dump() + m["offset"].dump();
    return text;
  };
  EXPECT_EQ(layout(grow["uniform_block"]), layout(said[0]["uniform_block"]));
  EXPECT_EQ(layout(show["uniform_block"]), layout(said[1]["uniform_block"]));
  EXPECT_EQ(layout(grow["inputs"][1]["record"]), layout(said[0]["inputs"][1]["record"]));
  EXPECT_EQ(grow["inputs"][0]["name"], "level_before");
  EXPECT_EQ(grow["inputs"][0]["format"], "?");
  EXPECT_EQ(grow["outputs"][0]["format"], "r32f");
  EXPECT_EQ(show["outputs"][0]["format"], "rgba16f");
  EXPECT_EQ(show["inputs"][1]["binding"], 2);
  EXPECT_EQ(show["outputs"][0]["width"], "?");
}

// Matrices, arrays and structures in a block are taken apart; std140 says where their parts lie.
TEST_F(ForeignPacks, ABlocksPartsAreMembersOfTheirOwn) {
  const auto spirv = spirv::compiled(R"(
layout(local_size_x = 1) in;
struct Light { vec3 place; float power; };
layout(std140, binding = 0) uniform All { mat3 turn; Light lights[2]; float weights[2]; uint flags; } all;
layout(binding = 1, rgba16f) uniform writeonly image2D picture;
void main() { imageStore(picture, ivec2(0), vec4(all.turn[0] + all.lights[1].place * all.weights[1], float(all.flags))); }
)");
  const spirv::Module module(spirv, "'all.spv'");
  const std::vector<spirv::Wanted> wanted = spirv::interface_of(module);
  std::vector<std::string> members;
  for (const scene::Member& m : wanted.at(0).block.members)
    members.push_back(fmt::format("{} {}{} {}", m.name, scene::name(m.scalar), m.components, m.offset));
  EXPECT_THAT(members, testing::ElementsAre("turn_0 float3 0", "turn_1 float3 16", "turn_2 float3 32", "lights_0_place float3 48",
                                            "lights_0_power float1 60", "lights_1_place float3 64", "lights_1_power float1 76",
                                            "weights_0 float1 80", "weights_1 float1 96", "flags uint1 112"));
  EXPECT_EQ(wanted[0].block.size, 128u);
}

TEST_F(ForeignPacks, APackHoldsWhatTheShaderGives) {
  const ForeignPack made = make();
  EXPECT_EQ(made.total.cases, 2 * ForeignEffect::frames);
  EXPECT_THAT(made.warnings, IsEmpty());
  const capture::Pack pack(*effect_ / "pack");
  EXPECT_EQ(pack.file_beside(), "");
  // The first pass by hand, in floats: the same operations, one after the other.
  std::vector<float> level = ForeignEffect::first_level();
  const Growth u;
  for (const capture::PackCase& entry : pack.cases) {
    if (entry.pass != "grow") continue;
    const capture::PassCase c = pack.read(entry);
    const auto* stored = reinterpret_cast<const float*>(c.outputs[0].array.levels[0].data());
    const auto* before = reinterpret_cast<const float*>(c.inputs[0].array.levels[0].data());
    for (int y = 0; y < ForeignEffect::height; ++y) {
      for (int x = 0; x < ForeignEffect::width; ++x) {
        const auto i = static_cast<std::size_t>(y * ForeignEffect::width + x);
        ASSERT_EQ(before[i], level[i]) << entry.id << ": the frame before gives it";
        float value = std::fmin(level[i] + u.rate * u.dt, 1.0f);
        for (const Drop& d : ForeignEffect::drops()) {
          const float dx = static_cast<float>(x) + 0.5f - d.centre[0] - u.wind[0] * u.dt;
          const float dy = static_cast<float>(y) + 0.5f - d.centre[1] - u.wind[1] * u.dt;
          const float inside = std::sqrt(dx * dx + dy * dy) / d.radius, low = 1.0f - u.rim;
          const float t = std::fmin(std::fmax((inside - low) / (1.0f - low), 0.0f), 1.0f);
          value *= 1.0f - d.weight * (1.0f - t * t * (3.0f - 2.0f * t));
        }
        level[i] = value;
        ASSERT_EQ(stored[i], value) << entry.id << " at " << x << ", " << y;
      }
    }
  }
  // Coverage stands in the manifest, by lines of the shader.
  const ordered_json manifest = ordered_json::parse(contents(*effect_ / "pack/manifest.json"));
  EXPECT_GT(manifest["passes"][0]["coverage"]["alternatives"], 8);
  for (const auto& name : manifest["passes"][0]["coverage"]["never"]) EXPECT_THAT(name.get<std::string>(), Not(HasSubstr(".h,")));
}

TEST_F(ForeignPacks, ThreadsChangeNoByte) {
  make("pack", 1);
  make("other", 3);
  for (const auto& file : fs::recursive_directory_iterator(*effect_ / "pack")) {
    if (!file.is_regular_file()) continue;
    const fs::path other = *effect_ / "other" / fs::relative(file.path(), *effect_ / "pack");
    EXPECT_EQ(contents(file.path()), contents(other)) << other;
  }
}

// The reference's own outputs, and a port that says the same in another order: what a device may give.
TEST_F(ForeignPacks, ARightPortPasses) {
  make();
  write_port("same", "", "", "");
  run_port("same", "out");
  const Judged same = judged("out", "same");
  EXPECT_EQ(same.judged.status, judge::Status::pass);
  EXPECT_THAT(same.judged.notes, IsEmpty());
  write_port("other", "grow", "1.0 - drops[i].weight * (1.0 - smoothstep(1.0 - rim, 1.0, inside))",
             "1.0 - drops[i].weight + smoothstep(1.0 - rim, 1.0, inside) * drops[i].weight");
  run_port("other", "out_other");
  const Judged other = judged("out_other");
  EXPECT_NE(other.judged.status, judge::Status::fail);
  EXPECT_NE(other.judged.status, judge::Status::untested);
}

// A mistake fails, its cause is found, and the port's own shader has it in this line.
TEST_F(ForeignPacks, AMistakeFailsInItsLine) {
  make();
  write_port("wrong", "show", "mix(below, tint, sqrt(l))", "mix(below, tint, l)");
  run_port("wrong", "out");
  const Judged wrong = judged("out", "wrong");
  ASSERT_EQ(wrong.judged.status, judge::Status::fail);
  for (const judge::PassJudgement& pass : wrong.judged.passes) {
    EXPECT_EQ(pass.status, pass.pass == "show" ? judge::Status::fail : judge::Status::pass) << pass.pass;
    if (pass.pass != "show") continue;
    ASSERT_FALSE(pass.causes.empty());
    ASSERT_FALSE(pass.causes[0].lines.empty()) << pass.causes[0].sentence;
    // The root may be missing where l is made, in line 11, or where it is used, in line 14.
    EXPECT_EQ(pass.causes[0].lines[0].line, 11);
    EXPECT_EQ(pass.causes[0].lines[0].until, 14);
  }
  EXPECT_THAT(wrong.judged.notes, Contains(HasSubstr("the device did what this shader says")));
}

// A block whose members lie elsewhere than the pack's is said to be that, before anything is made of its values.
TEST_F(ForeignPacks, AUniformBlockOfOtherOffsetsIsNamed) {
  make();
  write_port("padded", "grow", "vec2 wind; float rate; float dt;", "vec2 wind; vec2 unused; float rate; float dt;");
  run_port("padded", "out");
  EXPECT_THAT(
      judged("out", "padded").judged.notes,
      Contains("grow: 'grow.spv': its uniform block has 'rate' at byte 16, the pack has it at byte 8: every value from there on may "
               "be another one"));
  write_port("typed", "grow", "int count;", "uint count;");
  run_port("typed", "out_typed");
  EXPECT_THAT(judged("out_typed", "typed").judged.notes,
              Contains("grow: 'grow.spv': its uniform block has 'count' as uint, the pack has it as int"));
}

TEST_F(ForeignPacks, APackTellsWhichMistakesItShows) {
  make();
  const parallel::Executor executor(2);
  judge::ValidateOptions options;
  options.executor = &executor;
  const faults::MutationReport report = faults::mutate(capture::Pack(*effect_ / "pack"), options);
  EXPECT_THAT(report.unjudged, IsEmpty());
  int caught = 0, all = 0;
  for (const faults::MutantJudgement& m : report.mutants) {
    caught += m.caught();
    all += !m.legal && m.differing > 0;
  }
  EXPECT_GT(all, 20);
  EXPECT_GT(caught, all / 2);
}

TEST_F(ForeignPacks, ADescriptionThatIsWrongIsRefusedAtThePlace) {
  struct Wrong {
    const char *place, *value, *said;
  };
  const Wrong all[] = {
      {"/format", R"("rainref.pack")", R"(this describes no effect: expected "format": "rainref.effect")"},
      {"/effect", R"("?")", "effect: expected a name of up to 64 letters, digits and _ that begins with a letter, found \"?\""},
      {"/effect", R"("puddle")", "effect: expected a name that none of rainref's own effects has"},
      {"/passes", "[]", "passes: expected one pass or more"},
      {"/passes/1/name", R"("grow")", "passes[1].name: 'grow' is there twice"},
      {"/passes/0/inputs/0/width", R"("?")", "passes[0].inputs[0].width: expected a whole number from 1 to 65536, found \"?\""},
      {"/passes/0/inputs/0/format", R"("r32")", "passes[0].inputs[0].format: "},
      {"/passes/0/inputs/0/adress_u", R"("clamp")", "did you mean 'address_u'?"},
      {"/passes/0/inputs/1/format", R"("r32f")", "expected \"records\", for 'grow.spv' has a storage buffer there"},
      {"/passes/0/inputs/0/binding", "3", "passes[0].inputs[0]: 'grow.spv' has a storage image at set 0, binding 3"},
      {"/passes/0/inputs/0/binding", "9", "expected a binding that 'grow.spv' has, found set 0, binding 9"},
      {"/passes/0/outputs/0/format", R"("rg32f")", "passes[0].outputs[0].format: expected \"r32f\", as 'grow.spv' has"},
      {"/passes/0/outputs", "[]", "passes[0].outputs: expected one output or more"},
      {"/passes/1/inputs", "[]", "'show.spv' has a"},
      {"/passes/0/uniform_block/members/2/offset", "20", "expected float at byte 12, 'dt' of 'grow.spv', found float at byte 20"},
      {"/passes/0/uniform_block/size", "48", "passes[0].uniform_block.size: expected 32 bytes, as 'grow.spv' has"},
      {"/passes/0/inputs/0/run", R"("this")", "'grow' runs no earlier than 'grow': say \"run\": \"previous\""},
      {"/passes/1/inputs/0/from", R"("groww")", "did you mean 'grow'?"},
      {"/passes/1/inputs/0/width", "20", "expected one level of 19x11 as 'grow' gives, found 1 of 20x11"},
      {"/passes/1/inputs/1/from", R"("grow")", "'grow' has no output 'ground'"},
      {"/passes/1/spirv", R"("shown.spv")", "shown.spv"},
      {"/passes/0/outputs/0/range", "[1, 1]", "two numbers, the lower one first"},
  };
  for (const Wrong& w : all) {
    ordered_json json = ForeignEffect::description();
    json[ordered_json::json_pointer(w.place)] = ordered_json::parse(w.value);
    effect_->describe(json);
    std::string said;
    try {
      static_cast<void>(foreign::read_effect(effect_->file()));
    } catch (const Error& e) {
      said = e.what();
    }
    EXPECT_THAT(said, HasSubstr(w.said)) << w.place << " = " << w.value;
  }
}

TEST_F(ForeignPacks, ARunThatLacksSomethingIsRefusedByName) {
  fs::rename(*effect_ / "run/pond.grow/0000.0/in.level.npy", *effect_ / "kept");
  EXPECT_THAT(refusal(), HasSubstr("pond.grow/0000.0: expected a file in.level, because no earlier run of grow gives it, found none"));
  fs::rename(*effect_ / "kept", *effect_ / "run/pond.grow/0000.0/in.level.npy");
  fs::rename(*effect_ / "run/pond.show/0001.0/in.ground.npy", *effect_ / "kept");
  EXPECT_THAT(refusal(), HasSubstr("in.ground"));
  fs::rename(*effect_ / "kept", *effect_ / "run/pond.show/0001.0/in.ground.npy");
  put(*effect_ / "run/pond.grow/0001.0/uniforms.bin", std::string(20, '\0'));
  EXPECT_THAT(refusal(), HasSubstr("uniforms.bin: expected the 32 bytes of Growth, found 20"));
  put(*effect_ / "run/pond.grow/0001.0/uniforms.bin", std::string(33, '\0'));
  EXPECT_THAT(refusal(), HasSubstr("uniforms.bin"));
  fs::remove_all(effect_->run());
  EXPECT_THAT(refusal(), HasSubstr("run: expected a folder with the inputs of a run, found none"));
}

// Shaders that no judge of single invocations can take for the reference.
TEST_F(ForeignPacks, AShaderThatCannotBeAReferenceIsRefused) {
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = grow_shader;
    const std::size_t at = text.find(from);
    if (at == std::string::npos) throw std::runtime_error(from);
    text.replace(at, from.size(), to);
    effect_->write("grow.spv", spirv::compiled(text, "-g"));
    return refusal();
  };
  EXPECT_THAT(with("imageStore(level, at,", "imageStore(level, at ^ ivec2(1, 0),"),
              HasSubstr("grow.spv writes other texels of level than that of its invocation: it cannot be a reference"));
  EXPECT_THAT(with("vec4(value)", "vec4(value / (value - value))"),
              HasSubstr("the reference stores what is no finite number in level at "));
  EXPECT_THAT(with("void main() {", "shared float all;\nvoid main() {\n  all = 1.0;\n  barrier();"),
              HasSubstr("its invocations work together"));
  EXPECT_THAT(with("float value", "mediump float value"), HasSubstr("RelaxedPrecision"));
}

// A pack comes from anywhere: its reference is what the manifest names, and nothing else is evaluated.
TEST_F(ForeignPacks, ADamagedReferenceIsRefused) {
  make();
  const auto refused = [&] {
    try {
      static_cast<void>(foreign::reference_of(capture::Pack(*effect_ / "pack")));
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::port_files);
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(refused(), "");
  const fs::path shader = *effect_ / "pack/reference/grow.spv", manifest = *effect_ / "pack/manifest.json";
  const std::string whole = contents(shader), said = contents(manifest);
  std::string bytes = whole;
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  put(shader, bytes);
  EXPECT_THAT(refused(), HasSubstr("damaged: expected hash"));
  put(shader, whole);
  const auto with = [&](const char* place, const ordered_json& value) {
    ordered_json json = ordered_json::parse(said);
    json[ordered_json::json_pointer(place)] = value;
    put(manifest, json.dump());
    return refused();
  };
  EXPECT_THAT(with("/cases/0/outputs/0/width", 20), HasSubstr("out.level is not as the description says"));
  EXPECT_THAT(with("/cases/0/outputs/0/judge", "bits"), HasSubstr("out.level is not as the description says"));
  EXPECT_THAT(with("/cases/0/inputs/0/format", "rg32f"), Not(IsEmpty()));
  EXPECT_THAT(with("/effect", "lake"), Not(IsEmpty()));
  EXPECT_THAT(with("/passes/0/formula", "pond.grow.reference/2"), HasSubstr("pass 'grow' is not as its reference describes it"));
  EXPECT_THAT(with("/reference/1", ordered_json::parse(said)["reference"][2]), HasSubstr("does not name the shader 'reference/grow.spv'"));
  // Nor is any file read that the manifest does not name, wherever it lies.
  put(manifest, said);
  ordered_json description = ordered_json::parse(contents(*effect_ / "pack/reference/effect.json"));
  description["passes"][0]["spirv"] = "../../grow.spv";
  const std::string outside = description.dump();
  put(*effect_ / "pack/reference/effect.json", outside);
  ordered_json file = ordered_json::parse(said)["reference"][0];
  file["bytes"] = outside.size();
  file["xxh3"] = file_hash(std::as_bytes(std::span(outside))).text();
  EXPECT_THAT(with("/reference/0", file), HasSubstr("does not name the shader"));
}

}  // namespace
}  // namespace rainref::judging
