#include "math/places.h"

#include <algorithm>

#include "math/formula.h"
#include "math/half.h"
#include "math/perturbed.h"
#include "math/rewrites.h"

namespace rainref::perturbed {
namespace {

constinit thread_local int unseen = 0;
constinit thread_local Rewrites rewrites;

/// A running hash: both halves of a product, as in wyhash (Wang Yi). One multiplication, because each operation makes three of them.
constexpr std::uint32_t hashed(std::uint32_t h, std::uint32_t x) {
  const std::uint64_t product = static_cast<std::uint64_t>(h ^ 0x53c5ca59u) * (x ^ 0x74743c1bu);
  return static_cast<std::uint32_t>(product) ^ static_cast<std::uint32_t>(product >> 32);
}
/// Initial hash of each operation.
constexpr auto beginnings = [] {
  std::array<std::uint32_t, static_cast<std::size_t>(Op::stored) + 1> all{};
  for (std::uint32_t op = 0; op < all.size(); ++op) all[op] = hashed(0, op + 1);
  return all;
}();

}  // namespace

Perturbed again(Op op, const Perturbed& r, const std::array<Perturbed, 4>& of) {
  const auto& [a, b, c, d] = of;
  switch (op) {
    case Op::sum:
      return a + b;
    case Op::difference:
      return a - b;
    case Op::negation:
      return -a;
    case Op::product:
      return a * b;
    case Op::quotient:
      return a / b;
    case Op::minimum:
      return min(a, b);
    case Op::maximum:
      return max(a, b);
    case Op::magnitude:
      return abs(a);
    case Op::root:
      return sqrt(a);
    case Op::square:
      return square(a);
    case Op::floor:
      return floor(a);
    case Op::fract:
      return fract(a);
    case Op::exponential:
      return exp(a);
    case Op::exponential2:
      return exp2(a);
    case Op::logarithm:
      return log(a);
    case Op::power:
      return pow(a, b);
    case Op::sine:
      return sin(a);
    case Op::cosine:
      return cos(a);
    case Op::angle:
      return atan2(a, b);
    case Op::mix:
      return mix(a, b, c);
    case Op::smoothstep:
      return scalar::smoothstep<Perturbed>(b.v, c.v, a);
    case Op::choice:
      return c.v != 0 ? a : b;
    case Op::coordinate:
    case Op::level:
    case Op::argument:
    case Op::bent:
    case Op::stored:
      return a;
    case Op::comparison:
      return a.v < b.v ? Perturbed::of(1.0f) : b.v < a.v ? Perturbed::of(0.0f) : r;
    default:
      return r;
  }
}
namespace {

/// The original operands of a node.
std::array<Perturbed, 4> operands_of(const Trace::Node& n) {
  std::array<Perturbed, 4> out;
  std::transform(n.with.begin(), n.with.end(), out.begin(), [](float v) { return Perturbed::of(v); });
  return out;
}
/// The inner operation after the outer one; one or both may be two operations in sequence.
Perturbed commuted(const Rewrite& rewriting, Op op, const Perturbed& r, std::array<Perturbed, 4> of, const Trace::Node& operand,
                   const Trace& trace) {
  const auto k = static_cast<std::size_t>(rewriting.operand), j = static_cast<std::size_t>(rewriting.path[0]);
  const auto below = [&](const Trace::Node& n, std::size_t at) {
    return n.of[at] < 0 ? nullptr : &trace.nodes[static_cast<std::size_t>(n.of[at])];
  };
  if (rewriting.kind == RewriteKind::commuted) {
    std::array<Perturbed, 4> inner = operands_of(operand);
    of[k] = inner[j];
    inner[j] = again(op, r, of);
    return again(operand.op, r, inner);
  }
  const Trace::Node* const lower = below(operand, 0);
  if (!lower) return r;
  std::array<Perturbed, 4> middle = operands_of(operand), inner = operands_of(*lower);
  if (rewriting.kind == RewriteKind::commuted_outer_2) {
    middle[0] = inner[j];
    of[k] = again(operand.op, r, middle);
    inner[j] = again(op, r, of);
    return again(lower->op, r, inner);
  }
  of[k] = inner[j];
  inner[j] = again(op, r, of);
  middle[0] = again(lower->op, r, inner);
  return again(operand.op, r, middle);
}
/// The result of a rewrite of an operation, whose operands are these nodes of the trace.
Perturbed rewritten(const Rewrite& rewriting, Op op, const Perturbed& r, std::array<Perturbed, 4> of,
                    const std::array<std::int32_t, 4>& nodes, const Trace& trace) {
  const Unseen parts;
  const auto k = static_cast<std::size_t>(rewriting.operand);
  if (rewriting.kind == RewriteKind::formula) return by_formula(*rewriting.formula, r, of, nodes, trace, trace.nodes.size());
  if (nodes[k] < 0) return r;
  const Trace::Node& operand = trace.nodes[static_cast<std::size_t>(nodes[k])];
  const auto value = [&](std::int32_t node) { return Perturbed::of(trace.nodes[static_cast<std::size_t>(node)].value); };
  const auto child = [](const Trace::Node& n, int i) { return i < 0 ? -1 : n.of[static_cast<std::size_t>(i)]; };
  switch (rewriting.kind) {
    case RewriteKind::none:
    case RewriteKind::formula:
      return r;
    case RewriteKind::part: {
      std::int32_t part = child(operand, rewriting.path[0]);
      if (part >= 0 && rewriting.path[1] >= 0) part = child(trace.nodes[static_cast<std::size_t>(part)], rewriting.path[1]);
      if (part < 0) return r;
      of[k] = value(part);
      return again(op, r, of);
    }
    case RewriteKind::over_all: {
      const std::int32_t factor = child(operand, rewriting.path[0]), other = child(operand, 1 - rewriting.path[0]);
      if (operand.op != Op::product || factor < 0 || other < 0) return r;
      of[k] = value(other);
      return again(op, r, of) * value(factor);
    }
    case RewriteKind::over_first:
    case RewriteKind::over_second: {
      const std::int32_t first = child(operand, 0), second = child(operand, 1);
      if ((operand.op != Op::sum && operand.op != Op::difference) || first < 0 || second < 0) return r;
      const Perturbed factor = of[1 - k], a = value(first), b = value(second);
      const bool is_first = rewriting.kind == RewriteKind::over_first;
      const Perturbed scaled = again(op, r, {is_first ? a : b, factor, a, a});
      return again(operand.op, r, {is_first ? scaled : a, is_first ? b : scaled, a, a});
    }
    case RewriteKind::function_of_all: {
      const std::int32_t inner = child(operand, 0);
      if (inner < 0) return r;
      of[k] = value(inner);
      const Perturbed whole = again(op, r, of);
      return again(operand.op, r, {whole, whole, whole, whole});
    }
    case RewriteKind::function_of_first:
    case RewriteKind::function_of_second: {
      const std::int32_t first = child(operand, 0), second = child(operand, 1);
      if ((operand.op != Op::sum && operand.op != Op::difference) || first < 0 || second < 0) return r;
      std::array<Perturbed, 4> terms{value(first), value(second), r, r};
      Perturbed& term = terms[rewriting.kind == RewriteKind::function_of_first ? 0 : 1];
      of[k] = term;
      term = again(op, r, of);
      return again(operand.op, r, terms);
    }
    case RewriteKind::commuted:
    case RewriteKind::commuted_outer_2:
    case RewriteKind::commuted_inner_2:
      return commuted(rewriting, op, r, of, operand, trace);
    case RewriteKind::first_wins: {
      // The choices before this one, along the side that keeps; the first that held is kept.
      const Trace::Node* kept = &operand;
      for (int round = 0; round < 64 && kept->op == Op::choice; ++round) {
        if (kept->with[2] != 0) return value(nodes[k]);
        const std::int32_t next = child(*kept, static_cast<int>(k));
        if (next < 0) break;
        kept = &trace.nodes[static_cast<std::size_t>(next)];
      }
      return r;
    }
  }
  return r;
}

}  // namespace

float changed(float v, Change change) {
  switch (change) {
    case Change::none:
      return v;
    case Change::negated:
      return -v;
    case Change::from_one:
      return 1 - v;
    case Change::magnitude:
      return v < 0 ? -v : v;
    case Change::squared:
      return v * v;
    case Change::rooted:
      return v > 0 ? __builtin_sqrtf(v) : v;
    case Change::inverted:
      return v != 0 ? 1 / v : v;
    case Change::doubled:
      return 2 * v;
    case Change::halved:
      return v / 2;
    case Change::floored:
      return __builtin_floorf(v);
    case Change::rounded:
      return __builtin_floorf(v + 0.5f);
    case Change::truncated:
      return __builtin_truncf(v);
    case Change::fraction:
      return v - __builtin_floorf(v);
    case Change::saturated:
      return v > 0 ? v < 1 ? v : 1 : 0;
    case Change::as_half:
      return to_float(to_half(v));
    case Change::cubed:
      return v * v * v;
    case Change::smoothed:
      return v * v * (3 - 2 * v);
  }
  return v;
}
float put(float right, float value, Put how) {
  switch (how) {
    case Put::instead:
      return value;
    case Put::times:
      return right * value;
    case Put::plus:
      return right + value;
  }
  return right;
}

void Substitutions::start() {
  seen.assign(all.size(), 0);
  met.resize(all.size());
  for (std::vector<float>& values : met) values.clear();  // their capacity is kept, because this is done for each invocation
}
void Substitutions::meet(std::uint32_t shape, float value) {
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (is_looking && all[k].ahead >= 0 && all[k].source == shape) right[k].push_back(value);
    if (all[k].back > 0 && all[k].source == shape) met[k].push_back(value);
  }
}
float Substitutions::value_for(std::size_t k, float meant) const {
  const Substitution& s = all[k];
  const auto back = static_cast<std::size_t>(s.back);
  if (back > met[k].size()) return meant;
  if (s.ahead >= 0 && (k >= right.size() || static_cast<std::size_t>(s.ahead) >= right[k].size())) return meant;
  const float other = s.ahead >= 0 ? right[k][static_cast<std::size_t>(s.ahead)] : back == 0 ? s.number : met[k][met[k].size() - back];
  return changed(put(meant, changed(other, s.change), s.how), s.last);
}

RewriteScope::RewriteScope(const Rewrites& r) : saved_(rewrites) { rewrites = r; }
RewriteScope::~RewriteScope() { rewrites = saved_; }

void Behaviour::begin_invocation() {
  for (Place& place : places) place.seen = 0;
  recent = 0;
  if (!trace || rewrites[0].kind == RewriteKind::none) return;
  trace->clear();
}

Unseen::Unseen() { ++unseen; }
Unseen::~Unseen() { --unseen; }

/// Leaves are also recorded in the parts of named operations, whose edges and texels have names.
void Perturbed::leaf(Op op, std::uint32_t shape) {
  shape_.fill(hashed(static_cast<std::uint32_t>(op) + 1, shape));
  Behaviour& b = behaviour();
  if (b.substitutions) b.substitutions->meet(shape_[0], v);
  if (b.trace && b.trace->nodes.empty()) b.recent = 0;
  b.recent = b.recent << 6 | (static_cast<std::uint64_t>(op) + 1);
  if (!b.trace) return;
  node_ = static_cast<std::int32_t>(b.trace->nodes.size());
  b.trace->add(op, v, shape_[0]);
}

namespace {

/// Makes the substitutions at an operation with result r, each after the previous ones: first in operands, then in the result. `with`
/// becomes the operands.
void substitute(Substitutions& all, Op op, Perturbed& r, std::initializer_list<const Perturbed*> of, std::uint32_t shape,
                std::array<float, 4>& with) {
  if (std::none_of(all.all.begin(), all.all.end(), [&](const Substitution& s) { return s.shape == shape; })) return;
  std::array<Perturbed, 4> operands;
  std::transform(of.begin(), of.end(), operands.begin(), [](const Perturbed* operand) { return *operand; });
  for (std::size_t s = 0; s < all.all.size(); ++s) {
    const Substitution& other = all.all[s];
    if (other.shape != shape) continue;
    const std::int32_t occurrence = all.seen[s]++;
    if (other.occurrence >= 0 && other.occurrence != occurrence) continue;
    const Unseen parts;
    if (other.operand == Substitution::result) {
      r = Perturbed::of(all.value_for(s, r.v));
      continue;
    }
    Perturbed& operand = operands[static_cast<std::size_t>(other.operand)];
    operand = Perturbed::of(all.value_for(s, operand.v));
    with[static_cast<std::size_t>(other.operand)] = operand.v;
    r = again(op, r, operands);
  }
}

}  // namespace

void Perturbed::follow(Op op, Perturbed& r, std::initializer_list<const Perturbed*> of) {
  if (unseen > 0) return;
  Behaviour& b = behaviour();
  if (b.trace && b.trace->nodes.empty()) b.recent = 0;
  b.recent = b.recent << 6 | (static_cast<std::uint64_t>(op) + 1);
  // Hashes of this operation and one, two and three below it, in registers: this is the innermost part of a search for causes.
  const std::uint32_t alone = beginnings[static_cast<std::size_t>(op)];
  std::uint32_t one = alone, two = alone, shape = alone;
  for (const Perturbed* operand : of) {
    one = hashed(one, operand->shape_[0]);
    two = hashed(two, operand->shape_[1]);
    shape = hashed(shape, operand->shape_[2]);
  }
  // By Place::depth; the last one covers the previous operations, if they are observed.
  std::array<std::uint32_t, 5> depth{alone, one, two, shape, 0};
  if (b.trace || b.places[0].depth == by_sequence)
    depth[by_sequence] = hashed(static_cast<std::uint32_t>(b.recent), static_cast<std::uint32_t>(b.recent >> 32));
  for (Place& place : b.places) {
    if (place.fault == PlaceFault::none) break;
    if (place.shape != depth[static_cast<std::size_t>(place.depth)]) continue;
    const std::int32_t occurrence = place.seen++;
    if (place.occurrence < 0 || place.occurrence == occurrence) r = with_fault(op, r, of, place.fault);
  }
  if (!b.trace && !b.substitutions) {
    std::copy_n(depth.begin(), r.shape_.size(), r.shape_.begin());
    return;
  }
  std::array<float, 4> with{};
  std::transform(of.begin(), of.end(), with.begin(), [](const Perturbed* operand) { return operand->v; });
  if (b.substitutions && !b.substitutions->is_looking) substitute(*b.substitutions, op, r, of, shape, with);
  for (const Rewrite& rewriting : rewrites) {
    if (!b.trace || rewriting.kind == RewriteKind::none) break;
    const bool is_wild = rewriting.kind == RewriteKind::first_wins;  // it applies to every choice, whatever its shape
    if (is_wild ? op != Op::choice : rewriting.shape != depth[static_cast<std::size_t>(rewriting.depth)]) continue;
    const std::int32_t occurrence = b.trace->met.at(shape);
    if (!is_wild && rewriting.occurrence >= 0 &&
        rewriting.occurrence != (rewriting.period > 0 ? occurrence % rewriting.period : occurrence))
      continue;
    std::array<Perturbed, 4> operands;
    std::array<std::int32_t, 4> nodes{-1, -1, -1, -1};
    std::transform(of.begin(), of.end(), operands.begin(), [](const Perturbed* operand) { return *operand; });
    std::transform(of.begin(), of.end(), nodes.begin(), [](const Perturbed* operand) { return operand->node_; });
    r = rewritten(rewriting, op, r, operands, nodes, *b.trace);
  }
  std::copy_n(depth.begin(), r.shape_.size(), r.shape_.begin());
  if (b.substitutions) b.substitutions->meet(shape, r.v);
  if (!b.trace) return;
  r.node_ = static_cast<std::int32_t>(b.trace->nodes.size());
  Trace::Node& node = b.trace->add(op, r.v, shape);
  std::transform(of.begin(), of.end(), node.of.begin(), [](const Perturbed* operand) { return operand->node_; });
  node.with = with;
  node.shallow = {depth[1], depth[2]};
  node.sequence = depth[by_sequence];
}
bool Perturbed::follow(bool result, const Perturbed& a, const Perturbed& b) {
  Perturbed r = of(result ? 1.0f : 0.0f);
  follow(Op::comparison, r, {&a, &b});
  return r.v != 0;
}

Perturbed Perturbed::with_fault(Op op, const Perturbed& r, std::initializer_list<const Perturbed*> operands, PlaceFault fault) {
  const Unseen parts;
  const Perturbed zero = of(0.0f), one = of(1.0f), half = of(0.5f);
  const auto operand = [&](std::size_t k) { return *operands.begin()[operands.size() > k ? k : 0]; };
  const Perturbed a = operand(0), b = operand(1), c = operand(2);
  const bool minus = op == Op::difference;
  switch (fault) {
    case PlaceFault::none:
      return r;
    case PlaceFault::first:
      return a;
    case PlaceFault::second:
      return minus ? -b : b;
    case PlaceFault::negated:
      return -r;
    case PlaceFault::second_negated:
      return minus ? a + b : a - b;
    case PlaceFault::first_twice:
      return minus ? (a + a) - b : (a + a) + b;
    case PlaceFault::second_twice:
      return minus ? a - (b + b) : a + (b + b);
    case PlaceFault::first_squared:
      return a * a * b;
    case PlaceFault::second_squared:
      return a * (b * b);
    case PlaceFault::swapped:
      return minus                  ? b - a
             : op == Op::sum        ? b - a
             : op == Op::quotient   ? b / a
             : op == Op::angle      ? atan2(b, a)
             : op == Op::mix        ? mix(b, a, c)
             : op == Op::power      ? pow(b, a)
             : op == Op::smoothstep ? one - r
             : op == Op::choice     ? (c.v != 0 ? b : a)
             : op == Op::comparison ? (a.v < b.v   ? zero
                                       : b.v < a.v ? one
                                                   : r)
                                    : r;
    case PlaceFault::inverted:
      return op == Op::quotient ? a * b : op == Op::power ? pow(a, one / b) : b.v != 0 ? a / b : zero;
    case PlaceFault::other:
      return op == Op::sine           ? cos(a)
             : op == Op::cosine       ? sin(a)
             : op == Op::minimum      ? max(a, b)
             : op == Op::maximum      ? min(a, b)
             : op == Op::exponential  ? exp2(a)
             : op == Op::exponential2 ? exp(a)
             : op == Op::floor        ? floor(a + half)
             : op == Op::smoothstep   ? scalar::saturate((a - b) / (c - b))
             : op == Op::square       ? a * a * a
             : op == Op::fract        ? a
             : op == Op::difference   ? b
                                      : r;
    case PlaceFault::doubled:
      return r + r;
    case PlaceFault::halved:
      return r * half;
    case PlaceFault::squared:
      return r * r;
    case PlaceFault::rooted:
      return r.v > 0 ? sqrt(r) : r;
    case PlaceFault::linear:
      return one + a;
    case PlaceFault::added:
      return op == Op::mix ? a + b * c : a + b;
    case PlaceFault::premultiplied:
      return a * (one - c) + b;
    case PlaceFault::in_gamma: {
      const Perturbed gamma = of(2.2f), encoding = of(1 / 2.2f);
      return pow(mix(pow(max(a, zero), encoding), pow(max(b, zero), encoding), c), gamma);
    }
    case PlaceFault::saturated:
      return scalar::saturate(op == Op::maximum ? a + b : r);
    case PlaceFault::larger:
      return max(a, b);
    case PlaceFault::smaller:
      return min(a, b);
    case PlaceFault::nearest:
      return floor(r + half);
    case PlaceFault::half_less:
      return r - half;
    case PlaceFault::half_more:
      return r + half;
    case PlaceFault::one_less:
      return r - one;
    case PlaceFault::one_more:
      return r + one;
    case PlaceFault::zero:
    case PlaceFault::never:
      return zero;
    case PlaceFault::always:
      return one;
  }
  return r;
}

}  // namespace rainref::perturbed
