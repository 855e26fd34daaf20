// Records which sides of the decisions in a pass text are taken, to measure what a pack exercises.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace rainref::perturbed {

/// Kinds of decisions, with their sides in order. `choice`: the first is taken, the second. `minimum`, `maximum`: the first operand, the
/// second. `clamp`: below, within, above. `total_reflection`: a refracted ray, none. `address`: a lookup's coordinate below the first
/// texel's centre, between, beyond the last one's. `load`: a texel's index below 0, inside, beyond the last one.
enum class DecisionKind : std::uint8_t { choice, minimum, maximum, clamp, total_reflection, address, load };
/// "select", "min", ...
std::string_view name(DecisionKind kind);
int sides(DecisionKind kind);
/// The name of a side, used after the kind's name: "the second" and the like.
std::string_view side_name(DecisionKind kind, int side);

/// A position in a source, from the compiler. here() as a default argument is the position of the call.
struct Site {
  const char* file;
  const char* function;
  int line;
  static constexpr Site here(const char* file = __builtin_FILE(), const char* function = __builtin_FUNCTION(),
                             int line = __builtin_LINE()) {
    return {file, function, line};
  }
};

/// A decision in a pass text. Decisions of one kind on one line (the components of a vector) count as one, and so do all lookups of one
/// input.
struct Decision {
  std::string file;  ///< with its last folder: "puddle/shade.pass.h"; for a lookup its address rule: "clamp"
  int line = 0;      ///< 0 for a lookup
  DecisionKind kind = DecisionKind::choice;
  std::string function;  ///< without template arguments; "" for a lookup, and in a shader that rainref executes
  std::string input;     ///< for a lookup the input that it reads; "" if the pass does not say
  auto operator<=>(const Decision&) const = default;
};
/// How often each side of a decision was taken, and for an impossible side the reason.
struct Sides {
  std::array<std::int64_t, 3> counts{};
  std::array<std::string_view, 3> reasons{};
  void add(const Sides& other);
};

/// How often each side of each decision was taken.
class Coverage {
 public:
  void met(const Site& site, DecisionKind kind, int side);
  /// Records why nothing takes this side of the last decision or lookup. -1: the side that guard() of the pass vocabulary means, which is
  /// both outer sides of three, else the second. `reason`: a literal.
  void guarded(const char* reason, int side);
  /// Records a coordinate of a lookup or the index of a texel; the image is that of the next fetch(). Numbers that a lookup computes from
  /// its coordinates do not count.
  void addressed(const char* rule, DecisionKind kind, int side);
  void fetched(const float* texel) {
    if (open_ > 0) settle(texel);
  }
  /// From now on decisions belong to the line `site` of a shader that rainref executes. If `site` is null, they are steps of an instruction
  /// that decides nothing, and do not count. The strings of a site must live as long as the program.
  void executes(const Site* site) {
    is_shader_ = true;
    shader_site_ = site ? *site : Site{"", "", 0};
  }
  void add(const Coverage& other);
  /// Gives the images seen so far the names of these inputs.
  void name_inputs(const std::function<std::string(const float* texel)>& name_of);
  /// Decisions of pass texts and of the named functions that they use. A decision inside a vocabulary function belongs to the line that
  /// calls it.
  std::map<Decision, Sides> decisions() const;

 private:
  struct Key {
    const char* file;
    int line;
    DecisionKind kind;
    const char* function;
    const float* texel = nullptr;  ///< for a lookup: some texel that it read, until the input has a name
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
  std::map<Key, Sides>::value_type* last_ = nullptr;  ///< the last one; null: it belongs to a function
  std::array<Open, 8> opened_{};                      ///< coordinates of the current lookup
  std::size_t open_ = 0;
  bool is_shader_ = false;
  Site shader_site_{"", "", 0};
};

}  // namespace rainref::perturbed
