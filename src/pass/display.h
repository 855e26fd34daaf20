// The last pass of every effect but the puddle. The scene key is display.exposure.
#pragma once

#include <memory>
#include <string>

#include "capture/pass_info.h"
#include "capture/pass_model.h"
#include "image/code_table.h"
#include "pass/display.pass.h"
#include "pass/run.h"

namespace rainref::pass {

/// exposure: [EV].
DisplayUniforms display_uniforms(double exposure);
/// colour: rgba16f; picture: rgba8, alpha 1.
Run<DisplayPass> display_run(double exposure, Rounding rounding, const Image& colour, Image& picture);
/// The same by table, for pictures of this size.
CodeTable display_table(int width, int height, double exposure, Rounding rounding);

/// It reads the colour of the pass `from`.
capture::PassInfo display_info(const std::string& from);
std::unique_ptr<capture::PassModel> bind_display(const capture::PassCase& c);

}  // namespace rainref::pass
