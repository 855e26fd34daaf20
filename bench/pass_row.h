// A row of an effect's pass through the shell that users run: its best time against the stream of what it moves.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <map>
#include <string>

#include <fmt/format.h>

#include "capture/hashing.h"
#include "goes.h"
#include "rainref/image.h"
#include "stream.h"

namespace rainref::bench {

class PassTimes : public Recorder {
 public:
  void pass(const PassCall& call) override { seconds[std::string(call.pass)] = call.seconds; }
  std::map<std::string, double> seconds;
};

/// render(recorder) makes one frame of width x height pixels, cut into tiles of tile_rows rows. The label holds the hash of each
/// buffer that the pass gave in the first.
template <class Render>
void pass_row(benchmark::State& state, const parallel::Executor& executor, int width, int height, int tile_rows, const std::string& pass,
              Traffic traffic, const Render& render) {
  capture::HashRecorder recorder;
  render(&recorder);
  std::string hashes;
  for (const capture::HashLine& line : recorder.take_lines()) {
    if (line.pass == pass) hashes += fmt::format("{}{:.16}", hashes.empty() ? "" : " ", line.hash.text());
  }
  const double bound = stream_seconds(executor, width, height, tile_rows, traffic);
  Goes goes(state);
  for (auto _ : state) {
    goes.add([&] {
      PassTimes times;
      render(&times);
      return times.seconds.at(pass);
    });
  }
  const double best = goes.best();
  state.counters["Mpix/s"] = 1e-6 * width * height / best;
  state.counters["stream_%"] = 100 * bound / best;
  state.SetLabel(hashes);
}

/// A picture of integers, rgba32f, so that no change of the street at night changes a hash.
inline Image integers(int width, int height) {
  Image image(Format::rgba32f, width, height);
  for (int y = 0; y < height; ++y) {
    for (int i = 0; i < 4 * width; ++i) {
      image.row<float>(y)[i] =
          static_cast<float>((static_cast<std::uint32_t>(i) * 37u + static_cast<std::uint32_t>(y * y) * 11u) >> 3 & 255u) / 128.0f;
    }
  }
  return image;
}

}  // namespace rainref::bench
