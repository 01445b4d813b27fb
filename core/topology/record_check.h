// What the checks of single values share: the record that is checked and its problems.
#pragma once

#include <string>
#include <vector>

#include "core/topology/linkage.h"
#include "core/topology/problem.h"

namespace linkstudy {

// A number as it stands in messages: nine digits.
std::string text_of(double value);
// The same for a vector, such as "[0, 0.25, 0]".
std::string text_of(const Eigen::Vector3d& value);

bool all_finite(const std::vector<double>& values);

// Collects the problems of one record: its path, and its title such as "joint 'A'". Keys count from
// the record, such as "friction.mu_s".
struct RecordCheck {
  std::string path;
  std::string title;
  std::vector<Problem>& problems;

  void report(const std::string& key, const std::string& message, const std::string& remedy);
  void require_positive(const std::string& key, double value);
  void require_not_negative(const std::string& key, double value);
  void require_finite(const std::string& key, bool finite);
  void require_unit(const std::string& key, double norm);
  void require_frame(const std::string& key, const Frame& frame);
};

}  // namespace linkstudy
