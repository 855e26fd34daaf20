// Lanes that are written by hand, or made, against what a pass's definition gives one number at a time.
#pragma once

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "capture/capture_recorder.h"
#include "capture/pass_model.h"

namespace rainref::test {

/// The runs of a pass, or of every one (""), that body(recorder) records.
template <class Body>
std::vector<capture::PassCase> captured(const capture::EffectInfo& info, bool corrected, std::string_view pass, const Body& body) {
  std::vector<capture::PassCase> cases;
  capture::CaptureRecorder recorder(
      info, corrected ? "corrected" : "as-published", true, [&](int, std::string_view p) { return pass.empty() || p == pass; },
      [&](capture::PassCase c) { cases.push_back(std::move(c)); });
  body(recorder);
  return cases;
}

template <class Storage>
bool is_stored(scalar::Scalar<float> value, Rounding rounding, const std::byte* at) {
  Storage expected;
  store(&expected, value, rounding);
  return std::memcmp(&expected, at, sizeof expected) == 0;
}
/// The records of a list, in an order that does not depend on how they were found.
inline std::vector<std::string> sorted_records(const std::vector<std::byte>& bytes, std::size_t size) {
  std::vector<std::string> all;
  for (std::size_t at = 0; at < bytes.size(); at += size) all.emplace_back(reinterpret_cast<const char*>(bytes.data()) + at, size);
  std::sort(all.begin(), all.end());
  return all;
}
/// Whether every stored value of the outputs is the definition's, to the bit; of lists the records, in any order.
inline testing::AssertionResult is_as_defined(const capture::PassCase& c, const capture::PassModel& model) {
  for (const capture::CaseOutput& out : c.outputs) {
    if (!out.array.is_records) continue;
    const capture::KeyedModel* list = model.keyed(out.name);
    if (!list) return testing::AssertionFailure() << c.folder() << ": " << out.name << " has no model";
    const std::size_t size = out.array.record.size;
    if (sorted_records(*list->reference(), size) != sorted_records(out.array.levels.at(0), size))
      return testing::AssertionFailure() << c.folder() << ": records of " << out.name;
  }
  std::vector<scalar::Scalar<float>> values(static_cast<std::size_t>(model.values()));
  for (int y = 0; y < model.height(); ++y) {
    for (int x = 0; x < model.width(); ++x) {
      model.evaluate(x, y, values.data());
      std::size_t k = 0;
      for (const capture::CaseOutput& out : c.outputs) {
        if (out.array.is_records) continue;
        const FormatInfo& format = info(out.array.format);
        const std::byte* at = out.array.levels.at(0).data() + (static_cast<std::ptrdiff_t>(y) * model.width() + x) * format.texel_bytes();
        for (int channel = 0; channel < format.channels; ++channel, ++k, at += format.channel_bytes) {
          const bool is_same = format.kind == FormatInfo::float16   ? is_stored<Half>(values[k], out.store_rounding, at)
                               : format.kind == FormatInfo::float32 ? is_stored<float>(values[k], out.store_rounding, at)
                                                                    : is_stored<Unorm8>(values[k], out.store_rounding, at);
          if (!is_same)
            return testing::AssertionFailure() << c.folder() << ": " << out.name << " channel " << channel << " at " << x << ", " << y;
        }
      }
    }
  }
  return testing::AssertionSuccess();
}

/// The same of every case whose pass has a model; one at least.
inline testing::AssertionResult are_as_defined(const std::vector<capture::PassCase>& cases,
                                               const std::vector<capture::PassEvaluations>& evaluations) {
  int compared = 0;
  for (const capture::PassCase& c : cases) {
    for (const capture::PassEvaluations& e : evaluations) {
      if (e.pass != c.pass || !e.bind) continue;
      const testing::AssertionResult result = is_as_defined(c, *e.bind(c));
      if (!result) return result;
      ++compared;
    }
  }
  return compared > 0 ? testing::AssertionSuccess() : testing::AssertionFailure() << "nothing was compared";
}

}  // namespace rainref::test
