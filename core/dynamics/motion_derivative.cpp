#include "core/dynamics/motion_derivative.h"

#include <algorithm>
#include <numeric>

#include "core/base/flush_denormals.h"
#include "core/codegen/tangents.h"
#include "core/codegen/traced.h"
#include "core/dynamics/equations_of_motion.h"
#include "core/model/parameter_numbers.h"

namespace linkstudy {
namespace {

// Slots of a graph in a row: t, then parameters, memory, and the state, which is differentiated.
class Tracer {
 public:
  Tracer(const Mechanism& m, codegen::Graph& graph, bool rows_may_depend)
      : m_(m), graph_(graph), w_(make_workspace<Traced>(m)) {
    w_.rows_may_depend = rows_may_depend;
  }

  void trace(const Parameters<double>& sizes) {
    const Traced t = input();
    Parameters<Traced> p;
    for_parameter_lists([](auto& to, const auto& from) { to.resize(from.size()); }, p, sizes);
    for_parameter_numbers<Traced>(p, [this](Traced* x, std::size_t n) { read(x, n); });
    memory = next_;
    for (ContactMemory<Traced>& one : w_.memory) {
      for (Traced* x : {&one.depth, &one.rate, &one.touching, &one.approach, &one.least_depth})
        *x = input();
    }
    state = next_;
    IndexedVector<PositionIndex, Traced> q(static_cast<std::size_t>(m_.nq));
    IndexedVector<VelocityIndex, Traced> v(static_cast<std::size_t>(m_.nv));
    read(q.data(), q.size());
    read(v.data(), v.size());
    read(w_.z.data(), w_.z.size());
    end = next_;
    evaluate(m_, p, t, q.data(), v.data(), w_);
    IndexedVector<PositionIndex, Traced> rates(q.size());
    for (const Stage& s : m_.stages) position_rates(s, &q[s.q], &v[s.v], &rates[s.q]);
    write(rates);
    write(w_.qdd);
    write(w_.z_rate);
    write({w_.supplied_power, w_.dissipated_power});
  }

  int memory = 0, state = 0, end = 0;  // first slots

 private:
  Traced input() { return Traced::from(graph_.input(next_++)); }
  void read(Traced* x, std::size_t n) {
    for (std::size_t k = 0; k < n; ++k) x[k] = input();
  }
  void write(const std::vector<Traced>& x) {
    for (const Traced& one : x) graph_.write(one.value, 0);
  }

  const Mechanism& m_;
  codegen::Graph& graph_;
  Workspace<Traced> w_;
  int next_ = 0;
};

// The traced linkage, ready to be differentiated.
struct Graphed {
  Graphed(const Mechanism& m, const Parameters<double>& sizes, bool rows_may_depend) {
    const FlushDenormals flush;
    const codegen::Trace tracing(graph);
    Tracer tracer(m, graph, rows_may_depend);
    tracer.trace(sizes);
    memory = tracer.memory;
    state = tracer.state;
    end = tracer.end;
  }

  codegen::Graph graph;
  int memory = 0, state = 0, end = 0;
};

std::vector<int> slots_between(int begin, int end) {
  std::vector<int> slots(static_cast<std::size_t>(end - begin));
  std::iota(slots.begin(), slots.end(), begin);
  return slots;
}

}  // namespace

struct MotionDerivative::Code {
  explicit Code(const Graphed& g)
      : memory(g.memory),
        state(g.state),
        slots(static_cast<std::size_t>(g.end)),
        tangents(g.graph, slots_between(g.state, g.end)) {}

  void set_parameters(const Parameters<double>& p) {
    auto to = slots.begin() + 1;
    for_parameter_numbers<double>(
        p, [&](const double* x, std::size_t n) { to = std::copy_n(x, n, to); });
  }

  int memory, state;
  std::vector<double> slots;
  codegen::Tangents tangents;
};

std::unique_ptr<MotionDerivative::Code> MotionDerivative::trace(const Mechanism& m,
                                                                const Parameters<double>& p,
                                                                bool rows_may_depend) {
  try {
    auto code = std::make_unique<Code>(Graphed(m, p, rows_may_depend));
    code->set_parameters(p);
    return code;
  } catch (const Untraceable&) {
    return nullptr;
  }
}

MotionDerivative::MotionDerivative(const Mechanism& m, const Parameters<double>& p)
    : mechanism_(m), parameters_(p), code_(trace(m, p, false)) {
  const int n = m.nq + m.nv + m.nz;
  matrix_.resize(n + 2, n);
}

MotionDerivative::~MotionDerivative() = default;

bool MotionDerivative::has_structure_of(const Model& model) const {
  const MechanismStructure &own = mechanism_, &other = model.mechanism;
  return own == other &&
         parameter_number_count(parameters_) == parameter_number_count(model.parameters);
}

void MotionDerivative::set_parameters(const Parameters<double>& p) {
  parameters_ = p;
  for (Code* const code : {code_.get(), dependent_.get()})
    if (code != nullptr) code->set_parameters(p);
}

bool MotionDerivative::update(double t, const double* q, const double* v, const double* z,
                              const std::vector<ContactMemory<double>>& memory) {
  if (!code_) return false;
  if (update(*code_, t, q, v, z, memory)) return true;
  if (mechanism_.cut_rows.empty()) return false;
  if (!was_dependent_asked_) dependent_ = trace(mechanism_, parameters_, true);
  was_dependent_asked_ = true;
  return dependent_ && update(*dependent_, t, q, v, z, memory);
}

bool MotionDerivative::update(Code& code, double t, const double* q, const double* v,
                              const double* z, const std::vector<ContactMemory<double>>& memory) {
  code.slots.front() = t;
  auto to = code.slots.begin() + code.memory;
  for (const ContactMemory<double>& one : memory) {
    for (const double x : {one.depth, one.rate, one.touching, one.approach, one.least_depth})
      *to++ = x;
  }
  const auto copy = [&to](const double* x, int n) { to = std::copy_n(x, n, to); };
  copy(q, mechanism_.nq);
  copy(v, mechanism_.nv);
  copy(z, mechanism_.nz);
  codegen::Tangents& tangents = code.tangents;
  const FlushDenormals flush;
  if (!tangents.update(code.slots)) return false;
  for (int k = 0; k < tangents.columns(); ++k)
    for (int i = 0; i < tangents.rows(); ++i) matrix_(i, k) = tangents.derivative(i, k);
  return matrix_.allFinite();
}

MotionDerivative& derivative_of(const Model& model) {
  constexpr std::size_t kKept = 8;  // structures: replacements and exact joints of a study
  // The one asked for last is the last.
  static thread_local std::vector<std::unique_ptr<MotionDerivative>> kept;
  const auto found =
      std::ranges::find_if(kept, [&](const auto& one) { return one->has_structure_of(model); });
  if (found != kept.end()) {
    (*found)->set_parameters(model.parameters);
    std::rotate(found, found + 1, kept.end());
  } else {
    if (kept.size() == kKept) kept.erase(kept.begin());
    kept.push_back(std::make_unique<MotionDerivative>(model.mechanism, model.parameters));
  }
  return *kept.back();
}

}  // namespace linkstudy
