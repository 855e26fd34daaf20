// Replacements for a vector: exchanged components, a matrix left out or transposed.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "faults/edits.h"
#include "faults/members.h"
#include "faults/targets.h"
#include "faults/text.h"

namespace rainref::faults {
namespace {

using perturbed::FormulaStep;
using perturbed::Op;
using Node = perturbed::Trace::Node;

/// A component as a sum of coefficients times the components of another vector, as nodes.
struct Row {
  struct Term {
    std::int32_t coefficient, of;
    bool is_negative;
  };
  std::vector<Term> terms;
};
bool is_coefficient(const Probe& p, std::int32_t node) { return node >= 0 && node_of(p, node).op == Op::constant; }

std::optional<Row> row_of(const Probe& p, std::int32_t node, bool is_negative = false, int depth = 3) {
  if (node < 0 || depth == 0) return {};
  const Node& n = node_of(p, node);
  if (n.op == Op::sum || n.op == Op::difference) {
    std::optional<Row> a = row_of(p, n.of[0], is_negative, depth - 1),
                       b = row_of(p, n.of[1], is_negative != (n.op == Op::difference), depth - 1);
    if (!a || !b) return {};
    a->terms.insert(a->terms.end(), b->terms.begin(), b->terms.end());
    return a;
  }
  if (n.op != Op::product) return {};
  for (const std::size_t k : {0u, 1u})
    if (is_coefficient(p, n.of[k]) && !is_coefficient(p, n.of[1 - k]) && n.of[1 - k] >= 0)
      return Row{{{n.of[k], n.of[1 - k], is_negative}}};
  return {};
}

/// A matrix times a vector: rows, and the vector's components in order.
struct Product {
  std::vector<Row> rows;
  std::vector<std::int32_t> columns;
};
std::optional<Product> product_of(const Probe& p, const std::vector<std::int32_t>& v) {
  Product out;
  auto& [rows, columns] = out;
  const std::size_t n = v.size();
  for (const std::int32_t node : v) {
    const std::optional<Row> row = row_of(p, node);
    if (!row) return {};
    for (const Row::Term& t : row->terms)
      if (std::find(columns.begin(), columns.end(), t.of) == columns.end()) columns.push_back(t.of);
    rows.push_back(*row);
  }
  if (n == 0 || columns.size() != n) return {};
  // In the order of a complete row as written: the arguments of a call have no useful order.
  const auto whole = std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return r.terms.size() == n; });
  if (whole != rows.end())
    for (std::size_t k = 0; k < n; ++k) columns[k] = whole->terms[k].of;
  else
    std::sort(columns.begin(), columns.end());
  return out;
}
/// Operand k of each; empty if one has none.
std::vector<std::int32_t> operands(const Probe& p, const std::vector<std::int32_t>& v, std::size_t k) {
  std::vector<std::int32_t> out;
  for (const std::int32_t node : v)
    if (const std::int32_t of = node_of(p, node).of[k]; of >= 0) out.push_back(of);
  if (out.size() < v.size()) out.clear();
  return out;
}

}  // namespace

std::vector<Edit> vector_edits_of(const Probe& p, const std::vector<std::int32_t>& v) {
  std::vector<Edit> out;
  const std::size_t n = v.size();
  const auto add = [&](std::vector<Expression> made, Kind kind, std::vector<std::string> of) {
    if (std::all_of(made.begin(), made.end(), can_be_had)) out.push_back({std::move(made), {kind, std::move(of)}});
  };
  const auto component = [&](std::size_t from, std::size_t to) {
    return from == to ? expression_of(p, v[from], 1) : elsewhere(p, v[from], v[to], v);
  };
  const auto listed = [&](const std::vector<std::int32_t>& nodes) {
    std::string text;
    for (const std::int32_t node : nodes) text += (text.empty() ? "" : ", ") + words_for(p, node);
    return text;
  };
  const std::string vector = "(" + listed(v) + ")";

  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j) {
      std::vector<Expression> made;
      for (std::size_t k = 0; k < n; ++k) made.push_back(component(k == i ? j : k == j ? i : k, k));
      add(made, Kind::components_exchanged,
          {vector, component_name(static_cast<int>(i)), component_name(static_cast<int>(j)), words_for(p, v[i]), words_for(p, v[j])});
    }

  // For an operation that uses a matrix times a vector: the vector itself, only there.
  for (const std::size_t k : {0u, 1u}) {
    const std::optional<Product> inner = product_of(p, operands(p, v, k));
    if (!inner) continue;
    std::vector<Expression> made;
    std::vector<std::int32_t> whole;
    for (std::size_t c = 0; c < n; ++c) {
      Expression e = expression_of(p, v[c], 1);
      if (!e.is_operation() || e.of.size() <= k) break;
      whole.push_back(e.of[k].node);
      e.of[k] = elsewhere(p, inner->columns[c], v[c], v);
      made.push_back(std::move(e));
    }
    if (made.size() == n) add(std::move(made), Kind::matrix_left_out_there, {vector, listed(inner->columns), listed(whole)});
  }

  // For a matrix times a vector.
  const std::optional<Product> own = product_of(p, v);
  if (!own) return out;
  const std::vector<Row>& rows = own->rows;
  const std::vector<std::int32_t>& columns = own->columns;
  const std::string of_vector = "(" + listed(columns) + ")";
  std::vector<Expression> bare;
  for (std::size_t k = 0; k < n; ++k) bare.push_back(elsewhere(p, columns[k], v[k], v));
  add(bare, Kind::matrix_left_out, {vector, of_vector});

  // For a vector projected on others: on these as unit vectors, in place of the matrix.
  std::vector<Expression> on_units;
  for (std::size_t k = 0; k < n; ++k)
    if (const std::optional<Row> projection = row_of(p, columns[k])) {
      double length_sq = 0;
      for (const Row::Term& t : projection->terms) {
        const double one = node_of(p, t.coefficient).value;
        length_sq += one * one;
      }
      if (projection->terms.size() > 1 && length_sq > 0)
        on_units.push_back(operation(Op::product, {bare[k], number_of(static_cast<float>(1 / std::sqrt(length_sq)))}));
    }
  if (on_units.size() == n) add(std::move(on_units), Kind::matrix_for_unit_vectors, {vector, of_vector});

  // The transpose: each coefficient with the other component, in the other row.
  struct Entry {
    std::int32_t coefficient = -1;
    bool is_negative = false;
  };
  std::vector<std::vector<Entry>> m(n, std::vector<Entry>(n));
  for (std::size_t r = 0; r < n; ++r)
    for (const Row::Term& t : rows[r].terms) {
      Entry& e = m[r][static_cast<std::size_t>(std::find(columns.begin(), columns.end(), t.of) - columns.begin())];
      if (e.coefficient >= 0) return out;
      e = {t.coefficient, t.is_negative};
    }
  std::vector<Expression> transposed;
  std::vector<std::int32_t> beside;
  for (std::size_t r = 0; r < n; ++r) {
    Expression sum = number_of(0);
    bool is_first = true;
    for (std::size_t c = 0; c < n; ++c) {
      if (r != c && m[r][c].coefficient >= 0) beside.push_back(m[r][c].coefficient);
      const Entry& e = m[c][r];
      if (e.coefficient < 0) continue;
      Expression term = product(elsewhere(p, e.coefficient, v[r], v), elsewhere(p, columns[c], v[r], v));
      if (e.is_negative) term = operation(Op::negation, {std::move(term)});
      sum = is_first ? std::move(term) : operation(Op::sum, {std::move(sum), std::move(term)});
      is_first = false;
    }
    transposed.push_back(std::move(sum));
  }
  add(std::move(transposed), Kind::matrix_transposed, {vector, listed(beside)});
  return out;
}

}  // namespace rainref::faults
