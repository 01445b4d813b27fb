#include "core/simulation/written_steps.h"

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <mutex>
#include <optional>
#include <utility>

#include "core/codegen/traced.h"
#include "core/kinematics/assembly.h"
#include "core/simulation/trial_trace.h"

namespace linkstudy {
namespace {

// Writing takes as long as some hundred steps a freedom take in the general loop.
constexpr long kStepsPerFreedom = 500;
constexpr long kEvaluationsPerStep = 4;
constexpr std::size_t kMostStructures = 64;
// Two packs side by side gain where code waits for itself, and lose where it is long: what is
// fetched doubles. Beyond so many bytes of one pack they never gained, below it is measured.
constexpr std::size_t kLongCode = 64 * 1024;
constexpr double kLeastGain = 0.92;  // time of two side by side over that of one after the other

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

// Of the first case of a pack: the others depend likewise, or the general loop serves them.
bool rows_depend_at_start(const Mechanism& m, const LaneCase& c) {
  State<double> start = make_state<double>(m);
  std::copy_n(c.y, m.nq, start.q.begin());
  return closure_rank(m, *c.parameters, start) < m.cut_row_count();
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

constexpr double kFaster = 0.98;  // of the time: less may be chance

// The faster of two orders, but for two packs as made: alone in the cache of instructions the other
// looks better there than beside the loop that calls it. Null where the machine refuses executable
// memory. Makes the frame as large as it needs.
std::unique_ptr<codegen::WrittenCode> place_fastest(const codegen::Graph& graph, int constants,
                                                    InstructionSet isa, WrittenStep& step) {
  const int frames = isa == InstructionSet::avx512 ? step.packs : 1;
  std::vector<codegen::Program> programs;
  for (const auto order : {codegen::Order::as_made, codegen::Order::depth_first}) {
    if (step.packs > 1 && order != codegen::Order::as_made) continue;
    programs.push_back(
        codegen::allocate(graph, constants, codegen::program_registers(isa, frames), order));
    step.frame_slots = std::max(step.frame_slots, programs.back().slots);
  }
  const codegen::FrameLayout layout{step.slot_numbers, step.frame_slots, frames};
  std::unique_ptr<codegen::WrittenCode> fastest;
  for (const codegen::Program& program : programs) {
    auto page =
        codegen::WrittenCode::place_well(codegen::assemble(program, isa, layout),
                                         layout.frames * layout.slots * layout.slot_numbers);
    if (!page) return nullptr;
    if (!fastest || page->call_s() < kFaster * fastest->call_s()) fastest = std::move(page);
  }
  return fastest;
}

// Code of a trace on the frame of `step`, whose first free slot is `constants`; none where the
// machine refuses executable memory. Narrow code beside wide is asked once, any is good enough.
std::unique_ptr<codegen::FrameCode> place_code(const StepTrace& trace, int constants,
                                               WrittenStep& step) {
  constexpr auto avx2 = InstructionSet::avx2, avx512 = InstructionSet::avx512;
  const codegen::Program narrow_program =
      codegen::allocate(trace.graph, constants, codegen::program_registers(avx2, 1));
  const std::vector<codegen::SlotValue>& values = narrow_program.constants;
  step.frame_slots = std::max(step.frame_slots, narrow_program.slots);
  codegen::WrittenCode::Function narrow = nullptr, wide = nullptr;
  const bool is_wide = step.slot_numbers >= native_lanes(avx512);
  auto serves = place_fastest(trace.graph, constants, is_wide ? avx512 : avx2, step);
  if (!serves) return nullptr;
  (is_wide ? wide : narrow) = serves->function();
  step.code_bytes = serves->size();
  step.call_s = serves->call_s();
  step.pages.push_back(std::move(serves));
  if (is_wide) {
    auto page = codegen::WrittenCode::place(
        codegen::assemble(narrow_program, avx2, {step.slot_numbers, step.frame_slots, 1}));
    if (!page) return nullptr;
    narrow = page->function();
    step.pages.push_back(std::move(page));
  }
  step.constants.insert(step.constants.end(), values.begin(), values.end());
  const codegen::FrameCode::Frame frame{step.slot_numbers, step.frame_slots,
                                        constants + static_cast<int>(values.size()),
                                        trace.slots.fine, step.packs};
  return std::make_unique<codegen::FrameCode>(frame, narrow, wide);
}

struct Asked {
  WrittenKind kind;
  const std::vector<Channel>& observed;
  int slot_numbers;
  bool rows_may_depend;
  int packs = 1;
  bool is_needed = false;  // whether it pays or not

  bool is(const WrittenStep& w) const {
    return w.kind == kind && w.slot_numbers == slot_numbers && w.packs == packs &&
           w.rows_may_depend == rows_may_depend && same_channels(w.observed, observed);
  }
};

// None where the machine refuses executable memory. Throws Untraceable.
std::optional<WrittenStep> write_step(const Asked& asked, const Mechanism& m,
                                      const Parameters<double>& sizes, std::vector<Known> known) {
  WrittenStep step;
  step.kind = asked.kind;
  step.slot_numbers = asked.slot_numbers;
  step.packs = asked.packs;
  step.rows_may_depend = asked.rows_may_depend;
  step.observed = asked.observed;
  const bool is_trial = asked.kind == WrittenKind::trial;
  const auto make = is_trial ? trace_trial : trace_step;
  const StepTrace trace = make(m, sizes, known, asked.observed, asked.rows_may_depend);
  step.slots = trace.slots;
  step.code = place_code(trace, trace.slots.end, step);
  if (is_trial) {
    step.inside = place_code(trace_inside(m, sizes, known, asked.observed, asked.rows_may_depend),
                             step.frame_slots, step);
  }
  step.known = std::move(known);
  if (!step.code || (is_trial && !step.inside)) return std::nullopt;
  return step;
}

struct Structure {
  MechanismStructure structure;
  std::size_t numbers;  // of its parameters: chosen points are no structure
  long steps = 0;       // asked for so far
  bool traceable = true;
  // Code for two packs, for rows that do not depend and for such that may, once it has been
  // measured.
  std::array<std::optional<bool>, 2> two_packs_pay;
  std::vector<std::shared_ptr<const WrittenStep>> written;
};

class Library {
 public:
  std::shared_ptr<const WrittenStep> find(const Asked& asked, const Mechanism& m,
                                          std::span<const LaneCase> cases, long steps,
                                          Kernels choice) {
    const std::lock_guard lock(mutex_);
    std::vector<Known> known = known_in_all(cases);
    Structure& s = structure_of(m, known.size());
    s.steps += steps;
    if (!s.traceable) return nullptr;
    const bool may_write = choice == Kernels::written || s.steps >= kStepsPerFreedom * (m.nv + 1);
    const auto get = [&](const Asked& one) -> std::shared_ptr<const WrittenStep> {
      return find_or_write(one, m, *cases[0].parameters, known, s, may_write);
    };
    if (asked.packs == 1 || choice == Kernels::written || asked.is_needed) return get(asked);
    std::optional<bool>& pays = s.two_packs_pay[asked.rows_may_depend ? 1 : 0];
    if (!pays) {
      Asked alone = asked;
      alone.packs = 1;
      const auto one = get(alone);
      if (!one) return nullptr;
      const auto two = one->code_bytes <= kLongCode ? get(asked) : nullptr;
      pays = two && two->call_s < kLeastGain * 2.0 * one->call_s;
    }
    return *pays ? get(asked) : nullptr;
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
      structures_.insert(structures_.begin(), {m, numbers, 0, true, {}, {}});
    }
    return structures_.front();
  }

  // Null where there is none yet and none may be written.
  std::shared_ptr<const WrittenStep> find_or_write(const Asked& asked, const Mechanism& m,
                                                   const Parameters<double>& sizes,
                                                   std::vector<Known> known, Structure& s,
                                                   bool may_write) {
    const WrittenStep* near = nullptr;
    for (const auto& w : s.written) {
      if (!asked.is(*w)) continue;
      if (serves(w->known, known)) return w;
      near = w.get();
    }
    if (!may_write || !s.traceable) return nullptr;
    if (near) known = known_in_both(std::move(known), near->known);
    return write(asked, m, sizes, std::move(known), s);
  }

  std::shared_ptr<const WrittenStep> write(const Asked& asked, const Mechanism& m,
                                           const Parameters<double>& sizes,
                                           std::vector<Known> known, Structure& s) {
    const auto begin = std::chrono::steady_clock::now();
    std::optional<WrittenStep> step;
    try {
      step = write_step(asked, m, sizes, std::move(known));
    } catch (const Untraceable& e) {
      s.traceable = false;
      ++report_.untraceable;
      report_.why = e.what();
      return nullptr;
    }
    if (!step) return nullptr;
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
      codegen::WrittenCode::place(codegen::assemble(
          {}, InstructionSet::avx2, {native_lanes(InstructionSet::avx2)})) != nullptr;
  return may;
}

}  // namespace

void WrittenStep::put_constants(double* frame) const {
  for (int pack = 0; pack < packs; ++pack, frame += frame_slots * slot_numbers) {
    for (const auto& [slot, bits] : constants) {
      std::fill_n(frame + slot * slot_numbers, slot_numbers, std::bit_cast<double>(bits));
    }
  }
}

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
                                                const SimdLevel& level, int slot_numbers,
                                                bool rows_may_depend, int packs) {
  if (!why_not_written(level).empty()) return nullptr;
  const bool may = rows_may_depend || rows_depend_at_start(m, cases[0]);
  // Two packs that are under way stay together.
  return library().find({WrittenKind::step, observed, slot_numbers, may, packs, rows_may_depend}, m,
                        cases, steps, level.kernels);
}

std::shared_ptr<const WrittenStep> written_trial(const Mechanism& m,
                                                 std::span<const LaneCase> cases,
                                                 const std::vector<Channel>& observed,
                                                 long evaluations, const SimdLevel& level,
                                                 int slot_numbers, bool rows_may_depend) {
  if (!why_not_written(level).empty()) return nullptr;
  const bool may = rows_may_depend || rows_depend_at_start(m, cases[0]);
  return library().find({WrittenKind::trial, observed, slot_numbers, may}, m, cases,
                        evaluations / kEvaluationsPerStep, level.kernels);
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
