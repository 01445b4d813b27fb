// The job of the queue (Slurm) that this process belongs to, told by the environment.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "study/schedule/launcher.h"

namespace linkstudy {

struct BatchJob {
  std::string id;                    // "" outside of a job; "12_3" for a task of an array
  std::uint32_t restart = 0;         // how often it was requeued before
  std::optional<double> end_unix_s;  // when its time is over, s since 1970-01-01 UTC
};

// SLURM_JOB_END_TIME is set by jobs/slurm_study.sbatch where Slurm (before 23.02) does not.
BatchJob find_batch_job(const Environment& environment);

// "Slurm job 12, restart 1", "" outside of a job.
std::string text_of(const BatchJob& job);

// Throws LaunchError when a batch script runs the program itself, which would be one process where
// the job has several tasks.
void check_batch_step(const Environment& environment, const Launcher& launcher);

}  // namespace linkstudy
