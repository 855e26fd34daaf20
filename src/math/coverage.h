// Which sides of the decisions of a pass text are taken: what a pack exercises.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace rainref::perturbed {

/// What decides. Its sides, in order: `choice`: the first is taken, the second; `minimum`, `maximum`: the first operand, the
/// second; `clamp`: below, within, above; `total_reflection`: a refracted ray, none; `address`: a lookup's coordinate below the
/// first texel's centre, between, beyond the last one's.
enum class DecisionKind : std::uint8_t { choice, minimum, maximum, clamp, total_reflection, address };
/// "select", "min", ...
std::string_view name(DecisionKind kind);
int sides(DecisionKind kind);
/// "the second" and the like: what a side is called after the kind's name.
std::string_view side_name(DecisionKind kind, int side);

/// Where it stands in a pass text. Decisions of one kind on one line (the components of a vector) are one.
struct Decision {
  std::string file;  ///< without folders
  int line = 0;
  DecisionKind kind = DecisionKind::choice;
  auto operator<=>(const Decision&) const = default;
};

/// How often each side of each decision was taken.
class Coverage {
 public:
  using Counts = std::array<std::int64_t, 3>;
  /// `file`: as the compiler names it.
  void met(const char* file, int line, DecisionKind kind, int side);
  void add(const Coverage& other);
  /// Those of pass texts and of the named mathematics that they use. A decision within a function of the vocabulary is one of the
  /// line that calls it.
  std::map<Decision, Counts> decisions() const;

 private:
  struct Key {
    const char* file;
    int line;
    DecisionKind kind;
    auto operator<=>(const Key&) const = default;
  };
  std::map<Key, Counts> counts_;
};

/// Sides that were taken, and those that there are.
struct Exercised {
  int taken = 0, of = 0;
};
Exercised exercised(const std::map<Decision, Coverage::Counts>& decisions);

}  // namespace rainref::perturbed
