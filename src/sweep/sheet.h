// A contact sheet: small pictures of the cells, side by side.
#pragma once

#include "rainref/image.h"
#include "sweep/table.h"

namespace rainref::sweep {

/// The last picture of each cell that has one, at most most_cells cells, row by row from the top; rgba8, row 0 on top. Each is reduced by
/// an integer factor until it is at most `largest` texels wide; texels are averaged in display code and rounded to nearest. Empty if no
/// cell has a picture. Throws Error.
Image contact_sheet(const Cells& cells, const Table& table, const Store& store, int most_cells = 400, int largest = 160);

}  // namespace rainref::sweep
