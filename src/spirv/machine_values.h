// Operations on values; included by machine.h.
#pragma once

#include "spirv/machine.h"

namespace rainref::spirv {

template <class N>
void Invocation<N>::execute(const Code& code) {
  using namespace numbers;
  switch (code.op) {
#define RAINREF_SPIRV_WORDS(name, spirv_number, operands, in, out, value)                                                      \
  case Op::name:                                                                                                               \
    return each<Kind::in, Kind::out>(code, operands,                                                                           \
                                     []([[maybe_unused]] std::uint32_t a, [[maybe_unused]] std::uint32_t b) -> std::uint32_t { \
                                       [[maybe_unused]] const std::int64_t sa = signed_word(a), sb = signed_word(b);           \
                                       return value;                                                                           \
                                     });
#define RAINREF_SPIRV_NUMBERS(name, spirv_number, operands, in, out, value) \
  case Op::name:                                                            \
    return each<Kind::in, Kind::out>(code, operands, []([[maybe_unused]] const auto& a, [[maybe_unused]] const auto& b) { return value; });
#include "spirv/opcodes.inc"
    default:
      return execute_other(code);
  }
}

template <class N>
void Invocation<N>::execute_other(const Code& code) {
  Slot<N>* const to = at(code.to);
  const Slot<N>*const a = at(code.in[0]), *const b = at(code.in[1]), *const c = at(code.in[2]);
  switch (code.op) {
    case Op::Load:
      return load(code);
    case Op::Store:
      return store(code);
    case Op::AccessChain:
      return chain(code);
    case Op::CopyObject:
      std::copy(a, a + code.n, to);
      return;
    case Op::Undef:
      std::fill(to, to + code.n, Slot<N>{});
      return;
    case Op::Variable: {
      Slot<N>* const memory = stack_.data() + base_ + code.m;
      to[0].word = 0;
      to[1].word = base_ + code.m;
      if (code.sub != 0)
        std::copy(a, a + code.n, memory);
      else
        std::fill(memory, memory + code.n, Slot<N>{});
      return;
    }
    case Op::Select:
      for (std::uint32_t k = 0; k < code.n; ++k) to[k] = a[code.sub != 0 ? 0 : k].word != 0 ? b[k] : c[k];
      return;
    case Op::Bitcast:
      for (std::uint32_t k = 0; k < code.n; ++k) {
        if (code.sub != 0)
          to[k].number = N(std::bit_cast<float>(a[k].word));
        else
          to[k].word = numbers::bits_of(a[k].number);
      }
      return;
    case Op::ExtInst:
      return numbers::glsl_function(code, to, a, b, c);
    case Op::BitFieldInsert:
    case Op::BitFieldSExtract:
    case Op::BitFieldUExtract: {
      const std::uint32_t offset = c->word, count_of = at(code.in[3])->word;
      for (std::uint32_t k = 0; k < code.n; ++k)
        to[k].word = code.op == Op::BitFieldInsert ? inserted_bits(a[k].word, b[k].word, offset, count_of)
                                                   : extracted_bits(a[k].word, offset, count_of, code.op == Op::BitFieldSExtract);
      return;
    }
    case Op::IAddCarry:
    case Op::ISubBorrow:
    case Op::UMulExtended:
    case Op::SMulExtended:
      return widen(code);
    case Op::VectorTimesScalar:
    case Op::MatrixTimesScalar:
    case Op::VectorTimesMatrix:
    case Op::MatrixTimesVector:
    case Op::MatrixTimesMatrix:
    case Op::OuterProduct:
    case Op::Dot:
      return multiply(code);
    case Op::Any:
    case Op::All: {
      std::uint32_t set = 0;
      for (std::uint32_t k = 0; k < code.m; ++k) set += a[k].word != 0;
      to->word = code.op == Op::Any ? set > 0 : set == code.m;
      return;
    }
    case Op::Transpose:
    case Op::CompositeConstruct:
    case Op::VectorShuffle:
    case Op::VectorExtractDynamic:
    case Op::VectorInsertDynamic:
      return rearrange(code);
    case Op::ArrayLength: {
      const BoundBuffer* buffer = resource(code, a[0]).buffer;
      const std::uint64_t begin = std::uint64_t{a[1].word} + code.m;
      if (buffer == nullptr || begin > buffer->size) module_.refuse(code, "the buffer ends before its array begins");
      to->word = static_cast<std::uint32_t>((buffer->size - begin) / module_.pool[code.pool]);
      return;
    }
    case Op::ImageSampleExplicitLod:
    case Op::ImageFetch:
    case Op::ImageRead:
    case Op::ImageWrite:
    case Op::ImageQuerySizeLod:
    case Op::ImageQuerySize:
    case Op::ImageQueryLevels:
      return use_image(code);
    default:
      return exchange(code);
  }
}

// The columns of a matrix are contiguous.
template <class N>
void Invocation<N>::multiply(const Code& code) {
  Slot<N>* const to = at(code.to);
  const Slot<N>*const a = at(code.in[0]), *const b = at(code.in[1]);
  const std::uint32_t n = code.n, m = code.m;
  switch (code.op) {
    case Op::VectorTimesScalar:
    case Op::MatrixTimesScalar:
      for (std::uint32_t k = 0; k < n; ++k) to[k].number = a[k].number * b[0].number;
      return;
    case Op::Dot:
      to->number = numbers::dot_of(a, 1, b, m);
      return;
    case Op::VectorTimesMatrix:
      for (std::uint32_t k = 0; k < n; ++k) to[k].number = numbers::dot_of(a, 1, b + k * m, m);
      return;
    case Op::OuterProduct:
      for (std::uint32_t k = 0; k < n; ++k) to[k].number = a[k % m].number * b[k / m].number;
      return;
    default: {  // a matrix times a vector, or times the columns of another one
      const std::uint32_t rows = n / code.sub;
      for (std::uint32_t column = 0; column < code.sub; ++column)
        for (std::uint32_t k = 0; k < rows; ++k) to[column * rows + k].number = numbers::dot_of(a + k, rows, b + column * m, m);
    }
  }
}

template <class N>
void Invocation<N>::widen(const Code& code) {
  const Slot<N>*const a = at(code.in[0]), *const b = at(code.in[1]);
  for (std::uint32_t k = 0; k < code.m; ++k) {
    const std::uint64_t x = a[k].word, y = b[k].word;
    std::uint64_t wide = x * y;
    std::uint32_t high = 0;
    if (code.op == Op::IAddCarry) wide = x + y;
    if (code.op == Op::ISubBorrow) wide = x - y;
    if (code.op == Op::SMulExtended)
      wide = static_cast<std::uint64_t>(std::int64_t{signed_word(a[k].word)} * std::int64_t{signed_word(b[k].word)});
    high = static_cast<std::uint32_t>(wide >> 32);
    Slot<N>* const to = at(code.to);
    to[k].word = static_cast<std::uint32_t>(wide);
    to[code.m + k].word = code.op == Op::ISubBorrow ? x < y : high;
  }
}

template <class N>
void Invocation<N>::rearrange(const Code& code) {
  Slot<N>* to = at(code.to);
  const Slot<N>* const a = at(code.in[0]);
  const std::uint32_t* parts = module_.pool.data() + code.pool;
  switch (code.op) {
    case Op::Transpose:
      for (std::uint32_t k = 0; k < code.n; ++k) to[k] = a[k % (code.n / code.m) * code.m + k / (code.n / code.m)];
      return;
    case Op::CompositeConstruct:
      for (std::uint32_t k = 0; k < code.pool_count; k += 2) {
        const Slot<N>* const part = at(static_cast<Place>(parts[k]));
        copy(part, parts[k + 1], to);
        to += parts[k + 1];
      }
      return;
    case Op::VectorShuffle:
      for (std::uint32_t k = 0; k < code.pool_count; ++k) copy(at(static_cast<Place>(parts[k])), 1, to + k);
      return;
    default: {
      const std::uint32_t index = at(code.in[1])->word;
      if (index >= code.m) module_.refuse(code, fmt::format("component {} of a vector of {} is asked for", signed_word(index), code.m));
      if (code.op == Op::VectorExtractDynamic) {
        *to = a[index];
        return;
      }
      std::copy(a, a + code.m, to);
      to[index] = *at(code.in[2]);
    }
  }
}

}  // namespace rainref::spirv
