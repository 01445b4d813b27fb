// The searches of one variable (find_window.h, search_section.h) along one axis of a box: a log of
// that variable whose questions are asked at the other values of a point.
#pragma once

#include "study/tune/evaluation_log.h"

namespace linkstudy::tuning {

class AxisSearch {
 public:
  // `known`: what was seen on the axis is asked for again and costs nothing there. `budget`: new
  // evaluations it may ask for.
  AxisSearch(const EvaluationLog& known, std::vector<double> point, std::size_t j,
             std::size_t budget, EvaluateBatch ask);

  AxisSearch(const AxisSearch&) = delete;
  AxisSearch& operator=(const AxisSearch&) = delete;

  EvaluationLog& log() { return log_; }
  double start() const { return point_[j_]; }

 private:
  std::vector<Answer> answer(const std::vector<Request>& requests) const;

  std::vector<double> point_;
  std::size_t j_;
  EvaluateBatch ask_;
  EvaluationLog log_;
};

}  // namespace linkstudy::tuning
