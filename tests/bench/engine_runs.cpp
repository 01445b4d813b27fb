#include "tests/bench/engine_runs.h"

#include <fmt/core.h>

#include <limits>
#include <stdexcept>

#include "core/simulation/run_state.h"

namespace linkstudy::testing {
namespace {

Cause never(void*, double) {
  return Cause::ok;
}

Comparison compare_closure_force(const Mechanism& mechanism, const double* reference, long steps) {
  Comparison c;
  c.channels = find_channels(list_channels(mechanism),
                             "closure." + mechanism.closure_names.front() + ".force");
  c.sampling = {0, steps, 1};
  c.reference = reference;
  c.sign.assign(3, 1.0);
  c.max_error.assign(3, 0.0);
  c.square_error.assign(3, 0.0);
  return c;
}

}  // namespace

EngineRun::EngineRun(const Model& model, const SimdLevel& level, double step, long steps,
                     bool written, int packs)
    : model_(model), kernel_(&find_kernel(level.isa, level.lanes)), step_(step), steps_(steps) {
  y_ = model.start.q;
  y_.insert(y_.end(), model.start.v.begin(), model.start.v.end());
  y_.resize(static_cast<std::size_t>(state_size(model.mechanism)), 0.0);
  reference_.assign(3 * (static_cast<std::size_t>(steps) + 1), 1.0);
  observers_.resize(static_cast<std::size_t>(packs * level.lanes));
  for (auto& o : observers_) {
    o.comparisons = {compare_closure_force(model.mechanism, reference_.data(), steps)};
  }
  ends_.resize(observers_.size());
  finals_.assign(observers_.size(), y_);
  for (std::size_t i = 0; i < observers_.size(); ++i) {
    cases_.push_back(
        {&model_.parameters, y_.data(), finals_[i].data(), &observers_[i], nullptr, &ends_[i]});
  }
  if (written) {
    code_ = std::make_unique<PackCode>(model_.mechanism, cases_, steps, level, level.lanes);
  }
}

double EngineRun::run() {
  const KernelRun setting{begin_, step_, steps_,  100,
                          1.0,    never, nullptr, code_ ? code_->get() : nullptr};
  const double spent =
      seconds([&] { kernel_->run(model_.mechanism, setting, cases_.data(), lanes()); });
  for (const LaneEnd& end : ends_) {
    if (end.cause == Cause::ok && end.steps == steps_) continue;
    throw std::runtime_error(fmt::format("a run ended early: {}", name_of(end.cause)));
  }
  return spent / (4.0 * static_cast<double>(steps_) * lanes());
}

void EngineRun::go_on() {
  std::copy(finals_.front().begin(), finals_.front().end(), y_.begin());
  begin_ += step_ * static_cast<double>(steps_);
}

std::vector<double> EngineRun::positions(int lane) const {
  const std::vector<double>& y = finals_[static_cast<std::size_t>(lane)];
  return {y.begin(), y.begin() + model_.mechanism.nq};
}

double EngineRow::ratio() const {
  std::vector<double> sorted = ratios;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

std::vector<EngineRow> engine_rows(const Model& model, InstructionSet isa, double step,
                                   long steps) {
  const SimdLevel level = choose_simd_level(std::string(name_of(isa)).c_str(), nullptr);
  std::vector<EngineRow> rows;
  for (const int lanes : {1, level.lanes}) {
    for (const bool written : {false, true}) {
      EngineRun run(model, {isa, lanes, Kernels::written}, step, steps, written);
      if (run.is_written() != written) continue;
      rows.push_back({std::move(run), std::numeric_limits<double>::infinity(), {}});
    }
  }
  if (level.isa == InstructionSet::avx512) {
    EngineRun two(model, {isa, level.lanes, Kernels::written}, step, steps, true, 2);
    if (two.is_written()) {
      rows.push_back({std::move(two), std::numeric_limits<double>::infinity(), {}});
    }
  }
  return rows;
}

void print_heading() {
  fmt::print("ns per right-hand side and case, one thread, g++ {}\n", __VERSION__);
  fmt::print("{:<12}{:<10}{:>6}  {:<8}{:>10}{:>10}\n", "model", "set", "lanes", "loop", "ns",
             "ratio");
}

void print_rows(const std::string& model, const std::string& other, double least,
                const std::vector<EngineRow>& rows) {
  fmt::print("{:<12}{:<10}{:>6}  {:<8}{:>10.0f}\n", model, other, 1, "", least * 1e9);
  for (const EngineRow& r : rows) {
    fmt::print("{:<12}{:<10}{:>6}  {:<8}{:>10.1f}{:>10.1f}\n", model, name_of(r.load.isa()),
               r.load.lanes(), r.load.is_written() ? "written" : "general", r.best * 1e9,
               r.ratio());
  }
}

}  // namespace linkstudy::testing
