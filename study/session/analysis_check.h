// Results of statics and kinematics against the program: the analysis is made again from the model
// that they hold, and every number, position and table compared.
#pragma once

#include "study/session/verification.h"

namespace linkstudy {

// Numbers, coordinates and tables agree to the last bit. Of statics, where the instruction set of
// the results rounds otherwise, numbers with a unit agree to 1e-6 of the greatest of it, and tables
// are not compared. Throws StoreError and InputError.
Verification verify_analysis(const StudyResults& results, AnswerKind kind);

}  // namespace linkstudy
