#include "sweep/buffer_keeper.h"

#include <algorithm>

#include "capture/capture_recorder.h"

namespace rainref::sweep {

BufferKeeper::BufferKeeper(const capture::EffectInfo& info, std::string variant, std::vector<std::string> names)
    : info_(info), variant_(std::move(variant)), names_(std::move(names)) {}

bool BufferKeeper::is_wanted(std::string_view name) const {
  return is_on_ && std::find(names_.begin(), names_.end(), name) != names_.end();
}

const scene::UniformBlock& BufferKeeper::record_of(std::string_view buffer) const {
  return info_.record(info_.buffer(buffer, variant_).record);
}

void BufferKeeper::before(const PassStart& start) {
  for (const PassInput& input : start.inputs) {
    if (!is_wanted(input.name)) continue;
    capture::Array& array = found_[std::string(input.name)];
    if (const auto* image = std::get_if<BufferView>(&input.content)) {
      array = capture::array_of(*image, {});
    } else if (const auto* records = std::get_if<RecordView>(&input.content)) {
      array = capture::array_of(*records, record_of(input.name));
    } else if (const auto* texture = std::get_if<const Texture*>(&input.content)) {
      array = capture::array_of(**texture);
    } else {
      array = capture::array_of(BufferView(std::get<std::span<const Image>>(input.content)[0]), {});
    }
  }
}

void BufferKeeper::pass(const PassCall& call) {
  for (const PassOutput& output : call.outputs) {
    if (!is_wanted(output.name) || call.level > 0) continue;
    const bool is_records = std::holds_alternative<RecordView>(output.content);
    found_[std::string(output.name)] =
        is_records ? capture::array_of(output.content, record_of(output.name)) : capture::array_of(output.content, {});
  }
}

}  // namespace rainref::sweep
