// What stands in place of a vector: its components exchanged or turned, a matrix left out or transposed.
#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "faults/edits.h"
#include "faults/targets.h"

namespace rainref::faults {
namespace {

using perturbed::FormulaStep;
using perturbed::Op;
using Node = perturbed::Trace::Node;

/// A component as a sum of coefficients times the components of another vector, which are nodes.
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

/// A matrix times a vector: rows, and the vector's components in their order.
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
  // In the order of a row that has them all, as it is written: arguments of a call are met in no order that counts.
  const auto whole = std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return r.terms.size() == n; });
  if (whole != rows.end())
    for (std::size_t k = 0; k < n; ++k) columns[k] = whole->terms[k].of;
  else
    std::sort(columns.begin(), columns.end());
  return out;
}
/// Operand k of each; empty where one has none.
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
  const auto add = [&](std::vector<Expression> made, std::string name, std::string sentence) {
    if (std::all_of(made.begin(), made.end(), can_be_had)) out.push_back({std::move(made), std::move(name), std::move(sentence)});
  };
  const auto component = [&](std::size_t from, std::size_t to) {
    if (from == to) {
      Expression own = expression_of(p, v[from], 1);
      return own;
    }
    return elsewhere(p, v[from], v[to], v);
  };
  std::vector<std::string> words;
  for (const std::int32_t node : v) words.push_back(words_for(p, node));
  const auto name_of = [&](std::size_t k) { return words[k]; };
  std::string vector = "(";
  for (std::size_t k = 0; k < n; ++k) vector += (k == 0 ? "" : ", ") + words[k];
  vector += ")";

  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j) {
      std::vector<Expression> made;
      for (std::size_t k = 0; k < n; ++k) made.push_back(component(k == i ? j : k == j ? i : k, k));
      const std::string which = n == 3 ? fmt::format("{} and {} of ", "xyz"[i], "xyz"[j]) : "x and y of ";
      add(made, fmt::format("components exchanged: {}{}", which, vector),
          fmt::format("of {} {} and {} are exchanged: {} stands where {} belongs, and the reverse", vector, "xyz"[i], "xyz"[j], name_of(i),
                      name_of(j)));
      if (n != 2) continue;
      for (const std::size_t turned : {0u, 1u}) {
        std::vector<Expression> other = made;
        other[turned] = operation(Op::negation, {other[turned]});
        add(other, fmt::format("turned by a quarter: {}", vector),
            fmt::format("{} is turned by a right angle: {} in place of (x, y)", vector, turned == 0 ? "(-y, x)" : "(y, -x)"));
      }
    }

  // One operand of each component in the other one.
  for (const std::size_t k : {0u, 1u}) {
    const std::vector<std::int32_t> all = operands(p, v, k);
    if (all.empty() || n != 2 || all[0] == all[1] || operands(p, v, 1 - k).empty()) continue;
    std::vector<Expression> made;
    for (const std::size_t c : {0u, 1u}) {
      Expression e = expression_of(p, v[c], 1);
      if (!e.is_operation() || e.of.size() != 2) break;
      e.of[k] = elsewhere(p, all[1 - c], v[c], v);
      made.push_back(std::move(e));
    }
    if (made.size() == n)
      add(std::move(made), fmt::format("exchanged between components: {} and {} in {}", words_for(p, all[0]), words_for(p, all[1]), vector),
          fmt::format("in {} {} and {} stand in each other's place, each in the other component", vector, words_for(p, all[0]),
                      words_for(p, all[1])));
  }

  // Of something that takes a matrix times a vector: the vector as it is, there alone.
  for (const std::size_t k : {0u, 1u}) {
    const std::optional<Product> inner = product_of(p, operands(p, v, k));
    if (!inner) continue;
    std::vector<Expression> made;
    std::string bare, whole;
    for (std::size_t c = 0; c < n; ++c) {
      Expression e = expression_of(p, v[c], 1);
      if (!e.is_operation() || e.of.size() <= k) break;
      bare += (c == 0 ? "" : ", ") + words_for(p, inner->columns[c]);
      whole += (c == 0 ? "" : ", ") + words_for(p, e.of[k].node);
      e.of[k] = elsewhere(p, inner->columns[c], v[c], v);
      made.push_back(std::move(e));
    }
    if (made.size() == n)
      add(std::move(made), fmt::format("matrix left out: ({}) for ({}) in {}", bare, whole, vector),
          fmt::format("in {} ({}) stands in place of ({}): the matrix, or the conversion to other axes, is left out there", vector, bare,
                      whole));
  }

  // Of a matrix times a vector.
  const std::optional<Product> own = product_of(p, v);
  if (!own) return out;
  const std::vector<Row>& rows = own->rows;
  const std::vector<std::int32_t>& columns = own->columns;
  const auto of_vector = [&] {
    std::string text = "(";
    for (std::size_t k = 0; k < n; ++k) text += (k == 0 ? "" : ", ") + words_for(p, columns[k]);
    return text + ")";
  };
  std::vector<Expression> bare;
  for (std::size_t k = 0; k < n; ++k) bare.push_back(elsewhere(p, columns[k], v[k], v));
  add(bare, fmt::format("matrix left out: {} for {}", of_vector(), vector),
      fmt::format("{} stands in place of {}: the matrix, or the conversion to other axes, is left out", of_vector(), vector));

  // Of a vector that is projected on others: on these as unit vectors in place of by the matrix.
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
  if (on_units.size() == n)
    add(std::move(on_units), fmt::format("matrix for unit vectors: {} for {}", of_vector(), vector),
        fmt::format("the projections {} are taken on vectors of length 1 and stand in place of {}: the matrix, which has their lengths "
                    "squared, is left out",
                    of_vector(), vector));

  // The same with rows and columns exchanged: each coefficient with the other component, in the other row.
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
  const auto product = [&](const auto& entry, std::string name, std::string sentence) {
    std::vector<Expression> made;
    for (std::size_t r = 0; r < n; ++r) {
      Expression sum = number_of(0);
      bool is_first = true;
      for (std::size_t c = 0; c < n; ++c) {
        const Entry e = entry(r, c);
        if (e.coefficient < 0) continue;
        Expression term = operation(Op::product, {elsewhere(p, e.coefficient, v[r], v), elsewhere(p, columns[c], v[r], v)});
        if (e.is_negative) term = operation(Op::negation, {std::move(term)});
        sum = is_first ? std::move(term) : operation(Op::sum, {std::move(sum), std::move(term)});
        is_first = false;
      }
      made.push_back(std::move(sum));
    }
    add(std::move(made), std::move(name), std::move(sentence));
  };
  std::string off_diagonal;
  for (std::size_t r = 0; r < n; ++r)
    for (std::size_t c = 0; c < n; ++c)
      if (r != c && m[r][c].coefficient >= 0) off_diagonal += (off_diagonal.empty() ? "" : ", ") + words_for(p, m[r][c].coefficient);
  product([&](std::size_t r, std::size_t c) { return m[c][r]; }, fmt::format("matrix transposed: {}", vector),
          fmt::format("in {} rows and columns of the matrix are exchanged: {} goes with the other component, into the other one", vector,
                      off_diagonal));
  product([&](std::size_t r, std::size_t c) { return r == c ? m[r][c] : Entry{}; }, fmt::format("matrix' other terms left out: {}", vector),
          fmt::format("in {} only the diagonal of the matrix counts: {} is left out", vector, off_diagonal));
  if (n == 2) {
    product(
        [&](std::size_t r, std::size_t c) {
          Entry e = m[r][c];
          if (r != c) e.is_negative = !e.is_negative;
          return e;
        },
        fmt::format("turned the other way: {}", vector),
        fmt::format("in {} the terms off the diagonal, {}, have the other sign: it is turned the other way", vector, off_diagonal));
    product([&](std::size_t r, std::size_t c) { return m[r][1 - c]; }, fmt::format("matrix with its columns exchanged: {}", vector),
            fmt::format("in {} the components of {} are exchanged", vector, of_vector()));
  }
  return out;
}

}  // namespace rainref::faults
