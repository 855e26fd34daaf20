#include "capture/capture_recorder.h"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "capture/record_format.h"
#include "math/half.h"
#include "rainref/error.h"

namespace rainref::capture {
namespace {

Array image_array(const BufferView& buffer) {
  Array array;
  array.format = buffer.format;
  array.width = buffer.width();
  array.height = buffer.height();
  std::vector<std::byte> bytes(buffer.row_bytes() * static_cast<std::size_t>(array.height));
  for (int y = 0; y < array.height; ++y) buffer.copy_row(y, bytes.data() + static_cast<std::size_t>(y) * buffer.row_bytes());
  array.levels.emplace_back(std::move(bytes));
  return array;
}

Array record_array(const RecordView& records, const scene::UniformBlock& layout) {
  if (layout.size != records.record_bytes) {
    throw Error(ExitCode::internal,
                fmt::format("record {}: declared with {} bytes, found {}", layout.name, layout.size, records.record_bytes));
  }
  Array array;
  array.is_records = true;
  array.record = layout;
  array.format = record_format(layout).value_or(array.format);
  array.width = static_cast<int>(records.count);
  array.height = 1;
  const auto bytes = records.bytes();
  array.levels.emplace_back(bytes.begin(), bytes.end());
  return array;
}

Format float_format(int channels) {
  switch (channels) {
    case 1:
      return Format::r32f;
    case 2:
      return Format::rg32f;
    case 4:
      return Format::rgba32f;
    default:
      throw Error(ExitCode::internal, fmt::format("a texture of {} channels has no format", channels));
  }
}

}  // namespace

Array array_of(const std::variant<BufferView, RecordView>& content, const scene::UniformBlock& record) {
  if (const auto* buffer = std::get_if<BufferView>(&content)) return image_array(*buffer);
  return record_array(std::get<RecordView>(content), record);
}

Array array_of(const Texture& texture) {
  Array array;
  array.format = float_format(texture.channels);
  array.width = texture.width[0];
  array.height = texture.height[0];
  for (int level = 0; level < texture.levels; ++level) {
    const std::size_t texels = static_cast<std::size_t>(texture.width[level]) * texture.height[level];
    const float* first = texture.texels + static_cast<std::size_t>(texture.offset[level]) * texture.channels;
    const auto* bytes = reinterpret_cast<const std::byte*>(first);
    array.levels.emplace_back(bytes, bytes + texels * array.element_bytes());
  }
  return array;
}

/// Converts an rgba32f image whose values are halves to rgba16f.
Array as_halves(const Array& floats) {
  Array halves = floats;
  halves.format = Format::rgba16f;
  for (Bytes& shared : halves.levels) {
    std::vector<std::byte>& level = shared.edit();
    const std::size_t n = level.size() / sizeof(float);
    for (std::size_t i = 0; i < n; ++i) {
      float value;
      std::memcpy(&value, level.data() + i * sizeof value, sizeof value);
      const Half half = to_half(value);
      std::memcpy(level.data() + i * sizeof half, &half, sizeof half);
    }
    level.resize(n * sizeof(Half));
  }
  return halves;
}

CaptureRecorder::CaptureRecorder(const EffectInfo& effect, std::string variant, bool with_inputs, Wanted wanted, Sink sink)
    : effect_(effect), variant_(std::move(variant)), with_inputs_(with_inputs), wanted_(std::move(wanted)), sink_(std::move(sink)) {}

const scene::UniformBlock& CaptureRecorder::record_of(std::string_view buffer, bool is_records) const {
  static const scene::UniformBlock none{"", 0, {}};
  const BufferInfo& declared = effect_.buffer(buffer, variant_);
  return is_records ? effect_.record(declared.record) : none;
}

void CaptureRecorder::before(const PassStart& start) {
  open_.reset();
  if (!wanted_(start.frame, start.pass)) return;
  PassCase& c = open_.emplace();
  c.effect = effect_.name;
  c.variant = variant_;
  c.pass = start.pass;
  c.frame = start.frame;
  c.step = start.step;
  c.level = start.level;
  c.time = start.time;
  c.dt = start.dt;
  c.uniforms.assign(start.uniforms.begin(), start.uniforms.end());
  rounding_ = start.store_rounding;
  if (!with_inputs_) return;
  for (const PassInput& from : start.inputs) {
    CaseInput& to = c.inputs.emplace_back();
    to.name = from.name;
    to.filter = from.filter;
    to.mip_filter = from.mip_filter;
    to.linear = from.filter == Filter::linear;
    if (const auto* texture = std::get_if<const Texture*>(&from.content)) {
      to.array = array_of(**texture);
      // A half texture is captured as halves, so that a device filters halves.
      if (effect_.buffer(from.name, variant_).format == "rgba16f") to.array = as_halves(to.array);
      to.address_u = (*texture)->address_u;
      to.address_v = (*texture)->address_v;
      std::copy_n((*texture)->border, 4, to.border.begin());
      continue;
    }
    to.address_u = to.address_v = from.address;
    to.border = from.border;
    if (const auto* levels = std::get_if<std::span<const Image>>(&from.content)) {
      to.array = image_array(levels->front());
      for (const Image& level : levels->subspan(1)) to.array.levels.push_back(image_array(level).levels.front());
      to.address_u = to.address_v = from.address;
      continue;
    }
    const auto* buffer = std::get_if<BufferView>(&from.content);
    const scene::UniformBlock& record = record_of(from.name, !buffer);
    to.array = buffer ? array_of(*buffer, record) : array_of(std::get<RecordView>(from.content), record);
  }
}

void CaptureRecorder::pass(const PassCall& call) {
  if (!wanted_(call.frame, call.pass)) return;
  if (!open_ || open_->pass != call.pass || open_->frame != call.frame || open_->step != call.step || open_->level != call.level) {
    throw Error(ExitCode::internal, fmt::format("pass {} of frame {} did not start", call.pass, call.frame));
  }
  const PassVariant* declared = effect_.pass(call.pass).variant(variant_);
  if (!declared) throw Error(ExitCode::internal, fmt::format("pass {} is not declared for {}", call.pass, variant_));
  for (const PassOutput& output : call.outputs) {
    const bool is_records = std::holds_alternative<RecordView>(output.content);
    const BufferInfo& buffer = effect_.buffer(output.name, variant_);
    // An image has no ids.
    const Judge judge = declared->judge == Judge::keyed && !is_records ? Judge::envelope : declared->judge;
    open_->outputs.push_back({std::string(output.name), array_of(output.content, record_of(output.name, is_records)), rounding_, judge,
                              buffer.range, buffer.unit, buffer.colour_space});
  }
  PassCase done = std::move(*open_);
  open_.reset();
  sink_(std::move(done));
}

}  // namespace rainref::capture
