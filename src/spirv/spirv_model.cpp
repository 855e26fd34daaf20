#include "spirv/spirv_model.h"

#include <algorithm>
#include <map>

#include "base/floating_point.h"
#include "math/perturbed.h"

namespace rainref::spirv {
namespace {

using capture::CaseOutput;

/// Keeps what an invocation writes to its own texel.
template <class N>
class OwnTexel final : public StorageImage<N> {
 public:
  OwnTexel(const CaseOutput& output, int x, int y) : StorageImage<N>(output.array.width, output.array.height), x_(x), y_(y) {}
  void write(int x, int y, const N* texel, int count) override {
    if (x == x_ && y == y_) std::copy(texel, texel + count, texel_);
  }
  void read(int, int, N* texel) const override { std::copy(texel_, texel_ + 4, texel); }
  const N& channel(int k) const { return texel_[k]; }

 private:
  int x_, y_;
  N texel_[4] = {N(0.0f), N(0.0f), N(0.0f), N(0.0f)};
};

/// True if the judge needs a model's values for an output.
bool is_asked(const CaseOutput& o) { return !o.array.is_records && o.judge == capture::Judge::envelope; }
int values_of(const capture::PassCase& c) {
  int values = 0;
  for (const CaseOutput& o : c.outputs) values += is_asked(o) ? info(o.array.format).channels : 0;
  return values;
}

/// The numbers of an invocation are not made by an instruction.
void note_given(capture::ProgramTrace& trace) {
  for (std::uint32_t part = 0; trace.steps.size() < trace.values.nodes.size(); ++part)
    trace.steps.push_back({capture::ProgramTrace::given, -1, part});
}

/// The resources of a case for another number type; `storage` makes the images that are written.
template <class N, class MakeStorage>
std::vector<Resource<N>> resources_of(const CaseBinding& binding, const MakeStorage& storage) {
  std::vector<Resource<N>> out;
  for (std::size_t i = 0; i < binding.resources().size(); ++i) {
    const Resource<Float>& bound = binding.resources()[i];
    out.push_back({bound.buffer, bound.image, bound.storage != nullptr ? storage(i) : nullptr});
  }
  return out;
}

class SpirvModel final : public capture::TracedProgram {
 public:
  SpirvModel(const capture::PassCase& c, const CaseOutput& first, std::unique_ptr<Module> module, std::unique_ptr<CaseBinding> binding,
             const Limits& limits)
      : TracedProgram(first.array.width, first.array.height, values_of(c)),
        case_(c),
        module_(std::move(module)),
        binding_(std::move(binding)),
        limits_(limits) {}
  void evaluate(int x, int y, scalar::Scalar<float>* out) const override { run(x, y, out); }
  void evaluate(int x, int y, scalar::Scalar<double>* out) const override { run(x, y, out); }
  void evaluate(int x, int y, perturbed::Perturbed* out) const override { run(x, y, out); }
  void enclose(int x, int y, const float*, enclosed::Enclosure* out) const override { run(x, y, out); }
  bool rearrange(int x, int y, const float*, enclosed::Enclosure* out) const override {
    std::vector<enclosed::Rearranged> all(static_cast<std::size_t>(values()));
    run(x, y, all.data());
    for (const enclosed::Rearranged& r : all) *out++ = r.settled();
    return true;
  }
  std::string_view input_of(const float* texel) const override { return binding_->input_of(texel); }
  void trace(int x, int y, capture::ProgramTrace& out) const override {
    perturbed::Behaviour behaviour;
    behaviour.trace = &out.values;
    const perturbed::Scope scope(behaviour);
    std::vector<perturbed::Perturbed> values(static_cast<std::size_t>(this->values()));
    run(x, y, values.data(), &out);
    for (const perturbed::Perturbed& v : values) out.outputs.push_back(v.node());
  }
  capture::SourceLine line(std::uint32_t instruction) const override { return module_->source_line(instruction); }

 private:
  template <class N>
  void run(int x, int y, N* out, [[maybe_unused]] capture::ProgramTrace* trace = nullptr) const {
    const FloatingPointGuard guard;
    std::map<const CaseOutput*, OwnTexel<N>> written;
    const auto resources = resources_of<N>(*binding_, [&](std::size_t i) -> StorageImage<N>* {
      return &written.try_emplace(binding_->output(i), *binding_->output(i), x, y).first->second;
    });
    Machine<N> machine(*module_, resources, limits_);
    Invocation<N> invocation(machine);
    if constexpr (std::is_same_v<N, perturbed::Perturbed>)
      if (trace) invocation.follow(*trace);
    const auto column = static_cast<std::uint32_t>(x), row = static_cast<std::uint32_t>(y);
    const Three& size = module_->group;
    invocation.begin({binding_->groups(), {column / size[0], row / size[1], 0}, {column % size[0], row % size[1], 0}});
    if constexpr (std::is_same_v<N, perturbed::Perturbed>)
      if (trace) note_given(*trace);
    invocation.run();
    for (const CaseOutput& o : case_.outputs) {
      if (!is_asked(o)) continue;
      const auto found = written.find(&o);
      for (int k = 0; k < info(o.array.format).channels; ++k) *out++ = found == written.end() ? N(0.0f) : found->second.channel(k);
    }
  }

  const capture::PassCase& case_;
  std::unique_ptr<Module> module_;
  std::unique_ptr<CaseBinding> binding_;
  Limits limits_;
};

class SpirvList final : public capture::TracedListProgram {
 public:
  SpirvList(const capture::PassCase& c, Program program, std::span<const std::byte> spirv, const std::string& name, const Limits& limits)
      : program_(std::move(program)), module_(spirv, name, specialization_of(program_, c)), limits_(limits) {}
  std::vector<capture::Array> trace(const capture::PassCase& c, capture::ProgramTrace& out) const override {
    using perturbed::Perturbed;
    const FloatingPointGuard guard;
    perturbed::Behaviour behaviour;
    behaviour.trace = &out.values;
    const perturbed::Scope scope(behaviour);
    const CaseBinding binding(c, program_, module_);
    const auto resources = resources_of<Perturbed>(binding, [](std::size_t) -> StorageImage<Perturbed>* { return nullptr; });
    Machine<Perturbed> machine(module_, resources, limits_);
    Invocation<Perturbed> invocation(machine);
    invocation.follow(out);
    invocation.begin({binding.groups(), {}, {}});
    note_given(out);
    // The others have no record of their own, so that a barrier waits for nobody.
    while (invocation.run() != Stop::finished) {
    }
    return binding.outputs();
  }
  capture::SourceLine line(std::uint32_t instruction) const override { return module_.source_line(instruction); }

 private:
  Program program_;
  Module module_;
  Limits limits_;
};

}  // namespace

std::unique_ptr<capture::TracedListProgram> spirv_list(const capture::PassCase& c, const Program& program, std::span<const std::byte> spirv,
                                                       const std::string& name, const Limits& limits) {
  return std::make_unique<SpirvList>(c, program, spirv, name, limits);
}

std::unique_ptr<capture::TracedProgram> spirv_model(const capture::PassCase& c, const Program& program, std::span<const std::byte> spirv,
                                                    const std::string& name, const Limits& limits) {
  auto module = std::make_unique<Module>(spirv, name, specialization_of(program, c));
  const auto is_list = [&](const std::string& output) { return c.output(output) != nullptr && c.output(output)->array.is_records; };
  if (module->is_cooperative || program.one_group || std::any_of(program.outputs.begin(), program.outputs.end(), is_list))
    module->refuse(0, 0, "invocations that work together, or write a list, are executed in float alone");
  auto binding = std::make_unique<CaseBinding>(c, program, *module);
  return std::make_unique<SpirvModel>(c, *c.output(program.outputs.at(0)), std::move(module), std::move(binding), limits);
}

}  // namespace rainref::spirv
