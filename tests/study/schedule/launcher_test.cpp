// Truth: the variables as Open MPI 4.1, Slurm 22.05 and MPICH's Hydra set them.
#include "study/schedule/launcher.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

namespace linkstudy::launcher_test {
namespace {

using ::testing::HasSubstr;

Launcher find(std::map<std::string, std::string> variables) {
  return find_launcher([&](const char* name) -> std::optional<std::string> {
    const auto found = variables.find(name);
    if (found == variables.end()) return std::nullopt;
    return found->second;
  });
}

TEST(Launcher, Is_absent_without_its_variables) {
  EXPECT_EQ(find({}).size, 1);
  EXPECT_EQ(find({{"PATH", "/bin"}, {"OMPI_MCA_pml", "ob1"}}).size, 1);
  EXPECT_EQ(find({{"OMPI_COMM_WORLD_SIZE", "many"}}).size, 1);
}

TEST(Launcher, Is_Open_MPI_also_within_a_Slurm_job) {
  const Launcher launcher = find({{"OMPI_COMM_WORLD_SIZE", "7"},
                                  {"OMPI_COMM_WORLD_RANK", "3"},
                                  {"PMIX_RANK", "3"},
                                  {"SLURM_STEP_ID", "0"},
                                  {"SLURM_STEP_NUM_TASKS", "2"}});
  EXPECT_THAT(launcher.name, HasSubstr("Open MPI"));
  EXPECT_EQ(launcher.size, 7);
  EXPECT_EQ(launcher.rank, 3);
  EXPECT_TRUE(launcher.connected);
}

TEST(Launcher, Is_srun_with_the_size_of_the_step_rather_than_of_the_job) {
  const Launcher launcher = find({{"SLURM_NTASKS", "8"},
                                  {"SLURM_STEP_ID", "1"},
                                  {"SLURM_STEP_NUM_TASKS", "4"},
                                  {"SLURM_PROCID", "2"},
                                  {"PMIX_RANK", "2"}});
  EXPECT_EQ(launcher.size, 4);
  EXPECT_EQ(launcher.rank, 2);
  EXPECT_TRUE(launcher.connected);
}

TEST(Launcher, Is_absent_in_a_batch_script_and_an_interactive_shell) {
  EXPECT_EQ(find({{"SLURM_NTASKS", "8"}, {"SLURM_JOB_ID", "5"}}).size, 1);
  EXPECT_EQ(find({{"SLURM_NTASKS", "8"}, {"SLURM_STEP_ID", "4294967291"}}).size, 1);
  EXPECT_EQ(find({{"SLURM_NTASKS", "8"}, {"SLURM_STEP_ID", "4294967290"}}).size, 1);
}

TEST(Launcher, That_leaves_its_processes_apart_is_explained_before_MPI_starts) {
  const Launcher launcher =
      find({{"SLURM_STEP_ID", "0"}, {"SLURM_NTASKS", "4"}, {"SLURM_PROCID", "1"}});
  EXPECT_FALSE(launcher.connected);
  try {
    check_reachable(launcher);
    FAIL() << "four copies would have run";
  } catch (const LaunchError& error) {
    EXPECT_THAT(error.what(), HasSubstr("--mpi=pmix"));
    EXPECT_FALSE(error.is_first());
  }
  EXPECT_NO_THROW(check_reachable(find({})));
}

TEST(Launcher, Of_another_MPI_library_is_explained) {
  const Launcher launcher = find({{"PMI_SIZE", "4"}, {"PMI_RANK", "0"}});
  EXPECT_NO_THROW(check_size(launcher, 4));
  try {
    check_size(launcher, 1, "Open MPI v4.1.4");
    FAIL() << "four copies would have run";
  } catch (const LaunchError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("two MPI installations: this program uses Open MPI v4.1.4"));
    EXPECT_THAT(error.what(), HasSubstr("started 4 processes, but this one sees 1"));
    EXPECT_TRUE(error.is_first());
  }
}

TEST(Launcher, Of_several_copies_of_a_verb_for_one_process_is_refused) {
  EXPECT_NO_THROW(check_alone(find({}), "simulate"));
  EXPECT_NO_THROW(check_alone(find({{"OMPI_COMM_WORLD_SIZE", "1"}, {"OMPI_COMM_WORLD_RANK", "0"}}),
                              "simulate"));
  try {
    check_alone(find({{"OMPI_COMM_WORLD_SIZE", "2"}, {"OMPI_COMM_WORLD_RANK", "1"}}), "simulate");
    FAIL() << "two copies would have run";
  } catch (const LaunchError& error) {
    EXPECT_THAT(error.what(), HasSubstr("'simulate' works in one process, and mpirun"));
    EXPECT_FALSE(error.is_first());
  }
}

}  // namespace
}  // namespace linkstudy::launcher_test
