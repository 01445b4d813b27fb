#include "study/tune/tuning_result.h"

namespace linkstudy::tuning {

TuningStatus status_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::certified:
      return TuningStatus::certified;
    case Verdict::refuted:
      return TuningStatus::refuted;
    case Verdict::inconclusive:
      break;
  }
  return TuningStatus::inconclusive;
}

}  // namespace linkstudy::tuning
