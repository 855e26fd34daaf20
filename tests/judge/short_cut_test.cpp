// What has the reference's bits needs no envelope: no element's verdict changes, and none of a port.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <optional>
#include <tuple>

#include <gtest/gtest.h>

#include "judge/judge.h"
#include "judge/known_device.h"
#include "judge/mini_port.h"
#include "judge/reference_outputs.h"
#include "judge/stored.h"
#include "judge/support.h"

namespace rainref::judge {
namespace {

using capture::Array;
using test::BoundCase;
using test::BoundPass;

// ---- the small packs -----------------------------------------------------------------------------------------------
class ShortCut : public testing::TestWithParam<test::PackPasses> {
 protected:
  /// Of each pass the largest run, of equals the last, whose state is of most steps.
  std::vector<BoundPass> passes() const {
    std::vector<BoundPass> all = test::enveloped_passes({GetParam()});
    if (!std::getenv("RAINREF_ALL_PACKS"))
      for (BoundPass& pass : all) {
        const auto texels = [](const BoundCase& b) { return static_cast<std::int64_t>(b.model->width()) * b.model->height(); };
        auto largest = pass.cases.begin();
        for (auto b = pass.cases.begin(); b != pass.cases.end(); ++b)
          if (texels(*b) >= texels(*largest)) largest = b;
        std::swap(*largest, pass.cases.front());
        pass.cases.erase(pass.cases.begin() + 1, pass.cases.end());
      }
    return all;
  }
};
INSTANTIATE_TEST_SUITE_P(Packs, ShortCut, testing::ValuesIn(test::shipped_packs()), test::name_of_pack_test);

/// The roundings that a pass of a profile may be judged by.
std::vector<HalfMode> modes_of(const BoundCase& b, const enclosed::Profile& p) {
  if (std::none_of(b.slots.begin(), b.slots.end(), [](const Slot& s) { return s.kind == FormatInfo::float16; })) return {HalfMode::rne};
  const HalfMode asked = half_mode_of(p);
  return asked == HalfMode::either ? std::vector<HalfMode>{HalfMode::rne, HalfMode::rtz, HalfMode::either}
                                   : std::vector<HalfMode>{HalfMode::rne, HalfMode::rtz};
}

/// What an evaluation stores of an invocation by this rounding.
std::vector<std::array<std::byte, 4>> stored_by(const std::vector<Slot>& slots, const std::vector<float>& values, HalfMode mode) {
  std::vector<std::array<std::byte, 4>> all(slots.size());
  for (std::size_t v = 0; v < slots.size(); ++v) store_value(slots[v], values[v], rounding_of(slots[v], mode), all[v].data());
  return all;
}
/// Whether some alternative holds it. What a store may do with halves at or beyond the largest is no part of the premise.
bool codes_are_held(const Alternatives& all, const BoundCase& b, const std::vector<Slot>& slots,
                    const std::vector<std::array<std::byte, 4>>& stored, const enclosed::Profile& p, HalfMode mode) {
  std::vector<enclosed::CodeRange> ranges;
  for (int a = 0; a < all.count; ++a) {
    code_ranges(slots, all.values[static_cast<std::size_t>(a)], p, mode, ranges);
    bool is_held = true;
    for (std::size_t v = 0; v < slots.size(); ++v) {
      const std::int64_t code = enclosed::ordered_code(slots[v].kind, stored[v].data());
      const bool overflows = slots[v].kind == FormatInfo::float16 && std::abs(code) >= 0x7bff;
      is_held &= overflows || b.model->is_free(static_cast<int>(v)) || ranges[v].contains(code);
    }
    if (is_held) return true;
  }
  return false;
}
/// In one alternative of an invocation's envelope lie these values of an evaluation, and in its codes what is stored of them.
void expect_held(const BoundCase& b, const std::vector<Slot>& slots, const enclosed::Profile& p, int x, int y,
                 const std::vector<float>& values, const std::string& what) {
  const capture::PassModel& model = *b.model;
  for (const HalfMode mode : modes_of(b, p)) {
    const bool is_own = std::all_of(slots.begin(), slots.end(), [&](const Slot& s) { return rounding_of(s, mode) == s.store_rounding; });
    if (!is_own && model.rounds_inside()) continue;  // the evaluation has another by this rounding
    const auto stored = stored_by(slots, values, mode);
    std::vector<float> port;
    for (std::size_t v = 0; v < slots.size(); ++v) port.push_back(stored_value(slots[v], stored[v].data()));
    Alternatives all;
    all.run(model, x, y, port.data(), model.rounds_inside() ? narrowed(p, mode) : p);
    if (all.gave_up) continue;
    EXPECT_TRUE(test::one_holds(all, model, values)) << what;
    EXPECT_TRUE(codes_are_held(all, b, slots, stored, p, mode)) << what << judge::name(mode);
  }
}
/// Calls ask(x, y, where) with some invocations of a run, evenly.
void each_of_some(const BoundPass& pass, const BoundCase& b, const std::string& profile,
                  const std::function<void(int, int, const std::string&)>& ask) {
  const std::int64_t texels = static_cast<std::int64_t>(b.model->width()) * b.model->height(),
                     step = std::max<std::int64_t>(1, texels / test::count_from("RAINREF_SHORT_CUTS", 100));
  for (std::int64_t at = 0; at < texels; at += step) {
    const int x = static_cast<int>(at % b.model->width()), y = static_cast<int>(at / b.model->width());
    ask(x, y, pass.name() + ' ' + b.c->folder() + ' ' + profile + " (" + std::to_string(x) + ", " + std::to_string(y) + ") ");
  }
}

// The premises: in one alternative of every envelope lies what the reference gives, and what each known device gives that the profile
// allows; in its codes what is stored of that.
TEST_P(ShortCut, EveryEnvelopeHoldsTheReference) {
  for (const BoundPass& pass : passes()) {
    for (const BoundCase& b : pass.cases) {
      const std::vector<Slot> slots = slots_of(*b.c, *b.model);
      for (const std::string& name : test::inexact_profiles())
        each_of_some(pass, b, name, [&](int x, int y, const std::string& where) {
          std::vector<scalar::Scalar<float>> values(slots.size());
          b.model->evaluate(x, y, values.data());
          std::vector<float> reference;
          for (const scalar::Scalar<float>& v : values) reference.push_back(v.v);
          expect_held(b, slots, profile(name), x, y, reference, where);
        });
    }
  }
}
TEST_P(ShortCut, EveryEnvelopeHoldsTheKnownDevices) {
  std::int64_t tried = 0, other = 0;
  const std::vector<perturbed::Behaviour> devices = known_devices();
  for (const BoundPass& pass : passes()) {
    for (const BoundCase& b : pass.cases) {
      if (b.model->rounds_inside()) continue;
      const std::vector<Slot> slots = slots_of(*b.c, *b.model);
      for (const std::string& name : test::inexact_profiles()) {
        for (std::size_t d = 0; d < devices.size(); ++d) {
          if (!allows(profile(name), devices[d])) continue;
          each_of_some(pass, b, name, [&](int x, int y, const std::string& where) {
            std::vector<perturbed::Perturbed> values(slots.size());
            std::vector<scalar::Scalar<float>> reference(slots.size());
            {
              const perturbed::Scope scope(devices[d]);
              perturbed::behaviour().begin_invocation();
              b.model->evaluate(x, y, values.data());
            }
            b.model->evaluate(x, y, reference.data());
            std::vector<float> given;
            for (std::size_t v = 0; v < slots.size(); ++v) given.push_back(values[v].v);
            ++tried;
            other += !std::equal(given.begin(), given.end(), reference.begin(), [](float g, const auto& r) { return g == r.v; });
            expect_held(b, slots, profile(name), x, y, given, where + "device " + std::to_string(d) + ' ');
          });
        }
      }
    }
  }
  EXPECT_TRUE(tried == 0 || other > 0) << "no device differs from the reference";
}

/// Whether some alternative holds what is stored.
bool holds(const Alternatives& some, const std::vector<Slot>& slots, const enclosed::Profile& p, HalfMode mode, const Stored& stored) {
  std::vector<enclosed::CodeRange> ranges;
  for (int a = 0; a < some.count; ++a) {
    code_ranges(slots, some.values[static_cast<std::size_t>(a)], p, mode, ranges);
    if (inside(p, ranges, stored)) return true;
  }
  return false;
}

// A part of an envelope that is found sooner holds no codes that the envelope does not hold, in one alternative: of ports that are some
// codes away from the reference, so that the parts hold some of them and not others, and of those that store the ends of a part.
TEST_P(ShortCut, PartsLieInTheirEnvelopes) {
  test::Words words(51);
  std::int64_t held = 0, missed = 0, offered = 0;
  const std::int64_t most = test::count_from("RAINREF_SHORT_CUTS", 100);
  for (const BoundPass& pass : passes()) {
    for (const BoundCase& b : pass.cases) {
      const capture::PassModel& model = *b.model;
      const std::vector<Slot> slots = slots_of(*b.c, model);
      for (const std::string& name : test::inexact_profiles()) {
        const enclosed::Profile& p = profile(name);
        if (model.rounds_inside() || model.parts() == 0) continue;
        for (std::int64_t k = 0; k < most; ++k) {
          const int x = static_cast<int>(words() % static_cast<std::uint64_t>(model.width())),
                    y = static_cast<int>(words() % static_cast<std::uint64_t>(model.height())),
                    part = static_cast<int>(words() % static_cast<std::uint64_t>(model.parts()));
          std::vector<Array> port = b.expected();
          Stored stored;
          stored.read(slots, *b.c, model, p, port, x, y);
          Alternatives parts, all;
          parts.run_part(model, part, x, y, stored, p);
          const bool takes_ends = parts.count > 0 && words.coin();
          for (std::size_t v = 0; v < slots.size(); ++v) {
            std::byte* at = port[static_cast<std::size_t>(slots[v].output)].levels[0].edit().data() + slots[v].offset(x, y);
            if (takes_ends && !stored.free[v])
              store_value(slots[v], words.coin() ? parts.values[0][v].lo : parts.values[0][v].hi, slots[v].store_rounding, at);
            if (!takes_ends && slots[v].channel_bytes == 4)
              change_at<std::uint32_t>(
                  at, [&](std::uint32_t code) { return code == 0 ? code : code + static_cast<std::uint32_t>(words() % 7) - 3; });
          }
          stored.read(slots, *b.c, model, p, port, x, y);
          parts.run_part(model, part, x, y, stored, p);
          if (parts.count == 0) continue;
          ++offered;
          all.run(model, x, y, stored.got_values.data(), p);
          if (all.gave_up) continue;
          for (const HalfMode mode : modes_of(b, p)) {
            const bool is_held = holds(parts, slots, p, mode, stored);
            EXPECT_TRUE(!is_held || holds(all, slots, p, mode, stored))
                << pass.name() << ' ' << b.c->folder() << ' ' << name << " (" << x << ", " << y << ") part " << part;
            ++(is_held ? held : missed);
          }
        }
      }
    }
  }
  if (GetParam().name != "puddle-corrected") return;
  EXPECT_GT(offered, 0) << "surface_hit has parts";
  EXPECT_GT(std::min(held, missed), 0);
}

/// All that a verdict hangs on and a report lists element by element.
void expect_equal(const CaseJudgement& some, const CaseJudgement& all, const std::string& what) {
  EXPECT_EQ(some.status, all.status) << what << ": " << some.reason << "; " << all.reason;
  EXPECT_TRUE(all.status == Status::untested || some.reason == all.reason) << what << ": " << some.reason << "; " << all.reason;
  for (auto count :
       {&CaseJudgement::invocations, &CaseJudgement::failing, &CaseJudgement::rearranged, &CaseJudgement::beyond, &CaseJudgement::expanded})
    EXPECT_EQ(some.*count, all.*count) << what;
  EXPECT_EQ(some.rearranged_distance, all.rearranged_distance) << what;
  EXPECT_EQ(some.undecided, 0) << what;
  ASSERT_EQ(some.outputs.size(), all.outputs.size()) << what;
  for (std::size_t o = 0; o < all.outputs.size(); ++o) {
    const OutputJudgement &a = some.outputs[o], &b = all.outputs[o];
    EXPECT_EQ(a.map, b.map) << what;
    for (auto count : {&OutputJudgement::elements, &OutputJudgement::failing, &OutputJudgement::differing, &OutputJudgement::atypical,
                       &OutputJudgement::beyond, &OutputJudgement::rearranged, &OutputJudgement::free})
      EXPECT_EQ(a.*count, b.*count) << what << ' ' << a.name;
    ASSERT_EQ(a.worst.size(), b.worst.size()) << what;
    for (std::size_t k = 0; k < b.worst.size(); ++k) {
      const auto fields = [](const Failure& f) { return std::tie(f.x, f.y, f.channel, f.got, f.low, f.high, f.expected, f.distance); };
      EXPECT_EQ(fields(a.worst[k]), fields(b.worst[k])) << what;
    }
    ASSERT_EQ(a.quantities.size(), b.quantities.size());
    for (std::size_t k = 0; k < b.quantities.size(); ++k) {
      EXPECT_EQ(a.quantities[k].elements, b.quantities[k].elements) << what;
      EXPECT_EQ(a.quantities[k].failing, b.quantities[k].failing) << what;
      EXPECT_EQ(a.quantities[k].farthest, b.quantities[k].farthest) << what;
    }
  }
}

/// What the reference gives, or where `device` is given that, by the reference's own rounding or toward zero; with `moved` one invocation
/// in 16 is moved by some codes.
std::vector<Array> port_of(const BoundCase& b, HalfMode stores, bool moved, const perturbed::Behaviour* device) {
  std::vector<Array> port = stores == HalfMode::either ? b.expected() : reference_outputs(*b.c, *b.model, test_executor(), stores);
  if (device && !b.model->rounds_inside()) {
    const perturbed::Scope scope(*device);
    std::vector<perturbed::Perturbed> values(b.slots.size());
    for (int y = 0; y < b.model->height(); ++y)
      for (int x = 0; x < b.model->width(); ++x) {
        perturbed::behaviour().begin_invocation();
        b.model->evaluate(x, y, values.data());
        for (std::size_t v = 0; v < values.size(); ++v)
          store_value(b.slots[v], values[v].v, rounding_of(b.slots[v], stores),
                      port[static_cast<std::size_t>(b.slots[v].output)].levels[0].edit().data() + b.slots[v].offset(x, y));
      }
  }
  test::Words words(50);
  for (int y = 0; moved && y < b.model->height(); ++y)
    for (int x = 0; x < b.model->width(); ++x) {
      if (words() % 16 != 0) continue;
      const Slot& s = b.slots[words() % b.slots.size()];
      std::byte* at = port[static_cast<std::size_t>(s.output)].levels[0].edit().data() + s.offset(x, y);
      const int far = 1 << words() % 12;
      if (s.kind == FormatInfo::unorm8)
        change_at<std::uint8_t>(at, [&](std::uint8_t v) { return static_cast<std::uint8_t>(v + far); });
      else if (s.kind == FormatInfo::float16)
        change_at<std::uint16_t>(at, [&](std::uint16_t v) { return static_cast<std::uint16_t>(v + far); });
      else
        change_at<std::uint32_t>(at, [&](std::uint32_t v) { return v + static_cast<std::uint32_t>(far); });
    }
  return port;
}

// A port that a known device made is known as that device's.
TEST_P(ShortCut, AKnownDeviceIsFound) {
  const std::vector<HalfMode> modes{HalfMode::rne};
  for (const BoundPass& pass : passes()) {
    for (const BoundCase& b : pass.cases) {
      if (b.model->rounds_inside() || b.slots.empty()) continue;
      const perturbed::Behaviour device = known_devices().front();
      const std::vector<Array> port = port_of(b, HalfMode::either, false, &device);
      KnownDevice found(*b.model, port, b.slots, modes);
      found.prepare(Sample(*b.c, *b.model, 0), known_devices(), [](int, int) { return true; });
      ASSERT_TRUE(found.device()) << pass.name();
      EXPECT_EQ(found.device()->filter, device.filter) << pass.name();
    }
  }
}

TEST_P(ShortCut, ChangesNoElementsVerdict) {
  // By default the profiles take turns.
  std::vector<std::string> profiles = profile_names();
  const bool takes_all = std::getenv("RAINREF_ALL_PACKS") != nullptr;
  if (!takes_all) std::erase(profiles, "ieee");
  std::size_t turn = GetParam().name.size();
  std::int64_t judged = 0, sampled = 0;
  struct Made {
    HalfMode stores;
    bool moved, by_device;
  };
  const perturbed::Behaviour device = known_devices().front();
  for (const BoundPass& pass : passes()) {
    for (const BoundCase& b : pass.cases) {
      const bool has_halves = std::any_of(b.slots.begin(), b.slots.end(), [](const Slot& s) { return s.kind == FormatInfo::float16; });
      for (const auto& [stores, moved, by_device] : {Made{HalfMode::either, false, false}, Made{HalfMode::either, true, false},
                                                     Made{HalfMode::rtz, true, false}, Made{HalfMode::rtz, true, true}}) {
        if (stores == HalfMode::rtz && !has_halves) continue;
        const std::vector<Array> port = port_of(b, stores, moved, by_device ? &device : nullptr);
        ++turn;
        for (std::size_t k = 0; k < profiles.size(); ++k) {
          if (!takes_all && k != turn % profiles.size()) continue;
          const std::string& name = profiles[k];
          const std::string what = pass.name() + ' ' + b.c->folder() + ' ' + name + (moved ? " moved" : "") +
                                   (by_device ? " by a device" : "") + ' ' + judge::name(stores);
          JudgeOptions options{&profile(name), name == "ieee" ? nullptr : &profile("typical"), &test_executor(), std::nullopt};
          const ModeJudgements all = judge_case(*b.c, b.model.get(), port, options);
          // A few hundred leave a margin that tells.
          const std::int64_t texels = static_cast<std::int64_t>(b.model->width()) * b.model->height();
          options.sample = std::max({std::int64_t{1}, std::min<std::int64_t>(120, texels / 2), texels / 5});
          options.every_rounding = true;
          const ModeJudgements every = all.modes.size() > 1 ? judge_case(*b.c, b.model.get(), port, options) : all;
          ASSERT_EQ(every.modes, all.modes);
          for (std::size_t m = 0; m < all.modes.size(); ++m)
            expect_equal(every.judgements[m], all.judgements[m], what + " every " + judge::name(all.modes[m]));
          options.every_rounding = false;
          const ModeJudgements some = judge_case(*b.c, b.model.get(), port, options);
          bool is_any_whole = false;
          for (std::size_t m = 0; m < all.modes.size(); ++m) {
            const CaseJudgement &a = some.judgements[m], &e = all.judgements[m];
            EXPECT_LE(a.failing, e.failing) << what;
            EXPECT_GE(a.failing + a.undecided, e.failing) << what;
            is_any_whole |= a.undecided == 0;
            if (a.undecided == 0) expect_equal(a, e, what + " some " + judge::name(all.modes[m]));
          }
          EXPECT_TRUE(is_any_whole) << what;
          ++judged;
          sampled += some.judgements[0].stride > 1;
        }
      }
    }
  }
  EXPECT_TRUE(judged == 0 || sampled > 0) << "no run of the pack is judged by a sample";
}

// ---- whole ports ---------------------------------------------------------------------------------------------------
TEST(SampledVerdict, APortHasTheVerdictThatAllEnvelopesGive) {
  for (const HalfMode stores : {HalfMode::either, HalfMode::rtz}) {
    for (const char* only : {"", "normals"}) {
      MiniPort port("windshield-corrected");
      port.stores = stores;
      port.stores_only = only;
      for (const std::string profile : {"vulkan", "d3d"}) {
        ValidateOptions options;
        options.profile = profile;
        options.sample = 0;
        const PortJudgement all = judged(port, options);
        options.sample = 300;
        const PortJudgement some = judged(port, options);
        EXPECT_EQ(some.status, all.status) << why(some) << '\n' << why(all);
        ASSERT_EQ(some.passes.size(), all.passes.size());
        for (std::size_t p = 0; p < all.passes.size(); ++p) {
          EXPECT_EQ(some.passes[p].status, all.passes[p].status) << all.passes[p].pass;
          EXPECT_EQ(some.passes[p].reason, all.passes[p].reason) << all.passes[p].pass;
          EXPECT_EQ(some.passes[p].half_mode, all.passes[p].half_mode) << all.passes[p].pass;
          for (std::size_t m = 0; m < 3; ++m) {
            EXPECT_LE(some.passes[p].half_votes[m], all.passes[p].half_votes[m]) << all.passes[p].pass;
            EXPECT_TRUE(some.passes[p].half_is_least[m] || some.passes[p].half_votes[m] == all.passes[p].half_votes[m])
                << all.passes[p].pass;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace rainref::judge
