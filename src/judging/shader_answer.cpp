#include "judging/shader_answer.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "judge/alternatives.h"
#include "judge/check_pack.h"
#include "judge/evaluations.h"
#include "judge/invocation_judge.h"
#include "judge/port_files.h"
#include "judge/profiles.h"
#include "judge/slots.h"
#include "rainref/error.h"
#include "spirv/spirv_model.h"

namespace rainref::judging {
namespace {

using capture::Array, capture::PassCase, capture::PassModel;
using Places = std::vector<std::array<int, 2>>;

constexpr std::size_t most_places = 32;

/// Texels that fail, or, where none does, some all over the picture.
Places places_of(const judge::CaseJudgement& judged, const PassModel& model) {
  std::set<std::array<int, 2>> found;
  for (const judge::OutputJudgement& output : judged.outputs)
    for (const judge::Failure& f : output.worst)
      if (found.size() < most_places && f.x < model.width() && f.y < model.height()) found.insert({f.x, f.y});
  const int all = model.width() * model.height(), step = std::max(1, all / static_cast<int>(most_places));
  if (found.empty())
    for (int i = step / 2; i < all; i += step) found.insert({i % model.width(), i / model.width()});
  return {found.begin(), found.end()};
}

/// Whether a model may give what is stored; nothing where it has too many alternatives, or no bound.
std::optional<bool> may_give(const PassModel& model, const std::vector<judge::Slot>& slots, const std::vector<Array>& stored, int x, int y,
                             const enclosed::Profile& profile, judge::HalfMode mode) {
  judge::Alternatives all;
  all.run(model, x, y, nullptr, profile);
  if (all.gave_up) return std::nullopt;
  bool is_open = false;
  std::vector<enclosed::CodeRange> ranges;
  for (int a = 0; a < all.count; ++a) {
    judge::code_ranges(slots, all.values[static_cast<std::size_t>(a)], profile, mode, ranges);
    bool holds = true;
    for (std::size_t v = 0; v < slots.size(); ++v) {
      is_open |= ranges[v].is_vacuous();
      holds &= ranges[v].contains(slots[v].code(stored[static_cast<std::size_t>(slots[v].output)], x, y));
    }
    if (holds && !is_open) return true;
  }
  return is_open ? std::nullopt : std::optional(false);
}

/// What a pass's program says of the case that fails most, or of the first one.
std::string answer_of(const capture::Pack& pack, const judge::PassJudgement& pass, const Programs& programs, judge::PortFiles& files,
                      const judge::ValidateOptions& options) {
  const auto failing = [](const judge::CaseJudgement& c) { return c.failing; };
  const auto most =
      std::max_element(pass.cases.begin(), pass.cases.end(), [&](const auto& a, const auto& b) { return failing(a) < failing(b); });
  const auto entry = most == pass.cases.end()
                         ? pack.cases.end()
                         : std::find_if(pack.cases.begin(), pack.cases.end(), [&](const auto& c) { return c.id == most->id; });
  if (entry == pack.cases.end()) return "";
  const PassCase c = judge::read_case(pack, *entry);
  const std::unique_ptr<PassModel> shader = program_model(programs, pass.formula, c);
  if (!shader) return "";
  const std::unique_ptr<PassModel> reference = judge::bound(pass.pass, judge::binder(pack.effect, pass.pass), c);
  if (shader->values() != reference->values()) return "";
  std::vector<Array> stored;
  for (const capture::CaseOutput& output : c.outputs) stored.push_back(files.read(c.folder(), "out." + output.name, output.array));
  const bool fails = most->failing > 0;
  return sentence(ask_shader(c, *reference, *shader, stored, places_of(*most, *reference), judge::profile(options.profile), pass.half_mode),
                  fails);
}

}  // namespace

std::unique_ptr<capture::TracedProgram> program_model(const Programs& programs, const std::string& formula, const PassCase& c) {
  const auto program = programs.find(formula);
  if (program == programs.end() || program->second.one_group || !judge::is_enveloped(c)) return nullptr;
  return spirv::spirv_model(c, program->second, spirv::read_spirv(program->second), "'" + program->second.spirv.filename().string() + "'");
}

ShaderAnswer ask_shader(const PassCase& c, const PassModel& reference, const PassModel& shader, const std::vector<Array>& stored,
                        const Places& places, const enclosed::Profile& profile, judge::HalfMode mode) {
  const judge::InvocationJudge by_reference(c, reference, profile, mode);
  const std::vector<judge::Slot> slots = judge::slots_of(c, reference);
  ShaderAnswer answer;
  std::vector<Array> in_float = stored;
  std::vector<scalar::Scalar<float>> values(slots.size());
  for (const auto& [x, y] : places) {
    const std::optional<bool> is_said = may_give(shader, slots, stored, x, y, profile, mode);
    if (!is_said) continue;
    ++answer.tried;
    answer.said += *is_said;
    if (*is_said) continue;
    shader.evaluate(x, y, values.data());
    for (std::size_t v = 0; v < slots.size(); ++v) {
      const judge::Slot& s = slots[v];
      judge::store_value(s, values[v].v, judge::rounding_of(s, mode),
                         in_float[static_cast<std::size_t>(s.output)].levels[0].edit().data() + s.offset(x, y));
    }
    answer.right += by_reference.accepts(x, y, in_float) != judge::Accepted::no;
  }
  return answer;
}

std::string sentence(const ShaderAnswer& a, bool fails) {
  const auto nearly_all = [&](int count) { return 4 * count >= 3 * a.tried; };
  if (a.tried == 0) return "";
  if (!fails) return nearly_all(a.said) ? "" : "passes, but not by what this SPIR-V says: is it the one that ran?";
  if (nearly_all(a.said))
    return fmt::format("the device did what this shader says ({} of {} failing texels that were tried): the mistake is in the shader",
                       a.said, a.tried);
  if (nearly_all(a.right))
    return fmt::format(
        "the shader is right ({} of {} failing texels that were tried): what is stored is not what it gives for these inputs. "
        "Look at what is bound, at the compiler's options, at the driver and at the read-back",
        a.right, a.tried);
  return fmt::format(
      "of {} failing texels that were tried {} are what this shader says and at {} more the shader is right: is it the one that ran?",
      a.tried, a.said, a.right);
}

void ask_shaders(const capture::Pack& pack, const std::filesystem::path& port, const Programs& programs,
                 const judge::ValidateOptions& options, judge::PortJudgement& judgement) {
  judge::PortFiles files(port, pack.effect, pack.variant, options.buffers);
  for (const judge::PassJudgement& pass : judgement.passes) {
    if (pass.status != judge::Status::pass && pass.status != judge::Status::warn && pass.status != judge::Status::fail) continue;
    std::string said;
    try {
      said = answer_of(pack, pass, programs, files, options);
    } catch (const Error& e) {
      if (e.code() == ExitCode::internal) throw;
      said = e.what();  // the verdict stands without it
    }
    if (!said.empty()) judgement.notes.push_back(pass.pass + ": " + said);
  }
}

}  // namespace rainref::judging
