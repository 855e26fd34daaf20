// What can go wrong at one place of a pass text.
#include "faults/place_faults.h"
#include "faults/text.h"

namespace rainref::faults {
namespace {

using perturbed::Op;
using perturbed::PlaceFault;
using Node = perturbed::Trace::Node;

/// The input that a lookup's coordinate leads to: the next texel fetched.
std::string image_of(const Probe& p, std::size_t node) {
  for (std::size_t n = node; n < p.trace.nodes.size(); ++n) {
    if (p.trace.nodes[n].op != Op::fetch && p.trace.nodes[n].op != Op::load) continue;
    return first_name(p.names[n]);
  }
  return "a texture";
}

/// Whether a square is a term of a sum of squares, of which hardly anybody forgets one.
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

}  // namespace

std::vector<Mistake> mistakes_at(const Probe& p, std::size_t at) {
  const Node& n = p.trace.nodes[at];
  const std::string all = shortened(p, static_cast<std::int32_t>(at)), a = shortened(p, n.of[0]), b = shortened(p, n.of[1]);
  std::vector<Mistake> out;
  const auto add = [&](PlaceFault fault, Kind kind, std::vector<std::string> of) { out.push_back({fault, {kind, std::move(of)}}); };
  switch (n.op) {
    case Op::sum:
    case Op::difference: {
      const bool is_sum = n.op == Op::sum;
      add(PlaceFault::first, Kind::term_left_out, {all, b});
      add(PlaceFault::second, Kind::term_left_out, {all, a});
      add(PlaceFault::second_negated, Kind::term_of_other_sign, {all, b});
      if (is_sum)
        add(PlaceFault::swapped, Kind::term_of_other_sign, {all, a});
      else
        add(PlaceFault::swapped, has_fraction(all) ? Kind::fraction_the_other_way : Kind::difference_the_other_way, {all});
      if (is_sum) add(PlaceFault::larger, Kind::max_for_sum, {all, a, b});
      if (is_sum) add(PlaceFault::smaller, Kind::min_for_sum, {all, a, b});
      add(PlaceFault::first_twice, Kind::term_twice, {all, a});
      add(PlaceFault::second_twice, Kind::term_twice, {all, b});
      if (!is_sum) add(PlaceFault::other, a == "1" ? Kind::complement_of_1_left_out : Kind::complement_left_out, {all, b});
      add(PlaceFault::rooted, Kind::root_for_square, {all});
      break;
    }
    case Op::product:
      if (a == b && a != "...") {
        add(PlaceFault::first, Kind::not_squared, {a});
      } else {
        add(PlaceFault::first, Kind::factor_left_out, {all, b});
        add(PlaceFault::second, Kind::factor_left_out, {all, a});
        add(PlaceFault::first_squared, Kind::factor_twice, {all, a});
        add(PlaceFault::second_squared, Kind::factor_twice, {all, b});
        add(PlaceFault::inverted, Kind::divided_for_multiplied, {all, b});
      }
      add(PlaceFault::squared, Kind::squared, {all});
      add(PlaceFault::negated, Kind::product_of_other_sign, {all});
      add(PlaceFault::doubled, Kind::twice_as_large, {all});
      add(PlaceFault::halved, Kind::half_as_large, {all});
      break;
    case Op::quotient:
      add(PlaceFault::first, Kind::division_left_out, {a, b});
      add(PlaceFault::swapped, Kind::quotient_upside_down, {all});
      add(PlaceFault::inverted, Kind::multiplied_for_divided, {all, a, b});
      break;
    case Op::negation:
      add(PlaceFault::first, Kind::of_other_sign, {a});
      break;
    case Op::minimum:
    case Op::maximum: {
      const bool is_min = n.op == Op::minimum;
      // What is held rather stands alone than what holds it.
      const auto left_out = [&](std::int32_t kept) {
        const bool is_limit = kept >= 0 && p.trace.nodes[static_cast<std::size_t>(kept)].op == Op::constant;
        return is_limit ? is_min ? Kind::limit_of_min_alone : Kind::limit_of_max_alone : is_min ? Kind::min_left_out : Kind::max_left_out;
      };
      add(PlaceFault::first, left_out(n.of[0]), {all, a});
      add(PlaceFault::second, left_out(n.of[1]), {all, b});
      add(PlaceFault::other, is_min ? Kind::max_for_min : Kind::min_for_max, {all});
      add(PlaceFault::added, is_min ? Kind::sum_for_min : Kind::sum_for_max, {all, a, b});
      if (!is_min) add(PlaceFault::saturated, Kind::held_sum_for_max, {all, a, b});
      break;
    }
    case Op::magnitude:
      add(PlaceFault::first, Kind::abs_left_out, {a});
      break;
    case Op::root:
      add(PlaceFault::first, Kind::root_left_out, {all});
      add(PlaceFault::doubled, Kind::length_twice_as_large, {all});
      add(PlaceFault::halved, Kind::length_half_as_large, {all});
      break;
    case Op::square:
      add(PlaceFault::first, is_of_length(p, at) ? Kind::not_squared_in_length : Kind::not_squared, {a});
      add(PlaceFault::other, Kind::cube_for_square, {a});
      add(PlaceFault::squared, Kind::squared_twice, {a});
      break;
    case Op::floor:
      add(PlaceFault::first, Kind::floor_left_out, {a});
      add(PlaceFault::other, Kind::rounding_for_floor, {a});
      break;
    case Op::fract:
      add(PlaceFault::first, Kind::fract_left_out, {a});
      break;
    case Op::exponential:
    case Op::exponential2:
      add(PlaceFault::other, n.op == Op::exponential ? Kind::exp2_for_exp : Kind::exp_for_exp2, {all});
      add(PlaceFault::first, Kind::exponential_left_out, {all, a});
      add(PlaceFault::linear, Kind::linear_for_exponential, {all, a});
      break;
    case Op::power:
      add(PlaceFault::first, Kind::power_left_out, {all, a});
      add(PlaceFault::inverted, Kind::exponent_inverted, {all});
      break;
    case Op::sine:
    case Op::cosine:
      add(PlaceFault::other, n.op == Op::sine ? Kind::cosine_for_sine : Kind::sine_for_cosine, {all});
      add(PlaceFault::negated, Kind::of_other_sign, {all});
      break;
    case Op::angle:
      add(PlaceFault::swapped, Kind::arguments_of_atan2_swapped, {all});
      break;
    case Op::mix:
      add(PlaceFault::swapped, Kind::ends_of_mix_swapped, {all});
      add(PlaceFault::first, Kind::mix_left_out, {all, a});
      add(PlaceFault::second, Kind::mix_left_out, {all, b});
      add(PlaceFault::premultiplied, Kind::added_whole, {all, b});
      add(PlaceFault::added, Kind::added_for_mixed, {all});
      add(PlaceFault::in_gamma, Kind::blended_in_gamma, {all});
      break;
    case Op::smoothstep:
      add(PlaceFault::swapped, Kind::edges_of_smoothstep_swapped, {all});
      add(PlaceFault::other, Kind::linear_for_smoothstep, {all});
      break;
    case Op::choice:
      add(PlaceFault::first, Kind::choice_left_out, {all, a, b});
      add(PlaceFault::second, Kind::first_choice_left_out, {all, b, a});
      add(PlaceFault::swapped, Kind::select_the_other_way, {all});
      break;
    case Op::comparison:
      add(PlaceFault::swapped, Kind::condition_the_other_way, {a, b});
      add(PlaceFault::always, Kind::condition_left_out, {a, b});
      add(PlaceFault::never, Kind::condition_never_holds, {a, b});
      break;
    case Op::coordinate: {
      const std::string image = image_of(p, at);
      add(PlaceFault::nearest, Kind::nearest_for_linear, {image});
      add(PlaceFault::half_less, Kind::half_a_texel_low, {image});
      add(PlaceFault::half_more, Kind::half_a_texel_high, {image});
      add(PlaceFault::one_less, Kind::one_texel_low, {image});
      add(PlaceFault::one_more, Kind::one_texel_high, {image});
      break;
    }
    case Op::level: {
      const std::string image = image_of(p, at);
      add(PlaceFault::one_more, Kind::lookup_level_above, {image});
      add(PlaceFault::one_less, Kind::lookup_level_below, {image});
      add(PlaceFault::zero, Kind::lookup_level_0, {image});
      break;
    }
    case Op::argument:
      add(PlaceFault::negated, Kind::argument_of_other_sign, {all});
      break;
    case Op::bent:
      add(PlaceFault::second, Kind::refraction_left_out, {b});
      break;
    case Op::lookup:
      add(PlaceFault::zero, Kind::lookup_left_out, {all, a});
      break;
    default:
      break;
  }
  return out;
}

}  // namespace rainref::faults
