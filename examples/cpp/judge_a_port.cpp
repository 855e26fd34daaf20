// Judging a port in process: cases of a pass from a simulation, outputs from memory, the verdict, and the likely mistake.
#include <cstdint>
#include <cstdio>
#include <vector>

#include "rainref/error.h"
#include "rainref/judging.h"

namespace {

/// Where a GPU would run and be read back. This one is right but for one mistake: its rows begin at the top.
std::vector<std::uint8_t> my_display(const rainref::Cases& cases, std::size_t index) {
  const rainref::CaseArray right = cases.expected(index, "picture");
  std::vector<std::uint8_t> pixels;
  for (int y = right.height - 1; y >= 0; --y) {
    const auto* row = right.row<std::uint8_t>(y);
    pixels.insert(pixels.end(), row, row + right.width * 4);
  }
  return pixels;
}

}  // namespace

int main() try {
  const rainref::parallel::Executor threads;
  rainref::Simulation rain({.set = {"effect=edge_splash", "run.size=[96, 54]"}}, threads);
  rainref::Cases cases(rain);
  for (int frame = 0; frame < 2; ++frame) cases.add_next_frame(rain, {"display"});
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const rainref::CaseArray colour = cases.input(i, "colour"), uniforms = cases.uniforms(i);  // what a GPU is given
    if (colour.bytes.empty() || uniforms.fields.empty()) return 1;
    cases.give(i, "picture", my_display(cases, i).data(), 96 * 4, 54);
  }
  const rainref::Judgement judgement = cases.judge(threads, {.profile = "vulkan", .port = "my display"});
  const rainref::Verdict& verdict = judgement.verdict();
  std::printf("%s in %s: %s\n", verdict.status.c_str(), verdict.first_bad_pass.c_str(), verdict.passes[0].causes.at(0).name.c_str());
  return verdict.is_good() ? 1 : 0;  // it has a mistake
} catch (const rainref::Error& e) {
  std::printf("%s\n", e.what());
  return static_cast<int>(e.code());
}
