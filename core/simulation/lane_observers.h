// Observers of a pack: they sample all lanes at once, sum in step order, and hand each lane's
// results to the observers of its case when the lane ends.
#pragma once

#include <limits>

#include "core/simulation/instant.h"
#include "core/simulation/kernel.h"

namespace linkstudy {

template <class Real>
class LaneObservers {
 public:
  LaneObservers(const LaneCase* cases, int count) : cases_(cases), count_(count) {
    const Observers& form = *cases[0].observers;
    comparisons_.resize(form.comparisons.size());
    for (std::size_t i = 0; i < comparisons_.size(); ++i) {
      const std::size_t n = form.comparisons[i].max_error.size();
      comparisons_[i].max_error.assign(n, Real(0.0));
      comparisons_[i].square_error.assign(n, Real(0.0));
      comparisons_[i].shares_reference = shares_reference(i);
    }
    reductions_.resize(form.reductions.size());
    rows_.resize(form.series.size());
  }

  // values(observer, i, channel): channel i of an observer; observers count comparisons, reductions
  // and series in this order. No zero is seen with a sign: which it has is not a matter of motion,
  // and step loops differ in it.
  template <class Values>
  void observe(long step, Values&& values) {
    const Observers& form = *cases_[0].observers;
    int observer = 0;
    const auto of = [&](std::size_t i, const Channel& c) {
      return values(observer, i, c) + Real(0.0);
    };
    for (std::size_t i = 0; i < comparisons_.size(); ++i, ++observer) {
      compare(form.comparisons[i], i, step, of);
    }
    for (std::size_t i = 0; i < reductions_.size(); ++i, ++observer) {
      reduce(form.reductions[i], reductions_[i], step, of);
    }
    for (std::size_t i = 0; i < rows_.size(); ++i, ++observer) record(form.series[i], i, step, of);
  }

  // Hands over what lane i has seen so far.
  void store(int i) const {
    Observers& out = *cases_[i].observers;
    for (std::size_t k = 0; k < comparisons_.size(); ++k) {
      store(comparisons_[k], i, out.comparisons[k]);
    }
    for (std::size_t k = 0; k < reductions_.size(); ++k) {
      store(reductions_[k], i, out.reductions[k]);
    }
    for (std::size_t k = 0; k < rows_.size(); ++k) cases_[i].samples[k] = rows_[k].count;
  }

 private:
  struct LaneComparison {
    std::size_t seen = 0;
    bool shares_reference = true;               // one of all lanes
    std::vector<Real> max_error, square_error;  // (channels)
    Real max_vector_error = Real(0.0);
  };
  // A type of its own, so that its vector is not shared with other instruction sets.
  struct Rows {
    std::size_t count = 0;
  };
  struct LaneReduction {
    long seen = 0;
    Real min = Real(std::numeric_limits<double>::infinity());
    Real max = Real(-std::numeric_limits<double>::infinity());
    Real sum = Real(0.0);
    Real square = Real(0.0);
    Real last = Real(0.0);
    Real min_step = Real(0.0), max_step = Real(0.0);
    Real min_place = Real(0.0), max_place = Real(0.0);
  };

  bool shares_reference(std::size_t k) const {
    const double* first = cases_[0].observers->comparisons[k].reference;
    for (int i = 1; i < count_; ++i) {
      if (cases_[i].observers->comparisons[k].reference != first) return false;
    }
    return true;
  }

  // Number `at` of the reference of comparison k, times its sign; lanes without a case take the
  // first.
  Real reference_at(const Comparison& form, std::size_t k, std::size_t at, double sign) const {
    Real value(sign * form.reference[at]);
    if (comparisons_[k].shares_reference) return value;
    for (int i = 1; i < count_; ++i) {
      set_lane(value, i, sign * cases_[i].observers->comparisons[k].reference[at]);
    }
    return value;
  }

  template <class Of>
  void compare(const Comparison& form, std::size_t k, long step, Of&& of) {
    if (!form.sampling.hits(step)) return;
    LaneComparison& s = comparisons_[k];
    const std::size_t n = s.max_error.size();
    const std::size_t row = form.is_constant ? std::size_t{0} : s.seen * n;
    const Real weight(time_weight(form.sampling, {}, step));
    Real vector_square(0.0);
    for (std::size_t i = 0; i < n; ++i) {
      const Real error = of(i, form.channels[i]) - reference_at(form, k, row + i, form.sign[i]);
      s.max_error[i] = max(s.max_error[i], abs(error));
      s.square_error[i] = madd(weight * error, error, s.square_error[i]);
      vector_square = madd(error, error, vector_square);
    }
    s.max_vector_error = max(s.max_vector_error, sqrt(vector_square));
    ++s.seen;
  }

  template <class Of>
  static void reduce(const ChannelReduction& form, LaneReduction& s, long step, Of&& of) {
    if (!form.sampling.hits(step)) return;
    const Real x = of(0, form.channel);
    const auto lower = x<s.min, higher = x> s.max;
    const Real now(static_cast<double>(step));
    s.min_step = select(lower, now, s.min_step);
    s.max_step = select(higher, now, s.max_step);
    if (!form.place.empty()) {
      const Real there = of(1, form.place[0]);
      s.min_place = select(lower, there, s.min_place);
      s.max_place = select(higher, there, s.max_place);
    }
    s.min = min(s.min, x);
    s.max = max(s.max, x);
    const Real weighted = Real(time_weight(form.sampling, form.ends, step)) * x;
    s.sum = s.sum + weighted;
    s.square = madd(weighted, x, s.square);
    s.last = x;
    ++s.seen;
  }

  template <class Of>
  void record(const Series& form, std::size_t index, long step, Of&& of) {
    if (!form.sampling.hits(step)) return;
    const std::size_t n = form.channels.size();
    const std::size_t begin = rows_[index].count * n;
    for (std::size_t k = 0; k < n; ++k) {
      const Real x = of(k, form.channels[k]);
      for (int i = 0; i < count_; ++i) {
        cases_[i].observers->series[index].values[begin + k] = lane(x, i);
      }
    }
    ++rows_[index].count;
  }

  static void store(const LaneComparison& s, int i, Comparison& out) {
    out.seen = static_cast<long>(s.seen);
    for (std::size_t k = 0; k < s.max_error.size(); ++k) {
      out.max_error[k] = lane(s.max_error[k], i);
      out.square_error[k] = lane(s.square_error[k], i);
    }
    out.max_vector_error = lane(s.max_vector_error, i);
  }

  static void store(const LaneReduction& s, int i, ChannelReduction& out) {
    out.seen = s.seen;
    out.min = lane(s.min, i);
    out.max = lane(s.max, i);
    out.sum = lane(s.sum, i);
    out.square = lane(s.square, i);
    out.last = lane(s.last, i);
    out.min_step = static_cast<long>(lane(s.min_step, i));
    out.max_step = static_cast<long>(lane(s.max_step, i));
    out.min_place = lane(s.min_place, i);
    out.max_place = lane(s.max_place, i);
  }

  const LaneCase* cases_;
  int count_;
  std::vector<LaneComparison> comparisons_;
  std::vector<LaneReduction> reductions_;
  std::vector<Rows> rows_;  // (series)
};

}  // namespace linkstudy
