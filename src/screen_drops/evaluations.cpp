#include "screen_drops/info.h"

#include "drops/info.h"
#include "pass/display.h"
#include "pass/model.h"
#include "screen_drops/flow.h"
#include "screen_drops/scalar.h"

namespace rainref::screen_drops {
namespace {

using capture::PassCase;
using capture::PassModel;

std::unique_ptr<PassModel> bind_drops(const PassCase& c) {
  return c.corrected() ? pass::bind<DropsPass, scalar::DropsPassText>(c)
                       : pass::bind<PublishedDropsPass, scalar::PublishedDropsPassText>(c);
}

}  // namespace

std::vector<capture::PassEvaluations> flow_evaluations() {
  return {drops::spawn_evaluations(),
          {"integrate", drops::bind_integrate},
          {"necks", drops::bind_necks},
          {"merge", drops::bind_merge},
          {"splat", drops::bind_splat}};
}

const std::vector<capture::PassEvaluations>& evaluations() {
  static const std::vector<capture::PassEvaluations> all = [] {
    std::vector<capture::PassEvaluations> passes = flow_evaluations();
    for (const capture::PassEvaluations& own :
         {capture::PassEvaluations{"background", pass::bind<BackgroundPass, scalar::BackgroundPassText>},
          {"cells", pass::bind<CellsPass, scalar::CellsPassText>},
          {"drops", bind_drops},
          {"display", pass::bind_display}})
      passes.push_back(own);
    return passes;
  }();
  return all;
}

}  // namespace rainref::screen_drops
