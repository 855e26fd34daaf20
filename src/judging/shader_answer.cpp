#include "judging/shader_answer.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "base/path_text.h"
#include "judge/alternatives.h"
#include "judge/evaluations.h"
#include "judge/invocation_judge.h"
#include "judge/keyed.h"
#include "judge/profiles.h"
#include "judge/slots.h"
#include "rainref/error.h"
#include "spirv/spirv_model.h"

namespace rainref::judging {
namespace {

using capture::Array, capture::PassCase, capture::PassModel;
using Places = std::vector<std::array<int, 2>>;

constexpr std::size_t most_places = 32;

std::string name_of(const spirv::Program& program) { return "'" + path_text(program.spirv.filename()) + "'"; }

/// Failing texels; if there are none, some spread over the picture.
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

/// True if a model may give the stored values; nothing if it has too many alternatives, or no bound.
std::optional<bool> may_give(const PassCase& c, const PassModel& model, const std::vector<judge::Slot>& slots,
                             const std::vector<Array>& port, int x, int y, const enclosed::Profile& profile, judge::HalfMode mode,
                             const port_dump::KeptForms* kept) {
  judge::Stored stored;
  stored.read(slots, c, model, profile, port, x, y, kept);
  judge::Alternatives all;
  all.run(model, x, y, stored, profile);
  if (all.gave_up) return std::nullopt;
  bool is_open = false;
  std::vector<enclosed::CodeRange> ranges;
  for (int a = 0; a < all.count; ++a) {
    judge::code_ranges(slots, all.values[static_cast<std::size_t>(a)], profile, mode, ranges);
    bool holds = true;
    for (std::size_t v = 0; v < slots.size(); ++v) {
      is_open |= ranges[v].is_vacuous();
      holds &= ranges[v].contains(stored.got[v]);
    }
    if (holds && !is_open) return true;
  }
  return is_open ? std::nullopt : std::optional(false);
}

/// Executes a pass's program on the case with most failures, or on the first one.
std::string answer_of(const judge::PassJudgement& pass, const LoadStored& load, const BindPass& bind, const Programs& programs,
                      const std::string& profile) {
  const auto failing = [](const judge::CaseJudgement& c) { return c.failing; };
  const auto most =
      std::max_element(pass.cases.begin(), pass.cases.end(), [&](const auto& a, const auto& b) { return failing(a) < failing(b); });
  if (most == pass.cases.end() || !programs.contains(pass.formula)) return "";
  const std::optional<StoredRun> run = load(most->id);
  if (!run) return "";
  const spirv::Program& program = programs.at(pass.formula);
  const spirv::Module module(spirv::read_spirv(program), name_of(program), spirv::specialization_of(program, run->c));
  if (std::string fault = block_fault(run->block, module); !fault.empty()) return module.name + ": " + fault;
  const std::unique_ptr<PassModel> shader = program_model(programs, pass.formula, run->c);
  if (!shader) return "";
  const std::unique_ptr<PassModel> reference = judge::bound(pass.pass, bind(pass.pass), run->c);
  if (shader->values() != reference->values()) return "";
  const bool fails = most->failing > 0;
  return sentence(ask_shader(run->c, *reference, *shader, run->stored, places_of(*most, *reference), judge::profile(profile),
                             pass.half_mode, &run->kept),
                  fails);
}

/// The port's programs for a failing run, as far as they can be traced. ask_shaders() reports why they cannot.
struct FollowedPrograms {
  std::unique_ptr<capture::TracedProgram> texels;
  std::unique_ptr<capture::TracedListProgram> list;

  FollowedPrograms(const judge::FailedRun& failed, const Programs& programs) {
    const auto program = programs.find(failed.judged.formula);
    if (program == programs.end()) return;
    try {
      texels = program_model(programs, failed.judged.formula, failed.run.c);
      if (!judge::keyed_outputs(failed.run.c).empty())
        list = spirv::spirv_list(failed.run.c, program->second, spirv::read_spirv(program->second), name_of(program->second));
    } catch (const Error&) {
      // it cannot be executed, or not in every number type
    }
  }
  void give(judge::FailedRun& run) const {
    run.program = texels.get();
    run.list_program = list.get();
  }
};

}  // namespace

std::unique_ptr<capture::TracedProgram> program_model(const Programs& programs, const std::string& formula, const PassCase& c) {
  const auto program = programs.find(formula);
  if (program == programs.end() || program->second.one_group || !judge::is_enveloped(c)) return nullptr;
  return spirv::spirv_model(c, program->second, spirv::read_spirv(program->second), name_of(program->second));
}

ShaderAnswer ask_shader(const PassCase& c, const PassModel& reference, const PassModel& shader, const std::vector<Array>& stored,
                        const Places& places, const enclosed::Profile& profile, judge::HalfMode mode, const port_dump::KeptForms* kept) {
  const judge::InvocationJudge by_reference(c, reference, profile, mode);
  const std::vector<judge::Slot> slots = judge::slots_of(c, reference);
  ShaderAnswer answer;
  std::vector<Array> in_float = stored;
  std::vector<scalar::Scalar<float>> values(slots.size());
  for (const auto& [x, y] : places) {
    const std::optional<bool> is_said = may_give(c, shader, slots, stored, x, y, profile, mode, kept);
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

std::string block_fault(const scene::UniformBlock& block, const spirv::Module& shader) {
  const std::optional<scene::UniformBlock> own = spirv::uniform_block_of(shader);
  if (!own) return "";
  for (const scene::Member& m : own->members) {
    const auto same = std::find_if(block.members.begin(), block.members.end(), [&](const scene::Member& b) { return b.name == m.name; });
    if (same == block.members.end()) continue;
    if (same->offset != m.offset)
      return fmt::format("its uniform block has '{}' at byte {}, the pack has it at byte {}: every value from there on may be another one",
                         m.name, m.offset, same->offset);
    if (same->scalar != m.scalar)
      return fmt::format("its uniform block has '{}' as {}, the pack has it as {}", m.name, scene::name(m.scalar),
                         scene::name(same->scalar));
  }
  return "";
}

judge::Explanation explain(const judge::FailedRun& failed, const Programs& programs, const faults::SearchLimit& limit) {
  const FollowedPrograms own(failed, programs);
  const std::optional<FollowedPrograms> of_other =
      failed.other ? std::make_optional<FollowedPrograms>(*failed.other, programs) : std::nullopt;
  judge::FailedRun with_program = failed, other = failed.other ? *failed.other : failed;
  own.give(with_program);
  if (of_other) of_other->give(other);
  if (failed.other) with_program.other = &other;
  return faults::diagnose_within(limit, with_program);
}

void ask_shaders(const LoadStored& load, const BindPass& bind, const Programs& programs, judge::PortJudgement& judgement) {
  for (const judge::PassJudgement& pass : judgement.passes) {
    if (pass.status != judge::Status::pass && pass.status != judge::Status::warn && pass.status != judge::Status::fail) continue;
    std::string said;
    try {
      said = answer_of(pass, load, bind, programs, judgement.profile);
    } catch (const Error& e) {
      if (e.code() == ExitCode::internal) throw;
      said = e.what();  // the verdict does not depend on it
    }
    if (!said.empty()) judgement.notes.push_back(pass.pass + ": " + said);
  }
}

}  // namespace rainref::judging
