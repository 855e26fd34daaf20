// An effect of two passes for the tests of this room: `drip` writes records, `blur` takes them, a texture with levels
// and its own result of the run before, which it overwrites.
#pragma once

#include <cstring>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include "base/temporary_folder.h"
#include "capture/capture_recorder.h"
#include "capture/pack_write.h"
#include "image/texture.h"
#include "scene/example_effect.h"
#include "scene/toml.h"

namespace rainref::capture {

struct BlurUniforms {
  float weight;
  std::int32_t reach;
  std::uint32_t mask;
  float padding0;
};
struct DripRecord {
  float x;
  std::uint32_t id;
};

inline const EffectInfo& example_info() {
  using namespace scene;
  static const EffectInfo info = [] {
    EffectInfo i;
    i.name = "puddle";  // a name that scenes may have
    const UniformBlock block = uniform_block<BlurUniforms>({member<&BlurUniforms::weight>("1", {-1e6, 1e6}, "A weight."),
                                                            member<&BlurUniforms::reach>("texel", {-1e6, 1e6}, "A reach."),
                                                            member<&BlurUniforms::mask>("1", {-1e6, 1e6}, "A mask.")});
    i.passes = {{"drip", "Drops fall.", {{"corrected", 3, Judge::bits, "BlurUniforms"}}, {}, {"drips"}, {block}},
                {"blur",
                 "The picture spreads.",
                 {{"as-published", 1, Judge::input_only, "BlurUniforms"}, {"corrected", 2, Judge::envelope, "BlurUniforms"}},
                 {{"picture", "blur", true}, {"drips", "drip", false, "corrected"}, {"sky"}},
                 {"picture"},
                 {block},
                 "gather",
                 {"taps"}}};
    i.buffers = {{"drips", "records", "Drops.", "1", {0, 1}, "none", "none", "none", "", "DripRecord"},
                 {"picture", "rg16f", "Two channels.", "m", {-2, 2}},
                 {"sky", "rgba32f", "Radiance.", "1", {0, 1}, "none", "linear Rec. 709", "unused", "row 0 looks down"}};
    i.records = {record<DripRecord>({member<&DripRecord::x>("texel", "Place."), member<&DripRecord::id>("1", "Number.")})};
    return i;
  }();
  return info;
}

inline scene::Config example_config() {
  return scene::parse("effect = 'puddle'\nvariant = 'corrected'\nseed = 5\n", "x.toml", {}, scene::example_effects());
}

/// Two frames of two steps each of the example effect, told to a recorder.
class ExampleRun {
 public:
  ExampleRun() : picture_(Format::rg16f, 5, 3), sky_(texels(), 4, 7, 4, Address::repeat, Address::clamp) {
    sky_.build_mips();
    fill(picture_, 0);
  }

  void run(Recorder& recorder, int frames = 2) {
    for (int frame = 0; frame < frames; ++frame) {
      for (int step = 0; step < 2; ++step) run_step(recorder, frame, step);
    }
  }
  void run_step(Recorder& recorder, int frame, int step) {
    const int count = frame + step;
    std::vector<DripRecord> drips;
    for (int k = 0; k < count; ++k) drips.push_back({0.25f * static_cast<float>(k), static_cast<std::uint32_t>(k)});
    const RecordView records{drips.data(), drips.size(), sizeof(DripRecord)};
    const BlurUniforms u{0.5f, -3, 0x80000000u, 0};
    const auto uniforms = std::as_bytes(std::span(&u, 1));
    const float time = 0.5f * static_cast<float>(frame);
    recorder.before({frame, step, "drip", {}, uniforms, time, 0.25f});
    const PassOutput dripped[] = {{"drips", records}};
    recorder.pass({frame, step, "drip", dripped, 0});
    const PassInput inputs[] = {{"picture", picture_, Filter::none, Filter::none, Address::border, {0.5f, 0.25f, 0, 0}},
                                {"drips", records},
                                {"sky", &sky_.view(), Filter::linear, Filter::nearest}};
    recorder.before({frame, step, "blur", inputs, uniforms, time, 0.25f, Rounding::rtz});
    fill(picture_, 100 * (frame + 1) + 10 * (step + 1));  // in place, as wave_step does
    const PassOutput blurred[] = {{"picture", picture_}};
    recorder.pass({frame, step, "blur", blurred, 0});
  }

  static void fill(Image& image, int first) {
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width() * image.channels(); ++x)
        image.row<Half>(y)[x].bits = static_cast<std::uint16_t>(first + 10 * y + x);
    }
  }
  const Texture& sky() const { return sky_.view(); }

 private:
  static std::vector<float> texels() {
    std::vector<float> out(7 * 4 * 4);
    std::iota(out.begin(), out.end(), 1.0f);
    return out;
  }
  Image picture_;
  TextureData sky_;
};

inline std::vector<PassCase> example_cases(bool with_inputs = true) {
  std::vector<PassCase> cases;
  CaptureRecorder recorder(
      example_info(), "corrected", with_inputs, [](int, std::string_view) { return true; },
      [&](PassCase c) { cases.push_back(std::move(c)); });
  ExampleRun().run(recorder);
  return cases;
}

/// A pack of the example effect in this folder.
inline PackWriter::Total write_example(const std::filesystem::path& folder, bool with_inputs = true) {
  PackWriter writer(folder, example_info(), example_config(), "x.toml", with_inputs, {"drip", "blur"});
  for (const PassCase& c : example_cases(with_inputs)) writer.add(c);
  return writer.finish();
}

}  // namespace rainref::capture
