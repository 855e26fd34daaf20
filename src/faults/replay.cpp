#include "faults/replay.h"

#include <cstdlib>
#include <cstring>
#include <sstream>
#include <utility>

#include "faults/members.h"
#include "rainref/error.h"

namespace rainref::faults {
namespace {

using judge::Cause;

/// The kind of a draw, for ranking; its texts are in a list of their own.
Kind kind_of(const random::Draws& d) {
  const random::Draws right;
  const auto is_one = [](int off) { return off == 1 || off == -1; };
  const bool is_one_off = (is_one(d.counters_off[0]) && d.counters_off[1] == 0) || (is_one(d.counters_off[1]) && d.counters_off[0] == 0) ||
                          is_one(d.purpose_off);
  if (d.moved != right.moved) return Kind::drawn_with_factor_moved;
  if (is_one_off && d.only == right.only) return Kind::drawn_by_one;
  return d.mixing ? Kind::drawn_otherwise : Kind::drawn;
}

/// True if a kind is left out: RAINREF_LEAVE_OUT gives their numbers, "17-23", for scripts/full/ablation.
bool is_left_out(Kind kind) {
  static const std::pair<int, int> range = [] {
    std::pair<int, int> out{0, -1};
    char dash;
    if (const char* const text = std::getenv("RAINREF_LEAVE_OUT")) std::istringstream(text) >> out.first >> dash >> out.second;
    return out;
  }();
  return range.first <= static_cast<int>(kind) && static_cast<int>(kind) <= range.second;
}

}  // namespace

Tried::Tried(What made, Cause figures, double how_far) : Cause(std::move(figures)), what(std::move(made)), misfit(how_far) {
  name = name_of(what);
  sentence = sentence_of(what);
}

Tried untried(const Fault& d, std::size_t of, bool of_records, double misfit) {
  What what = d;
  if (d.draws) what.kind = kind_of(*d.draws);
  return {std::move(what), {"", "", 0, static_cast<std::int64_t>(of), 0, of_records}, misfit};
}
std::vector<Tried> tried(const Replay& replay, const parallel::Executor& executor, const std::vector<Fault>& all, std::size_t of,
                         bool of_records, const std::function<Tried(const Fault&)>& try_one) {
  std::vector<Tried> out(all.size());
  executor.for_range(static_cast<std::int64_t>(all.size()), 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t k = begin; k < end; ++k) {
      const Fault& d = all[static_cast<std::size_t>(k)];
      Tried& made = out[static_cast<std::size_t>(k)];
      try {
        made = is_left_out(d.kind) || replay.is_time_over() ? untried(d, of, of_records) : try_one(d);
      } catch (const Error&) {
        made = untried(d, of, of_records);  // the pass cannot run on the altered case
      }
      made.fault = &d;
    }
  });
  return out;
}

std::optional<judge::ShaderLine> Replay::line(const FoundLine& found) const {
  if (!source_) return {};
  const auto number = [](const capture::SourceLine& l) { return static_cast<int>(l.line); };
  capture::SourceLine first = source_->line(found.at), last = source_->line(found.until);
  if (first.file == last.file && last.line < first.line) std::swap(first, last);
  if (first.file != last.file) last = first;
  judge::ShaderLine out{first.file, number(first), first.text, 0};
  if (last.line != first.line) out.until = number(last);
  return out.line == 0 ? std::nullopt : std::optional(out);
}

capture::PassCase varied(const capture::PackPass& pass, const capture::PassCase& c) {
  capture::PassCase out = c;
  const auto vary = [](std::byte* at, std::size_t k) {
    float v;
    std::memcpy(&v, at, 4);
    v = v == 0 ? 0.37f : v * (1 + 0.04f * static_cast<float>(1 + k * 7 % 6));
    std::memcpy(at, &v, 4);
  };
  std::size_t number = 0;
  for (const scene::Member& m : pass.block.members)
    for (int k = 0; m.scalar == scene::Scalar::float32 && k < m.components; ++k)
      vary(out.uniforms.data() + m.offset + 4 * static_cast<std::size_t>(k), number++);
  for (capture::CaseInput& in : out.inputs) {
    if (in.array.is_records) {
      std::vector<std::byte>& all = in.array.levels[0].edit();
      for (std::size_t r = 0; r + in.array.record.size <= all.size(); r += in.array.record.size)
        for (const scene::Member& m : in.array.record.members)
          for (int k = 0; m.scalar == scene::Scalar::float32 && !is_padding(m) && k < m.components; ++k)
            vary(all.data() + r + m.offset + 4 * static_cast<std::size_t>(k), number++);
      continue;
    }
    for (capture::Bytes& shared : in.array.levels) {
      std::vector<std::byte>& level = shared.edit();
      const std::size_t texels = level.size() / in.array.element_bytes(), by = texels / 3 + texels / 7;
      std::rotate(level.begin(), level.begin() + static_cast<std::ptrdiff_t>(by * in.array.element_bytes()), level.end());
    }
  }
  return out;
}

}  // namespace rainref::faults
