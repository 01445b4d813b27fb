#include "core/simulation/trial_trace.h"

#include "core/base/flush_denormals.h"
#include "core/simulation/inside_step.h"
#include "core/simulation/trial_step.h"

namespace linkstudy {
namespace {

TrialSlots slots_of(const Mechanism& m, const std::vector<Known>& known,
                    const std::vector<Channel>& observed) {
  return {m, static_cast<int>(known.size()), static_cast<int>(observed.size())};
}

Parameters<Traced> trace_parameters(codegen::Graph& graph, const Parameters<double>& sizes,
                                    const std::vector<Known>& known) {
  int slot = TrialSlots::parameters;
  return traced_parameters(graph, sizes, known, slot);
}

template <class Part>
void read(const TrialSlots& slots, codegen::Graph& graph, Part& part) {
  part.for_read(slots, [&graph](int first, Traced* x, int n) {
    for (int k = 0; k < n; ++k) x[k] = Traced::from(graph.input(first + k));
  });
}

template <class Part>
void write(const TrialSlots& slots, Part& part, codegen::Graph& graph) {
  part.for_written(slots, [&graph](int first, const Traced* x, int n) {
    for (int k = 0; k < n; ++k) graph.write(x[k].value, first + k);
  });
}

}  // namespace

StepTrace trace_trial(const Mechanism& m, const Parameters<double>& sizes,
                      const std::vector<Known>& known, const std::vector<Channel>& observed,
                      bool rows_may_depend) {
  const FlushDenormals flush;
  StepTrace traced;
  const codegen::Trace tracing(traced.graph);
  const TrialSlots slots = slots_of(m, known, observed);
  const Parameters<Traced> p = trace_parameters(traced.graph, sizes, known);
  TrialStep<Traced> trial(m, p);
  if (!rows_may_depend) trial.take_rows_as_clear();
  read(slots, traced.graph, trial);
  trial.advance();
  write(slots, trial, traced.graph);
  // What is folded may hide that something is no number.
  traced.graph.require(is_finite(trial.error()).value);
  traced.graph.write(traced.graph.required(), slots.fine);
  traced.slots.fine = slots.fine;
  traced.slots.end = slots.count;
  return traced;
}

StepTrace trace_inside(const Mechanism& m, const Parameters<double>& sizes,
                       const std::vector<Known>& known, const std::vector<Channel>& observed,
                       bool rows_may_depend) {
  const FlushDenormals flush;
  StepTrace traced;
  const codegen::Trace tracing(traced.graph);
  const TrialSlots slots = slots_of(m, known, observed);
  const Parameters<Traced> p = trace_parameters(traced.graph, sizes, known);
  InsideStep<Traced> inside(m, p, observed.data(), static_cast<int>(observed.size()));
  if (!rows_may_depend) inside.take_rows_as_clear();
  read(slots, traced.graph, inside);
  inside.look();
  write(slots, inside, traced.graph);
  traced.graph.require((inside.moves() > Traced(0.5)).value);
  traced.graph.write(traced.graph.required(), slots.instant_fine);
  traced.slots.fine = slots.instant_fine;
  traced.slots.end = slots.count;
  return traced;
}

}  // namespace linkstudy
