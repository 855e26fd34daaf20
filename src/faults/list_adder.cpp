#include "faults/list_adder.h"

#include <algorithm>

#include "faults/members.h"

namespace rainref::faults {

using capture::PassCase;
using scene::Member;

List::List(const PassCase& c, std::size_t o) : output(o), name(c.outputs[o].name), layout(c.outputs[o].array.record) {
  for (const Member& m : layout.members) {
    if (m.name == "id")
      id = m.offset;
    else if (!is_padding(m))
      fields.push_back(m);
  }
}

std::map<std::uint32_t, std::vector<std::byte>> List::taken(const PassCase& c) const {
  std::map<std::uint32_t, std::vector<std::byte>> out;
  const capture::CaseInput* in = c.input(name);
  if (!in || !in->array.is_records || in->array.record.size != layout.size) return out;
  for (std::vector<std::byte>& r : records_of(in->array)) out.emplace(id_of(r), std::move(r));
  return out;
}

std::size_t List::place(const Records& records, std::uint32_t of) const {
  return static_cast<std::size_t>(std::find_if(records.begin(), records.end(), [&](const auto& r) { return id_of(r) == of; }) -
                                  records.begin());
}

Fault& Adder::add(Kind kind, Alter alter, std::vector<std::string> more) {
  more.insert(more.begin(), list_.name);
  Fault& d = out_.emplace_back(What{kind, std::move(more)}, false);
  d.list_output = static_cast<int>(list_.output);
  d.alter_list = [list = list_, alter](const PassCase& c, ListEdit& e) { return alter(list, c, e); };
  return d;
}

}  // namespace rainref::faults
