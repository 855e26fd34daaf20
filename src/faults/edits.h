// An operation of a pass text as a small expression tree, and the expressions that a port may have in its place.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "faults/probe.h"
#include "math/rewrites.h"

namespace rainref::faults {

/// An expression tree: an operation with operands, or a leaf.
struct Expression {
  perturbed::FormulaStep step;      ///< the operation, or the leaf: part, number or value met before
  std::vector<Expression> of = {};  ///< operands of an operation
  std::int32_t node = -1;           ///< node of the probe, if the expression is that node unchanged

  bool is_operation() const { return step.kind == perturbed::FormulaStep::Kind::operation; }
};
Expression number_of(float value);
/// The value of a node, as a part of the expression that replaces it.
Expression itself(std::int32_t node);
/// True if every part is available; elsewhere() returns parts that are not.
bool can_be_had(const Expression& e);
/// x clamped to [0, 1].
Expression clamped(const Expression& x);
/// A part of expression_of() as its present value, instead of its own operands; other changes affect it.
Expression as_part(const Expression& e);
Expression operation(perturbed::Op op, std::vector<Expression> of);
inline Expression sum(Expression a, Expression b) { return operation(perturbed::Op::sum, {std::move(a), std::move(b)}); }
inline Expression difference(Expression a, Expression b) { return operation(perturbed::Op::difference, {std::move(a), std::move(b)}); }
inline Expression product(Expression a, Expression b) { return operation(perturbed::Op::product, {std::move(a), std::move(b)}); }
inline Expression quotient(Expression a, Expression b) { return operation(perturbed::Op::quotient, {std::move(a), std::move(b)}); }
/// sqrt(max(x, 0)).
Expression root_of(Expression x);

/// A node of a probe with its operands, `depth` operations deep; its parts are paths from it.
Expression expression_of(const Probe& p, std::int32_t node, int depth);
/// A node as an expression at another place `at`: numbers, values met before it, and what is computed from these. The nodes in `changed`
/// are recomputed, because they have other values there. A node that is not available becomes a part without a path.
Expression elsewhere(const Probe& p, std::int32_t node, std::int32_t at, const std::vector<std::int32_t>& changed, int depth = 6);

/// Collects the expression and all its subexpressions, top first.
void parts(Expression& e, std::vector<Expression*>& out);

perturbed::Formula formula_of(const Expression& e);
/// Value of a formula at a node of a probe.
float value_at(const Probe& p, std::int32_t node, const perturbed::Formula& formula);

/// Replacements for an expression.
struct Edit {
  std::vector<Expression> made;  ///< one for each place
  What what;
};
/// Edits of one place.
std::vector<Edit> edits_of(const Probe& p, std::int32_t node);
/// Edits of one place that exchange parts.
std::vector<Edit> exchanges_of(const Probe& p, std::int32_t node);
/// Other curves for an operation that is a polynomial of one number. Empty if it is none.
std::vector<Edit> curve_edits_of(const Probe& p, std::int32_t node);
/// One edit that changes several places together.
struct JointEdit {
  std::vector<std::int32_t> nodes;
  Edit edit;
};
/// Other weights for the terms of a weighted sum. Empty if it is none.
std::vector<Edit> weight_edits_of(const Probe& p, std::int32_t node);
/// A curve that is added to, or replaces the curve of, one value or the components of a vector.
std::vector<Edit> value_curve_edits_of(const Probe& p, const std::vector<std::int32_t>& values);
/// Values blended over each other: order reversed, or the last two exchanged.
std::vector<JointEdit> blend_edits_of(const Probe& p);
/// Edits of the components of a vector.
std::vector<Edit> vector_edits_of(const Probe& p, const std::vector<std::int32_t>& vector);

}  // namespace rainref::faults
