// Formulas rewritten as a compiler may, by the rules of the class alone (rearranged.h names it; Vulkan, Direct3D and WGSL allow parts of
// it): order, grouping, a factor moved into a sum or out of it, equal terms merged or cancelled. Then computed in float with fused
// multiply-adds and, where the profile leaves it open, either neighbour. Shares nothing with what it tests but the profile.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "math/random_gpu.h"

namespace rainref::test {

struct Node;
using Tree = std::shared_ptr<const Node>;
struct Node {
  /// A function's parts are its arguments; nothing moves through it.
  enum Kind { leaf, sum, product, function } kind;
  int index = 0;           ///< of a leaf
  bool negative = false;   ///< of a leaf
  bool is_closed = false;  ///< a sum that is computed once and used as a factor: nothing moves into it
  std::vector<Tree> parts;
  bool has_sum = false;  ///< is a sum or has one among its factors
  random_gpu::RandomGpu (*apply)(const random_gpu::RandomGpu* arguments) = nullptr;
};

inline Tree leaf_of(int index, bool negative = false) {
  Node n{.kind = Node::leaf, .parts = {}};
  n.index = index;
  n.negative = negative;
  return std::make_shared<Node>(n);
}
inline Tree of(Node::Kind kind, std::vector<Tree> parts) {
  if (parts.size() == 1) return parts.front();
  Node n{.kind = kind, .parts = std::move(parts)};
  n.has_sum = kind == Node::sum || std::any_of(n.parts.begin(), n.parts.end(), [](const Tree& p) { return p->has_sum; });
  return std::make_shared<Node>(std::move(n));
}
inline Tree applied(random_gpu::RandomGpu (*apply)(const random_gpu::RandomGpu*), std::vector<Tree> arguments) {
  Node n{.kind = Node::function, .parts = std::move(arguments)};
  n.apply = apply;
  return std::make_shared<Node>(std::move(n));
}
inline std::size_t drawn(std::size_t count) { return random_gpu::words()() % count; }

/// A sum or product of few leaves, nested.
inline Tree random_formula(int leaves, int depth) {
  if (depth == 0 || drawn(5) == 0) return leaf_of(static_cast<int>(drawn(static_cast<std::size_t>(leaves))), random_gpu::toss());
  std::vector<Tree> parts;
  const bool is_sum = drawn(5) < 3;
  for (std::size_t k = 0, n = 2 + drawn(is_sum ? 3 : 2); k < n; ++k) parts.push_back(random_formula(leaves, depth - 1));
  return of(is_sum ? Node::sum : Node::product, std::move(parts));
}

/// As written, with any number.
template <class N>
N as_written(const Tree& t, const std::vector<float>& values) {
  if (t->kind == Node::leaf) {
    const N x(values[static_cast<std::size_t>(t->index)]);
    return t->negative ? -x : x;
  }
  N all = as_written<N>(t->parts[0], values);
  for (std::size_t k = 1; k < t->parts.size(); ++k) {
    const N next = as_written<N>(t->parts[k], values);
    all = t->kind == Node::sum ? all + next : all * next;
  }
  return all;
}

inline Tree closed(const Tree& t) {
  Node copy = *t;
  copy.is_closed = true;
  return std::make_shared<Node>(copy);
}

/// "((x0 + -x1) x2)", for messages.
inline std::string text_of(const Tree& t) {
  if (t->kind == Node::leaf) return (t->negative ? "-x" : "x") + std::to_string(t->index);
  std::string out;
  for (const Tree& p : t->parts)
    out += (out.empty() ? "" : t->kind == Node::sum ? " + " : t->kind == Node::function ? ", " : " ") + text_of(p);
  if (t->kind == Node::function) return "f(" + out + ")";
  return (t->is_closed ? "[" : "(") + out + (t->is_closed ? "]" : ")");
}

/// One random rewrite at a random place, or none.
inline Tree rewritten(const Tree& t) {
  if (t->kind == Node::leaf || t->kind == Node::function || t->is_closed) return t;
  std::vector<Tree> parts = t->parts;
  if (drawn(3) != 0) {
    Tree& part = parts[drawn(parts.size())];
    part = rewritten(part);
    return of(t->kind, std::move(parts));
  }
  // a (b c) and a + (b + c) are lists.
  std::vector<Tree> flat;
  for (const Tree& p : parts) {
    if (p->kind == t->kind && !p->is_closed && random_gpu::toss())
      flat.insert(flat.end(), p->parts.begin(), p->parts.end());
    else
      flat.push_back(p);
  }
  if (t->kind == Node::product) {
    // A factor into a sum. A sum goes in whole, and closed: else both would be multiplied out.
    const std::size_t s = drawn(flat.size()), f = drawn(flat.size());
    if (s == f || flat[s]->kind != Node::sum || flat[s]->is_closed) return of(Node::product, std::move(flat));
    const Tree factor = flat[f]->has_sum ? closed(flat[f]) : flat[f];
    std::vector<Tree> terms, rest;
    for (const Tree& term : flat[s]->parts)
      terms.push_back(of(Node::product, {factor->has_sum && term->has_sum ? closed(term) : term, factor}));
    for (std::size_t k = 0; k < flat.size(); ++k)
      if (k != s && k != f) rest.push_back(flat[k]);
    rest.push_back(of(Node::sum, std::move(terms)));
    return of(Node::product, std::move(rest));
  }
  // A leaf that two terms have goes out; x - x goes away.
  const std::size_t a = drawn(flat.size()), b = drawn(flat.size());
  if (a != b && flat[a]->kind == Node::leaf && flat[b]->kind == Node::leaf && flat[a]->index == flat[b]->index &&
      flat[a]->negative != flat[b]->negative && flat.size() > 2) {
    flat.erase(flat.begin() + static_cast<std::ptrdiff_t>(std::max(a, b)));
    flat.erase(flat.begin() + static_cast<std::ptrdiff_t>(std::min(a, b)));
  } else if (a != b && flat[a]->kind == Node::product && flat[b]->kind == Node::product && !flat[a]->has_sum && !flat[b]->has_sum) {
    for (std::size_t i = 0; i < flat[a]->parts.size(); ++i)
      for (std::size_t j = 0; j < flat[b]->parts.size(); ++j) {
        const Tree &x = flat[a]->parts[i], &y = flat[b]->parts[j];
        if (x->kind != Node::leaf || y->kind != Node::leaf || x->index != y->index || x->negative != y->negative) continue;
        std::vector<Tree> left = flat[a]->parts, right = flat[b]->parts;
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
        right.erase(right.begin() + static_cast<std::ptrdiff_t>(j));
        const Tree both = of(Node::product, {x, of(Node::sum, {of(Node::product, left), of(Node::product, right)})});
        std::vector<Tree> rest;
        for (std::size_t k = 0; k < flat.size(); ++k)
          if (k != a && k != b) rest.push_back(flat[k]);
        rest.push_back(both);
        return of(Node::sum, std::move(rest));
      }
  }
  return of(Node::sum, std::move(flat));
}

/// One run of a device.
struct Run {
  const std::vector<float>& values;
  bool once = false;  ///< a part that stands in several places is computed once, as a program does
  int rewrites = 0;   ///< of a function's arguments, at most
  std::map<const Node*, random_gpu::RandomGpu> known;
  std::vector<Tree> kept;  ///< known goes by their addresses

  explicit Run(const std::vector<float>& leaves) : values(leaves) {}
};
inline Tree rewritten_often(Tree t, int most) {
  for (std::size_t n = drawn(static_cast<std::size_t>(most) + 1); n > 0; --n) t = rewritten(t);
  return t;
}
/// As some device computes it: lists in a random order and grouping, a closed sum and a function once.
inline random_gpu::RandomGpu computed(const Tree& t, Run& run) {
  using random_gpu::RandomGpu;
  if (t->kind == Node::leaf) {
    const RandomGpu x(run.values[static_cast<std::size_t>(t->index)]);
    return t->negative ? -x : x;
  }
  if (const auto found = run.known.find(t.get()); found != run.known.end()) return found->second;
  std::vector<RandomGpu> open;
  for (const Tree& p : t->parts) {
    if (t->kind == Node::function) run.kept.push_back(rewritten_often(p, run.rewrites));
    const Tree part = t->kind == Node::function ? run.kept.back() : p;
    open.push_back(computed(part, run));
  }
  if (t->kind == Node::function) open = {t->apply(open.data())};
  while (open.size() > 1) {
    const auto take = [&] {
      const std::size_t k = drawn(open.size());
      const RandomGpu x = open[k];
      open.erase(open.begin() + static_cast<std::ptrdiff_t>(k));
      return x;
    };
    const RandomGpu a = take(), b = take();
    open.push_back(t->kind == Node::sum ? a + b : a * b);
  }
  if (t->is_closed || t->kind == Node::function) open.front() = RandomGpu::exactly(open.front().v);
  if (t->is_closed || t->kind == Node::function || run.once) run.known.emplace(t.get(), open.front());
  return open.front();
}
inline random_gpu::RandomGpu computed(const Tree& t, const std::vector<float>& values) {
  Run run(values);
  return computed(t, run);
}

}  // namespace rainref::test
