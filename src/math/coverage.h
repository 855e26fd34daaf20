// Which sides of the decisions of a pass text are taken: what a pack exercises.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace rainref::perturbed {

/// What decides. Its sides, in order: `choice`: the first is taken, the second; `minimum`, `maximum`: the first operand, the
/// second; `clamp`: below, within, above; `total_reflection`: a refracted ray, none; `address`: a lookup's coordinate below the
/// first texel's centre, between, beyond the last one's; `load`: a texel's number below 0, inside, beyond the last one.
enum class DecisionKind : std::uint8_t { choice, minimum, maximum, clamp, total_reflection, address, load };
/// "select", "min", ...
std::string_view name(DecisionKind kind);
int sides(DecisionKind kind);
/// "the second" and the like: what a side is called after the kind's name.
std::string_view side_name(DecisionKind kind, int side);

/// A place in a source, as the compiler names it. here() as a default argument is the place of the call.
struct Site {
  const char* file;
  const char* function;
  int line;
  static constexpr Site here(const char* file = __builtin_FILE(), const char* function = __builtin_FUNCTION(),
                             int line = __builtin_LINE()) {
    return {file, function, line};
  }
};

/// Where it stands in a pass text. Decisions of one kind on one line (the components of a vector) are one, and so are all lookups of
/// one input.
struct Decision {
  std::string file;  ///< with its last folder: "puddle/shade.pass.h"; of a lookup its address rule: "clamp"
  int line = 0;      ///< of a lookup 0
  DecisionKind kind = DecisionKind::choice;
  std::string function;  ///< without template arguments; of a lookup, and in a shader that is executed, ""
  std::string input;     ///< of a lookup what it reads; "" where the pass does not say
  auto operator<=>(const Decision&) const = default;
};
/// How often each side of a decision was taken, and of a side that nothing can take why.
struct Sides {
  std::array<std::int64_t, 3> counts{};
  std::array<std::string_view, 3> reasons{};
  void add(const Sides& other);
};

/// How often each side of each decision was taken.
class Coverage {
 public:
  void met(const Site& site, DecisionKind kind, int side);
  /// Says of the decision or lookup met last why nothing takes this side of it; -1: what guard() of the pass vocabulary means, of three
  /// sides the outer ones and else the second. `reason`: a literal.
  void guarded(const char* reason, int side);
  /// A coordinate of a lookup or the number of a texel, whose image is that of the next fetch(). The numbers that a lookup makes of
  /// its coordinates are its own.
  void addressed(const char* rule, DecisionKind kind, int side);
  void fetched(const float* texel) {
    if (open_ > 0) settle(texel);
  }
  /// From now on decisions are those of a shader that rainref executes: of its line `site`, or, without one, steps of an instruction that
  /// decides nothing. Strings of a site must live as long as the program.
  void executes(const Site* site) {
    is_shader_ = true;
    shader_site_ = site ? *site : Site{"", "", 0};
  }
  void add(const Coverage& other);
  /// The images met so far have the names of these inputs from now on.
  void name_inputs(const std::function<std::string(const float* texel)>& name_of);
  /// Those of pass texts and of the named mathematics that they use. A decision within a function of the vocabulary is one of the
  /// line that calls it.
  std::map<Decision, Sides> decisions() const;

 private:
  struct Key {
    const char* file;
    int line;
    DecisionKind kind;
    const char* function;
    const float* texel = nullptr;  ///< of a lookup: some texel that it read, until the input has a name
    std::string input = "";
    auto operator<=>(const Key&) const = default;
  };
  struct Open {
    const char* rule;
    DecisionKind kind;
    int side;
  };
  void settle(const float* texel);

  std::map<Key, Sides> sides_;
  std::map<Key, Sides>::value_type* last_ = nullptr;  ///< the one met last; null: it is a part of a function
  std::array<Open, 8> opened_{};                      ///< coordinates of the lookup at hand
  std::size_t open_ = 0;
  bool is_shader_ = false;
  Site shader_site_{"", "", 0};
};

}  // namespace rainref::perturbed
