// Numbers straight from the generator, the same on every machine: the standard's distributions
// differ between libraries.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>

namespace linkstudy::testing {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double within(double size) {
    return size * (2.0 * static_cast<double>(engine_() >> 11) * 0x1p-53 - 1.0);
  }
  int below(int count) { return static_cast<int>(engine_() % static_cast<unsigned>(count)); }
  Eigen::VectorXd vector(Eigen::Index n, double size) {
    Eigen::VectorXd x(n);
    for (double& value : x) value = within(size);
    return x;
  }
  Eigen::MatrixXd matrix(Eigen::Index rows, Eigen::Index columns, double size) {
    Eigen::MatrixXd x(rows, columns);
    for (double& value : x.reshaped()) value = within(size);
    return x;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace linkstudy::testing
