#include "core/simulation/written_steps.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>
#include <optional>
#include <utility>

#include "core/codegen/traced.h"
#include "core/simulation/trial_trace.h"

namespace linkstudy {
namespace {

// Writing takes as long as some hundred steps a freedom take in the general loop.
constexpr long kStepsPerFreedom = 500;
constexpr double kStepsPerTrial = 1.5;  // by evaluations
constexpr std::size_t kMostStructures = 64;

Known known_of(double x) {
  return x == 0.0    ? Known::zero
         : x == 1.0  ? Known::one
         : x == -1.0 ? Known::minus_one
                     : Known::varies;
}

std::vector<Known> known_in_all(std::span<const LaneCase> cases) {
  std::vector<Known> known;
  for (const LaneCase& c : cases) {
    std::size_t i = 0;
    for_parameter_numbers<double>(*c.parameters, [&](const double* x, std::size_t n) {
      for (std::size_t k = 0; k < n; ++k, ++i) {
        const Known here = known_of(x[k]);
        if (&c == &cases.front()) known.push_back(here);
        if (known[i] != here) known[i] = Known::varies;
      }
    });
  }
  return known;
}

// But for their names.
bool same_channels(const std::vector<Channel>& a, const std::vector<Channel>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Channel& x, const Channel& y) {
    return x.quantity == y.quantity && x.index == y.index && x.component == y.component &&
           x.body == y.body;
  });
}

// Code made for `code` is right for numbers of which `pack` is known.
bool serves(const std::vector<Known>& code, const std::vector<Known>& pack) {
  return std::equal(code.begin(), code.end(), pack.begin(), pack.end(),
                    [](Known a, Known b) { return a == Known::varies || a == b; });
}

std::vector<Known> known_in_both(std::vector<Known> a, const std::vector<Known>& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] != b[i]) a[i] = Known::varies;
  return a;
}

// None where the machine refuses executable memory.
std::optional<WrittenStep> place_code(const StepTrace& trace, int slot_numbers) {
  WrittenStep step;
  step.slot_numbers = slot_numbers;
  step.slots = trace.slots;
  for (const InstructionSet isa : {InstructionSet::avx2, InstructionSet::avx512}) {
    if (native_lanes(isa) > slot_numbers) continue;
    const codegen::Program program =
        codegen::allocate(trace.graph, trace.slots.end, vector_registers(isa));
    auto page = codegen::WrittenCode::place(codegen::assemble(program, isa, slot_numbers));
    if (!page) return std::nullopt;
    step.pages.push_back(std::move(page));
    step.constants = program.constants;
    step.frame_slots = std::max(step.frame_slots, program.slots);
  }
  const bool is_wide = step.pages.size() > 1;
  step.code = std::make_unique<codegen::FrameCode>(
      codegen::FrameCode::Frame{slot_numbers, step.frame_slots,
                                step.slots.end + static_cast<int>(step.constants.size()),
                                step.slots.fine},
      step.pages.front()->function(), is_wide ? step.pages.back()->function() : nullptr);
  return step;
}

struct Structure {
  MechanismStructure structure;
  std::size_t numbers;  // of its parameters: chosen points are no structure
  long steps = 0;       // asked for so far
  bool traceable = true;
  std::vector<std::shared_ptr<const WrittenStep>> written;
};

class Library {
 public:
  std::shared_ptr<const WrittenStep> find(WrittenKind kind, const Mechanism& m,
                                          std::span<const LaneCase> cases,
                                          const std::vector<Channel>& observed, long steps,
                                          Kernels choice, int slot_numbers) {
    const std::lock_guard lock(mutex_);
    std::vector<Known> known = known_in_all(cases);
    Structure& s = structure_of(m, known.size());
    s.steps += steps;
    if (!s.traceable) return nullptr;
    const WrittenStep* near = nullptr;
    for (const auto& w : s.written) {
      if (w->kind != kind || w->slot_numbers != slot_numbers) continue;
      if (!same_channels(w->observed, observed)) continue;
      if (serves(w->known, known)) return w;
      near = w.get();
    }
    if (choice != Kernels::written && s.steps < kStepsPerFreedom * (m.nv + 1)) return nullptr;
    if (near) known = known_in_both(std::move(known), near->known);
    return write(kind, m, *cases[0].parameters, std::move(known), observed, slot_numbers, s);
  }

  WrittenReport report() {
    const std::lock_guard lock(mutex_);
    report_.distrusted = codegen::distrusted_count();
    return report_;
  }

 private:
  // The one asked for last comes first.
  Structure& structure_of(const Mechanism& m, std::size_t numbers) {
    const auto found = std::find_if(
        structures_.begin(), structures_.end(),
        [&](const Structure& s) { return s.numbers == numbers && same_structure(s.structure, m); });
    if (found != structures_.end()) {
      std::rotate(structures_.begin(), found, found + 1);
    } else {
      if (structures_.size() == kMostStructures) structures_.pop_back();
      structures_.insert(structures_.begin(), {m, numbers, 0, true, {}});
    }
    return structures_.front();
  }

  std::shared_ptr<const WrittenStep> write(WrittenKind kind, const Mechanism& m,
                                           const Parameters<double>& sizes,
                                           std::vector<Known> known,
                                           const std::vector<Channel>& observed, int slot_numbers,
                                           Structure& s) {
    const auto begin = std::chrono::steady_clock::now();
    std::optional<StepTrace> trace;
    try {
      trace.emplace(kind == WrittenKind::trial ? trace_trial(m, sizes, known)
                                               : trace_step(m, sizes, known, observed));
    } catch (const Untraceable& e) {
      s.traceable = false;
      ++report_.untraceable;
      report_.why = e.what();
      return nullptr;
    }
    std::optional<WrittenStep> step = place_code(*trace, slot_numbers);
    if (!step) return nullptr;
    step->kind = kind;
    step->observed = observed;
    step->known = std::move(known);
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
    ++report_.kernels;
    report_.seconds += spent.count();
    s.written.push_back(std::make_shared<const WrittenStep>(*std::move(step)));
    return s.written.back();
  }

  std::mutex mutex_;
  std::vector<Structure> structures_;
  WrittenReport report_;
};

Library& library() {
  static Library all;
  return all;
}

bool may_execute() {
  static const bool may =
      codegen::WrittenCode::place(codegen::assemble({}, InstructionSet::avx2,
                                                    native_lanes(InstructionSet::avx2))) != nullptr;
  return may;
}

}  // namespace

std::string why_not_written(const SimdLevel& level) {
  if (level.kernels == Kernels::general) return "LINKSTUDY_KERNELS=general";
  if (level.isa == InstructionSet::baseline) return "no fused multiply-add";
  return may_execute() ? "" : "this machine refuses executable memory";
}

WrittenReport written_report() {
  return library().report();
}

std::shared_ptr<const WrittenStep> written_step(const Mechanism& m, std::span<const LaneCase> cases,
                                                const std::vector<Channel>& observed, long steps,
                                                const SimdLevel& level, int slot_numbers) {
  if (!why_not_written(level).empty()) return nullptr;
  return library().find(WrittenKind::step, m, cases, observed, steps, level.kernels, slot_numbers);
}

std::shared_ptr<const WrittenStep> written_trial(const Mechanism& m,
                                                 std::span<const LaneCase> cases, long trials,
                                                 const SimdLevel& level, int slot_numbers) {
  if (!why_not_written(level).empty()) return nullptr;
  const long steps = std::lround(kStepsPerTrial * static_cast<double>(trials));
  return library().find(WrittenKind::trial, m, cases, {}, steps, level.kernels, slot_numbers);
}

bool is_writable(const Mechanism& m, const Channel& channel) {
  if (m.loop_joints.empty()) return true;
  switch (channel.quantity) {
    case Quantity::joint_force:
    case Quantity::joint_torque:
    case Quantity::joint_force_local:
    case Quantity::joint_torque_local:
    case Quantity::closure_force:
    case Quantity::closure_torque:
      return false;
    default:
      return true;
  }
}

}  // namespace linkstudy
