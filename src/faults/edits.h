// An operation of a pass text with what it is made of, as a small tree, and what a port's author may have written in its place.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "faults/probe.h"
#include "math/rewrites.h"

namespace rainref::faults {

/// A formula as a tree: an operation, or what it is made of.
struct Expression {
  perturbed::FormulaStep step;      ///< the operation, or the part, number or met value that it is
  std::vector<Expression> of = {};  ///< operands of an operation
  std::int32_t node = -1;           ///< of the probe, where it stands there as it is

  bool is_operation() const { return step.kind == perturbed::FormulaStep::Kind::operation; }
};
Expression number_of(float value);
/// What a node gives, as a part of what stands there instead.
Expression itself(std::int32_t node);
/// Whether all of it is there: elsewhere() gives parts that cannot be had.
bool can_be_had(const Expression& e);
/// x held to [0, 1].
Expression clamped(const Expression& x);
/// A part of expression_of() as the value that stands there, whatever else changes it, in place of what it is made of.
Expression as_part(const Expression& e);
Expression operation(perturbed::Op op, std::vector<Expression> of);
inline Expression sum(Expression a, Expression b) { return operation(perturbed::Op::sum, {std::move(a), std::move(b)}); }
inline Expression difference(Expression a, Expression b) { return operation(perturbed::Op::difference, {std::move(a), std::move(b)}); }
inline Expression product(Expression a, Expression b) { return operation(perturbed::Op::product, {std::move(a), std::move(b)}); }
inline Expression quotient(Expression a, Expression b) { return operation(perturbed::Op::quotient, {std::move(a), std::move(b)}); }
/// sqrt(max(x, 0)).
Expression root_of(Expression x);

/// A node of a probe with what it is made of, so many operations deep; its parts are paths from it.
Expression expression_of(const Probe& p, std::int32_t node, int depth);
/// A node as something that may stand at another place `at`: numbers, what was met before, and what is computed of these. Nothing of
/// `changed` is taken as it was met, because it is another number there. Of nodes that cannot be had: a part without a path.
Expression elsewhere(const Probe& p, std::int32_t node, std::int32_t at, const std::vector<std::int32_t>& changed, int depth = 6);

/// It and all that it is made of, from the top.
void parts(Expression& e, std::vector<Expression*>& out);

perturbed::Formula formula_of(const Expression& e);
/// What a formula gives at a node of a probe.
float value_at(const Probe& p, std::int32_t node, const perturbed::Formula& formula);

/// What may stand there in place of what is meant.
struct Edit {
  std::vector<Expression> made;  ///< of each place
  What what;
};
/// Of one place.
std::vector<Edit> edits_of(const Probe& p, std::int32_t node);
/// Of one place: parts in each other's place.
std::vector<Edit> exchanges_of(const Probe& p, std::int32_t node);
/// Of an operation that is a polynomial of one number: another curve of it. Empty where it is none.
std::vector<Edit> curve_edits_of(const Probe& p, std::int32_t node);
/// Of several places: one edit that belongs to all of them.
struct JointEdit {
  std::vector<std::int32_t> nodes;
  Edit edit;
};
/// Of a weighted sum: other weights of its terms. Empty where it is none.
std::vector<Edit> weight_edits_of(const Probe& p, std::int32_t node);
/// Of one value or the components of a vector: a curve that is applied to it, or another one in place of its own.
std::vector<Edit> value_curve_edits_of(const Probe& p, const std::vector<std::int32_t>& values);
/// Of values blended over each other: the order reversed, or the last two exchanged.
std::vector<JointEdit> blend_edits_of(const Probe& p);
/// Of the components of a vector.
std::vector<Edit> vector_edits_of(const Probe& p, const std::vector<std::int32_t>& vector);

}  // namespace rainref::faults
