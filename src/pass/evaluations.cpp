#include "pass/display.h"
#include "pass/display_scalar.h"
#include "pass/model.h"

namespace rainref::pass {

std::unique_ptr<capture::PassModel> bind_display(const capture::PassCase& c) {
  const capture::CaseInput* colour = c.input("colour");
  if (colour && colour->array.format == Format::rgba8) return bind<DisplayOfCodesPass, scalar::DisplayOfCodesPassText>(c);
  return bind<DisplayPass, scalar::DisplayPassText>(c);
}

}  // namespace rainref::pass
