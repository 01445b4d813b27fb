#include "study/schedule/manager_load.h"

#include <ctime>

namespace linkstudy {
namespace {

constexpr double kTooBusy = 0.2;
constexpr double kIdleAgain = 0.05;

double thread_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

void ManagerLoad::measure(Time now) {
  measure(now, thread_cpu_s());
}

void ManagerLoad::measure(Time now, double cpu_s) {
  const std::chrono::duration<double> since = now - measured_;
  if (cpu_s_ >= 0.0 && since.count() > 0.0) {
    const double busy = (cpu_s - cpu_s_) / since.count();
    leaves_time_ = busy < (leaves_time_ ? kTooBusy : kIdleAgain);
  }
  measured_ = now;
  cpu_s_ = cpu_s;
}

}  // namespace linkstudy
