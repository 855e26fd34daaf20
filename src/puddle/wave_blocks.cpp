// Steps blocked in time. A step computes row y from rows y - reach ... y + reach of the previous level, in place, so it also overwrites the
// level before that. Bands of rows go through all steps at once, each step `reach` rows narrower at both ends than the one before (a
// trapezoid of rows and steps). The gaps between two bands are triangles, which are computed afterwards. Nothing is computed twice, and
// every row is computed from the same rows as with single steps.
#include "puddle/kernels.h"

#include <algorithm>
#include <iterator>
#include <vector>

namespace rainref::puddle {
namespace {

constexpr int tile_rows = 16;        // for a single step
constexpr int band_rows = 256;       // for steps together; large, because rows between bands are read twice
constexpr int least_band_rows = 16;  // unless threads would be idle or wait long
constexpr int bands_of_thread = 8;
constexpr int visit_rows = 8;  // rows that a band advances between two steps

class Blocks {
 public:
  Blocks(std::span<const WaveJob> jobs, int threads)
      : jobs_(jobs),
        reach_(jobs[0].corrected ? 1 : static_cast<int>(__builtin_ceilf(jobs[0].uniforms.step))),
        steps_(static_cast<int>(jobs.size())),
        height_(jobs[0].newest->height()),
        wraps_(jobs[0].boundary == Boundary::periodic),
        bands_(bands_for(threads)) {}

  int bands() const { return bands_; }
  /// Bands and triangles must not overlap; if the wave is lower than one band there are none.
  bool possible() const { return bands_ > 0; }
  void band(int k) const {
    const int begin = first_row(k), end = first_row(k + 1);
    const bool open_below = k > 0 || wraps_, open_above = k + 1 < bands_ || wraps_;
    const Steps steps(jobs_, begin, end);
    // A front of visits moves up; each step follows `reach` rows behind the one before. Only the first reads from memory, and the others
    // prefetch its next rows.
    for (int front = begin; front < end + steps_ * reach_ + visit_rows; front += visit_rows) {
      RowsAhead ahead{std::min(front + visit_rows, end), std::min(front + 2 * visit_rows, end)};
      for (int step = 0; step < steps_; ++step) {
        const int narrower = step * reach_, y = front - narrower;
        rows(steps, step, std::max(y, open_below ? begin + narrower : begin), std::min(y + visit_rows, open_above ? end - narrower : end),
             step > 0 ? &ahead : nullptr);
      }
    }
  }
  /// Between band k - 1 and band k.
  void triangle(int k) const {
    if (k == 0 && !wraps_) return;
    const int middle = first_row(k);
    const Steps steps(jobs_, middle - steps_ * reach_, middle + steps_ * reach_);
    for (int step = 1; step < steps_; ++step) rows(steps, step, middle - step * reach_, middle + step * reach_);
  }

 private:
  int bands_for(int threads) const {
    const int slopes = std::max(2 * reach_ * steps_, 1);  // rows by which a band narrows
    const int for_threads = std::min({bands_of_thread * threads, height_ / least_band_rows, std::max(threads, height_ / (2 * slopes))});
    return std::min(std::max(height_ / band_rows, for_threads), height_ / slopes);
  }
  /// The steps with only those drops that reach rows [y0, y1), because visits test all their drops.
  class Steps {
   public:
    Steps(std::span<const WaveJob> jobs, int y0, int y1) : jobs_(jobs.begin(), jobs.end()), drops_(jobs.size()) {
      if (y0 < 0) return;  // rows of both ends
      for (std::size_t k = 0; k < jobs.size(); ++k) {
        std::copy_if(jobs[k].drops.begin(), jobs[k].drops.end(), std::back_inserter(drops_[k]),
                     [&](const Drop& d) { return reaches_rows(d, y0, y1); });
        jobs_[k].drops = drops_[k];
      }
    }
    Steps(const Steps&) = delete;
    Steps& operator=(const Steps&) = delete;
    const WaveJob& operator[](int step) const { return jobs_[static_cast<std::size_t>(step)]; }

   private:
    std::vector<WaveJob> jobs_;
    std::vector<std::vector<Drop>> drops_;
  };
  /// A band that ends at a wall does not narrow there in later steps. It begins narrower by that amount, so that all bands have the same
  /// work.
  int first_row(int band) const {
    if (band == 0 || band == bands_) return band == 0 ? 0 : height_;
    const int less = wraps_ ? 0 : std::min((steps_ - 1) * reach_ / 2, height_ / bands_ / 2);
    return static_cast<int>(static_cast<std::int64_t>(height_ + 2 * less) * band / bands_) - less;
  }
  /// Rows [y0, y1) of a step; negative rows are at the upper end of a wave that wraps.
  void rows(const Steps& steps, int step, int y0, int y1, RowsAhead* ahead = nullptr) const {
    if (y0 < 0) {
      rows(steps, step, y0 + height_, std::min(y1, 0) + height_);
      y0 = 0;
    }
    if (y0 >= y1) return;
    const parallel::Tile tile{0, y0, jobs_[0].newest->width(), y1};
    // Everything that reads these rows of the previous level without its drops is done.
    if (step > 0) add_drops(steps[step - 1], tile);
    const RowsAhead left = wave_step_rows(steps[step], tile, ahead ? *ahead : RowsAhead());
    if (ahead) *ahead = left;
  }
  static void add_drops(const WaveJob& job, const parallel::Tile& tile) {
    if (job.corrected && !job.drops.empty()) wave_previous_rows(job, tile);
  }

  std::span<const WaveJob> jobs_;
  int reach_, steps_, height_;
  bool wraps_;
  int bands_;
};

}  // namespace

void step_wave(std::span<const WaveJob> jobs, const parallel::Executor& executor) {
  if (jobs.empty()) return;
  const auto add_drops = [&](const WaveJob& job) {
    if (!job.corrected || job.drops.empty()) return;
    executor.for_tiles(job.newest->width(), job.newest->height(), job.newest->width(), tile_rows,
                       [&](const parallel::Tile& tile) { wave_previous_rows(job, tile); });
  };
  const Blocks blocks(jobs, executor.threads());
  if (jobs.size() > 1 && blocks.possible()) {
    const auto each = [&](const auto& body) {
      executor.for_range(blocks.bands(), 1, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t k = begin; k < end; ++k) body(static_cast<int>(k));
      });
    };
    each([&](int k) { blocks.band(k); });
    each([&](int k) { blocks.triangle(k); });
    return add_drops(jobs.back());
  }
  for (const WaveJob& job : jobs) {
    executor.for_tiles(job.newest->width(), job.newest->height(), job.newest->width(), tile_rows,
                       [&](const parallel::Tile& tile) { wave_step_rows(job, tile); });
    add_drops(job);
  }
}

}  // namespace rainref::puddle
