// Mistakes in lists of drops: each is judged as it must be, and the diagnosis names it.
#include "faults/list_faults.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <set>

#include <fmt/format.h>

#include "faults/diagnose.h"
#include "faults/mutate.h"
#include "faults/probe.h"
#include "judge/judge.h"
#include "judge/keyed.h"
#include "judge/support.h"
#include "rainref/error.h"
#include "registry/registry.h"

namespace rainref::faults {
namespace {

using namespace judge;
using namespace judge::test;
using capture::Array;
using capture::PassCase;
using testing::HasSubstr;

const parallel::Executor& executor() {
  static const parallel::Executor two(2);
  return two;
}

/// A case with a keyed list, and how it is judged and read.
struct ListCase {
  capture::PackPass pass;
  std::unique_ptr<PassCase> c;
  std::optional<PassCase> before;
  std::unique_ptr<capture::PassModel> model;  ///< a pass of integers has none
  std::size_t output = 0;

  const capture::PassEvaluations& evaluations() const { return *evaluations_of(c->effect, c->pass); }
  const Array& reference() const { return c->outputs[output].array; }
  const capture::KeyedModel* keyed() const { return model->keyed(c->outputs[output].name); }
  std::vector<Fault> faults() const { return faults_of(pass, *c, *model, before ? &*before : nullptr); }
  KeyedJudgement judged(const Array& list, const std::string& under = "vulkan") const {
    return judge_keyed(c->outputs[output], list, keyed(), profile(under));
  }
  std::vector<Cause> causes(const Array& list) const {
    std::vector<Array> port;
    for (const capture::CaseOutput& o : c->outputs) port.push_back(o.array);
    port[output] = list;
    return diagnose_lists(pass, *c, before ? &*before : nullptr, model.get(), port, profile("vulkan"), executor());
  }
  std::string text(const Fault& d) const { return c->folder() + " " + name_of(d); }
};
std::vector<ListCase> list_cases(const PackPasses& of) {
  const capture::Pack pack(pack_folder(of.name));
  std::vector<ListCase> out;
  for (const capture::PackCase& entry : pack.cases) {
    if (!of.has(entry.pass)) continue;
    ListCase l{pack.pass(entry.pass), std::make_unique<PassCase>(pack.read(entry)), std::nullopt, nullptr, 0};
    const std::vector<std::size_t> keyed = keyed_outputs(*l.c);
    if (keyed.empty()) continue;
    l.output = keyed.front();
    const Bind bind = l.evaluations().bind;
    l.model = bind ? bind(*l.c) : std::make_unique<capture::ListPass>("", nullptr);
    for (ListCase& earlier : out)
      if (earlier.c->pass == l.c->pass) l.before = *earlier.c;
    out.push_back(std::move(l));
  }
  return out;
}
std::vector<ListCase> list_cases(const std::string& pack_name, const std::string& pass) {
  return list_cases(shipped_pack(pack_name, {pass}));
}
/// Of the packs that the proofs go by those with passes that give a list of records with ids, and these passes.
std::vector<PackPasses> packs_with_lists() {
  std::vector<PackPasses> all = proven_packs();
  for (PackPasses& p : all) {
    const capture::EffectInfo& info = *registry::effect_of_pack(p.effect).info;
    const auto is_list = [&](const std::string& buffer) {
      const std::string& record = info.buffer(buffer, p.variant).record;
      return !record.empty() && has_key(info.record(record));
    };
    std::erase_if(p.passes, [&](const std::string& pass) {
      const std::vector<std::string> writes = info.writes(info.pass(pass), p.variant);
      return info.pass(pass).variant(p.variant)->judge != capture::Judge::keyed || std::none_of(writes.begin(), writes.end(), is_list);
    });
  }
  std::erase_if(all, [](const PackPasses& p) { return p.passes.empty(); });
  return all;
}
bool gives(const std::vector<Cause>& causes, const std::string& name) {
  return std::any_of(causes.begin(), causes.end(), [&](const Cause& c) { return c.name == name && c.explained == c.of && c.of_records; });
}
std::string text_of(const std::vector<Cause>& causes) {
  std::string out;
  for (const Cause& c : causes) out += fmt::format("{} {}/{}/{}; ", c.name, c.explained, c.inside, c.of);
  return out;
}

class ListFaults : public testing::TestWithParam<PackPasses> {};

// Whatever changes a record is outside, and the cause that is found gives the same records: the mistake itself, or one
// that nobody could tell from it here. Each mistake is explained by trying all: here every fifth, in scripts/full/samples each.
TEST_P(ListFaults, EachIsCaughtAndNamed) {
  const std::int64_t step = count_from("RAINREF_FAULTS_STEP", 5);
  std::int64_t made = 0, named_first = 0, applicable = 0;
  for (const ListCase& l : list_cases(GetParam())) {
    for (const Fault& d : l.faults()) {
      if (!d.alter_list || d.for_diagnosis) continue;
      const std::optional<Array> port = faulty_list(d, *l.c, l.output, l.evaluations(), l.model.get(), l.reference());
      if (!port || same_records(*port, l.reference())) continue;
      if (applicable++ % step != 0) continue;
      ++made;
      const KeyedJudgement j = l.judged(*port);
      EXPECT_GT(j.failing, 0) << l.text(d);
      EXPECT_FALSE(j.events.text().empty()) << l.text(d);
      const std::vector<Cause> causes = l.causes(*port);
      ASSERT_FALSE(causes.empty()) << l.text(d);
      EXPECT_EQ(causes[0].explained, causes[0].of) << l.text(d) << ": " << text_of(causes);
      named_first += causes[0].name == name_of(d);
    }
  }
  fmt::print("{}: {} of {} named first\n", GetParam().name, named_first, made);
  EXPECT_GT(applicable, 15 * static_cast<std::int64_t>(GetParam().passes.size()));
  // The others: one record has no neighbour, resting drops have no stale velocity, a pass that changes two fields leaves
  // the rest as they were.
  EXPECT_GT(10 * named_first, 7 * made);
}

// Records are matched by id: slots may be filled in any order.
TEST_P(ListFaults, AnotherOrderIsRight) {
  for (const ListCase& l : list_cases(GetParam())) {
    for (const Fault& d : l.faults()) {
      if (!name_of(d).ends_with("in another order")) continue;
      const std::optional<Array> port = faulty_list(d, *l.c, l.output, l.evaluations(), l.model.get(), l.reference());
      if (!port) continue;  // one record
      EXPECT_NE(port->levels, l.reference().levels) << l.text(d);
      for (const char* under : {"ieee", "vulkan"}) EXPECT_EQ(l.judged(*port, under).failing, 0) << l.text(d);
      EXPECT_TRUE(d.legal);
    }
  }
}

TEST_P(ListFaults, MutateCountsThemAlikeForEveryNumberOfThreads) {
  const capture::Pack pack(pack_folder(GetParam().name));
  for (const std::string& pass : GetParam().passes) {
    ValidateOptions options;
    options.only = {pass};
    std::array<std::string, 2> lines;
    int applicable = 0, bugs = 0, caught = 0, warned = 0;
    for (const int threads : {1, 3}) {
      const parallel::Executor some(threads);
      options.executor = &some;
      for (const char* under : {"ieee", "vulkan"}) {
        options.profile = under;
        for (const MutantJudgement& m : mutate(pack, options, 100).mutants) {
          lines[threads == 1 ? 0 : 1] += fmt::format("{} {} {} {} {}\n", under, m.name, m.compared, m.differing, m.outside);
          if (threads > 1) continue;
          // Bits are bits: under ieee whatever differs is outside.
          if (under == std::string("ieee")) {
            EXPECT_EQ(m.outside, m.differing) << pass << ' ' << m.name;
          }
          applicable += m.differing > 0;
          bugs += under == std::string("vulkan") && m.differing > 0 && !m.legal;
          caught += under == std::string("vulkan") && m.differing > 0 && !m.legal && m.caught();
          warned += under == std::string("vulkan") && m.differing > 0 && !m.legal && m.warned();
        }
      }
    }
    EXPECT_EQ(lines[0], lines[1]) << pass;
    fmt::print("{} {}: {} of {} caught under vulkan, {} more warn\n", GetParam().name, pass, caught, bugs, warned);
    EXPECT_GT(bugs, 20) << pass;
    EXPECT_GE(10 * (caught + warned), 9 * bugs) << pass;
    EXPECT_GE(10 * caught, 8 * bugs) << pass;
  }
}

INSTANTIATE_TEST_SUITE_P(Packs, ListFaults, testing::ValuesIn(packs_with_lists()), name_of_pack_test);

/// What port writers really do to the merge of the windshield, where it matters: events, and the cause that is named.
struct Expected {
  const char *fault, *events;
};
constexpr Expected expected_of_merge[] = {
    {"drops without a record", "missing: "},
    {"drops with a record twice", "duplicate: "},
    {"drops with an ended record still alive", "extra: "},
    {"drops with an unmerged pair", "extra: "},
    {"drops with a capture that is lost", "outside: "},
    {"drops with the mass of before a capture", "outside: "},
    {"drops with a record not treated", "outside: "},
    {"drops under permuted ids", "outside: "},
    {"drops one slot off", "outside: "},
    {"drops with the velocity of the next slot", "outside: "},
    {"drops with stale mass", "outside: "},
    {"drops with velocity.y negated", "outside: "},
    {"drops one step late", "extra: "},
};

/// The fused product of another device, on whose list a mistake is made.
Array fused_list(const ListCase& l) {
  perturbed::Behaviour b;
  b.fault = perturbed::Fault::fused;
  const perturbed::Scope scope(b);
  Array out = l.reference();
  out.levels = {*l.keyed()->perturbed()};
  out.width = static_cast<int>(out.levels[0].size() / out.element_bytes());
  return out;
}

TEST(ListFaultsOfMerge, AreEventsAndNamedOnOtherDevicesToo) {
  std::set<std::string> seen;
  for (const ListCase& l : list_cases("windshield-corrected", "merge")) {
    const Array fused = fused_list(l);
    ASSERT_EQ(l.judged(fused).failing, 0);
    for (const Fault& d : l.faults()) {
      const auto expected = std::find_if(std::begin(expected_of_merge), std::end(expected_of_merge),
                                         [&](const Expected& e) { return name_of(d) == e.fault; });
      if (expected == std::end(expected_of_merge)) continue;
      for (const Array& base : {l.reference(), fused}) {
        const std::optional<Array> port = faulty_list(d, *l.c, l.output, l.evaluations(), l.model.get(), base);
        if (!port || same_records(*port, base)) continue;
        seen.insert(name_of(d));
        EXPECT_THAT(l.judged(*port).events.text(), HasSubstr(expected->events)) << l.text(d);
        const std::vector<Cause> causes = l.causes(*port);
        ASSERT_FALSE(causes.empty()) << l.text(d);
        EXPECT_TRUE(std::any_of(causes.begin(), causes.end(), [&](const Cause& c) { return c.name == name_of(d) && c.inside == c.of; }))
            << l.text(d) << ": " << text_of(causes);
      }
    }
  }
  EXPECT_EQ(seen.size(), std::size(expected_of_merge));
}

// A mistake in what the pass takes, not in its list.
TEST(ListFaultsOfIntegrate, AStaleInputIsNamed) {
  int tried = 0;
  for (const ListCase& l : list_cases("windshield-corrected", "integrate")) {
    for (const Fault& d : l.faults()) {
      if (name_of(d) != "input glass_frame stale" && name_of(d) != "uniform dt is zero") continue;
      const std::optional<Array> port = faulty_list(d, *l.c, l.output, l.evaluations(), l.model.get(), l.reference());
      if (!port || same_records(*port, l.reference())) continue;
      ++tried;
      EXPECT_TRUE(gives(l.causes(*port), name_of(d))) << l.text(d) << ": " << text_of(l.causes(*port));
    }
  }
  EXPECT_GT(tried, 2);
}

// No mistake explains a list that is wrong in no way.
TEST(ListFaultsOfMerge, ACauseMustNotBreakWhatIsRight) {
  const ListCase l = std::move(list_cases("windshield-corrected", "merge").front());
  Records records = records_of(l.reference());
  ASSERT_GT(records.size(), 10u);
  const float far = 7;  // one field of three records, by nobody's rule
  for (const std::size_t k : {2u, 5u, 9u}) std::memcpy(&records[k][4 * k % 12], &far, sizeof far);
  const Array port = array_of(records, l.reference());
  EXPECT_GE(l.judged(port).failing, 3);
  EXPECT_TRUE(l.causes(port).empty()) << text_of(l.causes(port));
}

// A uniform that a pass of whole numbers only hands on has another number: it is read off what the port stored.
TEST(ListDiagnosis, AnotherValueOfAUniformIsReadOff) {
  int named = 0;
  for (const ListCase& l : list_cases("windshield-as-published", "spawn")) {
    if (l.reference().width < 4 || named > 0) continue;
    PassCase altered = *l.c;
    for (const scene::Member& m : l.pass.block.members)
      if (const float life = 0.8125f; m.name == "life") std::memcpy(altered.uniforms.data() + m.offset, &life, 4);
    const Array port = l.evaluations().recompute(altered)[l.output];
    const std::vector<Cause> causes = l.causes(port);
    ASSERT_FALSE(causes.empty());
    EXPECT_EQ(causes[0].name, "another value of life");
    EXPECT_THAT(causes[0].sentence, HasSubstr("0.8125"));
    ++named;
  }
  EXPECT_EQ(named, 1);
}
// A place that a record meets twice: the second time is met in every record, not in the first one of the list alone.
TEST(ListDiagnosis, PlacesAreCountedAnewInEachRecord) {
  const ListCase l = std::move(list_cases("windshield-corrected", "integrate").front());
  const Probed probed{l.pass, *l.c, l.evaluations().bind, *l.model};
  const std::vector<Probe> probes = probes_of_list(probed, l.c->outputs[l.output].name, {});
  ASSERT_EQ(probes.size(), 1u);
  const auto records = static_cast<std::int32_t>(l.reference().width);
  ASSERT_GT(records, 3);
  int most = 0;
  std::set<std::uint32_t> shapes;
  for (const perturbed::Trace::Node& n : probes[0].trace.nodes) shapes.insert(n.shape);
  for (const std::uint32_t shape : shapes) {
    const std::int32_t count = probes[0].trace.met.at(shape);
    if (count < 2 * records) continue;
    Fault d;
    d.behaviour.places[0] = {shape, 1, perturbed::PlaceFault::doubled};
    const std::optional<Array> list = faulty_list(d, *l.c, l.output, l.evaluations(), l.model.get(), l.reference());
    ASSERT_TRUE(list);
    const Records made = records_of(*list), right = records_of(l.reference());
    int changed = 0;
    for (std::size_t k = 0; k < std::min(made.size(), right.size()); ++k) changed += made[k] != right[k];
    most = std::max(most, changed);
  }
  EXPECT_GT(most, 1);
}
// One field alone has half precision.
TEST(ListDiagnosis, AFieldThroughHalfIsNamed) {
  int named = 0;
  for (const ListCase& l : list_cases("windshield-corrected", "integrate")) {
    for (const Fault& d : l.faults()) {
      if (name_of(d) != "drops with velocity through half") continue;
      const std::optional<Array> port = faulty_list(d, *l.c, l.output, l.evaluations(), l.model.get(), l.reference());
      if (!port || l.judged(*port).events.outside.size() < 4) continue;
      const std::vector<Cause> causes = l.causes(*port);
      ASSERT_FALSE(causes.empty());
      EXPECT_EQ(causes[0].name, name_of(d));
      ++named;
    }
  }
  EXPECT_GT(named, 0);
}

}  // namespace
}  // namespace rainref::faults
