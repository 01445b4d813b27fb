// Truth: the variables as Slurm 22.05 sets them in batch scripts, steps and interactive shells.
#include "study/schedule/batch_job.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

namespace linkstudy::batch_job_test {
namespace {

using ::testing::HasSubstr;

Environment make_environment(std::map<std::string, std::string> variables) {
  return [variables = std::move(variables)](const char* name) -> std::optional<std::string> {
    const auto found = variables.find(name);
    if (found == variables.end()) return std::nullopt;
    return found->second;
  };
}

void check(const std::map<std::string, std::string>& variables) {
  const Environment environment = make_environment(variables);
  check_batch_step(environment, find_launcher(environment));
}

TEST(Batch_job, Is_none_outside_of_Slurm) {
  EXPECT_EQ(text_of(find_batch_job(make_environment({{"SLURM_RESTART_COUNT", "3"}}))), "");
}

TEST(Batch_job, Has_its_id_its_restarts_and_its_end) {
  const BatchJob job = find_batch_job(make_environment({{"SLURM_JOB_ID", "17"},
                                                        {"SLURM_RESTART_COUNT", "2"},
                                                        {"SLURM_JOB_END_TIME", "1796000000"}}));
  EXPECT_EQ(text_of(job), "Slurm job 17, restart 2");
  EXPECT_DOUBLE_EQ(job.end_unix_s.value(), 1796000000.0);
  const BatchJob first =
      find_batch_job(make_environment({{"SLURM_JOB_ID", "17"}, {"SLURM_JOB_END_TIME", "Unknown"}}));
  EXPECT_EQ(first.restart, 0u);
  EXPECT_FALSE(first.end_unix_s);
  const BatchJob task = find_batch_job(make_environment(
      {{"SLURM_JOB_ID", "19"}, {"SLURM_ARRAY_JOB_ID", "18"}, {"SLURM_ARRAY_TASK_ID", "4"}}));
  EXPECT_EQ(task.id, "18_4");
}

TEST(Batch_step, Of_several_tasks_that_starts_one_process_is_refused) {
  std::map<std::string, std::string> batch = {
      {"SLURM_JOB_ID", "5"}, {"SLURM_NTASKS", "3"}, {"ENVIRONMENT", "BATCH"}};
  try {
    check(batch);
    ADD_FAILURE() << "one of three tasks would do everything";
  } catch (const LaunchError& error) {
    EXPECT_THAT(error.what(), HasSubstr("3 tasks"));
    EXPECT_THAT(error.what(), HasSubstr("put 'mpirun'"));
    EXPECT_TRUE(error.is_first());
  }
  auto mpirun = batch;
  mpirun["OMPI_COMM_WORLD_SIZE"] = "1";
  EXPECT_NO_THROW(check(mpirun)) << "one process was asked for";
  auto srun = batch;
  srun.insert({{"SLURM_STEP_ID", "0"}, {"SLURM_STEP_NUM_TASKS", "3"}, {"PMIX_RANK", "0"}});
  EXPECT_NO_THROW(check(srun));
  auto single = batch;
  single["SLURM_NTASKS"] = "1";
  EXPECT_NO_THROW(check(single));
  auto shell = batch;
  shell.erase("ENVIRONMENT");
  EXPECT_NO_THROW(check(shell)) << "tried out in an allocation";
}

}  // namespace
}  // namespace linkstudy::batch_job_test
