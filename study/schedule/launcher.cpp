#include "study/schedule/launcher.h"

#include <fmt/core.h>

#include <charconv>
#include <cstdlib>
#include <string_view>

namespace linkstudy {
namespace {

std::optional<long> read_number(const Environment& environment, const char* name) {
  const auto text = environment(name);
  if (!text) return std::nullopt;
  long value = 0;
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), value);
  if (error != std::errc{} || end != text->data() + text->size()) return std::nullopt;
  return value;
}

// The process-management interface of one launcher: the variables with size and rank.
std::optional<Launcher> find_one(const Environment& environment, const char* name,
                                 const char* size_name, const char* rank_name) {
  const auto size = read_number(environment, size_name);
  if (!size || *size < 1) return std::nullopt;
  const auto rank = read_number(environment, rank_name).value_or(0);
  return Launcher{name, static_cast<int>(*size), static_cast<int>(rank), true};
}

// srun's steps count up from 0; a batch script and an interactive shell carry reserved numbers and
// a task count too, but are one process.
std::optional<Launcher> find_srun(const Environment& environment) {
  constexpr long kFirstReservedStep = 0xfffffff0;
  const auto step = read_number(environment, "SLURM_STEP_ID");
  if (!step || *step < 0 || *step >= kFirstReservedStep) return std::nullopt;
  const char* size_name =
      environment("SLURM_STEP_NUM_TASKS") ? "SLURM_STEP_NUM_TASKS" : "SLURM_NTASKS";
  auto launcher = find_one(environment, "srun", size_name, "SLURM_PROCID");
  if (launcher)
    launcher->connected = environment("PMIX_RANK") || environment("PMI_RANK") ||
                          environment("PMI_FD") || environment("PMIX_NAMESPACE");
  return launcher;
}

}  // namespace

std::optional<std::string> read_environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? std::optional<std::string>(value) : std::nullopt;
}

Launcher find_launcher(const Environment& environment) {
  if (const auto found = find_one(environment, "mpirun (Open MPI)", "OMPI_COMM_WORLD_SIZE",
                                  "OMPI_COMM_WORLD_RANK"))
    return *found;
  if (const auto found = find_srun(environment)) return *found;
  if (const auto found =
          find_one(environment, "a PMI launcher (MPICH, Intel MPI)", "PMI_SIZE", "PMI_RANK"))
    return *found;
  return {};
}

void check_reachable(const Launcher& launcher) {
  if (launcher.connected || launcher.size <= 1) return;
  throw LaunchError(
      fmt::format("srun started {} processes without a plugin through which they find each other; "
                  "start them with 'srun --mpi=pmix' or with 'mpirun'",
                  launcher.size),
      launcher.rank);
}

void check_size(const Launcher& launcher, int communicator_size, const std::string& library) {
  if (communicator_size == launcher.size) return;
  throw LaunchError(
      fmt::format("{} started {} processes, but this one sees {} (each would do the whole study); "
                  "there seem to be two MPI installations: this program uses {}; start it with the "
                  "mpirun of that one ('mpirun --version' tells), or 'srun --mpi=pmix' under Slurm",
                  launcher.name, launcher.size, communicator_size, library),
      launcher.rank);
}

void check_alone(const Launcher& launcher, const std::string& verb) {
  if (launcher.size <= 1) return;
  throw LaunchError(
      fmt::format("'{}' works in one process, and {} started {}; start it without (study and tune "
                  "share their work)",
                  verb, launcher.name, launcher.size),
      launcher.rank);
}

}  // namespace linkstudy
