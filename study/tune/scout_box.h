// Where no point of the scan matches and no start of NLopt comes to one: global searches of NLopt
// over the whole box for the least log10 max(error / tolerance), side by side (lockstep.h), until
// one of them sees a match: DIRECT (its locally biased form, which covers the box evenly first) and
// ISRES with seeds of their own. They find where to start anew; nothing else of them counts.
//
// They are trusted no more than in confirm_nlopt.h: budgets are counted here, what has a cause is
// 3 decades off, and an exception is kept, the search stopped, and the exception thrown from here.
#pragma once

#include "study/tune/evaluation_log.h"

namespace linkstudy::tuning {

// At most 150 evaluations for each variable, and none of the last `reserve`. Returns how many.
std::size_t scout_box(EvaluationLog& log, std::size_t reserve);

}  // namespace linkstudy::tuning
