// Operations on memory and images; included by machine.h. A pointer is two slots: the descriptor and a byte offset in its buffer, or
// nothing and a slot index.
#pragma once

#include "spirv/machine.h"

namespace rainref::spirv {

template <class N>
const Resource<N>& Invocation<N>::resource(const Code& code, const Slot<N>& handle) const {
  if (handle.word >= machine_.resources.size()) module_.refuse(code, op_name(code.op) + " has no buffer or image");
  return machine_.resources[handle.word];
}

template <class N>
std::byte* Invocation<N>::bytes(const Code& code, const Slot<N>* pointer, bool writes) {
  const BoundBuffer* buffer = resource(code, pointer[0]).buffer;
  if (buffer == nullptr) module_.refuse(code, op_name(code.op) + " has no buffer");
  const std::uint64_t first = pointer[1].word, end = first + code.m;
  const std::string& name_of = module_.descriptors[pointer[0].word].name;
  if (end > buffer->size)
    module_.refuse(code,
                   fmt::format("{} bytes {} to {} of '{}', which has {}", writes ? "writes" : "reads", first, end, name_of, buffer->size));
  if (writes && !buffer->is_writable) module_.refuse(code, fmt::format("writes to '{}', which is an input", name_of));
  return buffer->bytes + first;
}
template <class N>
Slot<N>* Invocation<N>::slots(const Code& code, const Slot<N>* pointer) {
  std::vector<Slot<N>>& memory = static_cast<Memory>(code.sub) == Memory::shared ? machine_.shared : stack_;
  if (std::uint64_t{pointer[1].word} + code.n > memory.size()) module_.refuse(code, "a place outside of the memory is used");
  return memory.data() + pointer[1].word;
}

template <class N>
void Invocation<N>::chain(const Code& code) {
  const Slot<N>* const base = at(code.in[0]);
  const std::uint32_t* parts = module_.pool.data() + code.pool;
  std::uint64_t place = std::uint64_t{base[1].word} + code.m;
  for (std::uint32_t k = 0; k < code.pool_count; k += 3) {
    const std::uint32_t index = at(static_cast<Place>(parts[k]))->word;
    if (parts[k + 2] != none && index >= parts[k + 2])
      module_.refuse(code, fmt::format("element {} of {} is asked for", signed_word(index), parts[k + 2]));
    place += std::uint64_t{index} * parts[k + 1];
    if (place > none) module_.refuse(code, fmt::format("element {} of an array in a buffer is asked for", signed_word(index)));
  }
  if (place > none) module_.refuse(code, "a place outside of the memory is asked for");
  Slot<N>* const to = at(code.to);
  const std::uint32_t object = base[0].word;
  to[0].word = object;
  to[1].word = static_cast<std::uint32_t>(place);
}

template <class N>
void Invocation<N>::load(const Code& code) {
  Slot<N>* const to = at(code.to);
  const Slot<N>* const pointer = at(code.in[0]);
  if (static_cast<Memory>(code.sub) != Memory::buffer) {
    const Slot<N>* const from = slots(code, pointer);
    // A copy onto itself overlaps only if a module forges a pointer.
    std::copy(from, from + code.n, to);
    return;
  }
  const std::byte* const from = bytes(code, pointer, false);
  const std::uint32_t* leaves = module_.pool.data() + code.pool;
  for (std::uint32_t k = 0; k < code.n; ++k) {
    std::uint32_t word = 0;
    std::memcpy(&word, from + leaves[k] / 2, 4);
    if (leaves[k] % 2 != 0)
      to[k].number = N(std::bit_cast<float>(word));
    else
      to[k].word = word;
  }
}
template <class N>
void Invocation<N>::store(const Code& code) {
  const Slot<N>*const pointer = at(code.in[0]), *const from = at(code.in[1]);
  if (static_cast<Memory>(code.sub) != Memory::buffer) {
    return copy(from, code.n, slots(code, pointer));
  }
  std::byte* const to = bytes(code, pointer, true);
  const std::uint32_t* leaves = module_.pool.data() + code.pool;
  for (std::uint32_t k = 0; k < code.n; ++k) {
    const std::uint32_t word = leaves[k] % 2 != 0 ? numbers::bits_of(from[k].number) : from[k].word;
    std::memcpy(to + leaves[k] / 2, &word, 4);
    if constexpr (std::is_same_v<N, perturbed::Perturbed>)
      if (trace_ && leaves[k] % 2 != 0 && from[k].number.node() >= 0) trace_->outputs.push_back(from[k].number.as_stored().node());
  }
}

// Atomics. No other invocation runs meanwhile.
template <class N>
void Invocation<N>::exchange(const Code& code) {
  const Slot<N>* const pointer = at(code.in[0]);
  const std::uint32_t value = at(code.in[1])->word, compared = at(code.in[2])->word;
  std::byte* in_buffer = nullptr;
  std::uint32_t* in_memory = nullptr;
  std::uint32_t old = 0;
  if (static_cast<Memory>(code.sub) == Memory::buffer) {
    in_buffer = bytes(code, pointer, code.op != Op::AtomicLoad);
    std::memcpy(&old, in_buffer, 4);
  } else {
    in_memory = &slots(code, pointer)->word;
    old = *in_memory;
  }
  std::uint32_t now = old;
  switch (code.op) {
#define RAINREF_SPIRV_ATOMIC(name, number, result, after) \
  case Op::name:                                          \
    now = after;                                          \
    break;
#include "spirv/opcodes.inc"
    default:
      break;
  }
  if (in_buffer != nullptr)
    std::memcpy(in_buffer, &now, 4);
  else
    *in_memory = now;
  if (code.op != Op::AtomicStore) at(code.to)->word = old;
}

template <class N>
void Invocation<N>::use_image(const Code& code) {
  const Resource<N>& r = resource(code, at(code.in[0])[0]);
  Slot<N>* const to = at(code.to);
  const auto whole = [&](std::size_t operand, std::uint32_t k) { return std::int64_t{signed_word(at(code.in[operand])[k].word)}; };
  N texel[4];
  const auto give = [&] {
    for (std::uint32_t k = 0; k < 4; ++k) {
      to[k].number = texel[k];
      // In a trace a texel also depends on its coordinates.
      if constexpr (std::is_same_v<N, perturbed::Perturbed>) {
        const Slot<N>* const place = at(code.in[1]);
        if (trace_ && texel[k].node() >= 0)
          to[k].number = N::met(perturbed::Op::lookup, texel[k], texel[k], place[0].number, place[1].number);
      }
    }
  };
  switch (code.op) {
    case Op::ImageWrite:
    case Op::ImageRead: {
      if (r.storage == nullptr) module_.refuse(code, op_name(code.op) + " has no storage image");
      const std::int64_t x = whole(1, 0), y = whole(1, 1);
      const bool is_inside = x >= 0 && y >= 0 && x < r.storage->width() && y < r.storage->height();
      if (code.op == Op::ImageRead) {
        if (is_inside) r.storage->read(static_cast<int>(x), static_cast<int>(y), texel);
        return give();
      }
      std::array<Slot<N>, 4> stored;
      copy(at(code.in[2]), code.m, stored.data());
      for (std::uint32_t k = 0; k < code.m; ++k) texel[k] = stored[k].number;
      if (is_inside) r.storage->write(static_cast<int>(x), static_cast<int>(y), texel, static_cast<int>(code.m));
      return;
    }
    case Op::ImageQuerySize:
    case Op::ImageQuerySizeLod: {
      std::int64_t width = 0, height = 0;
      if (r.storage != nullptr) {
        width = r.storage->width();
        height = r.storage->height();
      } else if (r.image != nullptr) {
        const Texture& t = r.image->texture;
        const std::int64_t level = code.op == Op::ImageQuerySizeLod ? whole(1, 0) : 0;
        if (level < 0 || level >= t.levels) module_.refuse(code, fmt::format("mip level {} of {} is asked for", level, t.levels));
        width = t.width[level];
        height = t.height[level];
      }
      to[0].word = word_of(width);
      to[1].word = word_of(height);
      return;
    }
    default:
      break;
  }
  if (r.image == nullptr) module_.refuse(code, op_name(code.op) + " has no sampled image");
  const SampledImage& image = *r.image;
  if (code.op == Op::ImageQueryLevels) {
    to->word = static_cast<std::uint32_t>(image.texture.levels);
  } else if (code.op == Op::ImageFetch) {
    const bool moves = (code.sub & 2) != 0;
    numbers::fetch_texel(image, whole(1, 0) + (moves ? whole(3, 0) : 0), whole(1, 1) + (moves ? whole(3, 1) : 0),
                         code.sub & 1 ? whole(2, 0) : 0, texel);
    give();
  } else {
    const Slot<N>* const place = at(code.in[1]);
    const bool moves = code.sub != 0;
    const std::int64_t dx = moves ? whole(3, 0) : 0, dy = moves ? whole(3, 1) : 0;
    constexpr std::int64_t most = 64;
    if (dx < -most || dx > most || dy < -most || dy > most)
      module_.refuse(code, fmt::format("an offset of ({}, {}) texels is not executed", dx, dy));
    if ((dx != 0 || dy != 0) && image.texture.levels > 1)
      module_.refuse(code, "a lookup with an offset in an image of several levels is not executed");
    if (!image.is_linear && image.texture.levels > 1)
      module_.refuse(code, "an unfiltered lookup in an image of several levels is not executed");
    numbers::sample(image, place[0].number, place[1].number, at(code.in[2])->number, static_cast<int>(dx), static_cast<int>(dy), texel);
    give();
  }
}

}  // namespace rainref::spirv
