#include "spirv/interface.h"

#include <algorithm>
#include <set>
#include <tuple>

#include <fmt/format.h>

namespace rainref::spirv {
namespace {

constexpr std::size_t most_members = 4096;

// By the numbers of Image Format in the SPIR-V specification.
std::optional<Format> format_of(std::uint32_t image_format) {
  switch (image_format) {
    case 1:
      return Format::rgba32f;
    case 2:
      return Format::rgba16f;
    case 3:
      return Format::r32f;
    case 4:
      return Format::rgba8;
    case 6:
      return Format::rg32f;
    case 7:
      return Format::rg16f;
    case 9:
      return Format::r16f;
    case 13:
      return Format::rg8;
    case 15:
      return Format::r8;
    default:
      return std::nullopt;
  }
}

/// Lists the members of a type in a buffer.
class Layout {
 public:
  Layout(const Module& module, const Descriptor& of) : module_(module), of_(of) {}

  scene::UniformBlock block(TypeIndex type, std::string name, std::size_t multiple) {
    out_ = {std::move(name), 0, {}};
    names_.clear();
    add(type, 0, "");
    for (const scene::Member& m : out_.members) out_.size = std::max(out_.size, m.offset + m.size());
    out_.size = (std::max<std::size_t>(out_.size, 1) + multiple - 1) / multiple * multiple;
    return std::move(out_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    module_.refuse(0, 0, fmt::format("binding {} ('{}') {}", of_.binding, of_.name, what));
  }
  std::string unique(std::string name) {
    if (name.empty()) name = "value";
    for (int k = 2; !names_.insert(name).second; ++k) name = fmt::format("{}_{}", name, k);
    return name;
  }
  void add_member(TypeIndex type, std::size_t offset, const std::string& name) {
    if (out_.members.size() == most_members) refuse(fmt::format("has more than {} members", most_members));
    const Type& t = module_.types[type];
    const bool is_vector = t.kind == Kind::vector;
    const Type& scalar = is_vector ? module_.types[t.element] : t;
    const scene::Scalar kind = scalar.kind == Kind::floating ? scene::Scalar::float32
                               : scalar.is_signed            ? scene::Scalar::int32
                                                             : scene::Scalar::uint32;
    out_.members.push_back({unique(name), kind, is_vector ? static_cast<int>(t.count) : 1, offset, "1", ""});
  }
  void add(TypeIndex type, std::uint64_t offset, const std::string& name) {
    const Type& t = module_.types[type];
    const bool is_together = t.kind != Kind::vector || t.stride == 4;  // a column of a row-major matrix is not contiguous
    if (t.kind == Kind::integer || t.kind == Kind::floating ||
        (t.kind == Kind::vector && is_together && module_.types.component_kind(type) != Kind::boolean))
      return add_member(type, offset, name);
    const bool is_structure = t.kind == Kind::structure;
    if (!is_structure && t.kind != Kind::matrix && t.kind != Kind::array && t.kind != Kind::vector)
      refuse("holds what no pack can describe: a boolean, or an array without a length that is not the last member");
    const auto parts = is_structure ? static_cast<std::uint32_t>(t.members.size()) : t.count;
    for (std::uint32_t i = 0; i < parts; ++i) {
      const std::uint32_t at = module_.types.part_offset(type, i);
      constexpr std::uint64_t most_of_block = 65536;
      if (at == none) refuse("has members without offsets");
      if (offset + at >= most_of_block) refuse(fmt::format("has more than {} bytes", most_of_block));
      const std::string own = is_structure && !t.members[i].name.empty() ? t.members[i].name : fmt::format("{}", i);
      add(module_.types.part(type, i), offset + at, name.empty() ? own : fmt::format("{}_{}", name, own));
    }
  }

  const Module& module_;
  const Descriptor& of_;
  scene::UniformBlock out_;
  std::set<std::string> names_;
};

/// The element layout of a storage buffer's array.
scene::UniformBlock record_of(const Module& module, const Descriptor& d) {
  const Type& block = module.types[d.type];
  const bool is_list = block.members.size() == 1 && module.types[block.members[0].type].kind == Kind::runtime_array;
  if (!is_list)
    module.refuse(0, 0,
                  fmt::format("binding {} ('{}') is a storage buffer, of which a pack describes those that are one array without a length "
                              "and nothing else",
                              d.binding, d.name));
  const Type& array = module.types[block.members[0].type];
  const Type& element = module.types[array.element];
  if (array.stride == 0) module.refuse(0, 0, fmt::format("binding {} ('{}') has elements without a stride", d.binding, d.name));
  const std::string& name = element.name.empty() ? d.name : element.name;
  scene::UniformBlock record = Layout(module, d).block(array.element, name, 4);
  if (record.size > array.stride) module.refuse(0, 0, fmt::format("binding {} ('{}') has elements that overlap", d.binding, d.name));
  record.size = array.stride;
  return record;
}

scene::UniformBlock block_of(const Module& module, const Descriptor& d, const std::string& name) {
  const std::string& type = module.types[d.type].name;
  return Layout(module, d).block(d.type, type.empty() ? name : type, 16);
}

}  // namespace

std::optional<scene::UniformBlock> uniform_block_of(const Module& module) {
  for (const Descriptor& d : module.descriptors)
    if (d.bound == Bound::uniform_buffer) return block_of(module, d, d.name);
  return std::nullopt;
}

std::vector<Wanted> interface_of(const Module& module) {
  std::vector<Wanted> all;
  for (const Descriptor& d : module.descriptors) {
    if (d.bound == Bound::sampler) continue;
    const Type& type = module.types[d.type];
    Wanted wanted{d.name, d.set, d.binding, d.bound, {}, std::nullopt};
    if (wanted.name.empty()) wanted.name = type.name.empty() ? fmt::format("binding_{}", d.binding) : type.name;
    if (d.bound == Bound::uniform_buffer) wanted.block = block_of(module, d, wanted.name);
    if (d.bound == Bound::storage_buffer) wanted.block = record_of(module, d);
    if (d.bound == Bound::storage_image) wanted.format = format_of(type.image_format);
    all.push_back(std::move(wanted));
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Wanted& a, const Wanted& b) { return std::tie(a.set, a.binding) < std::tie(b.set, b.binding); });
  return all;
}

}  // namespace rainref::spirv
