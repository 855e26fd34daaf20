// A pass that treats each record of a list separately, bound to a captured case, for the judge to evaluate its list.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "pass/model.h"

namespace rainref::pass {

/// Returns whether a record stays in the list: lives() of the text's result, if it has that.
template <class Given>
auto lives(const Given& given) {
  if constexpr (requires { given.lives(); })
    return given.lives();
  else
    return true;
}
inline enclosed::Enclosure settled(const enclosed::Enclosure& e) { return e; }
inline enclosed::Enclosure settled(const enclosed::Rearranged& r) { return r.settled(); }
template <class State>
capture::KeyedRecord keyed_record(const State& given, bool lives, std::uint32_t id) {
  capture::KeyedRecord out{id, lives, {}, {}};
  State::each(given, [&](const auto& number) { out.floats.push_back(settled(number)); });
  return out;
}

/// True if P takes records, or makes one from its uniforms alone.
template <class P>
constexpr bool changes_records = [] {
  bool found = false;
  const typename P::template Io<Declared> io;
  each<P>(io, [&](const auto& m) {
    found = found || (
                         requires { m.outs; } && requires { m.from; });
  });
  return found;
}();

/// A group is one record.
template <class P, class Text>
class RecordModel : public capture::KeyedModel {
 public:
  using Record = typename P::Record;
  /// records: the input records, or one without content.
  RecordModel(Bound<P, Text> pass, std::vector<Record> records) : pass_(std::move(pass)), records_(std::move(records)) {}
  int groups() const override { return static_cast<int>(records_.size()); }
  const std::vector<capture::FieldRange>& ranges() const override { return Record::ranges(pass_.corrected); }
  void enclose(int group, std::vector<capture::KeyedRecord>& out) const override { add<enclosed::Enclosure>(group, out); }
  bool rearrange(int group, std::vector<capture::KeyedRecord>& out) const override {
    add<enclosed::Rearranged>(group, out);
    return true;
  }
  std::optional<std::vector<std::byte>> reference() const override { return list<scalar::Scalar<float>>(); }
  std::optional<std::vector<std::byte>> perturbed() const override { return list<perturbed::Perturbed>(); }

 private:
  /// Calls f(result of the text for record i).
  template <class N, class F>
  void with_given(std::size_t i, const F& f) const {
    const auto run = [&](auto is_corrected) {
      if constexpr (changes_records<P>)
        f(pass_.template record<N, is_corrected()>(records_[i]));
      else
        f(pass_.template record<N, is_corrected()>());
    };
    if constexpr (P::about.corrected.revision != 0)
      if (pass_.corrected) return run(std::true_type());
    if constexpr (P::about.as_published.revision != 0) run(std::false_type());
  }
  template <class N>
  void add(int group, std::vector<capture::KeyedRecord>& out) const {
    const auto i = static_cast<std::size_t>(group);
    with_given<N>(i, [&](const auto& given) { out.push_back(keyed_record(given, lives(given), records_[i].id)); });
  }
  template <class N>
  std::vector<std::byte> list() const {
    std::vector<Record> all;
    for (std::size_t i = 0; i < records_.size(); ++i) {
      if constexpr (std::is_same_v<N, perturbed::Perturbed>) perturbed::begin_record([&] { with_given<N>(i, [](const auto&) {}); });
      with_given<N>(i, [&](const auto& given) {
        if (lives(given)) all.push_back(stored(given, records_[i]));
      });
    }
    return bytes_of(all);
  }
  Bound<P, Text> pass_;
  std::vector<Record> records_;
};
/// For a pass that writes no image.
template <class P, class Text>
std::unique_ptr<capture::PassModel> bind_records(const capture::PassCase& c) {
  Bound<P, Text> pass = bound<P, Text>(c);
  std::string output;
  std::vector<typename P::Record> records(1);
  each<P>(pass.captured, [&](const auto& member) {
    if constexpr (requires { member.out; }) {
      output = member.out.name;
      records = member.records;
    } else if constexpr (
        requires { member.is.sentence; } && !requires { member.formats; }) {
      output = member.is.name;
    }
  });
  return std::make_unique<capture::ListPass>(output, std::make_unique<RecordModel<P, Text>>(std::move(pass), std::move(records)));
}

}  // namespace rainref::pass
