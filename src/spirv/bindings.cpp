#include "spirv/bindings.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/path_text.h"
#include "base/read_file.h"
#include "capture/bound_texture.h"
#include "capture/json_read.h"
#include "ports/runner/programs_json.h"
#include "spirv/stored_image.h"

namespace rainref::spirv {
namespace {

using capture::CaseInput;
using capture::CaseOutput;

constexpr std::size_t count_bytes = 16;       // bytes before the records of an output
constexpr std::size_t absent_bytes = 256;     // of a list that is missing in the case: zeros
constexpr std::size_t most_list = 256 << 20;  // bytes of an output of records
constexpr std::size_t most_bytes = 4 << 20;   // of a module

}  // namespace

std::map<std::string, Program> read_programs(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "bindings.json";
  const nlohmann::json all = capture::read_json(file, "'" + path_text(file) + "'", capture::small_json);
  try {
    const std::map<std::string, port_runner::Program> programs = port_runner::programs_of(all, folder);
    return {programs.begin(), programs.end()};
  } catch (const port_runner::Error& e) {
    throw Error(ExitCode::port_files, e.what());
  }
}
std::vector<std::byte> read_spirv(const Program& program) { return read_file(program.spirv, {most_bytes, ExitCode::port_files}); }

Specialization specialization_of(const Program& program, const capture::PassCase& c) {
  Specialization values;
  for (const port_runner::Fact& fact : program.constants) {
    const CaseInput* input = c.input(fact.input);
    if (fact.key == "present") {
      values[fact.id] = input != nullptr;
      continue;
    }
    if (input == nullptr)
      throw Error(ExitCode::port_files, fmt::format("{}: no input '{}' to take {} from", c.folder(), fact.input, fact.key));
    const Address address = fact.key == "address_u" ? input->address_u : input->address_v;
    values[fact.id] = static_cast<std::uint32_t>(port_runner::address_number(rainref::name(address)));
  }
  return values;
}

/// A resource of one binding, and its memory.
struct CaseBinding::Bound {
  std::vector<std::byte> bytes;
  BoundBuffer buffer;
  capture::BoundTexture texture;
  std::optional<SampledImage> image;
  std::optional<StoredImage> storage;
  const CaseOutput* output = nullptr;
  spirv::Bound kind = spirv::Bound::storage_buffer;

  void set_buffer(std::vector<std::byte> from, bool is_writable) {
    bytes = std::move(from);
    buffer = {bytes.data(), bytes.size(), is_writable};
  }
  void set_image(const CaseInput& input) {
    kind = spirv::Bound::sampled_image;
    texture = capture::BoundTexture(input);
    image = SampledImage{texture.view(), input.filter == Filter::linear, input.mip_filter};
  }
};

CaseBinding::CaseBinding(const capture::PassCase& c, const Program& program, const Module& module)
    : case_(c), program_(program), module_(module) {
  Bound& uniforms = *bound_.emplace_back(std::make_unique<Bound>());
  uniforms.kind = spirv::Bound::uniform_buffer;
  uniforms.set_buffer(c.uniforms, false);
  for (const std::string& name : program.inputs) bind_input(name);
  for (const std::string& name : program.outputs) bind_output(name);
  for (const Descriptor& d : module.descriptors) {
    Resource<Float>& r = resources_.emplace_back();
    if (d.bound == spirv::Bound::sampler) continue;
    const std::size_t place = place_of(d);
    if (place == bound_.size())
      module.refuse(0, 0,
                    fmt::format("nothing is bound to set {}, binding {} ('{}'): the program binds {} buffers{}", d.set, d.binding, d.name,
                                bound_.size(), program.at.empty() ? " from binding 0 of set 0 on" : ""));
    Bound& b = *bound_[place];
    if (b.kind != d.bound)
      module.refuse(
          0, 0,
          fmt::format("binding {} ('{}') is {}, and the program binds {}", d.binding, d.name, spirv::name(d.bound), spirv::name(b.kind)));
    if (b.image)
      r.image = &*b.image;
    else if (b.storage)
      r.storage = &*b.storage;
    else
      r.buffer = &b.buffer;
  }
}
CaseBinding::~CaseBinding() = default;

void CaseBinding::bind_input(const std::string& name) {
  Bound& b = *bound_.emplace_back(std::make_unique<Bound>());
  const CaseInput* input = case_.input(name);
  if (input != nullptr && input->array.is_records) {
    std::vector<std::byte> bytes = input->array.levels.at(0);
    bytes.resize(std::max(bytes.size(), input->array.element_bytes()));
    return b.set_buffer(std::move(bytes), false);
  }
  if (input != nullptr) return b.set_image(*input);
  if (std::find(program_.lists.begin(), program_.lists.end(), name) != program_.lists.end())
    return b.set_buffer(std::vector<std::byte>(absent_bytes), false);
  CaseInput absent;
  absent.name = name;
  absent.array.format = Format::r32f;
  absent.array.width = absent.array.height = 1;
  absent.array.levels = {std::vector<std::byte>(4)};
  b.set_image(absent);
}
void CaseBinding::bind_output(const std::string& name) {
  Bound& b = *bound_.emplace_back(std::make_unique<Bound>());
  b.output = case_.output(name);
  if (b.output == nullptr) throw Error(ExitCode::port_files, fmt::format("{}: the pack expects no output '{}'", case_.folder(), name));
  if (b.output->array.is_records) {
    if (program_.capacity == 0)
      throw Error(ExitCode::port_files, fmt::format("{}: the program says no capacity of '{}'", case_.folder(), name));
    const std::size_t bytes = count_bytes + program_.capacity * b.output->array.element_bytes();
    if (bytes > most_list)
      throw Error(ExitCode::port_files, fmt::format("{}: a capacity of {} bytes of '{}' is not executed", case_.folder(), bytes, name));
    return b.set_buffer(std::vector<std::byte>(bytes), true);
  }
  b.kind = spirv::Bound::storage_image;
  b.storage.emplace(*b.output);
}

const CaseOutput* CaseBinding::output(std::size_t descriptor) const {
  const std::size_t place = place_of(module_.descriptors[descriptor]);
  return place < bound_.size() ? bound_[place]->output : nullptr;
}
std::size_t CaseBinding::place_of(const Descriptor& d) const {
  if (program_.at.empty()) return d.set == 0 ? std::min<std::size_t>(d.binding, bound_.size()) : bound_.size();
  const auto found = std::find(program_.at.begin(), program_.at.end(), std::array{d.set, d.binding});
  return std::min(static_cast<std::size_t>(found - program_.at.begin()), bound_.size());
}
std::string_view CaseBinding::input_of(const float* texel) const {
  for (std::size_t i = 0; i < program_.inputs.size(); ++i) {
    const std::optional<SampledImage>& image = bound_[1 + i]->image;
    if (!image) continue;
    const Texture& t = image->texture;
    const std::int64_t last = t.levels - 1;
    const std::int64_t count = (t.offset[last] + std::int64_t{t.width[last]} * t.height[last]) * t.channels;
    if (std::less_equal<>{}(t.texels, texel) && std::less<>{}(texel, t.texels + count)) return program_.inputs[i];
  }
  return "";
}
Three CaseBinding::groups() const {
  if (program_.one_group) return {1, 1, 1};
  const CaseOutput* first = bound_[1 + program_.inputs.size()]->output;
  const auto groups = [](int texels, std::uint32_t size) { return (static_cast<std::uint32_t>(texels) + size - 1) / size; };
  return {groups(first->array.width, program_.group[0]), groups(first->array.height, program_.group[1]), 1};
}

std::vector<capture::Array> CaseBinding::outputs() const {
  std::vector<capture::Array> out;
  for (std::size_t i = 1 + program_.inputs.size(); i < bound_.size(); ++i) {
    const Bound& b = *bound_[i];
    if (b.storage) {
      out.push_back(b.storage->array());
      continue;
    }
    std::uint32_t count = 0;
    std::memcpy(&count, b.bytes.data(), sizeof count);
    if (count > program_.capacity)
      module_.refuse(0, 0,
                     fmt::format("the program counts {} records of '{}', there is room for {}", count, b.output->name, program_.capacity));
    capture::Array& array = out.emplace_back(b.output->array);
    array.width = static_cast<int>(count);
    const auto first = b.bytes.begin() + count_bytes;
    array.levels = {std::vector<std::byte>(first, first + static_cast<std::ptrdiff_t>(count * array.element_bytes()))};
  }
  return out;
}

std::vector<capture::Array> execute(const capture::PassCase& c, const Program& program, std::span<const std::byte> spirv,
                                    const std::string& name, const Limits& limits) {
  const Module module(spirv, name, specialization_of(program, c));
  const CaseBinding binding(c, program, module);
  Machine<Float> machine(module, binding.resources(), limits);
  dispatch(machine, binding.groups());
  return binding.outputs();
}

}  // namespace rainref::spirv
