// A report as one HTML file that needs nothing beside it: the data, the drawing code of
// study/page/web, and the libraries that draw (Chart.js, three.js), compiled in.
#pragma once

#include <string>
#include <string_view>

#include "study/page/moving_run.h"

namespace linkstudy {

struct PageTexts {
  std::string_view frame;  // with @style@, @libraries@, @data@, @script@ and @title@
  std::string_view style;
  std::string_view libraries;
  std::string_view script;
};

// Written by CMake.
const PageTexts& page_texts();

std::string page_of(const StudyResults& results, const MovingRuns& again);

}  // namespace linkstudy
