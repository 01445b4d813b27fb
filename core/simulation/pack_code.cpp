#include "core/simulation/pack_code.h"

namespace linkstudy {

PackCode::PackCode(const Mechanism& m, std::span<const LaneCase> cases, long steps,
                   const SimdLevel& level, int lanes)
    : m_(m),
      cases_(cases),
      steps_(steps),
      level_(level),
      lanes_(lanes),
      packs_(static_cast<int>(cases.size()) > lanes ? 2 : 1),
      observed_(m, *cases[0].observers) {
  place(false, first_);
  if (!first_.written || first_.written->rows_may_depend || m.cut_rows.empty()) return;
  first_.code.context = this;
  first_.code.instead = [](void* pack) {
    return static_cast<PackCode*>(pack)->place_for_dependent_rows();
  };
}

const StepCode* PackCode::place_for_dependent_rows() {
  place(true, dependent_);
  return dependent_.written ? &dependent_.code : nullptr;
}

void PackCode::place(bool rows_may_depend, Placed& at) {
  at.written = written_step(m_, cases_, observed_.all(), steps_, level_, slot_numbers(lanes_),
                            rows_may_depend, packs_);
  if (!at.written) return;
  const int numbers = at.written->frame_slots * at.written->slot_numbers;
  at.frame = codegen::FrameNumbers(packs_ * numbers);
  at.written->put_constants(at.frame.data());
  at.code = {at.written->code.get(),
             at.written->slots,
             at.frame.data(),
             numbers,
             observed_.first().data(),
             observed_.beyond().data(),
             static_cast<int>(observed_.beyond().size())};
}

}  // namespace linkstudy
