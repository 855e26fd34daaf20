// Mistakes at one place of a pass text.
#include "faults/place_faults.h"
#include "faults/text.h"

namespace rainref::faults {
namespace {

using perturbed::Op;
using perturbed::PlaceFault;
using Node = perturbed::Trace::Node;

/// The image of a lookup's coordinate: the next texel fetched.
std::string image_of(const Probe& p, std::size_t node) {
  for (std::size_t n = node; n < p.trace.nodes.size(); ++n) {
    if (p.trace.nodes[n].op != Op::fetch && p.trace.nodes[n].op != Op::load) continue;
    return first_name(p.names[n]);
  }
  return "a texture";
}

/// True if a square is a term of a sum of squares, which is hardly ever forgotten.
bool is_of_length(const Probe& p, std::size_t square) {
  const auto op = [&](std::int32_t i) { return i < 0 ? Op::constant : p.trace.nodes[static_cast<std::size_t>(i)].op; };
  constexpr std::size_t near = 12;
  const std::size_t end = std::min(p.trace.nodes.size(), square + near);
  for (std::size_t n = square + 1; n < end; ++n) {
    const Node& sum = p.trace.nodes[n];
    for (const std::size_t k : {0u, 1u})
      if (sum.op == Op::sum && sum.of[k] == static_cast<std::int32_t>(square))
        return op(sum.of[1 - k]) == Op::square || op(sum.of[1 - k]) == Op::sum;
  }
  return false;
}

/// One mistake in an operation. `of`: the names in its text: '*' the operation, 'a' and 'b' its operands, 'i' the image.
struct Row {
  Op op;
  PlaceFault fault;
  Kind kind;
  const char* of;
};
constexpr Row mistakes_of_operations[] = {
    {Op::sum, PlaceFault::first, Kind::term_left_out, "*b"},
    {Op::sum, PlaceFault::second, Kind::term_left_out, "*a"},
    {Op::sum, PlaceFault::second_negated, Kind::term_of_other_sign, "*b"},
    {Op::sum, PlaceFault::swapped, Kind::term_of_other_sign, "*a"},
    {Op::sum, PlaceFault::larger, Kind::max_for_sum, "*ab"},
    {Op::sum, PlaceFault::smaller, Kind::min_for_sum, "*ab"},
    {Op::sum, PlaceFault::first_twice, Kind::term_twice, "*a"},
    {Op::sum, PlaceFault::second_twice, Kind::term_twice, "*b"},
    {Op::sum, PlaceFault::rooted, Kind::root_for_square, "*"},
    {Op::difference, PlaceFault::first, Kind::term_left_out, "*b"},
    {Op::difference, PlaceFault::second, Kind::term_left_out, "*a"},
    {Op::difference, PlaceFault::second_negated, Kind::term_of_other_sign, "*b"},
    {Op::difference, PlaceFault::swapped, Kind::difference_the_other_way, "*"},
    {Op::difference, PlaceFault::first_twice, Kind::term_twice, "*a"},
    {Op::difference, PlaceFault::second_twice, Kind::term_twice, "*b"},
    {Op::difference, PlaceFault::other, Kind::complement_left_out, "*b"},
    {Op::difference, PlaceFault::rooted, Kind::root_for_square, "*"},
    {Op::product, PlaceFault::first, Kind::not_squared, "a"},
    {Op::product, PlaceFault::first, Kind::factor_left_out, "*b"},
    {Op::product, PlaceFault::second, Kind::factor_left_out, "*a"},
    {Op::product, PlaceFault::first_squared, Kind::factor_twice, "*a"},
    {Op::product, PlaceFault::second_squared, Kind::factor_twice, "*b"},
    {Op::product, PlaceFault::inverted, Kind::divided_for_multiplied, "*b"},
    {Op::product, PlaceFault::squared, Kind::squared, "*"},
    {Op::product, PlaceFault::negated, Kind::product_of_other_sign, "*"},
    {Op::product, PlaceFault::doubled, Kind::twice_as_large, "*"},
    {Op::product, PlaceFault::halved, Kind::half_as_large, "*"},
    {Op::quotient, PlaceFault::first, Kind::division_left_out, "ab"},
    {Op::quotient, PlaceFault::swapped, Kind::quotient_upside_down, "*"},
    {Op::quotient, PlaceFault::inverted, Kind::multiplied_for_divided, "*ab"},
    {Op::negation, PlaceFault::first, Kind::of_other_sign, "a"},
    {Op::minimum, PlaceFault::first, Kind::min_left_out, "*a"},
    {Op::minimum, PlaceFault::second, Kind::min_left_out, "*b"},
    {Op::minimum, PlaceFault::other, Kind::max_for_min, "*"},
    {Op::minimum, PlaceFault::added, Kind::sum_for_min, "*ab"},
    {Op::maximum, PlaceFault::first, Kind::max_left_out, "*a"},
    {Op::maximum, PlaceFault::second, Kind::max_left_out, "*b"},
    {Op::maximum, PlaceFault::other, Kind::min_for_max, "*"},
    {Op::maximum, PlaceFault::added, Kind::sum_for_max, "*ab"},
    {Op::maximum, PlaceFault::saturated, Kind::held_sum_for_max, "*ab"},
    {Op::magnitude, PlaceFault::first, Kind::abs_left_out, "a"},
    {Op::root, PlaceFault::first, Kind::root_left_out, "*"},
    {Op::root, PlaceFault::doubled, Kind::length_twice_as_large, "*"},
    {Op::root, PlaceFault::halved, Kind::length_half_as_large, "*"},
    {Op::square, PlaceFault::first, Kind::not_squared, "a"},
    {Op::square, PlaceFault::other, Kind::cube_for_square, "a"},
    {Op::square, PlaceFault::squared, Kind::squared_twice, "a"},
    {Op::floor, PlaceFault::first, Kind::floor_left_out, "a"},
    {Op::floor, PlaceFault::other, Kind::rounding_for_floor, "a"},
    {Op::fract, PlaceFault::first, Kind::fract_left_out, "a"},
    {Op::exponential, PlaceFault::other, Kind::exp2_for_exp, "*"},
    {Op::exponential, PlaceFault::first, Kind::exponential_left_out, "*a"},
    {Op::exponential, PlaceFault::linear, Kind::linear_for_exponential, "*a"},
    {Op::exponential2, PlaceFault::other, Kind::exp_for_exp2, "*"},
    {Op::exponential2, PlaceFault::first, Kind::exponential_left_out, "*a"},
    {Op::exponential2, PlaceFault::linear, Kind::linear_for_exponential, "*a"},
    {Op::power, PlaceFault::first, Kind::power_left_out, "*a"},
    {Op::power, PlaceFault::inverted, Kind::exponent_inverted, "*"},
    {Op::sine, PlaceFault::other, Kind::cosine_for_sine, "*"},
    {Op::sine, PlaceFault::negated, Kind::of_other_sign, "*"},
    {Op::cosine, PlaceFault::other, Kind::sine_for_cosine, "*"},
    {Op::cosine, PlaceFault::negated, Kind::of_other_sign, "*"},
    {Op::angle, PlaceFault::swapped, Kind::arguments_of_atan2_swapped, "*"},
    {Op::mix, PlaceFault::swapped, Kind::ends_of_mix_swapped, "*"},
    {Op::mix, PlaceFault::first, Kind::mix_left_out, "*a"},
    {Op::mix, PlaceFault::second, Kind::mix_left_out, "*b"},
    {Op::mix, PlaceFault::premultiplied, Kind::added_whole, "*b"},
    {Op::mix, PlaceFault::added, Kind::added_for_mixed, "*"},
    {Op::mix, PlaceFault::in_gamma, Kind::blended_in_gamma, "*"},
    {Op::smoothstep, PlaceFault::swapped, Kind::edges_of_smoothstep_swapped, "*"},
    {Op::smoothstep, PlaceFault::other, Kind::linear_for_smoothstep, "*"},
    {Op::choice, PlaceFault::first, Kind::choice_left_out, "*ab"},
    {Op::choice, PlaceFault::second, Kind::first_choice_left_out, "*ba"},
    {Op::choice, PlaceFault::swapped, Kind::select_the_other_way, "*"},
    {Op::comparison, PlaceFault::swapped, Kind::condition_the_other_way, "ab"},
    {Op::comparison, PlaceFault::always, Kind::condition_left_out, "ab"},
    {Op::comparison, PlaceFault::never, Kind::condition_never_holds, "ab"},
    {Op::coordinate, PlaceFault::nearest, Kind::nearest_for_linear, "i"},
    {Op::coordinate, PlaceFault::half_less, Kind::half_a_texel_low, "i"},
    {Op::coordinate, PlaceFault::half_more, Kind::half_a_texel_high, "i"},
    {Op::coordinate, PlaceFault::one_less, Kind::one_texel_low, "i"},
    {Op::coordinate, PlaceFault::one_more, Kind::one_texel_high, "i"},
    {Op::level, PlaceFault::one_more, Kind::lookup_level_above, "i"},
    {Op::level, PlaceFault::one_less, Kind::lookup_level_below, "i"},
    {Op::level, PlaceFault::zero, Kind::lookup_level_0, "i"},
    {Op::argument, PlaceFault::negated, Kind::argument_of_other_sign, "*"},
    {Op::bent, PlaceFault::second, Kind::refraction_left_out, "b"},
    {Op::lookup, PlaceFault::zero, Kind::lookup_left_out, "*a"},
};

}  // namespace

std::vector<Mistake> mistakes_at(const Probe& p, std::size_t at) {
  const Node& n = p.trace.nodes[at];
  const std::string all = shortened(p, static_cast<std::int32_t>(at)), a = shortened(p, n.of[0]), b = shortened(p, n.of[1]);
  const bool is_of_itself = n.op == Op::product && a == b && a != "...";
  // If a minimum or maximum is left out, the clamped value remains rather than the limit.
  const auto is_limit = [&](PlaceFault kept) {
    const std::int32_t of = n.of[kept == PlaceFault::first ? 0 : 1];
    return of >= 0 && p.trace.nodes[static_cast<std::size_t>(of)].op == Op::constant;
  };
  const auto kind_of = [&](const Row& row) {
    if (row.kind == Kind::difference_the_other_way && has_fraction(all)) return Kind::fraction_the_other_way;
    if (row.kind == Kind::complement_left_out && a == "1") return Kind::complement_of_1_left_out;
    if (row.kind == Kind::min_left_out && is_limit(row.fault)) return Kind::limit_of_min_alone;
    if (row.kind == Kind::max_left_out && is_limit(row.fault)) return Kind::limit_of_max_alone;
    if (n.op == Op::square && row.kind == Kind::not_squared && is_of_length(p, at)) return Kind::not_squared_in_length;
    return row.kind;
  };
  // A product of two values has factors; that of a number and itself is a square.
  const auto applies = [&](const Row& row) {
    if (row.op != n.op) return false;
    if (n.op != Op::product) return true;
    if (row.kind == Kind::not_squared) return is_of_itself;
    const bool is_of_factors =
        row.kind == Kind::factor_left_out || row.kind == Kind::factor_twice || row.kind == Kind::divided_for_multiplied;
    return !(is_of_itself && is_of_factors);
  };
  std::vector<Mistake> out;
  for (const Row& row : mistakes_of_operations) {
    if (!applies(row)) continue;
    Mistake& m = out.emplace_back(Mistake{row.fault, {kind_of(row)}});
    for (const char* part = row.of; *part; ++part)
      m.what.of.push_back(*part == '*' ? all : *part == 'a' ? a : *part == 'b' ? b : image_of(p, at));
  }
  return out;
}

}  // namespace rainref::faults
