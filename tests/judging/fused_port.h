// Ports that compute two passes in one shader.
#pragma once

#include <cstring>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "judge/mini_port.h"
#include "judge/profiles.h"
#include "judging/judge_folder.h"

namespace rainref::judging {

using capture::Array, capture::PassCase;

/// Adds to every float of one member of each record, or to every channel of an image.
inline void add(Array& a, float difference, std::size_t first = 0, std::size_t stride = 1) {
  std::vector<std::byte>& bytes = a.levels[0].edit();
  if (!a.is_records && info(a.format).kind == FormatInfo::float16) {
    for (std::size_t at = 0; at + 2 <= bytes.size(); at += 2) {
      Half half;
      std::memcpy(&half.bits, &bytes[at], 2);
      half = to_half(to_float(half) + difference);
      std::memcpy(&bytes[at], &half.bits, 2);
    }
    return;
  }
  for (std::size_t at = 4 * first; at + 4 <= bytes.size(); at += 4 * stride) {
    float value;
    std::memcpy(&value, &bytes[at], 4);
    value += difference;
    std::memcpy(&bytes[at], &value, 4);
  }
}

/// A pass that takes `buffer` of `source` from its own shader.
struct Fused {
  const char *pack, *source, *buffer, *pass;
  std::function<void(Array&)> own;  ///< what it computes there instead of the pack's

  judge::MiniPort port() const {
    judge::MiniPort made(pack);
    const auto kept = std::make_shared<std::map<int, Array>>();  // by frame
    made.after = [this, kept](const PassCase& c, std::vector<Array>& out) {
      if (c.pass != source) return;
      for (std::size_t o = 0; o < out.size(); ++o)
        if (c.outputs[o].name == buffer) {
          own(out[o]);
          (*kept)[c.frame] = out[o];
        }
    };
    made.before = [this, kept](PassCase& c) {
      if (c.pass != pass || !kept->contains(c.frame)) return;
      for (capture::CaseInput& input : c.inputs)
        if (input.name == buffer) input.array = kept->at(c.frame);
    };
    return made;
  }
};
/// Runs a port and judges one of its passes. `fused`: of --fused. `without`: a pass whose files the port does not have.
inline judge::PassJudgement judged_pass(const judge::MiniPort& port, const std::string& pass, const std::vector<std::string>& fused = {},
                                        const std::string& without = "") {
  const TemporaryFolder folder;
  port.run(folder.path());
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    if (!without.empty() && entry.path().filename().string().ends_with("." + without)) std::filesystem::remove_all(entry.path());
  FolderOptions options;
  options.only = {pass};
  options.fused = fused;
  options.executor = &judge::test_executor();
  const Judged all = judge_folder(std::make_shared<const capture::Pack>(port.pack.folder()), {folder.path()}, options);
  EXPECT_EQ(all.judged.passes.size(), 1u);
  return all.judged.passes.at(0);
}

inline const std::vector<Fused>& fused_passes() {
  static const std::vector<Fused> all{
      {"puddle-as-published", "raindrops", "drops", "wave_step", [](Array& a) { add(a, 0.3f, 0, a.element_bytes() / 4); }},
      {"puddle-as-published", "ground_noise", "noise", "shade", [](Array& a) { add(a, 0.02f); }},
      {"puddle-corrected", "raindrops", "drops", "wave_step", [](Array& a) { add(a, 0.3f, 0, a.element_bytes() / 4); }},
      {"puddle-corrected", "shade", "colour", "display", [](Array& a) { add(a, 0.01f); }},
      {"screen_drops-as-published", "background", "background", "drops", [](Array& a) { add(a, 0.01f); }},
  };
  return all;
}

}  // namespace rainref::judging
