#include "study/evaluate/sample_memory.h"

#include <fmt/format.h>
#include <unistd.h>

namespace linkstudy {

double sample_bytes(const Observers& observers) {
  double bytes = 0.0;
  for (const Series& series : observers.series) {
    bytes += static_cast<double>(sizeof(double)) * static_cast<double>(series.sampling.count()) *
             static_cast<double>(series.channels.size());
  }
  return bytes;
}

double most_sample_bytes() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE)) /
         8.0;
}

std::string refuse_samples(double bytes) {
  const double most = most_sample_bytes();
  if (!(bytes > most)) return {};
  return fmt::format(
      "what it keeps of its steps takes {:.3g} GB, and {:.3g} GB, an eighth of this machine's "
      "memory, are allowed: fewer channels, longer steps or output intervals, a shorter window",
      1e-9 * bytes, 1e-9 * most);
}

}  // namespace linkstudy
