// Mistakes in a list of records matched by their ids: what an append, a compaction or a struct of arrays gets wrong.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "capture/pass_model.h"
#include "faults/fault.h"

namespace rainref::faults {

/// Of a list and back; array_of() takes everything but the records from `like`.
Records records_of(const capture::Array& list);
capture::Array array_of(const Records& records, const capture::Array& like);
/// The key of a record whose layout has one.
std::uint32_t id_of(const std::vector<std::byte>& record, const scene::UniformBlock& layout);

/// Adds the mistakes that can be made in the case's keyed lists. `before`: the run of the same pass before, or null.
void add_list_faults(std::vector<Fault>& out, const capture::PassCase& c, const capture::PassCase* before);
/// Literals and uniforms that a model meets for at least every other record of a keyed list. Sorted.
std::vector<float> constants_of_lists(const capture::PassModel& model, const capture::PassCase& c);

/// The list that a port with this mistake stores in place of `finished`, which is c.outputs[output] as the reference gives
/// it, in the order of the port's slots. `at`: the ids to which a mistake of few records happens; empty: some that show
/// it. `port`: what a port stored, for mistakes that are fitted to it; null: none. Nothing where the mistake does not
/// concern the list or cannot happen here. Throws Error when the altered case cannot be bound. `model` may be null.
std::optional<capture::Array> faulty_list(const Fault& d, const capture::PassCase& c, std::size_t output,
                                          const capture::PassEvaluations& evaluations, const capture::PassModel* model,
                                          const capture::Array& finished, const std::vector<std::uint32_t>& at = {},
                                          const Records* port = nullptr);

}  // namespace rainref::faults
