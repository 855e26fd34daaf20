// Every operation of the number interface as a function of three numbers a, b, c of a type N.
#pragma once

#include <cstdint>

// X(name, domain, expression in a, b, c)
//   any     finite floats
//   small   magnitude below 2^20, any fraction: may be cut to integers
//   index   from 0 to under 16
//   moved   b is a few units in the last place from a, or its negation
#define RAINREF_OPERATIONS(X)                                                                                                \
  X(add, any, a + b)                                                                                                         \
  X(subtract, any, a - b)                                                                                                    \
  X(multiply, any, a* b)                                                                                                     \
  X(divide, any, a / b)                                                                                                      \
  X(negate, any, -a)                                                                                                         \
  X(square_of, any, square(a))                                                                                               \
  X(square_root, any, sqrt(abs(a)))                                                                                          \
  X(smaller, any, min(a, b))                                                                                                 \
  X(larger, any, max(a, b))                                                                                                  \
  X(magnitude, any, abs(a))                                                                                                  \
  X(floor_of, any, floor(a))                                                                                                 \
  X(fract_of, any, fract(a))                                                                                                 \
  X(mix_of, any, mix(a, b, c))                                                                                               \
  X(mix_within, any, mix(a, b, saturate(c)))                                                                                 \
  X(less, any, select(a < b, N(1.0f), N(2.0f)))                                                                              \
  X(less_or_equal, any, select(a <= b, N(1.0f), N(2.0f)))                                                                    \
  X(greater, any, select(a > b, N(1.0f), N(2.0f)))                                                                           \
  X(greater_or_equal, any, select(a >= b, N(1.0f), N(2.0f)))                                                                 \
  X(less_moved, moved, select(a < b, a, b))                                                                                  \
  X(greater_moved, moved, select(a >= b, a, b))                                                                              \
  X(smaller_moved, moved, min(a, b))                                                                                         \
  X(larger_moved, moved, max(a, b))                                                                                          \
  X(subtract_moved, moved, a - b)                                                                                            \
  X(mask_and, any, select((a < b) & (b < c), a, c))                                                                          \
  X(mask_or, any, select((a < b) | (b < c), a, c))                                                                           \
  X(mask_not, any, select(!(a < b), a, c))                                                                                   \
  X(mask_mixed, any, select((!((a < b) | (c >= a))) & (!(b <= c)), N(-0.0f), a))                                             \
  X(clamp_of, any, clamp(a, min(b, c), max(b, c)))                                                                           \
  X(clamp_crossed, any, clamp(a, b, c))                                                                                      \
  X(saturate_of, any, saturate(a))                                                                                           \
  X(smoothstep_rising, any, smoothstep(0.5f, 4.0f, a))                                                                       \
  X(smoothstep_falling, any, smoothstep(4.0f, 0.5f, a))                                                                      \
  X(smoothstep_narrow, any, smoothstep(0.35f, 0.2f, a))                                                                      \
  X(smoothstep_unit, small, smoothstep(0.0f, 0.15f, fract(a)))                                                               \
  X(sum_of_three, any, sum_any_order(a, b, c))                                                                               \
  X(sum_of_four, any, sum_any_order(a, b, c, a))                                                                             \
  X(minus_four, any, minus_four_times(a, b* N(0.25f)))                                                                       \
  X(minus_four_moved, moved, minus_four_times(a, b* N(0.25f)))                                                               \
  X(plane_length, any, length(a, b))                                                                                         \
  X(cut, small, to_number(to_int(a)))                                                                                        \
  X(cut_floor, small, to_number(to_int(floor(a))))                                                                           \
  X(int_plus, small, to_number(to_int(a) + 12345))                                                                           \
  X(int_sum, small, to_number(to_int(a) + to_int(b)))                                                                        \
  X(int_times, small, to_number(to_int(a) * -2047))                                                                          \
  X(int_clamped, small, to_number(clamp_index(to_int(a), N::uniform_int(37))))                                               \
  X(int_clamped_each, small, to_number(clamp_index(to_int(a), to_int(abs(b)) + 1)))                                          \
  /* Out by less than a period, as passes have it: further out only the scalar evaluations hold an index. */                 \
  X(int_wrapped, small, to_number(wrap_index(clamp_index(to_int(a) + 36, N::uniform_int(110)) + (-36), N::uniform_int(37)))) \
  X(int_larger, small, to_number(max_index(to_int(a), to_int(b))))                                                           \
  X(int_shifted, small, to_number(shift_right(to_int(a), to_int(fract(b) * N(31.9f)))))                                      \
  X(int_inside, small, select(inside(to_int(a), N::uniform_int(37)), a, N(-0.0f)))                                           \
  X(int_product, small, to_number(to_int(a) * to_int(b * N(0x1p-16f)) + to_int(c)))                                          \
  X(table_entry, index, to_number(lookup(lookup_table, to_int(a))))                                                          \
  X(fetched, index, fetch(fetch_table, to_int(a), N()))                                                                      \
  X(fetched_moved, index, fetch(fetch_table, to_int(a) + 16, N()))                                                           \
  X(exp_of, any, exp(a))                                                                                                     \
  X(exp2_of, any, exp2(a))                                                                                                   \
  X(log_of, any, log(a))                                                                                                     \
  X(pow_of, any, pow(abs(a), b))                                                                                             \
  X(pow_any, any, pow(a, b))                                                                                                 \
  X(pow_fixed, any, pow(max(a, N(0.0f)), N(0x1.d1745ep-2f)))                                                                 \
  X(sin_of, any, sin(a))                                                                                                     \
  X(cos_of, any, cos(a))                                                                                                     \
  X(atan2_of, any, atan2(a, b))                                                                                              \
  X(half_turn, any, select(is_at_most_half_turn(a, b), N(1.0f), N(2.0f)))                                                    \
  X(half_turn_axis, any, select(is_at_most_half_turn(min(abs(a), N(0.0f)) * b, c), N(1.0f), N(2.0f)))                        \
  X(half_turn_narrow, moved, select(is_at_most_half_turn(b* N(0x1p-23f), a), N(1.0f), N(2.0f)))                              \
  X(half_turn_wide, moved, select(is_at_most_half_turn(b* N(0x1p-22f), a), N(1.0f), N(2.0f)))                                \
  X(cube_root_any, any, cube_root(a))                                                                                        \
  X(cube_root_small, small, cube_root(abs(a) + N(0x1p-12f)))                                                                 \
  X(cube_root_whole, small, cube_root(floor(abs(a)) + N(1.0f)))                                                              \
  X(vector_length, small, length(Vec3<N>(a, b, c)))                                                                          \
  X(dot_of, any, dot(Vec3<N>(a, b, c), Vec3<N>(c, a, b)))                                                                    \
  X(normalized_x, small, normalize(Vec3<N>(a, b, N(0.5f))).x)                                                                \
  X(normalized_z, small, normalize(Vec3<N>(a, N(1.0f), b)).z)                                                                \
  X(reflected, small, reflect(Vec3<N>(a, b, c), normalize(Vec3<N>(b, N(3.0f), a))).y)                                        \
  X(refracted_in, small, refracted(a, b, 0x1.8p-1f))                                                                         \
  X(refracted_out, small, refracted(a, b, 0x1.554p0f))                                                                       \
  X(vector_mixed, any, mix(Vec3<N>(a, b, c), Vec3<N>(c, b, a), N(0.25f)).x)                                                  \
  X(vector_selected, any, select(a < c, Vec3<N>(a, b, c), Vec3<N>(c, b, a)).z)                                               \
  X(vector_arithmetic, any, ((a * Vec3<N>(a, b, c) + Vec3<N>(c, c, c)) - Vec3<N>(b, a, b) * Vec3<N>(c, a, b)).y)             \
  X(uniform_vector, any, Vec3<N>(fetch_table).y + a)                                                                         \
  X(loop, small, run_loop(a, b))                                                                                             \
  X(loop_none, small, advance_while(100, LoopState<N>{a, b}, a < a, loop_body<N>).x)                                         \
  X(schlick, small, fresnel_schlick(fract(a), 0.02f))                                                                        \
  X(dielectric, small, fresnel_dielectric(fract(a), 1.333f))                                                                 \
  X(beer, small, transmittance(abs(a), abs(b)))                                                                              \
  X(srgb_x, small, encode_srgb(Vec3<N>(fract(a), b, c)).x)                                                                   \
  X(srgb_z, small, encode_srgb(Vec3<N>(a, b, fract(c))).z)                                                                   \
  X(pow_x, any, pow(Vec3<N>(abs(a), abs(b), abs(c)), b).x)                                                                   \
  X(pow_y, any, pow(Vec3<N>(abs(a), abs(b), abs(c)), b).y)                                                                   \
  X(pow_z, any, pow(Vec3<N>(abs(a), abs(b), abs(c)), b).z)                                                                   \
  X(atan2_a, any, atan2(Two<N>(a, b), Two<N>(c, a)).a)                                                                       \
  X(atan2_b, any, atan2(Two<N>(a, b), Two<N>(c, a)).b)

namespace rainref::test {

enum class Operation {
#define RAINREF_NAME(name, domain, expression) name,
  RAINREF_OPERATIONS(RAINREF_NAME)
#undef RAINREF_NAME
};
enum class Domain { any, small, index, moved };

struct OperationInfo {
  Operation operation;
  const char* name;
  Domain domain;
};
inline constexpr OperationInfo operations[] = {
#define RAINREF_ROW(name, domain, expression) {Operation::name, #name, Domain::domain},
    RAINREF_OPERATIONS(RAINREF_ROW)
#undef RAINREF_ROW
};

inline constexpr std::int32_t lookup_table[16] = {5, -3, 0, 100000, 7, 7, -2147483647, 2147483647, 1, 2, 3, 4, -5, 16777217, 9, 15};
inline constexpr float fetch_table[32] = {0.0f,  -0.0f, 1.5f,   -2.25f, 1e-40f, 1e30f, 7,  8,  9,  10, 11, 12, 13, 14, 15, 16,
                                          -1.0f, 2.0f,  -1e-3f, 4.0f,   1e-45f, 6,     -7, -8, -9, 10, 11, 12, 13, 14, 15, 0x1p127f};

}  // namespace rainref::test
