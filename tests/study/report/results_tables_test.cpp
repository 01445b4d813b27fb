#include "study/report/results_tables.h"

#include <gmock/gmock.h>

#include <functional>

#include "study/config/input_error.h"
#include "study/report/choose_table.h"
#include "study/report/write_table.h"

namespace linkstudy::results_tables_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const std::string kMax = "largest relative error of closure.S.force.";
const std::string kRms = "root-mean-square relative error of closure.S.force.";

// Names and meanings as study/metrics/response_list writes them.
std::vector<Response> responses_of(const std::string& load_case) {
  const std::string prefix = load_case.empty() ? "" : load_case + "_";
  std::vector<Response> all;
  for (const char* c : {"x", "y"}) {
    all.push_back({prefix + "error_max_closure_S_force_" + c, "1", kMax + c});
  }
  for (const char* c : {"x", "y"}) {
    all.push_back({prefix + "error_rms_closure_S_force_" + c, "1", kRms + c});
  }
  all.push_back({prefix + "peak", "N", "max_abs of closure.S.force.x"});
  all.push_back({prefix + "gap_max", "m", "largest distance between the two points of a closure"});
  all.push_back({prefix + "drift_max", "", "largest norm of the cut-joint residuals, m and 1"});
  all.push_back({prefix + "energy_residual_max", "J", "largest residual of the energy ledger"});
  all.push_back({prefix + "omega_max", "rad/s", "highest eigenfrequency along the run"});
  all.push_back(
      {prefix + "step_limit", "s", "largest stable step of RK4, the least along the run"});
  return all;
}

Evaluation evaluation(std::uint64_t id, double stiffness, std::vector<double> responses) {
  Evaluation one;
  one.point = {id, {stiffness, std::string("sde"), 0.7}};
  one.responses = std::move(responses);
  one.derived = {{"closure.S.sde.damping_ratio", "", {0.7}},
                 {"closure.S.sde.damping", "N s/m", {stiffness / 1e3}}};
  one.host = "n1";
  return one;
}

StudyResults ladder() {
  StudyResults results;
  results.description = {"ladder",
                         "study",
                         0,
                         {{"closure.S.sde.stiffness", "N/m", "stiffness"},
                          {"closure.S.model", "", "model"},
                          {"closure.S.sde.damping_ratio", "", "zeta"}},
                         responses_of("")};
  results.evaluations = {
      evaluation(1, 1e6, {0.0158, 0.01, 0.001, 0.00621, 11.0, 6.55e-5, 0, 0, 2e3, 1.23e-3}),
      evaluation(0, 1e5, {0.1, 0.218, 0.102, 0.05, 12.0, 7.45e-4, 0, 0, 1e3, 4.18e-3})};
  Evaluation bad = evaluation(2, 1e9, {});
  bad.status = Cause::diverged;
  bad.message = "state is not finite at t = 0.0019 s";
  results.evaluations.push_back(bad);
  return results;
}

TEST(SummaryTable, Has_what_varies_the_worst_component_in_percent_and_damping_in_SI) {
  EXPECT_EQ(
      text_of(make_results_table(ladder(), "summary")),
      "ladder\n"
      "evaluation  closure.S.sde.stiffness  closure.S.sde.damping  error_max_closure_S_force  "
      "worst_closure_S_force  error_rms_closure_S_force  peak   gap_max  step_limit  status\n"
      "                                N/m                  N s/m                          %  "
      "                                               %     N         m           s\n"
      "----------  -----------------------  ---------------------  -------------------------  "
      "---------------------  -------------------------  ----  --------  ----------  --------"
      "\n"
      "         0                   100000                    100                       21.8  "
      "y                                           10.2    12  0.000745     0.00418  ok\n"
      "         1                    1e+06                   1000                       1.58  "
      "x                                          0.621    11  6.55e-05     0.00123  ok\n"
      "         2                    1e+09                  1e+06                          -  "
      "                                               -     -         -           -  diverged"
      "\n");
}

TEST(SummaryTable, Has_a_row_for_each_load_case) {
  StudyResults results = ladder();
  results.description.responses = responses_of("slow");
  for (Response& fast : responses_of("very_fast")) {
    results.description.responses.push_back(std::move(fast));
  }
  results.evaluations = {evaluation(0, 1e5, {0.1, 0.2, 0.01, 0.02, 1, 2, 3, 4,  5,  6,  //
                                             0.4, 0.3, 0.04, 0.03, 7, 8, 9, 10, 11, 12})};
  results.evaluations[0].derived = {{"slow_closure.S.sde.damping", "N s/m", {100.0}},
                                    {"very_fast_closure.S.sde.damping", "N s/m", {200.0}}};
  const Table table = make_results_table(results, "summary");
  EXPECT_EQ(csv_of(choose_columns(
                table, {"load_case", "closure.S.sde.damping", "error_max_closure_S_force",
                        "worst_closure_S_force", "peak", "gap_max", "step_limit"})),
            "# units: ,N s/m,%,,N,m,s\n"
            "load_case,closure.S.sde.damping,error_max_closure_S_force,worst_closure_S_force,peak,"
            "gap_max,step_limit\n"
            "slow,100,20,y,1,2,6\n"
            "very_fast,200,40,x,7,8,12\n");
}

// Two windows of one signal, and a [[response]] that ends like a run number.
TEST(SummaryTable, Keeps_matches_and_responses_apart) {
  StudyResults results = ladder();
  std::vector<Response>& all = results.description.responses;
  all = {{"error_max_joint_A_q", "1", "largest relative error of joint.A.q"},
         {"error_rms_joint_A_q", "1", "root-mean-square relative error of joint.A.q"},
         {"error_max_joint_A_q_2", "1", "largest relative error of joint.A.q"},
         {"error_rms_joint_A_q_2", "1", "root-mean-square relative error of joint.A.q"},
         {"my_gap_max", "m", "max of closure.S.gap.x"},
         {"gap_max", "m", "largest distance between the two points of a closure"}};
  results.evaluations = {evaluation(0, 1.0, {0.1, 0.2, 0.3, 0.4, 5.0, 6.0})};
  const Table table = make_results_table(results, "summary");
  EXPECT_EQ(csv_of(choose_columns(
                table, {"error_max_joint_A_q", "error_rms_joint_A_q_2", "my_gap_max", "gap_max"})),
            "# units: %,%,m,m\n"
            "error_max_joint_A_q,error_rms_joint_A_q_2,my_gap_max,gap_max\n"
            "10,40,5,6\n");
  EXPECT_EQ(find_column(table, "load_case"), nullptr);
  EXPECT_EQ(find_column(table, "worst_joint_A_q"), nullptr) << "one component has no worst";
}

TEST(EvaluationsTable, Shows_inputs_outputs_and_causes_by_id) {
  StudyResults results = ladder();
  results.description.responses = {{"gap", "m", ""}};
  results.evaluations = {evaluation(1, 1e4, {}), evaluation(0, 1e4, {0.5})};
  results.evaluations[0].status = Cause::timeout;
  results.evaluations[0].message = "after 5 s";
  for (Evaluation& one : results.evaluations) one.derived.clear();
  EXPECT_EQ(text_of(choose_columns(make_results_table(results, "evaluations"), {})),
            "ladder\n"
            "evaluation  closure.S.sde.stiffness  closure.S.model  closure.S.sde.damping_ratio  gap"
            "  status   message\n"
            "                                N/m                                                  m"
            "\n"
            "----------  -----------------------  ---------------  ---------------------------  ---"
            "  -------  ---------\n"
            "         0                    10000  sde                                      0.7  0.5"
            "  ok\n"
            "         1                    10000  sde                                      0.7    -"
            "  timeout  after 5 s\n");
}

TEST(EvaluationsTable, Has_the_column_of_messages_when_nothing_failed_too) {
  StudyResults results = ladder();
  results.evaluations.pop_back();
  const std::string text = text_of(choose_columns(make_results_table(results, "evaluations"), {}));
  EXPECT_THAT(text, HasSubstr("message"));
  EXPECT_THAT(text, HasSubstr("message  closure.S.sde.damping\n"));
  EXPECT_THAT(text, Not(HasSubstr("parent")));
  EXPECT_THAT(text, Not(HasSubstr("host")));
}

TEST(EvaluationsTable, Gives_the_columns_asked_for_in_their_order) {
  const Table table = make_results_table(ladder(), "evaluations");
  const Table chosen = choose_columns(table, {"gap_max", "host", "evaluation", "attempts"});
  ASSERT_EQ(chosen.columns.size(), 4u);
  EXPECT_EQ(chosen.columns[1].name, "host");
  EXPECT_EQ(std::get<std::vector<std::int64_t>>(chosen.columns[2].values),
            (std::vector<std::int64_t>{0, 1, 2}));
}

TEST(ResultsTables, Are_listed_with_their_rows) {
  StudyResults results = ladder();
  const std::string list = text_of(list_tables(results));
  EXPECT_THAT(list, HasSubstr("summary         3  what varies"));
  EXPECT_THAT(list, HasSubstr("provenance      0  "));
  EXPECT_THAT(list, Not(HasSubstr("tuning")));
  EXPECT_THAT(list, Not(HasSubstr("traces")));
  results.answers = {{AnswerKind::tuning,
                      {"S", {}, {}, {{"result", {{"value", "N/m", "", "", std::vector{1e6}}}}}}}};
  EXPECT_THAT(text_of(list_tables(results)), HasSubstr("tuning          1  the answer"));
  EXPECT_EQ(csv_of(make_results_table(results, "tuning")), "# units: N/m\nvalue\n1000000\n");
}

TEST(ResultsTables, Starts_and_resumes_have_their_rows) {
  StudyResults results = ladder();
  results.provenance = {{"start", 1.7e9, 2, 3, "n1", "0.1.0", "abc", "linkstudy study", "avx2", 4}};
  EXPECT_THAT(csv_of(make_results_table(results, "provenance")),
              HasSubstr("start,1700000000,2,3,n1,0.1.0,abc,avx2,4,,0,linkstudy study"));
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const UsageError& error) {
    return error.what();
  }
  return "nothing was refused";
}

TEST(ResultsTables, Unknown_names_are_refused_with_the_nearest) {
  const StudyResults results = ladder();
  const Table table = make_results_table(results, "evaluations");
  EXPECT_THAT(message_of([&] { make_results_table(results, "sumary"); }), HasSubstr("'summary'"));
  EXPECT_THAT(message_of([&] { make_results_table(results, "tuning"); }),
              HasSubstr("there is no table 'tuning': only a tune"));
  EXPECT_THAT(message_of([&] { choose_columns(table, {"gapmax"}); }),
              HasSubstr("there is no column 'gapmax'; nearest: gap_max"));
  EXPECT_THAT(message_of([&] { choose_rows(table, "stiffness > 1"); }),
              HasSubstr("there is no column 'stiffness'; nearest: "));
}

std::vector<std::int64_t> rows_where(const std::string& text) {
  const Table table = choose_rows(make_results_table(ladder(), "summary"), text);
  return std::get<std::vector<std::int64_t>>(find_column(table, "evaluation")->values);
}

TEST(Rows, Are_chosen_by_numbers_with_units_and_by_words) {
  using Ids = std::vector<std::int64_t>;
  EXPECT_EQ(rows_where(""), (Ids{0, 1, 2}));
  EXPECT_EQ(rows_where("closure.S.sde.stiffness >= 1e6"), (Ids{1, 2}));
  EXPECT_EQ(rows_where("closure.S.sde.stiffness<=1000 N/mm"), (Ids{0, 1}));
  EXPECT_EQ(rows_where("gap_max > 0.1 mm"), (Ids{0}));
  EXPECT_EQ(rows_where("error_max_closure_S_force < 2 %"), (Ids{1}));
  EXPECT_EQ(rows_where("status = ok"), (Ids{0, 1}));
  EXPECT_EQ(rows_where("status != ok"), (Ids{2}));
  EXPECT_EQ(rows_where("worst_closure_S_force == y"), (Ids{0}));
  EXPECT_EQ(rows_where("status = ok and gap_max < 1e-4"), (Ids{1}));
  EXPECT_EQ(rows_where("status = ok, evaluation != 1"), (Ids{0}));
}

// 6.55e-05 m is what the table shows; a missing number is neither below nor above.
TEST(Rows, Equal_what_agrees_to_six_digits_and_never_what_is_missing) {
  using Ids = std::vector<std::int64_t>;
  EXPECT_EQ(rows_where("gap_max = 6.5500001e-5"), (Ids{1}));
  EXPECT_EQ(rows_where("gap_max = 6.551e-5"), (Ids{}));
  EXPECT_EQ(rows_where("gap_max <= 6.5499999e-5"), (Ids{1}));
  EXPECT_EQ(rows_where("gap_max != 6.55e-5"), (Ids{0}));
  EXPECT_EQ(rows_where("gap_max > -1"), (Ids{0, 1}));
}

TEST(Rows, That_are_written_wrongly_are_refused_with_the_reason) {
  const auto refused = [](const std::string& text) {
    return message_of([&] { rows_where(text); });
  };
  EXPECT_THAT(refused("gap_max"), HasSubstr("'gap_max' is no comparison; write COLUMN SIGN VALUE"));
  EXPECT_THAT(refused("gap_max <"), HasSubstr("is no comparison"));
  EXPECT_THAT(refused("gap_max < 1 and"), HasSubstr("does not fit column 'gap_max'"));
  EXPECT_THAT(refused("gap_max < 1,"), Not(HasSubstr("nothing was refused")));
  EXPECT_THAT(refused("gap_max < small"), HasSubstr("holds numbers, got 'small'"));
  EXPECT_THAT(refused("gap_max < 1 N"),
              HasSubstr("'1 N' does not fit column 'gap_max', which is in 'm'"));
  EXPECT_THAT(refused("status < ok"), HasSubstr("holds words: compare with = or !="));
}

TEST(TracesTable, Stand_below_each_other_with_their_differences) {
  StudyResults results = ladder();
  results.references = {{"reference", -1, {{"time", "s", {0.0, 0.1}}, {"f", "N", {1.0, 2.0}}}}};
  results.traces = {{"evaluation_2", 2, {{"time", "s", {0.0, 0.2}}, {"f", "N", {1.5, 3.0}}}},
                    {"evaluation_1", 1, {{"time", "s", {0.0}}, {"g", "m", {7.0}}}}};
  EXPECT_EQ(csv_of(make_results_table(results, "traces")),
            "# units: ,s,N,m,N\n"
            "run,time,f,g,f.difference\n"
            "reference,0,1,,\n"
            "reference,0.10000000000000001,2,,\n"
            "evaluation_1,0,,7,\n"
            "evaluation_2,0,1.5,,0.5\n"
            "evaluation_2,0.20000000000000001,3,,\n");
}

}  // namespace
}  // namespace linkstudy::results_tables_test
