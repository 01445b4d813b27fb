#include "core/simulation/step_trace.h"

#include "core/base/flush_denormals.h"
#include "core/codegen/traced.h"
#include "core/forces/contact_memory.h"
#include "core/numerics/runge_kutta.h"
#include "core/simulation/run_checks.h"
#include "core/simulation/run_state.h"

namespace linkstudy {
namespace {

class StepTracer {
 public:
  StepTracer(const Mechanism& m, const Parameters<double>& sizes, const std::vector<Known>& known,
             codegen::Graph& graph, bool rows_may_depend)
      : m_(m),
        graph_(graph),
        p_(traced_parameters(graph, sizes, known, slot_)),
        w_(make_workspace<Traced>(m)),
        checks_(m, p_),
        y_(static_cast<std::size_t>(state_size(m))),
        correction_(static_cast<std::size_t>(m.nv)),
        contact_steps_(m.contacts.size()),
        rk_(y_.size()) {
    w_.rows_may_depend = rows_may_depend;
  }

  StepSlots trace(const std::vector<Channel>& observed) {
    StepSlots slots;
    const Traced t = input(StepSlots::t), h = input(StepSlots::h);
    slots.state = slot_;
    read_state();
    differentiate(t, y_.data(), rk_.first_slope());
    const auto moving = checks_.moves(m_, y_.data(), w_);
    const auto closed = checks_.is_closed(m_, w_, input(StepSlots::drift_limit));
    std::vector<Traced> kept;
    for_kept_numbers<Traced>(
        w_, [&](const Traced* x, std::size_t n) { kept.insert(kept.end(), x, x + n); });
    const std::vector<Traced> samples = sample(t, observed);
    update_contact_memory(m_, w_, contact_steps_.data(), y_.data() + m_.nq + m_.nv, log_);
    rk_.advance(t, h, y_.data(), [this](Traced s, Traced* y, Traced* slope) {
      impose_motions(m_, p_, s, y, y + m_.nq);
      differentiate(s, y, slope);
    });
    settle_state(m_, p_, t + h, y_.data(), correction_.data(), w_);
    slots.next = slot_;
    write_state();
    slots.fine = slot_;
    graph_.require((moving && closed).value);
    graph_.write(graph_.required(), slot_++);
    slots.kept = slot_;
    for (const Traced& x : kept) graph_.write(x.value, slot_++);
    slots.observed = slot_;
    for (const Traced& x : samples) graph_.write(x.value, slot_++);
    slots.end = slot_;
    return slots;
  }

 private:
  Traced input(int slot) { return Traced::from(graph_.input(slot)); }

  template <class F>
  void for_state(F&& f) {
    for_state_numbers<Traced>(y_, w_.memory, contact_steps_, log_, checks_.drift_max(), f);
  }
  void read_state() {
    for_state([this](Traced* x, std::size_t n) {
      for (std::size_t k = 0; k < n; ++k) x[k] = input(slot_++);
    });
  }
  void write_state() {
    for_state([this](const Traced* x, std::size_t n) {
      for (std::size_t k = 0; k < n; ++k) graph_.write(x[k].value, slot_++);
    });
  }

  std::vector<Traced> sample(Traced t, const std::vector<Channel>& observed) {
    Instant<Traced> now(m_, p_, w_);
    now.move_to(t, y_.data());
    now.set_initial_energy(input(StepSlots::initial_energy));
    std::vector<Traced> samples;
    for (const Channel& c : observed) samples.push_back(now.sample(c));
    return samples;
  }

  void differentiate(Traced t, const Traced* y, Traced* slope) {
    evaluate_state(m_, p_, t, y, w_);
    write_slopes(m_, y, w_, slope);
  }

  const Mechanism& m_;
  codegen::Graph& graph_;
  int slot_ = StepSlots::parameters;
  Parameters<Traced> p_;
  Workspace<Traced> w_;
  RunChecks<Traced> checks_;
  std::vector<Traced> y_, correction_, contact_steps_;
  ContactLog<Traced> log_;
  RungeKutta<ClassicalRungeKutta, Traced> rk_;
};

}  // namespace

StepTrace trace_step(const Mechanism& m, const Parameters<double>& sizes,
                     const std::vector<Known>& known, const std::vector<Channel>& observed,
                     bool rows_may_depend) {
  const FlushDenormals flush;
  StepTrace step;
  const codegen::Trace tracing(step.graph);
  step.slots = StepTracer(m, sizes, known, step.graph, rows_may_depend).trace(observed);
  return step;
}

}  // namespace linkstudy
