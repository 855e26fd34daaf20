// A pass bound to a captured case, made from its definition, for the judge to evaluate. record_model.h handles lists record by record.
#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "capture/bound_texture.h"
#include "capture/pass_model.h"
#include "pass/fit.h"
#include "pass/number_cursors.h"
#include "pass/stored_record.h"
#include "rainref/error.h"
#include "rainref/executor.h"
#include "scene/uniform_block.h"

namespace rainref::pass {

/// The arrays of a case, decoded.
struct Captured {
  template <Format f, int around = 0>
  struct Texels {
    In is;
    std::shared_ptr<const std::vector<DecodedOf<f>>>
        texels;  ///< row-major, with `around` copies of the nearest texel before and behind each row
    std::shared_ptr<const enclosed::UncertainValues> uncertain;  ///< null: they are exact
    int width = 0, height = 0;
    static constexpr std::array formats{f};
    static constexpr int channels = StorageOf<f>::channels;

    Texels(In in) : is(in) {}
    void read(const capture::CaseInput& input) {
      width = input.array.width;
      height = input.array.height;
      if constexpr (std::is_same_v<DecodedOf<f>, float> && around == 0) {
        if (!input.array.uncertain) {
          texels = capture::shared_decoded(input.array);
          return;
        }
        // A copy of its own: other models read the same array as it is.
        texels = std::make_shared<const std::vector<float>>(capture::decoded(input.array));
        uncertain = std::make_shared<const enclosed::UncertainValues>(texels->data(), input.array.uncertain);
        return;
      }
      capture::require_certain(input);
      if constexpr (std::is_same_v<DecodedOf<f>, Unorm8>)
        frame(reinterpret_cast<const Unorm8*>(input.array.levels.at(0).data()));
      else
        frame(capture::shared_decoded(input.array)->data());
    }
    /// Column x of row y, or of the nearest row.
    const DecodedOf<f>* at(int x, int y) const {
      return texels->data() + channels * (static_cast<std::ptrdiff_t>(std::clamp(y, 0, height - 1)) * (width + 2 * around) + around + x);
    }

   private:
    void frame(const DecodedOf<f>* from) {
      std::vector<DecodedOf<f>> framed(static_cast<std::size_t>(channels) * static_cast<std::size_t>(width + 2 * around) *
                                       static_cast<std::size_t>(height));
      auto to = framed.begin();
      for (int y = 0; y < height; ++y)
        for (int x = -around; x < width + around; ++x)
          to = std::copy_n(from + channels * (static_cast<std::ptrdiff_t>(y) * width + std::clamp(x, 0, width - 1)), channels, to);
      texels = std::make_shared<const std::vector<DecodedOf<f>>>(std::move(framed));
    }
  };
  struct Sampled {
    In is;
    capture::BoundTexture bound;
    Texture texture;
    Sampled(In in) : is(in) {}
    void read(const capture::CaseInput& input) {
      bound = capture::BoundTexture(input);
      texture = bound.view();
    }
  };
  template <Format f>
  struct Stored : Sampled {
    static constexpr std::array formats{f};
    using Sampled::Sampled;
  };
  template <Format... f>
  struct Planes {
    static constexpr std::array formats{f...};
    In is;
    pass::Planes planes;
    Planes(In in) : is(in) {}
    void read(const capture::CaseInput& input) { planes = pass::Planes(input); }
  };
  template <class Record>
  struct Records {
    In is;
    std::vector<Record> records;
    std::vector<std::vector<Record>> near;  ///< records that may count in each block of texels; empty: all of them everywhere
    int columns = 0;                        ///< number of blocks in a row
    Records(In in) : is(in) {}
    void read(const capture::CaseInput& input) { records = capture::records_of<Record>(input); }
    /// of_tile(records, tile): those of them that may count in a tile.
    template <class Near>
    void choose(int width, int height, const Near& of_tile) {
      columns = (width + block - 1) / block;
      near.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>((height + block - 1) / block));
      if (!near.empty()) choose_in({0, 0, width, height}, records, of_tile);
    }
    /// reaches_all: also records that change nothing there unless a mistake makes them.
    std::span<const Record> at(int x, int y, bool reaches_all) const {
      if (near.empty() || reaches_all) return records;
      return near[static_cast<std::size_t>(y / block) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(x / block)];
    }

   private:
    static constexpr int block = 8;  // texels a side

    // What is near a block is near each tile around it: halves of a tile ask what is near the whole, so that a record costs the tiles that
    // it reaches.
    template <class Near>
    void choose_in(const parallel::Tile& t, std::span<const Record> around, const Near& of_tile) {
      std::vector<Record> here = of_tile(around, t);
      const int width = t.x1 - t.x0, height = t.y1 - t.y0;
      const auto middle = [](int from, int size) { return from + (size / 2 + block - 1) / block * block; };
      if (width <= block && height <= block) {
        near[static_cast<std::size_t>(t.y0 / block) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(t.x0 / block)] =
            std::move(here);
      } else if (width > height) {
        const int x = middle(t.x0, width);
        choose_in({t.x0, t.y0, x, t.y1}, here, of_tile);
        choose_in({x, t.y0, t.x1, t.y1}, here, of_tile);
      } else {
        const int y = middle(t.y0, height);
        choose_in({t.x0, t.y0, t.x1, y}, here, of_tile);
        choose_in({t.x0, y, t.x1, t.y1}, here, of_tile);
      }
    }
  };
  template <class Record>
  struct List {
    Out is;
    List(Out both) : is(both) {}
  };
  template <class Record>
  struct Changed {
    In is;
    Out out;
    std::vector<Record> records;
    Changed(In in, Out both) : is(in), out(both) {}
    Changed(In in, Out as_published, Out) : is(in), out(as_published) {}
    void read(const capture::CaseInput& input) { records = capture::records_of<Record>(input); }
  };
  template <Format... f>
  struct Result {
    static constexpr std::array formats{f...};
    Out is;
    int channels = info(formats.front()).channels;
    Rounding rounding = Rounding::rne;  ///< of the store
    bool is_given = true;
    Result(Out both) : is(both) {}
    Result(Out as_published, Out) : is(as_published) {}
  };
};

/// The first output that is an image; null if all are lists.
const capture::Array* first_image(const capture::PassCase& c);
/// Throws Error(port_files) unless the image has the channels of one of these formats, is stored as codes if it is loaded as codes, and has
/// the size of the outputs if it must.
void require_image(const capture::PassCase& c, const capture::CaseInput& image, std::span<const Format> formats, bool is_loaded,
                   bool has_size);

/// Contents of a case, by the names of the definition. width and height: of the images that the pass writes.
template <class P>
struct Inputs {
  int width, height, values = 0;
  typename P::Uniforms uniforms;
  bool corrected;
  typename P::template Io<Captured> captured;
};

/// Text: the arithmetic of P in the namespace of every number type except lanes.
template <class P, class Text>
struct Bound : Inputs<P> {
  /// Calls f(io) with the cursors of an invocation, which write to out.
  template <class N, class F>
  auto with_cursors(int x, int y, N* out, const F& f) const {
    typename P::template Io<NumberCursors<N>> io;
    each<P>(this->captured, io, [&](const auto& from, auto& to) {
      if constexpr (requires { to.out; }) {
        to.out = out;
        to.channels = from.channels;
        to.rounding = from.rounding;
        if (out && from.is_given) out += from.channels;  // null: a pass over records writes no texels
      } else if constexpr (requires { to.texture; }) {
        to.texture = &from.texture;
      } else if constexpr (requires { to.records; }) {
        to.records = from.at(x, y, to.takes(false));
      } else if constexpr (requires { to.planes; }) {
        to.planes = &from.planes;
        to.y = y;
      } else if constexpr (requires { to.x; }) {
        to.x = x;
        if (from.width == 0) return;  // not in this variant
        for (int k = 0; k < to.rows; ++k) to.row[k] = from.at(0, y + k - to.reach);
      }
    });
    return f(io);
  }
  /// Finds the input that a lookup reads, by a pointer to a channel of its first texel.
  std::string_view input_of(const float* texel) const {
    std::string_view found;
    each<P>(this->captured, [&](const auto& m) {
      if constexpr (requires { m.texture; })
        if (m.texture.texels && texel >= m.texture.texels && texel < m.texture.texels + m.texture.channels) found = m.is.name;
    });
    return found;
  }
  template <class N>
  void operator()(int x, int y, N* out) const {
    with_cursors(x, y, out, [&](const auto& io) {
      const auto run = [&](auto is_corrected) {
        if constexpr (requires { Text::views(io); })
          Text::template run<N, is_corrected()>(this->uniforms, io, Text::views(io), x, y);
        else
          Text::template run<N, is_corrected()>(this->uniforms, io, x, y);
      };
      if constexpr (P::about.corrected.revision != 0)
        if (this->corrected) return run(std::true_type());
      if constexpr (P::about.as_published.revision != 0) run(std::false_type());
    });
  }
  /// Result of the text for a record, or for its only record if it takes none.
  template <class N, bool is_corrected, class Record>
  auto record(const Record& from) const {
    return with_cursors(0, 0, static_cast<N*>(nullptr), [&](const auto& io) {
      return Text::template run_record<N, is_corrected>(this->uniforms, io, loaded<typename Text::template State<N>>(from));
    });
  }
  template <class N, bool is_corrected>
  auto record() const {
    return with_cursors(0, 0, static_cast<N*>(nullptr),
                        [&](const auto& io) { return Text::template run_record<N, is_corrected>(this->uniforms, io); });
  }
};
/// Throws Error(port_files) if the pass does not run in the case's variant, or if the case lacks an input or has one of another shape.
template <class P>
Inputs<P> inputs_of(const capture::PassCase& c) {
  if ((c.corrected() ? P::about.corrected : P::about.as_published).revision == 0)
    throw Error(ExitCode::port_files, fmt::format("{}: {} does not run {}", c.folder(), P::about.name, c.variant));
  const capture::Array* given = first_image(c);
  Inputs<P> m{given ? given->width : 0, given ? given->height : 0, 0, capture::uniforms_of<typename P::Uniforms>(c), c.corrected(), {}};
  const scene::UniformBlock block = P::uniforms();
  each<P>(m.captured, [&](auto& member) {
    if constexpr (requires { member.is.from; }) {
      if (!is_of(member.is.variant, c.corrected()) || (member.is.optional && !c.input(member.is.name))) return;
      if constexpr (requires { member.records; }) {
        member.read(capture::record_input(c, member.is.name));
        std::string fault = records_fault(block, c.uniforms, member.is, member.records.size());
        if constexpr (requires { member.out; })
          if (fault.empty()) fault = ids_fault(member.is.name, member.records);
        if (!fault.empty()) throw Error(ExitCode::port_files, c.folder() + ": " + fault);
      } else {
        const capture::CaseInput& image = capture::image_input(c, member.is.name);
        if constexpr (requires { member.formats; }) {
          constexpr bool is_loaded = requires { member.texels; }
          || requires { member.planes; };
          require_image(c, image, member.formats, is_loaded, member.is.same_size || is_loaded);
        }
        member.read(image);
      }
    } else if constexpr (requires { member.formats; }) {
      member.is_given = is_of(member.is.variant, c.corrected());
      if (const capture::CaseOutput* output = c.output(member.is.name)) {
        member.rounding = output->store_rounding;
        if (member.formats.size() > 1) member.channels = info(output->array.format).channels;
      }
      if (member.is_given) m.values += member.channels;
    }
  });
  if constexpr (requires { P::fault(m); }) {
    const std::string fault = P::fault(m);
    if (!fault.empty()) throw Error(ExitCode::port_files, c.folder() + ": " + fault);
  }
  if constexpr (requires { &P::near; }) {
    each<P>(m.captured, [&](auto& member) {
      if constexpr (requires(const parallel::Tile& t) {
                      member.near;
                      P::near(m.uniforms, member.records, m.corrected, m.width, t);
                    })
        member.choose(m.width, m.height, [&]<class Record>(std::span<const Record> some, const parallel::Tile& t) {
          return P::near(m.uniforms, some, m.corrected, m.width, t);
        });
    });
  }
  return m;
}
template <class P, class Text>
Bound<P, Text> bound(const capture::PassCase& c) {
  return {inputs_of<P>(c)};
}
template <class P, class Text>
class BoundModel : public capture::ModelOf<Bound<P, Text>> {
 public:
  using capture::ModelOf<Bound<P, Text>>::ModelOf;
  bool chooses_records() const override {
    bool is_any = false;
    each<P>(this->pass().captured, [&](const auto& member) {
      is_any |= requires { member.records; };
    });
    return is_any;
  }
  bool rounds_inside() const override {
    if constexpr (requires { P::rounds_inside(this->pass().uniforms); })
      return P::rounds_inside(this->pass().uniforms);
    else
      return false;
  }
};
template <class P, class Text>
std::unique_ptr<capture::PassModel> bind(const capture::PassCase& c) {
  return std::make_unique<BoundModel<P, Text>>(bound<P, Text>(c));
}

}  // namespace rainref::pass
