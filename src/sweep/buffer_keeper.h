// Keeps buffers of a frame by name, as its passes last read or wrote them.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "capture/array.h"
#include "capture/pass_info.h"
#include "rainref/recorder.h"

namespace rainref::sweep {

class BufferKeeper : public Recorder {
 public:
  /// `info` must outlive it.
  BufferKeeper(const capture::EffectInfo& info, std::string variant, std::vector<std::string> names);
  /// Sets whether buffers are copied from here on.
  void keep(bool is_on) { is_on_ = is_on; }
  bool reads(int, std::string_view) const override { return is_on_; }
  void before(const PassStart& start) override;
  void pass(const PassCall& call) override;

  /// The buffers of the frames since the last call; a buffer that no pass read or wrote is missing.
  std::map<std::string, capture::Array> take() { return std::exchange(found_, {}); }

 private:
  bool is_wanted(std::string_view name) const;
  const scene::UniformBlock& record_of(std::string_view buffer) const;

  const capture::EffectInfo& info_;
  std::string variant_;
  std::vector<std::string> names_;
  std::map<std::string, capture::Array> found_;
  bool is_on_ = false;
};

}  // namespace rainref::sweep
