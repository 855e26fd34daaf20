// A run of a pass, made from its definition: checked, computed tile by tile, timed and recorded.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "capture/pass_clock.h"
#include "pass/definition.h"
#include "pass/fit.h"
#include "pass/moment.h"
#include "rainref/error.h"
#include "rainref/executor.h"

namespace rainref::pass {

/// Rows of a tile in the SIMD target in use; RAINREF_PASS_DISPATCH makes one for each pass.
template <class P>
void rows(const typename P::Uniforms& uniforms, bool corrected, Rounding rounding, const HostIo<P>& io, const parallel::Tile& tile);

/// One run of P. Its inputs must not be written before start() is called; finish() records its outputs.
template <class P>
class Run {
 public:
  /// Throws Error(internal) if the variant does not run P, an image is missing or differs in format or size, or a uniform counts more
  /// records than exist.
  Run(const typename P::Uniforms& uniforms, bool corrected, Rounding rounding, const HostIo<P>& io)
      : uniforms_(uniforms), corrected_(corrected), rounding_(rounding), io_(io) {
    if ((corrected ? P::about.corrected : P::about.as_published).revision == 0)
      throw Error(ExitCode::internal, fmt::format("{} does not run {}", P::about.name, corrected ? "corrected" : "as-published"));
    const Image* first = nullptr;
    each<P>(io_, [&](const auto& member) {
      const auto misfit = [&](std::string_view why) {
        throw Error(ExitCode::internal, fmt::format("{}: {} {}", P::about.name, member.is.name, why));
      };
      bool is_needed = is_of(member.is.variant, corrected);
      if constexpr (requires { member.is.optional; }) is_needed = is_needed && !member.is.optional;
      if constexpr (requires { member.view; }) {
        if (is_needed && !member.view.texels) misfit("is missing");
        if (member.image && member.image->format() != member.format) misfit("has another format");
      } else if constexpr (requires { member.records; }) {
        if (is_needed && !member.is_set) misfit("is missing");
        if (!member.is_set) return;
        static const scene::UniformBlock block = P::uniforms();
        const std::string fault = records_fault(block, std::as_bytes(std::span(&uniforms, 1)), member.is, member.records.size());
        if (!fault.empty()) misfit("does not fit: " + fault);
      } else if constexpr (requires { member.input; }) {
        if (is_needed && !member.input) misfit("is missing");
      } else if constexpr (requires { member.list; }) {
        if (is_needed && !member.list) misfit("is missing");
      } else if constexpr (requires { member.image; }) {
        if constexpr (requires { member.planes; })
          if (member.planes) return;
        if (!member.image) return is_needed ? misfit("is missing") : void();
        if (!first) first = member.image;
        if (std::find(member.formats.begin(), member.formats.end(), member.image->format()) == member.formats.end())
          misfit("has another format");
        if (member.image->width() != first->width() || member.image->height() != first->height()) misfit("has another size");
      } else if (is_needed && !member.texture && !member.recorded) {
        misfit("is missing");
      }
    });
    if (!first) return;
    width_ = first->width();
    height_ = first->height();
    each<P>(io_, [&](const auto& member) {
      if constexpr (requires { member.view; })
        if (member.is.same_size && member.image && (member.image->width() != width_ || member.image->height() != height_))
          throw Error(ExitCode::internal, fmt::format("{}: {} has another size", P::about.name, member.is.name));
    });
  }

  /// Computes some of its texels; thread-safe.
  void tile(const parallel::Tile& t) {
    clock_.add([&] {
      if constexpr (requires { &P::near; })
        rows<P>(uniforms_, corrected_, rounding_, near(io_, t), t);
      else
        rows<P>(uniforms_, corrected_, rounding_, io_, t);
    });
  }
  /// The same with `body` in place of the pass's own rows; body() must give the same values.
  template <class Body>
  void tile(const Body& body) {
    clock_.add(body);
  }
  /// Computes all texels. tile_columns 0: whole rows.
  void tiles(const parallel::Executor& executor, int tile_rows, int tile_columns = 0) {
    const capture::Stopwatch watch;
    if (tile_columns <= 0) tile_columns = width_;
    if constexpr (requires { &P::near; }) {
      // Records near a tile are near its band of rows: each band searches the whole list, and its tiles search the band's list.
      executor.for_tiles(width_, height_, width_, tile_rows, [&](const parallel::Tile& band) {
        const HostIo<P> io = near(io_, band);
        for (int x = band.x0; x < band.x1; x += tile_columns) {
          const parallel::Tile t{x, band.y0, std::min(x + tile_columns, band.x1), band.y1};
          rows<P>(uniforms_, corrected_, rounding_, near(io, t), t);
        }
      });
    } else {
      executor.for_tiles(width_, height_, tile_columns, tile_rows,
                         [&](const parallel::Tile& t) { rows<P>(uniforms_, corrected_, rounding_, io_, t); });
    }
    seconds_ += watch.seconds();
  }
  void start(const Moment& m) const {
    if (!m.recorder) return;
    std::vector<PassInput> inputs;
    each<P>(io_, [&](const auto& member) {
      if constexpr (requires { member.record_bytes; }) {
        if (member.list) inputs.push_back({member.is.name, records_of(m, member)});
      } else if constexpr (requires { member.texture; }) {
        const Address address = member.texture ? member.texture->address_u : member.address;
        if (member.recorded)
          inputs.push_back({member.is.name, *member.recorded, member.is.filter, member.is.mip_filter, address});
        else if (member.texture)
          inputs.push_back({member.is.name, member.texture, member.is.filter, member.is.mip_filter});
      } else if constexpr (requires { member.view; }) {
        if (member.image)
          inputs.push_back({member.is.name, BufferView(*member.image), member.is.filter, member.is.mip_filter, member.address});
        else if (!member.levels.empty())
          inputs.push_back({member.is.name, member.levels, member.is.filter, member.is.mip_filter, member.address});
      } else if constexpr (requires { member.records; }) {
        if (member.is_set)
          inputs.push_back({member.is.name, RecordView{member.records.data(), member.records.size(), sizeof member.records[0]}});
      } else if constexpr (requires { member.input; }) {
        if (member.input) inputs.push_back(*member.input);
      } else if constexpr (requires { member.is.from; }) {
        if (member.image) inputs.push_back({member.is.name, BufferView(*member.image), member.is.filter, member.is.mip_filter});
      }
    });
    m.before(P::about.name, uniforms_, std::span<const PassInput>(inputs));
  }
  /// more: additional host time [s]; threads: number that worked on its tiles.
  void finish(const Moment& m, int threads = 1, double more = 0) const {
    if (!m.recorder) return;
    std::vector<PassOutput> outputs;
    each<P>(io_, [&](const auto& member) {
      if constexpr (requires { member.record_bytes; }) {
        if (member.list) outputs.push_back({member.is.name, records_of(m, member)});
      } else if constexpr (requires { member.list; }) {
        outputs.push_back({member.is.name, member.list()});
      } else if constexpr (requires { member.is.sentence; }) {
        if (member.planes || member.image) outputs.push_back({member.is.name, member.planes ? *member.planes : BufferView(*member.image)});
      }
    });
    m.after(P::about.name, std::span<const PassOutput>(outputs), seconds_ + clock_.seconds(threads) + more);
  }

 private:
  /// Done on demand, because listing records costs more than some passes.
  template <class Changed>
  static RecordView records_of(const Moment& m, const Changed& member) {
    return m.is_read(P::about.name) ? member.list() : RecordView{nullptr, 0, member.record_bytes};
  }
  /// The lists that P selects from, with the records that may count in a tile.
  HostIo<P> near(const HostIo<P>& all, const parallel::Tile& t) const {
    HostIo<P> io = all;
    each<P>(io, [&](auto& member) {
      if constexpr (requires {
                      member.near;
                      P::near(uniforms_, member.records, corrected_, width_, t);
                    })
        member.choose(P::near(uniforms_, member.records, corrected_, width_, t));
    });
    return io;
  }

  typename P::Uniforms uniforms_;
  bool corrected_;
  Rounding rounding_;
  HostIo<P> io_;
  int width_ = 0, height_ = 0;
  capture::PassClock clock_;
  double seconds_ = 0;
};

}  // namespace rainref::pass
