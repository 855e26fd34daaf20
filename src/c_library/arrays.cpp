#include "c_library/arrays.h"

#include <limits>

#include "c_library/call.h"
#include "c_library/handles.h"
#include "judging/case_list.h"
#include "registry/registry.h"

using namespace rainref;
using c_library::call;
using c_library::required;
using c_library::sized;
using judging::require_index;

namespace rainref::c_library {
namespace {

rr_type type_of(FormatInfo::Kind kind) {
  switch (kind) {
    case FormatInfo::unorm8:
      return RR_UNORM8;
    case FormatInfo::srgb8:
      return RR_SRGB8;
    case FormatInfo::float16:
      return RR_FLOAT16;
    case FormatInfo::float32:
      return RR_FLOAT32;
    case FormatInfo::uint32:
      return RR_UINT32;
  }
  throw Error(ExitCode::internal, "a format of no kind");
}
FormatInfo::Kind kind_of(int32_t type) {
  for (const FormatInfo::Kind kind : {FormatInfo::unorm8, FormatInfo::srgb8, FormatInfo::float16, FormatInfo::float32, FormatInfo::uint32})
    if (type_of(kind) == type) return kind;
  throw Error(ExitCode::usage, fmt::format("rr_array.type: expected that of a texel's channel, {} to {}, found {}",
                                           static_cast<int>(RR_UNORM8), static_cast<int>(RR_UINT32), type));
}
rr_type type_of(scene::Scalar scalar) {
  return scalar == scene::Scalar::float32 ? RR_FLOAT32 : scalar == scene::Scalar::int32 ? RR_INT32 : RR_UINT32;
}

const rr_layout* handle_of(const scene::UniformBlock* layout) { return reinterpret_cast<const rr_layout*>(layout); }

rr_array records(const char* name, const scene::UniformBlock& record, const void* data, std::size_t count) {
  return {sizeof(rr_array),
          name,
          record.name.c_str(),
          RR_RECORDS,
          1,
          static_cast<int32_t>(count),
          1,
          1,
          1,
          record.size,
          record.size * count,
          {data, nullptr, nullptr, nullptr},
          handle_of(&record)};
}
rr_array image(const char* name, Format format, int width, int height) {
  const FormatInfo& f = info(format);
  rr_array a{};
  a.struct_bytes = sizeof a;
  a.name = name;
  a.format = f.name.data();
  a.type = type_of(f.kind);
  a.channels = f.channels;
  a.width = width;
  a.height = height;
  a.levels = 1;
  return a;
}

}  // namespace

rr_array array_of(const char* name, const Buffer& content, const scene::UniformBlock* record) {
  if (const auto* r = std::get_if<RecordView>(&content)) return records(name, *record, r->data, r->count);
  const auto& view = std::get<BufferView>(content);
  rr_array a = image(name, view.format, view.width(), view.height());
  const Image& first = *view.parts.front();
  a.planes = static_cast<int32_t>(view.parts.size());
  a.texel_bytes = static_cast<std::size_t>(info(first.format()).texel_bytes());
  a.row_bytes = static_cast<std::size_t>(first.stride());
  for (std::size_t p = 0; p < view.parts.size(); ++p) a.plane[p] = view.parts[p]->row_bytes(0);
  return a;
}

rr_array array_of(const char* name, const capture::Array& array, int level) {
  require_index(static_cast<std::size_t>(level), array.levels.size(), "level");
  const void* data = array.levels[static_cast<std::size_t>(level)].data();
  if (array.is_records) return records(name, array.record, data, static_cast<std::size_t>(array.width));
  rr_array a = image(name, array.format, array.level_width(level), array.level_height(level));
  a.levels = static_cast<int32_t>(array.levels.size());
  a.planes = 1;
  a.texel_bytes = array.element_bytes();
  a.row_bytes = a.texel_bytes * static_cast<std::size_t>(a.width);
  a.plane[0] = data;
  return a;
}

port_dump::StoredImage image_of(const rr_array& given) {
  const auto within = [](const char* member, std::int64_t value, std::int64_t low, std::int64_t high) {
    if (value < low || value > high)
      throw Error(ExitCode::usage, fmt::format("rr_array.{}: expected {} to {}, found {}", member, low, high, value));
    return static_cast<std::size_t>(value);
  };
  constexpr std::int64_t longest = 65536;
  port_dump::StoredImage image;
  image.width = within("width", given.width, 1, longest);
  image.height = within("height", given.height, 1, longest);
  within("planes", given.planes, 1, 1);
  image.set_channels(kind_of(given.type), within("channels", given.channels, 1, 4));
  image.texel_bytes =
      within("texel_bytes", static_cast<std::int64_t>(given.texel_bytes), static_cast<std::int64_t>(image.texel_bytes), longest);
  const std::size_t row = image.width * image.texel_bytes;
  image.row_pitch = within("row_bytes", static_cast<std::int64_t>(given.row_bytes), static_cast<std::int64_t>(row), std::int64_t{1} << 40);
  const auto* const first = static_cast<const std::byte*>(given.plane[0]);
  image.rows = {&required(first, "rr_array.plane[0]"), (image.height - 1) * image.row_pitch + row};
  return image;
}

rr_array array_of(const scene::UniformBlock& block, const void* bytes) { return records(block.name.c_str(), block, bytes, 1); }

}  // namespace rainref::c_library

namespace {

const scene::UniformBlock& block_of(const rr_layout* layout) {
  return *reinterpret_cast<const scene::UniformBlock*>(&required(layout, "layout"));
}

}  // namespace

int rr_get_layout(const rr_layout* layout, rr_layout_info* info) {
  return call([&] {
    const scene::UniformBlock& block = block_of(layout);
    sized(info, "rr_layout_info") = {sizeof(rr_layout_info), block.name.c_str(), block.size, block.members.size()};
  });
}
int rr_get_member(const rr_layout* layout, size_t index, rr_member* member) {
  return call([&] {
    const scene::UniformBlock& block = block_of(layout);
    rr_member& to = sized(member, "rr_member");
    require_index(index, block.members.size(), "member");
    const scene::Member& m = block.members[index];
    constexpr double infinity = std::numeric_limits<double>::infinity();
    to = {sizeof to,
          m.name.c_str(),
          m.unit.c_str(),
          m.sentence.c_str(),
          c_library::type_of(m.scalar),
          m.components,
          m.offset,
          m.range ? m.range->low : -infinity,
          m.range ? m.range->high : infinity};
  });
}

const char* rr_buffer_name(rr_simulation* simulation, size_t index) {
  return simulation && index < simulation->buffers.size() ? simulation->buffers[index].c_str() : nullptr;
}
int rr_get_buffer(rr_simulation* simulation, const char* name, rr_array* buffer) {
  return call([&] {
    const rr_simulation& s = required(simulation, "simulation");
    rr_array& to = sized(buffer, "rr_array");
    const Buffer content = s.running.buffer(&required(name, "name"));
    const capture::EffectInfo& effect = *registry::find(s.running.effect())->info;
    const capture::BufferInfo& declared = effect.buffer(name, rainref::name(s.running.variant()));
    const scene::UniformBlock* record = std::holds_alternative<RecordView>(content) ? &effect.record(declared.record) : nullptr;
    to = c_library::array_of(declared.name.c_str(), content, record);
  });
}
int rr_get_picture(rr_simulation* simulation, rr_array* picture) {
  return call([&] {
    const rr_simulation& s = required(simulation, "simulation");
    rr_array& to = sized(picture, "rr_array");
    if (s.running.picture().empty()) throw Error(ExitCode::usage, "picture: expected a frame that was rendered, found none");
    to = c_library::array_of("picture", BufferView(s.running.picture()), nullptr);
  });
}
