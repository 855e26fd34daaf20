// A parameter and the member of a settings struct that holds it, in one line. Scenes, help, defaults and settings read it; the default
// is the struct's own, so that a default-constructed struct is what `describe` says.
//
//   static const std::vector<MemberParameter<Settings>> table{
//       real<&Settings::damping>("puddle.damping", "1", 0.5, 1, "How fast ripples fade ...").published(0.98),
//       choice<&Settings::boundary>("puddle.boundary", {{"reflecting", Boundary::reflecting}, ...}, "What happens to waves ..."),
//       text("scene.image", "", "Picture ...")};     // of no member: the caller reads it
#pragma once

#include <array>
#include <concepts>
#include <functional>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "rainref/image.h"
#include "rainref/variant.h"
#include "scene/config.h"
#include "scene/parameter.h"

namespace rainref::scene {

/// A parameter of settings S, with its member if it has one. If the variants differ, S{} holds the default of corrected.
template <class S>
struct MemberParameter {
  Parameter parameter;
  std::function<void(S&, const Value&)> set;  ///< null: no member
  std::function<Value(const S&)> get;

  MemberParameter(Parameter p) : parameter(std::move(p)) {}
  MemberParameter(Parameter p, std::function<void(S&, const Value&)> s, std::function<Value(const S&)> g)
      : parameter(std::move(p)), set(std::move(s)), get(std::move(g)) {
    parameter.default_value = get(S{});
  }

  /// The same, used by this variant only.
  MemberParameter only(std::string variant) const {
    MemberParameter m = *this;
    m.parameter = parameter.only(std::move(variant));
    return m;
  }
  /// The same with another default for as-published.
  MemberParameter published(Value value) const {
    MemberParameter m = *this;
    m.parameter = parameter.default_for(correct, parameter.default_value);
    m.parameter.default_value = std::move(value);
    return m;
  }
};

/// Names that a scene may choose from, with the values of the member.
template <class T>
using Choices = std::vector<std::pair<std::string, T>>;

namespace member_detail {

template <class>
struct Pointer;
template <class S, class M>
struct Pointer<M S::*> {
  using Struct = S;
  using Member = M;
};
template <auto First, auto... Rest>
struct Path {
  using Struct = typename Pointer<decltype(First)>::Struct;
  using Member = typename Path<Rest...>::Member;
  static auto& in(auto& object) { return Path<Rest...>::in(object.*First); }
};
template <auto Last>
struct Path<Last> {
  using Struct = typename Pointer<decltype(Last)>::Struct;
  using Member = typename Pointer<decltype(Last)>::Member;
  static auto& in(auto& object) { return object.*Last; }
};

// Converts between a member's type and the type of a scene's value.
template <class T>
struct Stored {
  using Type = T;
};
template <std::integral T>
struct Stored<T> {
  using Type = std::int64_t;
};
template <>
struct Stored<bool> {
  using Type = bool;
};
template <class To, class From, std::size_t n>
std::array<To, n> converted(const std::array<From, n>& from) {
  std::array<To, n> to;
  for (std::size_t i = 0; i < n; ++i) to[i] = static_cast<To>(from[i]);
  return to;
}

template <class P>
MemberParameter<typename P::Struct> number(Parameter parameter) {
  using S = typename P::Struct;
  using M = typename P::Member;
  if constexpr (requires { std::tuple_size<M>::value; }) {
    using C = typename M::value_type;
    constexpr std::size_t n = std::tuple_size_v<M>;
    using V = std::array<typename Stored<C>::Type, n>;
    return {std::move(parameter), [](S& s, const Value& v) { P::in(s) = converted<C>(std::get<V>(v)); },
            [](const S& s) { return Value(converted<typename Stored<C>::Type>(P::in(s))); }};
  } else {
    using V = typename Stored<M>::Type;
    return {std::move(parameter), [](S& s, const Value& v) { P::in(s) = static_cast<M>(std::get<V>(v)); },
            [](const S& s) { return Value(static_cast<V>(P::in(s))); }};
  }
}

}  // namespace member_detail

/// For a number, a pair or a triple of numbers. The range is inclusive, for each component.
template <auto... Path>
auto real(std::string key, std::string unit, double minimum, double maximum, std::string sentence) {
  using P = member_detail::Path<Path...>;
  using M = typename P::Member;
  constexpr Type type = std::is_same_v<M, Real2> ? Type::real2 : std::is_same_v<M, Real3> ? Type::real3 : Type::real;
  return member_detail::number<P>({std::move(key), type, std::move(unit), minimum, maximum, {}, std::move(sentence), {}, {}, {}});
}
/// For an integer or a pair of integers.
template <auto... Path>
auto integer(std::string key, std::string unit, double minimum, double maximum, std::string sentence) {
  using P = member_detail::Path<Path...>;
  constexpr Type type = std::is_integral_v<typename P::Member> ? Type::integer : Type::integer2;
  return member_detail::number<P>({std::move(key), type, std::move(unit), minimum, maximum, {}, std::move(sentence), {}, {}, {}});
}
template <auto... Path>
auto boolean(std::string key, std::string sentence) {
  return member_detail::number<member_detail::Path<Path...>>(boolean(std::move(key), false, std::move(sentence)));
}
template <auto... Path>
auto choice(std::string key, Choices<typename member_detail::Path<Path...>::Member> choices, std::string sentence) {
  using P = member_detail::Path<Path...>;
  using S = typename P::Struct;
  std::vector<std::string> names;
  for (const auto& c : choices) names.push_back(c.first);
  return MemberParameter<S>(
      choice(std::move(key), std::move(names), choices.front().first, std::move(sentence)),
      [choices](S& s, const Value& v) {
        for (const auto& c : choices)
          if (c.first == std::get<std::string>(v)) P::in(s) = c.second;
      },
      [choices](const S& s) {
        for (const auto& c : choices)
          if (c.second == P::in(s)) return Value(c.first);
        return Value(std::string());
      });
}
/// Rounding of every store of an effect.
template <auto... Path>
auto rounding(std::string key) {
  return choice<Path...>(std::move(key), {{"rne", Rounding::rne}, {"rtz", Rounding::rtz}},
                         "Rounding of every store: to nearest even, or toward zero as many GPUs do.");
}
/// Storage format of a buffer, by name.
template <auto... Path>
auto storage(std::string key, std::initializer_list<Format> formats, std::string sentence) {
  Choices<Format> choices;
  for (const Format f : formats) choices.emplace_back(info(f).name, f);
  return choice<Path...>(std::move(key), std::move(choices), std::move(sentence));
}

/// The parameters of the table, followed by more parameters without a member.
template <class S>
std::vector<Parameter> parameters_of(const std::vector<MemberParameter<S>>& table,
                                     std::initializer_list<std::vector<Parameter>> more = {}) {
  std::vector<Parameter> out;
  for (const MemberParameter<S>& m : table) out.push_back(m.parameter);
  for (const std::vector<Parameter>& others : more) out.insert(out.end(), others.begin(), others.end());
  return out;
}
/// Sets the members that the scene's variant uses; the others are unchanged.
template <class S>
void apply(const std::vector<MemberParameter<S>>& table, const Config& config, S& s) {
  for (const MemberParameter<S>& m : table)
    if (m.set && m.parameter.used_by(config.variant())) m.set(s, config.entry(m.parameter.key).value);
}
/// The settings of a scene, in a struct with the members variant, seed, fps, width and height besides those of the table. Members that the
/// scene's variant does not use keep their defaults.
template <class S>
S settings_from(const std::vector<MemberParameter<S>>& table, const Config& config) {
  S s;
  s.variant = variant_from_name(config.variant());
  s.seed = static_cast<std::uint64_t>(config.integer("seed"));
  s.fps = config.real("run.fps");
  s.width = static_cast<int>(config.integer2("run.size")[0]);
  s.height = static_cast<int>(config.integer2("run.size")[1]);
  apply(table, config, s);
  return s;
}
/// The result of settings_from for a scene that only names effect and variant.
template <class S>
S default_settings(const std::vector<MemberParameter<S>>& table, Variant variant) {
  S s;
  s.variant = variant;
  for (const MemberParameter<S>& m : table)
    if (m.set && m.parameter.used_by(name(variant))) m.set(s, m.parameter.default_in(name(variant)));
  return s;
}

}  // namespace rainref::scene
