#include "core/simulation/trial_trace.h"

#include "core/base/flush_denormals.h"
#include "core/simulation/trial_step.h"

namespace linkstudy {

StepTrace trace_trial(const Mechanism& m, const Parameters<double>& sizes,
                      const std::vector<Known>& known) {
  const FlushDenormals flush;
  StepTrace traced;
  codegen::Graph& graph = traced.graph;
  const codegen::Trace tracing(graph);
  const TrialSlots slots(m, static_cast<int>(known.size()));
  int slot = TrialSlots::parameters;
  const Parameters<Traced> p = traced_parameters(graph, sizes, known, slot);
  TrialStep<Traced> trial(m, p);
  trial.for_read(slots, [&graph](int first, Traced* x, int n) {
    for (int k = 0; k < n; ++k) x[k] = Traced::from(graph.input(first + k));
  });
  trial.advance();
  trial.for_written(slots, [&](int first, const Traced* x, int n) {
    // Where something is no number, what is folded may hide it.
    if (first == slots.error) graph.require(is_finite(*x).value);
    for (int k = 0; k < n; ++k) graph.write(x[k].value, first + k);
  });
  graph.write(graph.required(), slots.fine);
  traced.slots.fine = slots.fine;
  traced.slots.end = slots.count;
  return traced;
}

}  // namespace linkstudy
