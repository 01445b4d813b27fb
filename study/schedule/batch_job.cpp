#include "study/schedule/batch_job.h"

#include <fmt/core.h>

#include <charconv>

namespace linkstudy {
namespace {

template <class Number>
std::optional<Number> read_as(const Environment& environment, const char* name) {
  const auto text = environment(name);
  if (!text) return std::nullopt;
  Number value{};
  const char* end = text->data() + text->size();
  const auto [last, error] = std::from_chars(text->data(), end, value);
  if (error != std::errc{} || last != end) return std::nullopt;
  return value;
}

}  // namespace

BatchJob find_batch_job(const Environment& environment) {
  BatchJob job;
  job.id = environment("SLURM_JOB_ID").value_or("");
  if (job.id.empty()) return job;
  const auto array = environment("SLURM_ARRAY_JOB_ID");
  const auto task = environment("SLURM_ARRAY_TASK_ID");
  if (array && task) job.id = fmt::format("{}_{}", *array, *task);
  job.restart = read_as<std::uint32_t>(environment, "SLURM_RESTART_COUNT").value_or(0);
  job.end_unix_s = read_as<double>(environment, "SLURM_JOB_END_TIME");
  return job;
}

std::string text_of(const BatchJob& job) {
  if (job.id.empty()) return "";
  return fmt::format("Slurm job {}, restart {}", job.id, job.restart);
}

void check_batch_step(const Environment& environment, const Launcher& launcher) {
  const auto tasks = read_as<long>(environment, "SLURM_NTASKS");
  const bool is_batch = environment("SLURM_JOB_ID") && environment("ENVIRONMENT") == "BATCH";
  if (!is_batch || !launcher.name.empty() || !tasks || *tasks <= 1) return;
  throw LaunchError(
      fmt::format(
          "Slurm gave this job {} tasks, but the batch script starts the program as one "
          "process; put 'mpirun' (or 'srun --mpi=pmix') in front of it, 'mpirun -n 1' where "
          "one is meant, or use the script that 'linkstudy init study --slurm' writes",
          *tasks),
      0);
}

}  // namespace linkstudy
