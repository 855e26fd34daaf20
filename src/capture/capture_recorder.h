// Records runs of passes as cases. Copies their inputs and outputs while these exist.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <string>

#include "capture/pass_case.h"
#include "capture/pass_info.h"
#include "rainref/recorder.h"

namespace rainref::capture {

/// Copies a buffer of records or a texture with its levels. `record` is the layout of records.
Array array_of(const std::variant<BufferView, RecordView>& content, const scene::UniformBlock& record);
Array array_of(const Texture& texture);

/// Makes a case of every wanted run and passes it on, in the order of execution.
class CaptureRecorder : public Recorder {
 public:
  /// Returns true if a run is wanted.
  using Wanted = std::function<bool(int frame, std::string_view pass)>;
  using Sink = std::function<void(PassCase)>;
  /// `effect` must outlive the recorder. Without inputs, a case holds uniforms and outputs only.
  CaptureRecorder(const EffectInfo& effect, std::string variant, bool with_inputs, Wanted wanted, Sink sink);

  bool reads(int frame, std::string_view pass) const override { return wanted_(frame, pass); }
  void before(const PassStart& start) override;
  /// Throws Error(internal) for a run whose start was not recorded, or a buffer that the effect does not declare.
  void pass(const PassCall& call) override;

 private:
  const EffectInfo& effect_;
  std::string variant_;
  bool with_inputs_;
  Wanted wanted_;
  Sink sink_;
  std::optional<PassCase> open_;
  Rounding rounding_ = Rounding::rne;

  const scene::UniformBlock& record_of(std::string_view buffer, bool is_records) const;
};

/// Forwards to several recorders, which must outlive it.
class RecorderList : public Recorder {
 public:
  explicit RecorderList(std::vector<Recorder*> all) : all_(std::move(all)) {}
  bool reads(int frame, std::string_view pass) const override {
    return std::any_of(all_.begin(), all_.end(), [&](const Recorder* r) { return r->reads(frame, pass); });
  }
  void before(const PassStart& start) override {
    for (Recorder* r : all_) r->before(start);
  }
  void pass(const PassCall& call) override {
    for (Recorder* r : all_) r->pass(call);
  }

 private:
  std::vector<Recorder*> all_;
};

}  // namespace rainref::capture
